// SPDX-License-Identifier: MIT
// Guesses: by names, by words, and on skeletons without names by hierarchy and place alone.
#include "templates/map_guess.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "templates/templates_helpers.h"

using namespace rigc;
using namespace rigc::templates;
using namespace rigc::templates::testing;

namespace {

struct Biped {
  Diagnostics diagnostics;
  std::optional<Expanded> expanded = expand_file(biped_path(), diagnostics);
  std::optional<tags::TaggedSkeleton> placed = place(*expanded, diagnostics);
};

const Biped& biped() {
  static const Biped kBiped;
  return kBiped;
}

Guess guess(const tags::ForeignSkeleton& skeleton) {
  Diagnostics diagnostics;
  const auto guess = guess_map(*biped().expanded, skeleton, {template_folder()}, diagnostics);
  REQUIRE_MESSAGE(guess, render(diagnostics, false));
  CHECK(diagnostics.all().empty());
  return *guess;
}

const GuessLine& line(const Guess& guess, const std::string& joint) {
  for (const GuessLine& line : guess.lines)
    if (line.joint == joint) return line;
  FAIL("no line ", joint);
  return guess.lines.front();
}

/// The joint's bone by its node; -1: none.
int node_of(const Guess& guess, const tags::ForeignSkeleton& skeleton, const std::string& joint) {
  const GuessLine& found = line(guess, joint);
  return found.bones.empty() ? -1
                             : skeleton.joints[static_cast<std::size_t>(found.bones.front())].node;
}

const std::vector<std::string> kBody = {
    "hips",        "spine_chest",    "head_head",   "arm_l_shoulder", "arm_l_elbow",
    "arm_l_wrist", "arm_r_shoulder", "arm_r_elbow", "arm_r_wrist",    "leg_l_hip",
    "leg_l_knee",  "leg_l_ankle",    "leg_r_hip",   "leg_r_knee",     "leg_r_ankle"};

std::string named(const tags::TaggedJoint& joint) { return joint.name; }
std::string without_root(const tags::TaggedJoint& joint) {
  return joint.ids.local == "root" ? "" : joint.name;
}

/// Every joint but the root, without names.
tags::ForeignSkeleton nameless(const math::Affine& ancestor = {}) {
  auto skeleton = as_model(*biped().placed, ancestor, without_root);
  for (tags::ForeignJoint& joint : skeleton.joints) joint.name.clear();
  return skeleton;
}

int own_node(const std::string& joint) {
  return 100 + static_cast<int>(joint_named(*biped().placed, joint));
}

/// What `map_text` writes, read back.
Map read_back(const Guess& guess, const tags::ForeignSkeleton& skeleton) {
  Diagnostics diagnostics;
  const std::string text = map_text(guess, skeleton, "guess", "model.glb", "biped");
  const auto map = read_map(diagnostics.sources().add("map.yaml", text), diagnostics);
  REQUIRE_MESSAGE(map, render(diagnostics, false));
  return *map;
}

}  // namespace

TEST_CASE("templates map_guess: a skeleton without names is found by hierarchy and place") {
  const math::Affine turned = math::rotation(math::axis_angle({0, 1, 0}, math::kPi / 2));
  const math::Affine lying = math::rotation(math::axis_angle({1, 0, 0}, -math::kPi / 2));
  const math::Affine tiny = {{{0.01, 0, 0}, {0, 0.01, 0}, {0, 0, 0.01}}, {3, -2, 7}};
  for (const math::Affine& world : {math::Affine{}, tiny, turned, lying, turned * tiny * lying}) {
    auto skeleton = nameless();
    skeleton.ancestor_world = world;
    const Guess found = guess(skeleton);
    for (const ExpandedJoint& joint : biped().expanded->joints) {
      if (joint.helper || joint.chain) continue;
      CHECK_MESSAGE(node_of(found, skeleton, joint.tagged.name) == own_node(joint.tagged.name),
                    joint.tagged.name);
    }
    CHECK(line(found, "spine_spine").bones.size() == 2);
    CHECK(found.unmapped.empty());
    CHECK(found.missing_required() == 0);
    CHECK(found.count(GuessLine::Sure::name) == 0);
  }
}

TEST_CASE("templates map_guess: other proportions, lowered arms and missing bones") {
  std::mt19937_64 random(11);
  const auto number = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  for (int round = 0; round < 8; ++round) {
    CAPTURE(round);
    // No fingers and tips; sometimes neither clavicles, neck nor balls.
    const bool slim = round % 2 == 1;
    auto skeleton = as_model(*biped().placed, {}, [&](const tags::TaggedJoint& joint) {
      const std::string& local = joint.ids.local;
      const bool left_out = local == "root" || local.find("hand") != std::string::npos ||
                            local.find("tip") != std::string::npos || local == "head_eyes" ||
                            (slim && (joint.ids.label == "clavicle" || local == "head_neck" ||
                                      joint.ids.label == "ball"));
      return left_out ? std::string() : joint.name;
    });
    const double angle = -1.2 * number();  // arms down to almost hanging
    std::map<int, math::Vec3> was;
    for (const tags::ForeignJoint& joint : skeleton.joints) was[joint.node] = joint.rest.origin;
    const double sides[2] = {angle, -angle};
    for (std::size_t side = 0; side < 2; ++side) {
      const std::string arm = side == 0 ? "arm_l_" : "arm_r_";
      const math::Vec3 pivot = was[own_node(arm + "shoulder")];
      const math::Quat turn = math::axis_angle({0, 0, 1}, sides[side]);
      for (const char* joint : {"elbow", "wrist"})
        for (tags::ForeignJoint& bone : skeleton.joints)
          if (bone.node == own_node(arm + joint))
            bone.rest.origin = pivot + rotate(turn, bone.rest.origin - pivot);
    }
    for (tags::ForeignJoint& joint : skeleton.joints) {
      joint.name.clear();
      const double x = 0.97 + 0.06 * number();
      const double y = 0.97 + 0.06 * number();
      joint.rest.origin.x *= x;
      joint.rest.origin.y *= y;
    }
    const Guess found = guess(skeleton);
    for (const std::string& joint : kBody)
      CHECK_MESSAGE(node_of(found, skeleton, joint) == own_node(joint), joint);
  }
}

TEST_CASE("templates map_guess: what is written reads back as the same map") {
  auto skeleton = as_model(*biped().placed, {}, named);
  std::mt19937_64 random(3);
  const std::vector<std::string> odd = {"a b", "null", "x: y", "# c", "\"q\"",    "Bone", "Bone",
                                        "",    "on",   "-l",   "{a}", "/nodes/3", "\xff", "12"};
  for (tags::ForeignJoint& joint : skeleton.joints) joint.name = odd[random() % odd.size()];
  const Guess found = guess(skeleton);
  const Map map = read_back(found, skeleton);
  const BoneNames names(map, skeleton);
  std::size_t bones = 0;
  for (const GuessLine& line : found.lines) {
    const MapEntry* entry = map.find(line.local, line.label);
    if (line.bones.empty()) {
      CHECK((entry != nullptr) == line.required);
      continue;
    }
    REQUIRE(entry);
    REQUIRE(entry->bones.size() == line.bones.size());
    for (std::size_t i = 0; i < line.bones.size(); ++i, ++bones)
      CHECK(names.find(entry->bones[i].front()) == line.bones[i]);
  }
  CHECK(bones > 40);
  CHECK(map_text(found, skeleton, "guess", "m", "biped") ==
        map_text(guess(skeleton), skeleton, "guess", "m", "biped"));
}

TEST_CASE("templates map_guess: names that a map knows are sure, words are likely, and say so") {
  auto skeleton = as_model(*biped().placed, {}, [](const tags::TaggedJoint& joint) -> std::string {
    static const std::map<std::string, std::string> kNames = {{"hips", "hip"},
                                                              {"spine_spine_1", "s1"},
                                                              {"spine_chest", "chest"},
                                                              {"head_head", "head"},
                                                              {"arm_l_shoulder", "l-arm"},
                                                              {"arm_l_elbow", "l-forearm"},
                                                              {"arm_l_wrist", "hand.l.grip"},
                                                              {"arm_r_shoulder", "r-arm"},
                                                              {"arm_r_elbow", "r-forearm"},
                                                              {"leg_l_hip", "l-thigh"},
                                                              {"leg_l_knee", "l-shin"},
                                                              {"leg_l_ankle", "l-foot"},
                                                              {"leg_r_hip", "r-thigh"},
                                                              {"leg_r_knee", "r-shin"},
                                                              {"leg_r_ankle", "r-foot"}};
    const auto found = kNames.find(joint.name);
    return found == kNames.end() ? "" : found->second;
  });
  const Guess found = guess(skeleton);
  CHECK(found.nearest == "generic");
  CHECK_FALSE(found.fits);
  CHECK(line(found, "arm_l_elbow").sure == GuessLine::Sure::name);
  CHECK(line(found, "arm_l_wrist").sure != GuessLine::Sure::missing);
  CHECK(line(found, "spine_spine").sure == GuessLine::Sure::place);
  CHECK(line(found, "arm_r_wrist").sure == GuessLine::Sure::missing);
  CHECK(found.missing_required() == 1);
  const std::string text = map_text(found, skeleton, "m", "model.glb", "biped");
  CHECK(text.find("arm_r.wrist: ~ ") != std::string::npos);
  CHECK(text.find("# sure: its name and its place below l-arm") != std::string::npos);
  CHECK(text.find("# guess: its place below hip") != std::string::npos);
}

TEST_CASE("templates map_guess: sides by the names of one who looks at the character's face") {
  const auto skeleton = as_model(*biped().placed, {}, [](const tags::TaggedJoint& joint) {
    if (joint.ids.local.find("hand") != std::string::npos || joint.ids.local == "root" ||
        joint.ids.label == "wrist")
      return std::string();
    std::string name = joint.name;
    if (name.rfind("arm_", 0) == 0 || name.rfind("leg_", 0) == 0)
      name[4] = name[4] == 'l' ? 'r' : 'l';
    return name;
  });
  const Guess found = guess(skeleton);
  for (const std::string& joint : kBody)
    if (joint.find("wrist") == std::string::npos)
      CHECK_MESSAGE(node_of(found, skeleton, joint) == own_node(joint), joint);
  REQUIRE(found.notes.size() == 2);
  CHECK(found.notes[1].find("left and right") != std::string::npos);
}

TEST_CASE("templates map_guess: Xbot, first by its names and then without any") {
  auto xbot = read_xbot();
  if (!xbot) {
    MESSAGE("corpus not there: Xbot is not tested");
    return;
  }
  const Guess by_name = guess(*xbot);
  CHECK(by_name.fits);
  CHECK(by_name.nearest == "mixamo");
  CHECK(by_name.unmapped.empty());
  CHECK(by_name.missing_required() == 0);
  CHECK(by_name.count(GuessLine::Sure::place) == 0);
  for (tags::ForeignJoint& joint : xbot->joints) joint.name.clear();
  const Guess by_place = guess(*xbot);
  CHECK(by_place.nearest.empty());
  REQUIRE(by_place.lines.size() == by_name.lines.size());
  for (std::size_t i = 0; i < by_name.lines.size(); ++i)
    CHECK_MESSAGE(by_place.lines[i].bones == by_name.lines[i].bones, by_name.lines[i].joint);
}

TEST_CASE("templates map_guess: skeletons that are no character do no harm") {
  std::mt19937_64 random(17);
  const auto number = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
  for (const std::size_t count :
       {std::size_t{1}, std::size_t{2}, std::size_t{30}, std::size_t{150}}) {
    tags::ForeignSkeleton skeleton;
    for (std::size_t i = 0; i < count; ++i) {
      tags::ForeignJoint joint;
      joint.node = static_cast<int>(i);
      joint.parent = i == 0 ? -1 : static_cast<int>(random() % i);
      const double x = number(), y = number(), z = number();
      joint.rest.origin = {x, y, z};
      skeleton.joints.push_back(joint);
    }
    const Guess found = guess(skeleton);
    std::set<int> used;
    std::size_t bones = 0;
    for (const GuessLine& line : found.lines) {
      used.insert(line.bones.begin(), line.bones.end());
      bones += line.bones.size();
    }
    CHECK(used.size() == bones);  // no bone twice
    CHECK(bones + found.unmapped.size() == count);
    read_back(found, skeleton);
    for (tags::ForeignJoint& joint : skeleton.joints) joint.rest.origin = {};
    guess(skeleton);  // all in one place
  }
}

TEST_CASE("templates map_guess: a skeleton that is too large is refused") {
  tags::ForeignSkeleton skeleton;
  skeleton.joints.resize(100'000);
  Diagnostics diagnostics;
  CHECK_FALSE(guess_map(*biped().expanded, skeleton, {}, diagnostics));
  CHECK(numbers(diagnostics) == std::vector<int>{384});
}
