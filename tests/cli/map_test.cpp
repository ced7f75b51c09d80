// SPDX-License-Identifier: MIT
// rigc map on the command line: the file it writes serves the command that it names next.
#include <doctest/doctest.h>

#include <fstream>
#include <string>

#include "cli/json_helpers.h"
#include "cli/process_helpers.h"

namespace fs = std::filesystem;
using rigc::test::run_rigc;

TEST_CASE("cli map: a guess is written, printed and understood by build") {
  if (rigc::test::corpus_folder().empty()) {
    MESSAGE("the corpus is not here: rigc map is not tested");
    return;
  }
  const fs::path here = rigc::test::fresh_folder("map");
  const std::string model =
      (rigc::test::corpus_folder() / "khronos_CesiumMan/CesiumMan.glb").string();
  const auto written = run_rigc({"map", model, "-o", "man.yaml"}, {here, {}});
  INFO(written.err);
  REQUIRE(written.status == 0);
  CHECK(written.out.find("0 required not found") != std::string::npos);
  CHECK(written.out.find("rigc build biped --model " + model + " --map man.yaml") !=
        std::string::npos);
  const std::string text = rigc::test::file_text(here / "man.yaml");
  CHECK(text.find("map: man\n") != std::string::npos);

  const auto built = run_rigc(
      {"build", "biped", "--model", model, "--map", "man.yaml", "-o", "man.glb"}, {here, {}});
  CHECK_MESSAGE(built.status == 0, built.err);
  std::ofstream(here / "man.glb.model") << model << "\n";

  const auto printed = run_rigc({"map", model}, {here, {}});
  CHECK(printed.status == 0);
  CHECK(printed.out.find("joints:\n") != std::string::npos);
  const auto json = run_rigc({"map", model, "--json"}, {here, {}});
  CHECK(json.status == 0);
  CHECK(rigc::test::is_json(json.out));
  CHECK(rigc::test::json_at(json.out, "/joints/0/local") == "\"root\"");
}

TEST_CASE("cli map: what cannot be read or written is refused") {
  if (rigc::test::corpus_folder().empty()) return;
  const fs::path here = rigc::test::fresh_folder("map_refused");
  const std::string model =
      (rigc::test::corpus_folder() / "khronos_CesiumMan/CesiumMan.glb").string();
  CHECK(run_rigc({"map"}, {here, {}}).status == 2);
  CHECK(run_rigc({"map", "absent.glb", "-o", "x.yaml"}, {here, {}}).status != 0);
  CHECK_FALSE(fs::exists(here / "x.yaml"));
  CHECK(run_rigc({"map", model, "-o", "no/such/folder/x.yaml"}, {here, {}}).status == 3);
}
