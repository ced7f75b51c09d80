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
  CHECK(map->humanoid);
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

TEST_CASE("templates map: detection needs the required bones and takes the map that finds most") {
  const Folder folder("map_detect");
  folder.write("maps/a.yaml", "map: a\nrequires: [Root]\njoints: {g.x: A, g.y: B}\n");
  folder.write("maps/b.yaml",
               "map: b\nrequires: [[Pelvis, Root]]\njoints: {g.x: A, g.y: B, g.z: C}\n");
  folder.write("maps/c.yaml",
               "map: c\nrequires: [Nothing]\njoints: {g.x: A, g.y: B, g.z: C, g.w: Root}\n");
  Diagnostics diagnostics;
  CHECK(detect_map(bones({"Root", "A", "B"}), {folder.path()}, diagnostics)->name == "a");
  CHECK(detect_map(bones({"Root", "A", "B", "C"}), {folder.path()}, diagnostics)->name == "b");
  CHECK(diagnostics.ok());
  CHECK_FALSE(detect_map(bones({"A", "B", "C"}), {folder.path()}, diagnostics));
  CHECK(numbers(diagnostics) == std::vector<int>{341});
  Diagnostics second;
  CHECK(detect_map(bones({"mixamorig1:Hips"}), {template_folder()}, second)->name == "mixamo");
}
