// SPDX-License-Identifier: MIT
// Placements of joints through versions of their skeleton.
#include "update/skeleton.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "support/rig.h"
#include "support/skeletons.h"

namespace rigc {
namespace {

using math::Affine;
using math::Vec3;
using tags::TaggedSkeleton;
using test::Random;

TaggedSkeleton skeleton(const std::string& joints) {
  Diagnostics diagnostics;
  auto out = test::skeleton_from(test::template_of(joints), diagnostics);
  REQUIRE_MESSAGE(out, render(diagnostics, false));
  return *std::move(out);
}

TaggedSkeleton arm() {
  return skeleton(R"(joints:
  - {name: chest, at: [0, 1, 0]}
  - {name: upper, parent: chest, at: [0.3, 1.1, 0]}
  - {name: lower, parent: upper, at: [0.6, 1.1, -0.1]}
  - {name: hand, parent: lower, at: [0.9, 1.1, 0]}
)");
}

TaggedSkeleton spine(int count, const std::string& name = "spine", const std::string& more = "") {
  return skeleton("joints:\n  - {name: hips, at: [0, 1, 0]}\n  - {name: " + name +
                  ", parent: hips, at: [0, 1.1, 0], chain: {count: " + std::to_string(count) +
                  ", to: [0, 1.5, 0]}" + more + "}\n  - {name: head, parent: " + name +
                  ", at: [0, 1.7, 0]}\n");
}

std::size_t index_of(const TaggedSkeleton& skeleton, const std::string& name) {
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i)
    if (skeleton.joints[i].name == name) return i;
  FAIL("no joint " << name);
  return 0;
}

Affine world(const TaggedSkeleton& skeleton, const std::string& name) {
  return skeleton.world(index_of(skeleton, name));
}

double difference(const Affine& a, const Affine& b) {
  return std::max({length(a.origin - b.origin), length(a.linear.x - b.linear.x),
                   length(a.linear.y - b.linear.y), length(a.linear.z - b.linear.z)});
}

/// As if it had been fitted to a model: other axes, other proportions, another size and facing.
TaggedSkeleton fitted(TaggedSkeleton skeleton, std::uint64_t seed) {
  Random random(seed);
  auto worlds = test::worlds(skeleton);
  for (Affine& world : worlds) world.origin = world.origin + random.vector(0.05);
  test::set_worlds(skeleton, worlds);
  test::turn_axes(skeleton, seed);
  test::transform(skeleton, test::similarity(random.number(0.5, 100), random.rotation()));
  return skeleton;
}

}  // namespace

TEST_CASE("skeleton: the same joints stand where they stood, bit for bit") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const TaggedSkeleton old = fitted(arm(), seed);
    TaggedSkeleton fresh = arm();
    update::keep_placements(fresh, old);
    for (std::size_t i = 0; i < fresh.joints.size(); ++i)
      CHECK(fresh.joints[i].rest == old.joints[i].rest);
    CHECK(fresh.character.up == old.character.up);
    CHECK(fresh.character.unit == old.character.unit);
    CHECK(fresh.character.height == old.character.height);
  }
}

TEST_CASE("skeleton: a joint inserted into a chain moves nothing below it") {
  const TaggedSkeleton old = fitted(arm(), 3);
  TaggedSkeleton fresh = skeleton(R"(joints:
  - {name: chest, at: [0, 1, 0]}
  - {name: clavicle, parent: chest, at: [0.1, 1.1, 0]}
  - {name: upper, parent: clavicle, at: [0.3, 1.1, 0]}
  - {name: lower, parent: upper, at: [0.6, 1.1, -0.1]}
  - {name: hand, parent: lower, at: [0.9, 1.1, 0]}
)");
  const math::Trs clavicle = fresh.joints[index_of(fresh, "clavicle")].rest;
  update::keep_placements(fresh, old);
  CHECK(fresh.joints[index_of(fresh, "clavicle")].rest == clavicle);
  for (const char* name : {"chest", "upper", "lower", "hand"})
    CHECK(difference(world(fresh, name), world(old, name)) < 1e-9 * old.character.height);
  for (const char* name : {"chest", "hand"})  // hang where they hung
    CHECK(fresh.joints[index_of(fresh, name)].rest == old.joints[index_of(old, name)].rest);
}

TEST_CASE("skeleton: a joint taken out moves nothing below it") {
  const TaggedSkeleton old = fitted(arm(), 4);
  TaggedSkeleton fresh = skeleton(R"(joints:
  - {name: chest, at: [0, 1, 0]}
  - {name: lower, parent: chest, at: [0.6, 1.1, -0.1]}
  - {name: hand, parent: lower, at: [0.9, 1.1, 0]}
)");
  update::keep_placements(fresh, old);
  for (const char* name : {"chest", "lower", "hand"})
    CHECK(difference(world(fresh, name), world(old, name)) < 1e-9 * old.character.height);
}

TEST_CASE("skeleton: chains with more and with fewer joints are spread along the old one") {
  for (const std::pair<int, int>& counts :
       {std::pair{3, 5}, std::pair{5, 3}, std::pair{2, 7}, std::pair{6, 2}}) {
    const int from = counts.first, to = counts.second;
    CAPTURE(from);
    CAPTURE(to);
    const TaggedSkeleton old = fitted(spine(from), 5);
    TaggedSkeleton fresh = spine(to);
    update::keep_placements(fresh, old);
    const auto name = [](int i) { return "spine_" + std::to_string(i); };
    const double near = 1e-9 * old.character.height;
    CHECK(difference(world(fresh, name(1)), world(old, name(1))) < near);
    CHECK(difference(world(fresh, name(to)), world(old, name(from))) < near);
    CHECK(difference(world(fresh, "head"), world(old, "head")) < near);
    // Each lies on a bone of the old chain, at its share of the length.
    std::vector<Vec3> line;
    for (int i = 1; i <= from; ++i) line.push_back(world(old, name(i)).origin);
    double whole = 0;
    for (std::size_t i = 1; i < line.size(); ++i) whole += length(line[i] - line[i - 1]);
    for (int k = 1; k <= to; ++k) {
      const Vec3 at = world(fresh, name(k)).origin;
      double nearest = 1e9, along = 0, best = 0;
      for (std::size_t i = 1; i < line.size(); ++i) {
        const Vec3 bone = line[i] - line[i - 1];
        const double share = std::clamp(dot(at - line[i - 1], bone) / dot(bone, bone), 0.0, 1.0);
        const double distance = length(line[i - 1] + bone * share - at);
        if (distance < nearest - near) {
          nearest = distance;
          best = along + share * length(bone);
        }
        along += length(bone);
      }
      CHECK(nearest < near);
      CHECK(best / whole == doctest::Approx((k - 1.0) / (to - 1)).epsilon(1e-6));
    }
  }
}

TEST_CASE("skeleton: a chain that was renamed keeps its joints by what it was") {
  const TaggedSkeleton old = fitted(spine(3), 6);
  TaggedSkeleton fresh = spine(3, "back", ", was: [spine]");
  update::keep_placements(fresh, old);
  for (int i = 1; i <= 3; ++i)
    CHECK(fresh.joints[index_of(fresh, "back_" + std::to_string(i))].rest ==
          old.joints[index_of(old, "spine_" + std::to_string(i))].rest);
}

TEST_CASE("skeleton: a joint of another uid is the one that it says it was") {
  const TaggedSkeleton old = fitted(arm(), 7);
  TaggedSkeleton fresh = skeleton(R"(joints:
  - {name: chest, at: [0, 1, 0]}
  - {name: shoulder, uid: 00000000000000ab, was: [upper], parent: chest, at: [0.3, 1.1, 0]}
)");
  const auto from = update::counterparts(fresh, old);
  CHECK(from[index_of(fresh, "shoulder")] == static_cast<int>(index_of(old, "upper")));
  update::keep_placements(fresh, old);
  CHECK(fresh.joints[1].rest == old.joints[1].rest);
  // And back, where the old rig is the one that knows.
  const auto back = update::counterparts(old, fresh);
  CHECK(back[index_of(old, "upper")] == static_cast<int>(index_of(fresh, "shoulder")));
}

TEST_CASE("skeleton: joints that say they were each other are who they are") {
  TaggedSkeleton old = arm();
  TaggedSkeleton fresh = arm();
  fresh.joints[1].was = {fresh.joints[2].key};
  fresh.joints[2].was = {fresh.joints[1].key};
  CHECK(update::counterparts(fresh, old) == std::vector<int>{0, 1, 2, 3});
  // Both are new and claim the same two.
  fresh.joints[1].key.uid = 1;
  fresh.joints[2].key.uid = 2;
  fresh.joints[1].was = {old.joints[1].key, old.joints[2].key};
  fresh.joints[2].was = {old.joints[1].key, old.joints[2].key};
  CHECK(update::counterparts(fresh, old) == std::vector<int>{0, 2, 1, 3});
}

TEST_CASE("skeleton: no joint is given twice, whatever the lists of earlier keys say") {
  Random random(8);
  for (int round = 0; round < 200; ++round) {
    const auto make = [&] {
      TaggedSkeleton out;
      const std::size_t count = 1 + random.below(8);
      for (std::size_t i = 0; i < count; ++i) {
        tags::TaggedJoint joint;
        joint.key = {1 + random.below(10), static_cast<std::uint32_t>(random.below(2))};
        if (out.find(joint.key) >= 0) continue;
        joint.parent = static_cast<int>(random.below(out.joints.size() + 1)) - 1;
        while (random.chance(0.5))
          joint.was.push_back({1 + random.below(10), static_cast<std::uint32_t>(random.below(2))});
        joint.rest = {random.vector(1), random.rotation(), {1, 1, 1}};
        out.joints.push_back(std::move(joint));
      }
      return out;
    };
    const TaggedSkeleton old = make();
    TaggedSkeleton fresh = make();
    const auto from = update::counterparts(fresh, old);
    REQUIRE(from.size() == fresh.joints.size());
    std::set<int> given;
    for (std::size_t i = 0; i < from.size(); ++i) {
      if (from[i] < 0) continue;
      CHECK(given.insert(from[i]).second);
      REQUIRE(from[i] < static_cast<int>(old.joints.size()));
      const auto same = old.find(fresh.joints[i].key);
      if (same >= 0) CHECK(from[i] == same);
    }
    update::keep_placements(fresh, old);
    for (const tags::TaggedJoint& joint : fresh.joints)
      CHECK(std::isfinite(joint.rest.translation.x));
  }
}

}  // namespace rigc
