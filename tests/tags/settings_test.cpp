// SPDX-License-Identifier: MIT
// Settings: texts of the command line, and what they turn on and off.
#include "tags/settings.h"

#include <doctest/doctest.h>

using namespace rigc;
using namespace rigc::tags;

namespace {

/// Joints arm_l and leg_l, each with the feature ikfk (switch arms or legs) and with stretch, which
/// is off.
TaggedSkeleton limbs() {
  TaggedSkeleton skeleton;
  skeleton.global = "case";
  skeleton.features = {{"ikfk", "limb", "", "", true, {"arms", "legs"}},
                       {"stretch", "limb", "", "", false, {"arms", "legs"}}};
  for (const char* limb : {"arm", "leg"}) {
    TaggedJoint joint;
    joint.ids = {"case", std::string(limb) + "_l", ""};
    const std::string switch_name = std::string(limb) + "s";
    joint.features = {{"ikfk", "limb", switch_name, true, {}},
                      {"stretch", "limb", switch_name, false, {}}};
    joint.commands.resize(2);
    joint.commands[0].feature = 0;
    joint.commands[1].feature = 1;
    skeleton.joints.push_back(joint);
  }
  return skeleton;
}

/// `on` of arm ikfk, arm stretch, leg ikfk, leg stretch.
std::vector<bool> applied(const std::vector<std::string>& texts) {
  Diagnostics diagnostics;
  Settings settings;
  for (const std::string& text : texts) {
    const auto setting = parse_feature_setting(text, diagnostics);
    REQUIRE(setting);
    settings.features.push_back(*setting);
  }
  TaggedSkeleton skeleton = limbs();
  REQUIRE_MESSAGE(apply(skeleton, settings, diagnostics), render(diagnostics, false));
  std::vector<bool> on;
  for (const TaggedJoint& joint : skeleton.joints)
    for (const FeatureTag& feature : joint.features) on.push_back(feature.on);
  return on;
}

std::vector<int> errors(const std::vector<Settings::Feature>& features,
                        const std::vector<std::pair<std::string, bool>>& groups = {}) {
  Settings settings;
  settings.features = features;
  settings.groups = groups;
  TaggedSkeleton skeleton = limbs();
  Diagnostics diagnostics;
  CHECK_FALSE(apply(skeleton, settings, diagnostics));
  CHECK(skeleton.joints[0].features[0].on);
  std::vector<int> found;
  for (const Diagnostic& diagnostic : diagnostics.all()) found.push_back(diagnostic.code->number);
  return found;
}

}  // namespace

TEST_CASE("tags settings: texts") {
  Diagnostics diagnostics;
  const auto full = parse_feature_setting("arm_l/ikfk:arms=off", diagnostics);
  REQUIRE(full);
  CHECK(full->group == "arm_l");
  CHECK(full->name == "ikfk");
  CHECK(full->switch_name == "arms");
  CHECK_FALSE(full->on);
  CHECK(parse_feature_setting("ikfk=on", diagnostics)->on);
  CHECK(parse_group_setting("arm_l=off", diagnostics) == std::pair(std::string("arm_l"), false));
  CHECK(diagnostics.ok());
  for (const char* text :
       {"", "ikfk", "ikfk=", "=on", "ikfk=maybe", "/ikfk=on", "a/b/c=on", "ikfk:=on", "a b=on"})
    CHECK_FALSE(parse_feature_setting(text, diagnostics));
  CHECK_FALSE(parse_group_setting("arm l=on", diagnostics));
  CHECK(diagnostics.errors() == 10);
  for (const Diagnostic& diagnostic : diagnostics.all()) CHECK(diagnostic.code->number == 200);
}

TEST_CASE("tags settings: features, switches and groups of features") {
  using On = std::vector<bool>;
  CHECK(applied({}) == On{true, false, true, false});
  CHECK(applied({"ikfk=off"}) == On{false, false, false, false});
  CHECK(applied({"ikfk:arms=off"}) == On{false, false, true, false});
  CHECK(applied({"stretch=on"}) == On{true, true, true, true});
  CHECK(applied({"stretch:legs=on"}) == On{true, false, true, true});
  CHECK(applied({"ikfk=off", "ikfk:arms=on"}) == On{false, false, false, false});
  CHECK(applied({"leg_l/ikfk=off"}) == On{true, false, false, false});
  CHECK(applied({"leg_l/ikfk=on", "ikfk=off"}) == On{false, false, true, false});
  CHECK(applied({"ikfk=off", "ikfk=on"}) == On{true, false, true, false});
}

TEST_CASE("tags settings: a group's setting counts for those made beneath it, the nearest first") {
  const auto on = [](const std::vector<std::string>& texts) {
    TaggedSkeleton skeleton = limbs();
    skeleton.joints[0].ids.local = "arm_l_hand_index";
    skeleton.groups = {{"arm_l_hand_index", "arm_l_hand"}, {"arm_l_hand", "arm_l"}};
    Diagnostics diagnostics;
    Settings settings;
    for (const std::string& text : texts)
      settings.features.push_back(*parse_feature_setting(text, diagnostics));
    REQUIRE_MESSAGE(apply(skeleton, settings, diagnostics), render(diagnostics, false));
    return std::pair(skeleton.joints[0].features[0].on, skeleton.joints[1].features[0].on);
  };
  CHECK(on({"arm_l/ikfk=off"}) == std::pair(false, true));
  CHECK(on({"arm_l_hand/ikfk=on", "arm_l/ikfk=off", "ikfk=off"}) == std::pair(true, false));
  CHECK(on({"ikfk=off", "arm_l/ikfk=on"}) == std::pair(true, false));
  CHECK(on({"arm_l/ikfk=on", "arm_l/ikfk=off"}) == std::pair(false, true));
  // A file may say anything.
  TaggedSkeleton round = limbs();
  round.groups = {{"arm_l", "leg_l"}, {"leg_l", "arm_l"}};
  Diagnostics diagnostics;
  CHECK(apply(round, {{{"arm_l", "ikfk", "", false}}, {}, "bind", false}, diagnostics));
}

TEST_CASE("tags settings: a group that is off has no commands on") {
  TaggedSkeleton skeleton = limbs();
  Settings settings;
  settings.groups = {{"arm_l", false}};
  Diagnostics diagnostics;
  REQUIRE(apply(skeleton, settings, diagnostics));
  CHECK_FALSE(skeleton.joints[0].commands[0].on);
  CHECK(skeleton.joints[1].commands[0].on);
}

TEST_CASE("tags settings: unknown names are errors and change nothing") {
  CHECK(
      errors({{"", "ikkf", "", false}, {"", "ikfk", "tails", false}, {"arm_x", "ikfk", "", false}},
             {{"leg_x", false}}) == std::vector<int>{201, 202, 203, 203});
  CHECK(errors({{"arm_l", "ikfk", "legs", false}}) == std::vector<int>{202});
}

TEST_CASE("tags settings: the rig's name goes to the joints that had the old one") {
  TaggedSkeleton skeleton = limbs();
  skeleton.joints[1].ids.global = "other";
  set_global(skeleton, "hero");
  CHECK(skeleton.global == "hero");
  CHECK(skeleton.joints[0].ids.global == "hero");
  CHECK(skeleton.joints[1].ids.global == "other");
}
