// SPDX-License-Identifier: MIT
// rigc_embed, the build step that compiles descriptors and shapes in: it refuses two shapes of one
// name.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "cli/process_helpers.h"

namespace fs = std::filesystem;

TEST_CASE("cli embed: a shape that stands in two files is an error and nothing is generated") {
  const fs::path folder = rigc::test::fresh_folder("embed");
  const std::string embed =
      (fs::path(rigc::test::rigc_binary()).parent_path() / "rigc_embed").string();
  std::ofstream(folder / "a.yaml") << "line: {help: A line., lines: [[[0, 0, 0], [1, 0, 0]]]}\n";
  std::ofstream(folder / "b.yaml") << "line: {help: The same., lines: [[[0, 0, 0], [0, 0, 1]]]}\n";
  const auto twice =
      rigc::test::run_program(embed, {"out.cpp", "--shapes", "a.yaml", "b.yaml"}, {folder, {}});
  CHECK(twice.status == 1);
  CHECK(twice.err.find("b.yaml:1:1: error[RIG0126]") != std::string::npos);
  CHECK_FALSE(fs::exists(folder / "out.cpp"));
  const auto once = rigc::test::run_program(embed, {"out.cpp", "--shapes", "a.yaml"}, {folder, {}});
  INFO(once.err);
  CHECK(once.status == 0);
  CHECK(fs::exists(folder / "out.cpp"));
  fs::remove(folder / "out.cpp");
}
