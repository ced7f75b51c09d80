// SPDX-License-Identifier: MIT
// The code that pages of docs/ show is the code of the files that they name.
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

// Blocks that begin with "```language file" are in that file, to the letter; how many there are.
int check_blocks(const std::string& page) {
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
  return blocks;
}

}  // namespace

TEST_CASE("modules documentation: pages show what their files say") {
  CHECK(check_blocks(file_text("docs/adding_a_module.md")) >= 8);
  CHECK(check_blocks(file_text("docs/evaluation.md")) >= 8);
}
