// SPDX-License-Identifier: MIT
// rigc guides on the command line, and the file that it writes with build and rebuild.
#include <doctest/doctest.h>

#include <fstream>

#include "cli/json_helpers.h"
#include "cli/process_helpers.h"

namespace fs = std::filesystem;
using rigc::test::run_rigc;

namespace {

void replace_in(const fs::path& file, const std::string& from, const std::string& to) {
  std::string text = rigc::test::file_text(file);
  REQUIRE(text.find(from) != std::string::npos);
  text.replace(text.find(from), from.size(), to);
  std::ofstream(file) << text;
}

}  // namespace

TEST_CASE("cli guides: written, edited, written again, built and rebuilt with") {
  const fs::path here = rigc::test::fresh_folder("guides");
  const auto rigc = [&](const std::vector<std::string>& arguments) {
    auto outcome = run_rigc(arguments, {here, {}});
    CHECK_MESSAGE(outcome.status == 0, outcome.err);
    return outcome;
  };
  CHECK(rigc({"guides", "biped", "-o", "g.yaml"}).out.find("0 moved") != std::string::npos);
  rigc({"build", "biped", "-o", "plain.glb"});
  replace_in(here / "g.yaml", "arm_l.wrist:                  {at: [0.705, 1.42",
             "arm_l.wrist:                  {at: [0.705, 1.44");
  CHECK(rigc({"guides", "biped", "-o", "g.yaml"}).out.find("1 moved") != std::string::npos);
  CHECK(rigc::test::file_text(here / "g.yaml").find("[0.705, 1.44") != std::string::npos);
  rigc({"build", "biped", "--guides", "g.yaml", "-o", "moved.glb"});
  CHECK(rigc::test::file_text(here / "plain.glb") != rigc::test::file_text(here / "moved.glb"));
  CHECK(
      rigc({"rebuild", "plain.glb", "--guides", "g.yaml", "--plan"}).out.find("would be changed") !=
      std::string::npos);
  CHECK(rigc({"rebuild", "plain.glb", "--guides", "g.yaml"}).out.find("20 mm") !=
        std::string::npos);
  CHECK(rigc({"guides", "biped"}).out.find("guides: biped\n") != std::string::npos);
  const auto json = rigc({"guides", "biped", "--json", "-o", "g.yaml"});
  CHECK(rigc::test::json_at(json.out, "/moved") == "1");
  CHECK(rigc::test::is_json(rigc({"schema", "guides"}).out));
}

TEST_CASE("cli guides: a file that is no guides is not written over, nor built with") {
  const fs::path here = rigc::test::fresh_folder("guides_refused");
  std::ofstream(here / "other.yaml") << "rigc: 1\nname: other\nversion: 1\n";
  std::ofstream(here / "bad.yaml") << "guides: biped\njoints:\n  arm_l.elbo: [0, nan, 0]\n";
  CHECK(run_rigc({"guides", "biped", "-o", "other.yaml"}, {here, {}}).status == 1);
  CHECK(rigc::test::file_text(here / "other.yaml") == "rigc: 1\nname: other\nversion: 1\n");
  const auto bad = run_rigc({"build", "biped", "--guides", "bad.yaml", "-o", "x.glb"}, {here, {}});
  CHECK(bad.status == 1);
  CHECK(bad.err.find("bad.yaml:3:19: error[RIG0040]") != std::string::npos);
  CHECK(run_rigc({"build", "biped", "--guides", "absent.yaml", "-o", "x.glb"}, {here, {}}).status !=
        0);
  CHECK_FALSE(fs::exists(here / "x.glb"));
}
