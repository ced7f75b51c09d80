// SPDX-License-Identifier: MIT
// Maps: reading, the comparison of names, detection.
#include "templates/map.h"

#include <doctest/doctest.h>

#include "templates/templates_helpers.h"

using namespace rigc;
using namespace rigc::templates;
using namespace rigc::templates::testing;

namespace {

tags::ForeignSkeleton bones(const std::vector<std::string>& names) {
  tags::ForeignSkeleton skeleton;
  for (const std::string& name : names) {
    skeleton.joints.emplace_back();
    skeleton.joints.back().name = name;
  }
  return skeleton;
}

std::optional<Map> read_map_text(const std::string& text, Diagnostics& diagnostics) {
  return read_map(diagnostics.sources().add("map.yaml", text), diagnostics);
}

}  // namespace

TEST_CASE("templates map: entries for joints and chains") {
  Diagnostics diagnostics;
  const auto map = read_map_text(
      "map: m\ntitle: M\nnames: humanoid\nprefixes: ['a#:']\nsuffixes: [_#]\n"
      "requires: [x, [y, z]]\njoints:\n  g.l: A\n  g.m: [B, C]\n  g: [D, [E, F]]\n",
      diagnostics);
  REQUIRE_MESSAGE(map, render(diagnostics, false));
  CHECK(map->names == Map::Names::humanoid);
  CHECK(map->required.size() == 2);
  CHECK(map->find("g", "l")->bones == std::vector<std::vector<std::string>>{{"A"}});
  CHECK(map->find("g", "m")->bones == std::vector<std::vector<std::string>>{{"B", "C"}});
  CHECK(map->find("g", "")->bones == std::vector<std::vector<std::string>>{{"D"}, {"E", "F"}});
  CHECK(map->find("h", "l") == nullptr);
}

TEST_CASE("templates map: bad maps") {
  Diagnostics diagnostics;
  CHECK_FALSE(read_map_text("map: m\nnames: nodes\njoints:\n  1a: A\n", diagnostics));
  CHECK(numbers(diagnostics) == std::vector<int>{223, 342});
  Diagnostics second;
  CHECK_FALSE(read_map_text("title: x\n", second));
  CHECK(numbers(second) == std::vector<int>{221, 221});
  Diagnostics third;
  CHECK_FALSE(find_map("mixmao", {template_folder()}, third));
  CHECK(numbers(third) == std::vector<int>{340});
  CHECK(third.all()[0].hint == "did you mean \"mixamo\"?");
}

TEST_CASE("templates map: names are compared without prefix, suffix and case") {
  Map map;
  map.prefixes = {"mixamorig#:", "mixamorig#_"};
  map.suffixes = {"_#"};
  const auto skeleton = bones({"mixamorig:Hips", "mixamorig12:Spine", "MixamoRig_Head", "Neck_07",
                               "mixamorig:", "LeftToe_End", "", "neck"});
  const BoneNames names(map, skeleton);
  CHECK(names.find("hips") == 0);
  CHECK(names.find("Spine") == 1);
  CHECK(names.find("Head") == 2);
  CHECK(names.find("Neck") == 3);
  CHECK(names.find("LeftToe_End") == 5);
  CHECK(names.find("mixamorig:") == 4);
  CHECK(names.find("Foot") == -1);
  auto skinned = skeleton;
  skinned.joints[7].in_skin = true;
  CHECK(BoneNames(map, skinned).find("Neck") == 7);
}

TEST_CASE("templates map: a line for both sides stands for one of each") {
  Diagnostics diagnostics;
  const auto map = read_map_text(
      "map: m\nsides: {l: Left, r: [Right, R]}\njoints:\n  a_{s}.b: \"{side}Arm\"\n"
      "  a_{s}: [\"{side}1\", [\"{side}2\", \"2{side}\"]]\n  c.d: Hips\n  c.e: ~\n  f: ~\n",
      diagnostics);
  REQUIRE_MESSAGE(map, render(diagnostics, false));
  using Bones = std::vector<std::vector<std::string>>;
  CHECK(map->find("a_l", "b")->bones == Bones{{"LeftArm"}});
  CHECK(map->find("a_r", "b")->bones == Bones{{"RightArm", "RArm"}});
  CHECK(map->find("a_r", "")->bones == Bones{{"Right1", "R1"}, {"Right2", "R2", "2Right", "2R"}});
  CHECK(map->find("a_l", "b")->span.line == map->find("a_r", "b")->span.line);
  CHECK(map->find("c", "d")->bones == Bones{{"Hips"}});
  CHECK_FALSE(map->find("c", "d")->absent);
  CHECK(map->find("c", "e")->absent);
  CHECK(map->find("c", "e")->bones.empty());
  CHECK(map->find("f", "")->absent);
}

TEST_CASE("templates map: bad sides, and joints that a map has twice") {
  const auto codes_of = [](const std::string& rest) {
    Diagnostics diagnostics;
    CHECK_FALSE(read_map_text("map: m\n" + rest, diagnostics));
    return numbers(diagnostics);
  };
  const std::string sides = "sides: {l: Left, r: Right}\n";
  CHECK(codes_of("joints: {\"a_{s}.b\": \"{side}Arm\"}\n") == std::vector<int>{380});
  CHECK(codes_of(sides + "joints: {\"a_{s}.b\": Arm}\n") == std::vector<int>{380});
  CHECK(codes_of(sides + "joints: {a.b: \"{side}Arm\"}\n") == std::vector<int>{380});
  CHECK(codes_of("sides: Left\njoints: {a.b: c}\n") == std::vector<int>{380});
  CHECK(codes_of("sides: {l: Left, \"1\": Right}\njoints: {a.b: c}\n") == std::vector<int>{380});
  CHECK(codes_of(sides + "joints: {\"a_{s}.b\": \"{side}A\", a_r.b: B}\n") ==
        std::vector<int>{381});
}

TEST_CASE("templates map: a user's own map is told what of it does nothing") {
  Diagnostics diagnostics;
  const auto expanded = expand_file(biped_path(), diagnostics);
  const auto map = read_map_text(
      "map: m\njoints:\n  torso.hips: Hips\n  torso.hip: Hips\n  spine: [Spine, [Spyne, x]]\n"
      "  arm_l.wrist: ~\n",
      diagnostics);
  REQUIRE(map);
  check_map(*map, *expanded, bones({"Hips", "Spine"}), diagnostics);
  CHECK(diagnostics.ok());
  CHECK(numbers(diagnostics) == std::vector<int>{382, 383});
  CHECK(diagnostics.all()[0].hint == "did you mean \"torso.hips\"?");
  CHECK(diagnostics.all()[1].hint == "did you mean \"Spine\"?");
}
