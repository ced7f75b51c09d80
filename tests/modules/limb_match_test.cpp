// SPDX-License-Identifier: MIT
// The node that says how a limb is keyed in FK and in IK names what the modules made.
#include <doctest/doctest.h>

#include "modules/bodies_helpers.h"
#include "support/rig.h"

using namespace rigc;

namespace {

std::string limb_with(const std::string& more) {
  return test::limb("[0, 1, 0]", "[0, 0.5, 0.1]", "[0, 0.1, 0]",
                    {{"upper",
                      "{command: ik_fk_limb, with: {start: ., middle: limb.lower, end: "
                      "limb.end}}\n" +
                          more}});
}

}  // namespace

TEST_CASE("modules limb match: the rig names joints, controls and attributes by their meaning") {
  namespace match = scene::match;
  const test::Rig rig(limb_with("{command: limb_stretch, with: {limb: limb/ik_fk_limb.ik}}"));
  REQUIRE(rig.clean());
  const scene::Scene& scene = rig.scene();
  const scene::NodeId node = rig.node("limb/ik_fk_limb.driver::match");
  CHECK(std::get<std::string>(scene.value({node, match::kLimb})) == "limb");
  const char* joints[] = {"limb.upper", "limb.lower", "limb.end"};
  for (std::int32_t i = 0; i < 3; ++i) {
    CHECK(scene.source({node, match::kJoints, i})->node == rig.node(joints[i]));
    CHECK(scene.source({node, match::kFk, i})->node ==
          rig.node(std::string(joints[i]) + "/ik_fk_limb.fk"));
  }
  CHECK(scene.source({node, match::kIk})->node == rig.node("limb/ik_fk_limb.ik"));
  CHECK(scene.source({node, match::kPole})->node == rig.node("limb/ik_fk_limb.pole"));
  CHECK(*scene.source({node, match::kSwitch}) == rig.plug("limb/ik_fk_limb.settings@ik_fk"));
  const std::string words = std::get<std::string>(scene.value({node, match::kMeanings}));
  CHECK(words ==
        "upper_twist lower_twist upper_length lower_length fk_upper_length fk_lower_length "
        "stretch squash soft slide pin");
  CHECK(*scene.source({node, match::kNumbers, 1}) == rig.plug("limb/ik_fk_limb.ik@lower_twist"));
  CHECK(*scene.source({node, match::kNumbers, 4}) == rig.plug("limb.upper/ik_fk_limb.fk@length"));
  CHECK(*scene.source({node, match::kNumbers, 10}) == rig.plug("limb/ik_fk_limb.pole@pin"));
  CHECK(scene[node].attributes[match::kNumbers].size() == 11);
}
