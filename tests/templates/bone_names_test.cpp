// SPDX-License-Identifier: MIT
// The comparison of bone names: words, sides, what says nothing, numbers, references to nodes.
#include "templates/bone_names.h"

#include <doctest/doctest.h>

#include "templates/templates_helpers.h"

using namespace rigc;
using namespace rigc::templates;
using namespace rigc::templates::testing;

namespace {

using Words = std::vector<std::string>;

Map generic() {
  Diagnostics diagnostics;
  const auto map = find_map("generic", {template_folder()}, diagnostics);
  REQUIRE_MESSAGE(map, render(diagnostics, false));
  return *map;
}

tags::ForeignSkeleton bones(const Words& names) {
  tags::ForeignSkeleton skeleton;
  for (const std::string& name : names) {
    skeleton.joints.emplace_back();
    skeleton.joints.back().name = name;
    skeleton.joints.back().node = 10 + static_cast<int>(skeleton.joints.size());
  }
  return skeleton;
}

}  // namespace

TEST_CASE("templates bone_names: words end at separators, case changes and digits") {
  CHECK(words_of("LeftUpLeg") == Words{"left", "up", "leg"});
  CHECK(words_of("upper_arm.L") == Words{"upper", "arm", "l"});
  CHECK(words_of("Bip01 L UpperArm") == Words{"bip", "01", "l", "upper", "arm"});
  CHECK(words_of("CC_Base_L_Upperarm") == Words{"cc", "base", "l", "upperarm"});
  CHECK(words_of("IKHand") == Words{"ik", "hand"});
  CHECK(words_of("lThighBend") == Words{"l", "thigh", "bend"});
  CHECK(words_of("rig|ns:spine-02") == Words{"rig", "ns", "spine", "02"});
  CHECK(words_of("--__ ").empty());
  CHECK(words_of("").empty());
}

TEST_CASE("templates bone_names: the side may stand anywhere, and what says nothing is left out") {
  const Map map = generic();
  const auto same = [&](const std::string& a, const std::string& b) {
    INFO(a << " -> " << key_of(map, a).text << ", " << b << " -> " << key_of(map, b).text);
    return key_of(map, a).text == key_of(map, b).text;
  };
  for (const char* arm :
       {"LeftUpperArm", "upperarm_l", "L_UpperArm", "Upper Arm.Left", "CC_Base_L_Upperarm",
        "Bip01 L UpperArm", "Bip001 L UpperArm", "ValveBiped.Bip01_L_UpperArm", "DEF-upper_arm.L",
        "l_upper_arm_jnt", "J_Bip_L_UpperArm", "LEFT-UPPER-ARM", "bone_upperarm_lft"})
    CHECK(same(arm, "left upper arm"));
  CHECK_FALSE(same("RightUpperArm", "left upper arm"));
  CHECK(same("spine_01", "Spine1"));
  CHECK(same("spine_001", "spine 1"));
  CHECK_FALSE(same("spine_1_2", "spine_12"));
  CHECK(key_of(map, "L").side.empty());
  CHECK(key_of(map, "bone").words == Words{"bone"});
}

TEST_CASE("templates bone_names: numbers as written decide between Finger1 and Finger01") {
  const Map map = generic();
  const auto skeleton = bones({"Bip01 L Finger0", "Bip01 L Finger01", "Bip01 L Finger1"});
  const BoneNames names(map, skeleton);
  CHECK(names.find("left finger 01") == 1);
  CHECK(names.find("left finger 1") == 2);
  CHECK(names.find("left finger 001") >= 1);
  CHECK(names.find("right finger 1") == -1);
}

TEST_CASE("templates bone_names: namespaces and serial numbers of exporters are cut") {
  const Map map = generic();
  CHECK(BoneNames(map, bones({"hero:rig:LeftArm", "x:"})).find("left arm") == 0);
  Words names;
  for (const char* name : {"Hips", "Spine", "Spine1", "LeftArm", "RightArm", "Head", "Neck",
                           "LeftLeg", "RightLeg", "LeftFoot"})
    names.push_back(std::string(name) + "_0" + std::to_string(names.size() + 1));
  const BoneNames serial(map, bones(names));
  CHECK(serial.find("spine 1") == 2);
  CHECK(serial.find("left foot") == 9);
  names[3] = "LeftArm_01";  // a number twice: these count something else
  CHECK(BoneNames(map, bones(names)).find("left foot") == -1);
}

TEST_CASE("templates bone_names: case decides between names that differ in nothing else") {
  Map map;
  const BoneNames names(map, bones({"HEAD", "head", "Neck"}));
  CHECK(names.find("head") == 1);
  CHECK(names.find("HEAD") == 0);
  CHECK(names.find("Head") == 0);
  CHECK(names.find("neck") == 2);
}

TEST_CASE("templates bone_names: a bone may be given by its node") {
  Map map;
  const auto skeleton = bones({"a", "", "a"});
  const BoneNames names(map, skeleton);
  CHECK(names.find("/nodes/12") == 1);
  CHECK(names.find("/nodes/13") == 2);
  CHECK(names.find("/nodes/99") == -1);
  CHECK(names.find("a") == 0);
  CHECK(node_reference("/nodes/0") == 0);
  for (const char* bad : {"/nodes/", "/nodes/-1", "/nodes/1x", "/nodes/99999999999", "nodes/1"})
    CHECK_FALSE(node_reference(bad));
}
