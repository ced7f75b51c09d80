// SPDX-License-Identifier: MIT
// RIGC_ISA, as users set it: the same bytes for every instruction set, and wrong values refused.
#include "eval/isa.h"

#include <doctest/doctest.h>

#include "cli/process_helpers.h"

namespace fs = std::filesystem;
using rigc::test::Outcome;
using rigc::test::run_rigc;
using rigc::test::Surroundings;

namespace {

Surroundings with_isa(const fs::path& folder, const std::string& isa) {
  return {folder, {{"RIGC_ISA", isa}}};
}

TEST_CASE("cli isa: builds and bakes write the same bytes with every instruction set") {
  const fs::path folder = rigc::test::fresh_folder("cli_isa");
  const std::string biped = (rigc::test::source_folder() / "templates/biped.yaml").string();
  std::string rig, baked;
  for (const rigc::eval::Isa isa : rigc::eval::available_isas()) {
    const Surroundings here = with_isa(folder, std::string(rigc::eval::name(isa)));
    const std::string out = std::string(rigc::eval::name(isa)) + ".glb";
    REQUIRE(run_rigc({"build", biped, "-o", "rig_" + out}, here).status == 0);
    REQUIRE(run_rigc({"bake", "rig_" + out, "-o", "baked_" + out}, here).status == 0);
    const std::string own_rig = rigc::test::file_text(folder / ("rig_" + out));
    const std::string own_baked = rigc::test::file_text(folder / ("baked_" + out));
    REQUIRE(!own_rig.empty());
    REQUIRE(!own_baked.empty());
    CHECK((rig.empty() || rig == own_rig));
    CHECK((baked.empty() || baked == own_baked));
    rig = own_rig;
    baked = own_baked;
  }
}

TEST_CASE("cli isa: another value is wrong usage") {
  const fs::path folder = rigc::test::fresh_folder("cli_isa_wrong");
  const Outcome wrong = run_rigc({"modules"}, with_isa(folder, "avx3"));
  CHECK(wrong.status == 2);
  CHECK(wrong.err.find("RIGC_ISA is \"avx3\"; this machine runs baseline") != std::string::npos);
  CHECK(wrong.out.empty());
  CHECK(run_rigc({"modules"}, with_isa(folder, "")).status == 0);
}

}  // namespace
