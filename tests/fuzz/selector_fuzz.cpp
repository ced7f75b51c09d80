// SPDX-License-Identifier: MIT
// Any text as a selector and as an expression: what parses is printed, and the print parses to the
// same thing and prints the same.
#include <cstdint>
#include <string_view>

#include "selector/selector.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace rigc;

void selector_round_trip(std::string_view text, Diagnostics& diagnostics) {
  const fuzz::Stage stage(diagnostics);
  auto first = selector::parse(text, {}, diagnostics);
  if (!stage.ended(first.has_value(), "parse: empty exactly when an error was reported")) return;
  const std::string printed = selector::print(*first);
  const auto second = selector::parse(printed, {}, diagnostics);
  fuzz::expect(second.has_value(), "a printed selector parses");
  fuzz::expect(*second == *first, "a printed selector is the same selector");
  fuzz::expect(selector::print(*second) == printed, "printing is stable");
  selector::rename_groups(*first, {{"arm_l", "arm_r"}, {"arm_r", "arm_l"}});
  selector::rename_groups(*first, {{"arm_l", "arm_r"}, {"arm_r", "arm_l"}});
  fuzz::expect(*first == *second, "groups exchanged twice are as they were");
}

void expression_round_trip(std::string_view text, Diagnostics& diagnostics) {
  const fuzz::Stage stage(diagnostics);
  const auto first = selector::parse_expression(text, {}, diagnostics);
  if (!stage.ended(first.has_value(), "parse_expression: empty exactly when an error was reported"))
    return;
  fuzz::expect(first->pieces.size() == first->selectors.size() + 1, "a piece around each selector");
  const std::string printed = selector::print(*first);
  const auto second = selector::parse_expression(printed, {}, diagnostics);
  fuzz::expect(second.has_value(), "a printed expression parses");
  fuzz::expect(second->pieces == first->pieces && second->selectors == first->selectors,
               "a printed expression is the same expression");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  Diagnostics diagnostics;
  selector_round_trip(text, diagnostics);
  expression_round_trip(text, diagnostics);
  render(diagnostics, true);
  return 0;
}
