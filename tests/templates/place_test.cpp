// SPDX-License-Identifier: MIT
// Placing: rests, chains, orientation, mirrored behaviour.
#include <doctest/doctest.h>

#include <random>

#include "templates/expand.h"
#include "templates/templates_helpers.h"

using namespace rigc;
using namespace rigc::templates;
using namespace rigc::templates::testing;
using math::Vec3;

namespace {

struct Random {
  std::mt19937_64 engine{20240611};
  double operator()(double low, double high) {
    const double share = static_cast<double>(engine() >> 11) * 0x1.0p-53;
    return low + (high - low) * share;
  }
  Vec3 vector(double size) {
    const double x = (*this)(-size, size), y = (*this)(-size, size), z = (*this)(-size, size);
    return {x, y, z};
  }
  math::Quat rotation() {
    const Vec3 axis = normalised(vector(1));
    return math::axis_angle(axis, (*this)(-3, 3));
  }
};

std::string text(const Vec3& v) {
  return "[" + std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z) + "]";
}

double distance(Vec3 a, Vec3 b) { return length(a - b); }
double distance(const math::Mat3& a, const math::Mat3& b) {
  return distance(a.x, b.x) + distance(a.y, b.y) + distance(a.z, b.z);
}
Vec3 flipped(Vec3 v) { return {-v.x, v.y, v.z}; }
math::Mat3 flipped(const math::Mat3& m) { return {flipped(m.x), flipped(m.y), flipped(m.z)}; }

/// World matrices of a skeleton whose joints are turned by `turn(name)` on top of their rests.
template <class Turn>
std::vector<math::Affine> posed(const tags::TaggedSkeleton& skeleton, Turn turn) {
  std::vector<math::Affine> worlds;
  for (const tags::TaggedJoint& joint : skeleton.joints) {
    const math::Affine own = compose(joint.rest) * math::rotation(turn(joint));
    worlds.push_back(joint.parent < 0 ? own : worlds[static_cast<std::size_t>(joint.parent)] * own);
  }
  return worlds;
}

}  // namespace

TEST_CASE("templates place: at is in model space, translate and rotate in the parent's") {
  Diagnostics diagnostics;
  const auto placed =
      place_text(with_head("joints:\n"
                           "  - {name: c, parent: b, translate: [0, 1, 0]}\n"
                           "  - {name: a, at: [1, 0, 0], rotate: [0, 0, 90]}\n"
                           "  - {name: b, parent: a, at: [1, 2, 0], rotate: [0, 0, 90]}\n"),
                 diagnostics);
  REQUIRE_MESSAGE(placed, render(diagnostics, false));
  CHECK(placed->joints[0].name == "a");
  CHECK(placed->joints[1].name == "b");
  CHECK(placed->joints[2].name == "c");
  CHECK(distance(placed->joints[1].rest.translation, {2, 0, 0}) < 1e-12);
  CHECK(distance(placed->world(2).origin, {1, 1, 0}) < 1e-12);
  CHECK(placed->joints[0].rest.scale == Vec3{1, 1, 1});
  CHECK(placed->character.height == doctest::Approx(2));
  CHECK(placed->character.unit == 1);
}

TEST_CASE("templates place: document order stays, but parents come first") {
  Diagnostics diagnostics;
  const auto placed =
      place_text(with_head("joints: [{name: d, parent: c}, {name: a}, {name: c, parent: a}, "
                           "{name: b, parent: a}]\n"),
                 diagnostics);
  REQUIRE(placed);
  std::string order;
  for (const tags::TaggedJoint& joint : placed->joints) order += joint.name;
  CHECK(order == "acdb");
}

TEST_CASE("templates place: chains") {
  Diagnostics diagnostics;
  const auto placed =
      place_text(with_head("joints:\n"
                           "  - {name: s, at: [0, 1, 0], chain: {count: 3, to: [0, 2, 1]}, local: "
                           "s, label: base, rotate: [0, 90, 0],\n"
                           "     tags: [{command: fk_chain, with: {joints: 's[*]'}}]}\n"
                           "  - {name: t, parent: s, at: [0, 3, 1]}\n"),
                 diagnostics);
  REQUIRE_MESSAGE(placed, render(diagnostics, false));
  REQUIRE(placed->joints.size() == 4);
  CHECK(placed->joints[2].name == "s_3");
  CHECK(placed->joints[3].parent == 2);
  CHECK(distance(placed->world(1).origin, {0, 1.5, 0.5}) < 1e-12);
  CHECK(distance(placed->world(2).origin, {0, 2, 1}) < 1e-12);
  CHECK(placed->joints[0].key.uid == placed->joints[2].key.uid);
  CHECK(placed->joints[2].key.ordinal == 2);
  CHECK(placed->joints[0].commands.size() == 1);
  CHECK(placed->joints[1].commands.empty());
  CHECK(placed->joints[1].ids == Identifiers{"case", "s", ""});
  CHECK(placed->joints[1].rest.rotation == math::Quat{});
  CHECK(placed->find({placed->joints[0].key.uid, 1}) == 1);
}

TEST_CASE("templates place: orient aims one axis at a joint and turns another up") {
  Random random;
  const char* const axes[] = {"+x", "-x", "+y", "-y", "+z", "-z"};
  const Vec3 units[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int aim = 0; aim < 6; ++aim) {
    for (int up = 0; up < 6; ++up) {
      if (aim / 2 == up / 2) continue;
      const Vec3 from = random.vector(1), to = random.vector(1), toward = random.vector(1);
      Diagnostics diagnostics;
      const auto placed =
          place_text(with_head("joints:\n  - {name: r, rotate: [10, 20, 30], translate: [1, 1, "
                               "1]}\n  - {name: a, parent: r, at: " +
                               text(from) + ", orient: {aim: " + axes[aim] + ", up: " + axes[up] +
                               ", up_toward: " + text(toward) +
                               "}}\n  - {name: b, parent: a, at: " + text(to) + "}\n"),
                     diagnostics);
      REQUIRE_MESSAGE(placed, render(diagnostics, false));
      const math::Affine world = placed->world(1);
      CHECK(math::determinant(world.linear) == doctest::Approx(1));
      const Vec3 bone = normalised(placed->world(2).origin - world.origin);
      CHECK(distance(world.linear * units[aim], bone) < 1e-9);
      const Vec3 turned = world.linear * units[up];
      CHECK(dot(turned, toward) > 0);
      CHECK(std::abs(dot(turned, cross(bone, toward))) < 5e-6);
    }
  }
}

TEST_CASE("templates place: equal rotations of mirrored joints move the world in mirror images") {
  Random random;
  for (int round = 0; round < 20; ++round) {
    const Folder folder("place_mirror");
    std::string limb = "joints:\n";
    const char* const names[] = {"a", "b", "c", "d"};
    for (int i = 0; i < 4; ++i) {
      limb += std::string("  - {name: ") + names[i] +
              (i == 0 ? "" : std::string(", parent: ") + names[i - 1]);
      limb += round % 2 == 0 || i == 2 ? ", translate: " + text(random.vector(1))
                                       : ", at: " + text(random.vector(1));
      if (i % 2 == 0) limb += ", rotate: " + text(random.vector(170));
      limb += "}\n";
    }
    const Vec3 end_at =
        random.vector(1);  // one draw a statement: compilers order operands as they like
    const Vec3 end_rotate = random.vector(90);
    limb += "parts: [{template: end, as: end, attach: d, at: " + text(end_at) +
            ", rotate: " + text(end_rotate) + ", size: 0.5}]\n";
    folder.write("limb.yaml", with_head(limb, "limb"));
    folder.write("end.yaml",
                 with_head("joints:\n  - {name: e, translate: [1, 2, 3], rotate: [5, 6, 7]}\n"
                           "  - {name: f, parent: e, translate: [1, 0, 2], rotate: [50, 6, 7]}\n",
                           "end"));
    const Vec3 base = random.vector(1);
    const std::string body = folder.write(
        "body.yaml", with_head("joints: [{name: root, at: [0, " + std::to_string(base.y) + ", " +
                                   std::to_string(base.z) +
                                   "]}]\nparts:\n  - {template: limb, as: x_l, attach: root}\n"
                                   "  - {template: limb, as: x_r, attach: root, mirror: x}\n",
                               "body"));
    Diagnostics diagnostics;
    const auto expanded = expand_file(body, diagnostics);
    REQUIRE_MESSAGE(expanded, render(diagnostics, false));
    const auto placed = place(*expanded, diagnostics);
    REQUIRE(placed);

    std::map<std::string, math::Quat> turns;
    const auto turn = [&](const tags::TaggedJoint& joint) {
      if (joint.name.size() < 4) return math::Quat{};
      if (joint.name == "root") return math::Quat{};
      const std::string own = joint.name.substr(4);
      if (!turns.contains(own)) turns[own] = random.rotation();
      return turns[own];
    };
    for (const bool pose : {false, true}) {
      const auto worlds = posed(*placed, [&](const tags::TaggedJoint& joint) {
        return pose ? turn(joint) : math::Quat{};
      });
      for (std::size_t i = 0; i < placed->joints.size(); ++i) {
        const tags::TaggedJoint& joint = placed->joints[i];
        CHECK(math::determinant(worlds[i].linear) == doctest::Approx(1));
        if (joint.mirror.opposite.uid == 0 || joint.mirror.mirrored) continue;
        const auto other = static_cast<std::size_t>(placed->find(joint.mirror.opposite));
        CHECK(placed->joints[other].mirror.mirrored);
        CHECK(distance(worlds[other].origin, flipped(worlds[i].origin)) < 1e-9);
        const math::Mat3 image = flipped(worlds[i].linear);
        const math::Mat3 turned{-image.x, -image.y, -image.z};
        CHECK(distance(worlds[other].linear, turned) < 1e-9);
      }
    }
  }
}

TEST_CASE("templates place: size and rotation of a part, and mirrors at other planes") {
  const Folder folder("place_parts");
  folder.write(
      "p.yaml",
      with_head("joints: [{name: a, at: [1, 2, 3]}, {name: b, parent: a, at: [2, 2, 3]}]\n", "p"));
  const std::string body = folder.write(
      "body.yaml",
      with_head(
          "joints: [{name: r}]\nparts:\n"
          "  - {template: p, as: turned, attach: r, at: [0, 0, 5], rotate: [0, 90, 0], size: 2}\n"
          "  - {template: p, as: up, attach: r, mirror: y}\n"
          "  - {template: p, as: back, mirror: z}\n",
          "body"));
  Diagnostics diagnostics;
  const auto expanded = expand_file(body, diagnostics);
  REQUIRE_MESSAGE(expanded, render(diagnostics, false));
  const auto placed = place(*expanded, diagnostics);
  REQUIRE(placed);
  CHECK(distance(placed->world(joint_named(*placed, "turned_a")).origin, {6, 4, 3}) < 1e-12);
  CHECK(distance(placed->world(joint_named(*placed, "turned_b")).origin, {6, 4, 1}) < 1e-12);
  CHECK(distance(placed->world(joint_named(*placed, "up_b")).origin, {2, -2, 3}) < 1e-12);
  CHECK(distance(placed->world(joint_named(*placed, "back_b")).origin, {2, 2, -3}) < 1e-12);
  CHECK(placed->joints[joint_named(*placed, "back_a")].parent == -1);
  for (const tags::TaggedJoint& joint : placed->joints) CHECK(joint.rest.scale == Vec3{1, 1, 1});
}

TEST_CASE("templates place: the biped is a symmetric figure of 1.75 m with bent limbs") {
  Diagnostics diagnostics;
  const auto expanded = expand_file(biped_path(), diagnostics);
  REQUIRE_MESSAGE(expanded, render(diagnostics, false));
  const auto placed = place(*expanded, diagnostics);
  REQUIRE(placed);
  CHECK(placed->character.height == doctest::Approx(1.75));
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < placed->joints.size(); ++i) {
    const tags::TaggedJoint& joint = placed->joints[i];
    if (joint.mirror.opposite.uid == 0) continue;
    ++pairs;
    const int other = placed->find(joint.mirror.opposite);
    REQUIRE(other >= 0);
    CHECK(distance(placed->world(static_cast<std::size_t>(other)).origin,
                   flipped(placed->world(i).origin)) < 1e-9);
  }
  CHECK(pairs == 72);
  const auto at = [&](const char* name) {
    return placed->world(joint_named(*placed, name)).origin;
  };
  const Vec3 knee = at("leg_l_knee") - (at("leg_l_hip") + at("leg_l_ankle")) * 0.5;
  CHECK(knee.z > 0.02);
  const Vec3 elbow = at("arm_l_elbow") - (at("arm_l_shoulder") + at("arm_l_wrist")) * 0.5;
  CHECK(elbow.z < -0.02);
  CHECK(at("arm_l_hand_middle_tip").x > 0.85);
  CHECK(at("arm_l_hand_thumb_tip").z > 0.03);
}
