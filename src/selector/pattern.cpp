// SPDX-License-Identifier: MIT
// The grammar of selectors as a regular expression. Test: tests/selector/pattern_test.cpp
#include "selector/pattern.h"

#include <fmt/format.h>

namespace rigc::selector {

std::string pattern(Wanted wanted) {
  const std::string name = "[A-Za-z_][A-Za-z0-9_-]*";
  const std::string end = "(-?[0-9]+|START|MIDDLE|END)";
  const std::string item = fmt::format(R"([ \t\r\n]*(\*|{0}(\.\.{0})?)[ \t\r\n]*)", end);
  const std::string indices = fmt::format(R"(\[{0}(,{0})*\])", item);
  const std::string group = fmt::format(R"(({0}:)?{0}(\.{0}|{1})?)", name, indices);
  const std::string made = fmt::format(R"(/(\*|{0})(#{0})?(\.{0})?({1})?)", name, indices);
  const std::string attribute =
      wanted == Wanted::plug ? fmt::format(R"(@{}(\.[xyzw])?)", name) : "";
  const std::string choice =
      fmt::format(R"([ \t\r\n]*(\.\.?|{})({})?(::{})?{}[ \t\r\n]*)", group, made, name, attribute);
  return fmt::format(R"(^{0}(\|{0})*(\?[ \t\r\n]*)?$)", choice);
}

}  // namespace rigc::selector
