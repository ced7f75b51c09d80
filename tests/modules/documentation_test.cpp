// SPDX-License-Identifier: MIT
// The code that docs/adding_a_module.md shows is the code of the files that it names.
#include <doctest/doctest.h>

#include <fstream>
#include <sstream>

#include "base/text.h"

namespace {

std::string file_text(const std::string& path) {
  std::ifstream in(std::string(RIGC_SOURCE_DIR) + "/" + path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

}  // namespace

TEST_CASE("modules documentation: adding_a_module shows what its files say") {
  const std::string page = file_text("docs/adding_a_module.md");
  int blocks = 0;
  std::string block, file;
  for (const std::string_view line : rigc::split(page, '\n')) {
    if (!line.starts_with("```")) {
      if (!file.empty()) (block += line) += '\n';
      continue;
    }
    if (!file.empty()) {
      INFO(file << " does not have\n" << block);
      CHECK(file_text(file).find(block) != std::string::npos);
      ++blocks;
      file.clear();
      block.clear();
    } else if (const auto blank = line.find(' '); blank != std::string_view::npos) {
      file = line.substr(blank + 1);
    }
  }
  CHECK(blocks >= 8);
}
