// SPDX-License-Identifier: MIT
// The templates that come with rigc: all read, expand and stand; tutorials open with words.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "base/files.h"
#include "base/text.h"
#include "templates/templates_helpers.h"

using namespace rigc;
using namespace rigc::templates;
using namespace rigc::templates::testing;

namespace {

std::vector<std::string> yaml_files(const std::string& folder) {
  std::vector<std::string> files;
  for (const std::string& file : list_folder(folder))
    if (ends_with(file, ".yaml")) files.push_back(join_path(folder, file));
  return files;
}

}  // namespace

TEST_CASE("templates shipped: characters, props and tutorials have no errors") {
  std::vector<std::string> files = yaml_files(template_folder());
  const std::vector<std::string> tutorials = yaml_files(template_folder() + "/tutorial");
  CHECK(files.size() >= 6);
  CHECK(tutorials.size() >= 10);
  files.insert(files.end(), tutorials.begin(), tutorials.end());
  for (const std::string& file : files) {
    Diagnostics diagnostics;
    const auto expanded = expand_file(file, diagnostics);
    const auto placed = expanded ? place(*expanded, diagnostics) : std::nullopt;
    CHECK_MESSAGE(placed, render(diagnostics, false));
    CHECK(diagnostics.all().empty());
  }
}

TEST_CASE("templates shipped: a tutorial opens with a comment that teaches") {
  for (const std::string& file : yaml_files(template_folder() + "/tutorial")) {
    Diagnostics diagnostics;
    const auto text = read_file(file, 1u << 20, diagnostics);
    REQUIRE(text);
    const std::size_t head = text->find("\nrigc: 1");
    REQUIRE(head != std::string::npos);
    CHECK_MESSAGE(head > 200, file);
    CHECK_MESSAGE((*text)[0] == '#', file);
  }
}

TEST_CASE("templates shipped: every joint of the biped that a model must have is in every map") {
  Diagnostics diagnostics;
  const auto expanded = expand_file(biped_path(), diagnostics);
  REQUIRE(expanded);
  for (const std::string& file : yaml_files(template_folder() + "/maps")) {
    const auto map = find_map(file, {}, diagnostics);
    REQUIRE_MESSAGE(map, render(diagnostics, false));
    CHECK(map->name == stem_of(file));
    for (const ExpandedJoint& joint : expanded->joints) {
      const Identifiers& ids = joint.tagged.ids;
      if (joint.tagged.optional || joint.helper) continue;
      CHECK_MESSAGE(map->find(ids.local, ids.label), file, ids.local, ids.label);
    }
  }
}

TEST_CASE("templates shipped: every part is used by a template, and README lists the templates") {
  Diagnostics diagnostics;
  const auto readme = read_file(std::string(RIGC_SOURCE_DIR) + "/README.md", 1u << 20, diagnostics);
  REQUIRE(readme);
  std::set<std::string> used;
  for (const std::string& file : yaml_files(template_folder())) {
    CHECK_MESSAGE(readme->find("| `" + stem_of(file) + "` |") != std::string::npos, file);
    const auto expanded = expand_file(file, diagnostics);
    REQUIRE_MESSAGE(expanded, render(diagnostics, false));
    for (const auto& part : expanded->skeleton.templates) used.insert(part.name);
  }
  for (const std::string& file : yaml_files(template_folder() + "/parts"))
    CHECK_MESSAGE(used.contains(stem_of(file)), file);
}

TEST_CASE("templates shipped: both sides of a creature have the same joints, mirrored") {
  for (const char* name : {"biped", "biped_tail", "quadruped", "winged"}) {
    CAPTURE(std::string(name));
    Diagnostics diagnostics;
    const auto expanded = expand_file(template_folder() + "/" + name + ".yaml", diagnostics);
    const auto placed = expanded ? place(*expanded, diagnostics) : std::nullopt;
    REQUIRE_MESSAGE(placed, render(diagnostics, false));
    std::size_t sided = 0;
    for (std::size_t i = 0; i < placed->joints.size(); ++i) {
      const math::Vec3 here = placed->world(i).origin;
      CHECK(here.y >= 0);
      if (here.x < 1e-6 && here.x > -1e-6) continue;
      ++sided;
      const int other = placed->find(placed->joints[i].mirror.opposite);
      REQUIRE_MESSAGE(other >= 0, placed->joints[i].name);
      const math::Vec3 there = placed->world(static_cast<std::size_t>(other)).origin;
      CHECK(math::length(there - math::Vec3{-here.x, here.y, here.z}) < 1e-9);
    }
    CHECK(sided >= 10);
  }
}

TEST_CASE("templates shipped: the hand as a mirrored part is a right hand") {
  const Folder folder("right_hand");
  Diagnostics diagnostics;
  const std::string text = with_head("parts: [{template: hand, as: right, mirror: x}]\n");
  const auto right =
      place(expand_file(folder.write("right.yaml", text), diagnostics, {template_folder()}).value(),
            diagnostics);
  const auto left =
      place(expand_file(template_folder() + "/hand.yaml", diagnostics).value(), diagnostics);
  REQUIRE_MESSAGE((left && right), render(diagnostics, false));
  REQUIRE(left->joints.size() == 25);  // as many as WebXR has
  REQUIRE(right->joints.size() == left->joints.size());
  for (std::size_t i = 0; i < left->joints.size(); ++i) {
    CHECK(right->joints[i].name == "right_" + left->joints[i].name);
    const math::Vec3 l = left->world(i).origin, r = right->world(i).origin;
    CHECK(math::length(r - math::Vec3{-l.x, l.y, l.z}) < 1e-9);
  }
  // Palm to the front and fingers up, a left hand has its thumb on the right.
  CHECK(left->world(joint_named(*left, "hand_thumb_tip")).origin.x < -0.05);
  CHECK(left->world(joint_named(*left, "hand_middle_tip")).origin.y > 0.15);
}

TEST_CASE("templates shipped: user maps of creatures name joints that their templates have") {
  const std::pair<const char*, const char*> maps[] = {{"fox", "quadruped"},
                                                      {"enemy", "quadruped"},
                                                      {"trex", "biped_tail"},
                                                      {"hand", "hand"},
                                                      {"bat", "winged"}};
  for (const auto& pair : maps) {
    const std::string name = pair.first, creature = pair.second;
    CAPTURE(name);
    Diagnostics diagnostics;
    const auto map =
        find_map(std::string(RIGC_SOURCE_DIR) + "/tests/maps/" + name + ".yaml", {}, diagnostics);
    const auto expanded = expand_file(template_folder() + "/" + creature + ".yaml", diagnostics);
    REQUIRE_MESSAGE((map && expanded), render(diagnostics, false));
    CHECK(map->entries.size() >= 9);
    for (const MapEntry& entry : map->entries) {
      const bool found =
          std::any_of(expanded->joints.begin(), expanded->joints.end(), [&](const auto& joint) {
            return joint.tagged.ids.local == entry.local && joint.tagged.ids.label == entry.label;
          });
      CHECK_MESSAGE(found, entry.local, ".", entry.label);
    }
  }
}
