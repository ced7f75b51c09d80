// SPDX-License-Identifier: MIT
// limb_stretch: limbs that reach, shorten, soften, and have lengths, as an animator sees them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "modules/bodies_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

std::string limb_commands(const std::string& group, double ik_fk, bool stretch,
                          const std::string& bend) {
  std::string text = "{command: ik_fk_limb, with: {start: ., middle: " + group +
                     ".lower, end: " + group + ".end, bend: " + bend +
                     ", ik_fk: " + std::to_string(ik_fk) + "}}";
  if (stretch) text += "\n{command: limb_stretch, with: {limb: " + group + "/ik_fk_limb.settings}}";
  return text;
}

test::Commands arms_and_legs(double ik_fk, bool stretch = true) {
  test::Commands commands{{"root", "{command: root, with: {drive: on}}"},
                          {"hips", "{command: control, with: {}}"}};
  for (const std::string s : {"l", "r"}) {
    commands["upperarm_" + s] = limb_commands("arm_" + s, ik_fk, stretch, "backward");
    commands["thigh_" + s] = limb_commands("leg_" + s, ik_fk, stretch, "forward");
  }
  return commands;
}

const std::string kFoot = "leg_l/ik_fk_limb.ik";
const std::string kKnee = "leg_l/ik_fk_limb.pole";
const std::string kMaster = "root/root.world@master_scale";

/// Distance of the joints of the left leg from each other.
struct Lengths {
  double upper, lower, reach;
};
Lengths lengths(const test::Pose& pose, const std::string& group = "leg_l") {
  const Vec3 p[] = {pose.position(group + ".upper"), pose.position(group + ".lower"),
                    pose.position(group + ".end")};
  return {math::length(p[1] - p[0]), math::length(p[2] - p[1]), math::length(p[2] - p[0])};
}

const Vec3 kHip{0.1, 0.9, 0};
/// A goal below the hip, `reach` true lengths of the leg away.
Vec3 below_hip(const test::Rig& rig, double reach) {
  const Lengths rest = lengths(test::Pose(rig));
  return kHip + Vec3{0, -1, 0} * (reach * (rest.upper + rest.lower));
}

/// Whether the joints are turned and moved alone: their axes keep their lengths and right angles.
double distortion(const test::Rig& rig, const test::Pose& pose) {
  double worst = 0;
  const auto now = pose.joints(), rest = test::Pose(rig).joints();
  for (std::size_t i = 0; i < now.size(); ++i) {
    const math::Trs a = math::decompose(now[i]), b = math::decompose(rest[i]);
    worst = std::max({worst, math::shear(now[i]) - math::shear(rest[i]),
                      math::length(a.scale - b.scale) / math::length(b.scale)});
  }
  return worst;
}

}  // namespace

TEST_CASE("modules limb_stretch: at rest nothing moves, whatever the switch") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    for (const double ik_fk : {0.0, 0.3, 1.0}) {
      CAPTURE(ik_fk);
      const test::Rig rig(test::body(arms_and_legs(ik_fk)), model.change);
      INFO(test::text(rig.diagnostics));
      REQUIRE(rig.clean());
      CHECK(test::rest_error(rig) < 1e-9);
    }
  }
}

TEST_CASE("modules limb_stretch: within reach a limb moves as without it") {
  for (const double ik_fk : {0.0, 1.0}) {
    const test::Rig with(test::body(arms_and_legs(ik_fk))),
        without(test::body(arms_and_legs(ik_fk, false)));
    test::Random random(7);
    for (int i = 0; i < 50; ++i) {
      test::Pose a(with), b(without);
      for (const std::string group : {"arm_l", "arm_r", "leg_l", "leg_r"}) {
        const Vec3 move = random.vector(0.1);
        const Vec3 turn = random.vector(60);
        const Vec3 pole = random.vector(0.1);
        const Vec3 nearer = group == "arm_l"   ? Vec3{-0.25, 0, 0.1}
                            : group == "arm_r" ? Vec3{0.25, 0, 0.1}
                                               : Vec3{0, 0.25, 0};
        for (test::Pose* pose : {&a, &b}) {
          pose->translate(group + "/ik_fk_limb.ik", nearer + move);
          pose->translate(group + "/ik_fk_limb.pole", pole);
          pose->rotate(group + ".lower/ik_fk_limb.fk", turn);
          pose->rotate(group + "/ik_fk_limb.ik", turn);
        }
        for (const char* joint : {".upper", ".lower", ".end"})
          CHECK(test::difference(a.world(group + joint), b.world(group + joint), 1) < 1e-14);
      }
    }
  }
}

TEST_CASE("modules limb_stretch: the foot reaches a goal that is too far, up to the limit") {
  const std::vector<Vec3> goals{{0.15, -0.4, 0.2}, {0.5, 0.1, -0.6}, {0.1, -0.9, 0.1}};
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(test::body(arms_and_legs(1)), model.change);
    for (const Vec3 goal : goals) {
      test::Pose pose(rig);
      pose.move_to(kFoot, model.by * goal);
      CHECK(test::distance(pose.position("leg_l.end"), model.by * goal) <
            5e-6 * rig.skeleton.character.height);
      CHECK(distortion(rig, pose) < 1e-9);
      const Lengths rest = lengths(test::Pose(rig)), now = lengths(pose);
      CHECK(now.upper / rest.upper == doctest::Approx(now.lower / rest.lower).epsilon(1e-9));
    }
  }
  const test::Rig rig(test::body(arms_and_legs(1)));
  const Lengths rest = lengths(test::Pose(rig));
  const auto reach = [&](double far, double stretch, double most) {
    test::Pose pose(rig);
    pose.move_to(kFoot, below_hip(rig, far));
    pose.set(kFoot + "@stretch", stretch).set(kFoot + "@stretch_max", most);
    return lengths(pose).reach / (rest.upper + rest.lower);
  };
  CHECK(reach(1.5, 1, 3) == doctest::Approx(1.5).epsilon(1e-6));
  CHECK(reach(1.5, 0, 3) == doctest::Approx(1).epsilon(1e-9));
  CHECK(reach(1.5, 0.5, 3) == doctest::Approx(1.25).epsilon(1e-6));
  CHECK(reach(1.5, 1, 1.2) == doctest::Approx(1.2).epsilon(1e-9));
}

TEST_CASE("modules limb_stretch: the size of the character changes nothing") {
  const test::Rig rig(test::body(arms_and_legs(1)));
  for (const double scale : {0.25, 1.0, 3.0}) {
    CAPTURE(scale);
    test::Pose pose(rig), plain(rig);
    for (test::Pose* each : {&pose, &plain}) {
      each->translate(kFoot, {0.2, -0.4, 0.3}).set(kFoot + "@soft", 0.2);
      each->translate("arm_r/ik_fk_limb.ik", {0.3, 0.2, 0.1}).set(kFoot + "@slide", 0.3);
      each->set("arm_r/ik_fk_limb.ik@squash", 1.0).set("arm_r/ik_fk_limb.pole@pin", 0.5);
    }
    pose.set(kMaster, scale);
    for (const std::string joint :
         {"leg_l.upper", "leg_l.lower", "leg_l.end", "arm_r.lower", "arm_r.end"}) {
      const math::Affine big = pose.world(joint), small = plain.world(joint);
      CHECK(test::distance(big.origin, small.origin * scale) < 1e-9);
    }
  }
}

TEST_CASE("modules limb_stretch: squash shortens the limb where the goal comes near") {
  const test::Rig rig(test::body(arms_and_legs(1)));
  const Lengths rest = lengths(test::Pose(rig));
  const auto posed = [&](double squash, double least) {
    test::Pose pose(rig);
    pose.move_to(kFoot, kHip + Vec3{0, -0.3, 0});
    pose.set(kFoot + "@squash", squash).set(kFoot + "@squash_min", least);
    CHECK(test::distance(pose.position("leg_l.end"), kHip + Vec3{0, -0.3, 0}) < 1e-5);
    return lengths(pose);
  };
  // All of it: the leg keeps its shape.
  const Lengths all = posed(1, 0.1);
  CHECK(all.upper / rest.upper == doctest::Approx(0.3 / rest.reach).epsilon(1e-6));
  CHECK(all.lower / rest.lower == doctest::Approx(0.3 / rest.reach).epsilon(1e-6));
  CHECK(posed(1, 0.6).upper == doctest::Approx(rest.upper * 0.6).epsilon(1e-9));
  CHECK(posed(0.5, 0.6).upper == doctest::Approx(rest.upper * 0.8).epsilon(1e-9));
  CHECK(posed(0, 0.6).upper == doctest::Approx(rest.upper).epsilon(1e-12));
}

TEST_CASE("modules limb_stretch: soft IK has no pop near full extension") {
  const test::Rig rig(test::body(arms_and_legs(1)));
  const auto largest_step = [&](double soft, double stretch) {
    double largest = 0, last_reach = 0;
    std::optional<Vec3> last;
    for (int i = 0; i <= 400; ++i) {
      test::Pose pose(rig);
      const Vec3 goal = below_hip(rig, 0.9 + 0.0005 * i);
      pose.move_to(kFoot, goal);
      pose.set(kFoot + "@soft", soft).set(kFoot + "@stretch", stretch);
      const Vec3 knee = pose.position("leg_l.lower");
      if (last) largest = std::max(largest, test::distance(knee, *last));
      last = knee;
      const double reach = lengths(pose).reach;
      CHECK(reach > last_reach);  // never turns back
      last_reach = reach;
      if (stretch == 1) CHECK(test::distance(pose.position("leg_l.end"), goal) < 1e-5);
    }
    return largest;
  };
  // Of a leg of 0.82, in steps of 0.0005 of it. Without softness the knee shoots through.
  const double soft = largest_step(0.1, 0), soft_reaching = largest_step(0.1, 1);
  CHECK(soft < 0.0025);
  CHECK(soft_reaching < 0.0025);
  test::Pose before(rig), after(rig);
  before.move_to(kFoot, below_hip(rig, 0.9995));
  after.move_to(kFoot, below_hip(rig, 1));
  CHECK(test::distance(before.position("leg_l.lower"), after.position("leg_l.lower")) > 0.01);
}

TEST_CASE("modules limb_stretch: the knee pinned to its control, the foot at its goal") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(test::body(arms_and_legs(1)), model.change);
    const double tolerance = 1e-5 * rig.skeleton.character.height;
    for (const Vec3 knee : {Vec3{0.4, 0.5, 0.3}, Vec3{0.1, 0.6, -0.2}, Vec3{0.2, 1.2, 0.1}}) {
      test::Pose pose(rig);
      const Vec3 foot{0.2, 0.2, 0.1};
      pose.move_to(kFoot, model.by * foot).move_to(kKnee, model.by * knee);
      pose.set(kKnee + "@pin", 1.0);
      CHECK(test::distance(pose.position("leg_l.lower"), model.by * knee) < tolerance);
      CHECK(test::distance(pose.position("leg_l.end"), model.by * foot) < tolerance);
      const Vec3 pinned = pose.position("leg_l.lower");
      pose.set(kKnee + "@pin", 0.5);
      const Vec3 half = pose.position("leg_l.lower");
      pose.set(kKnee + "@pin", 0.0);
      CHECK(test::distance(half, pinned) < test::distance(pose.position("leg_l.lower"), pinned));
    }
  }
}

TEST_CASE("modules limb_stretch: slide moves the knee along the leg, lengths lengthen") {
  const test::Rig rig(test::body(arms_and_legs(1)));
  const Lengths rest = lengths(test::Pose(rig));
  for (const double slide : {-1.0, -0.4, 0.6, 1.0}) {
    test::Pose pose(rig);
    pose.set(kFoot + "@slide", slide);
    const Lengths now = lengths(pose);
    CHECK(now.upper + now.lower == doctest::Approx(rest.upper + rest.lower).epsilon(1e-9));
    const double room = slide > 0 ? rest.lower : rest.upper;
    CHECK(now.upper - rest.upper == doctest::Approx(0.9 * slide * room).epsilon(1e-9));
    CHECK(now.reach == doctest::Approx(rest.reach).epsilon(1e-6));
  }
  test::Pose pose(rig);
  pose.set(kFoot + "@upper_length", 1.5).set(kFoot + "@lower_length", 0.75);
  CHECK(lengths(pose).upper == doctest::Approx(1.5 * rest.upper).epsilon(1e-9));
  CHECK(lengths(pose).lower == doctest::Approx(0.75 * rest.lower).epsilon(1e-9));
  CHECK(distortion(rig, pose) < 1e-9);
}

TEST_CASE("modules limb_stretch: keys beyond the limits of attributes count as the limits") {
  const test::Rig rig(test::body(arms_and_legs(1)));
  struct Key {
    std::string name;
    double beyond, limit;
  };
  const Key keys[] = {{"upper_length", -0.4, 0.001},
                      {"lower_length", -0.24, 0.001},
                      {"stretch", 1.5, 1},
                      {"stretch", -1, 0},
                      {"stretch_max", 0.2, 1},
                      {"squash", 3, 1},
                      {"squash_min", -1, 0.01},
                      {"soft", 2, 0.5},
                      {"slide", -4, -1}};
  for (const Key& key : keys) {
    CAPTURE(key.name);
    test::Pose far(rig), at(rig);
    for (test::Pose* pose : {&far, &at})
      pose->set(kFoot + "@stretch", 1.0)
          .set(kFoot + "@squash", 1.0)
          .translate(kFoot, {0.1, 0.2, 0.1});
    far.set(kFoot + "@" + key.name, key.beyond);
    at.set(kFoot + "@" + key.name, key.limit);
    CHECK(test::largest_difference(far.joints(), at.joints(), 1) < 1e-12);
  }
  test::Pose far(rig), at(rig);
  for (const std::string label : {"upper", "lower"}) {
    const std::string control = "arm_l." + label + "/ik_fk_limb.fk@length";
    far.set(control, -1.0);
    at.set(control, 0.001);
  }
  for (test::Pose* pose : {&far, &at}) pose->set("arm_l/ik_fk_limb.settings@ik_fk", 0.0);
  CHECK(test::largest_difference(far.joints(), at.joints(), 1) < 1e-12);
}

TEST_CASE("modules limb_stretch: FK has lengths of its own, and its controls stay on the joints") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(test::body(arms_and_legs(0)), model.change);
    const Lengths rest = lengths(test::Pose(rig), "arm_r");
    test::Pose pose(rig);
    pose.set("arm_r.upper/ik_fk_limb.fk@length", 1.4).set("arm_r.lower/ik_fk_limb.fk@length", 0.6);
    pose.rotate("arm_r.upper/ik_fk_limb.fk", {10, 20, 30});
    pose.rotate("arm_r.lower/ik_fk_limb.fk", {0, 50, 0});
    pose.set("arm_r/ik_fk_limb.ik@upper_length", 3.0);  // of the other mode
    const Lengths now = lengths(pose, "arm_r");
    CHECK(now.upper == doctest::Approx(1.4 * rest.upper).epsilon(1e-9));
    CHECK(now.lower == doctest::Approx(0.6 * rest.lower).epsilon(1e-9));
    for (const char* joint : {".upper", ".lower", ".end"}) {
      const std::string name = std::string("arm_r") + joint;
      CHECK(test::distance(pose.position(name), pose.position(name + "/ik_fk_limb.fk")) <
            1e-9 * rig.skeleton.character.height);
    }
    pose.set("arm_r/ik_fk_limb.settings@ik_fk", 0.5);
    pose.set("arm_r/ik_fk_limb.ik@upper_length", 2.0);
    CHECK(lengths(pose, "arm_r").upper == doctest::Approx(1.7 * rest.upper).epsilon(1e-9));
  }
}

TEST_CASE("modules limb_stretch: equal values on both sides mirror each other") {
  const test::Rig rig(test::body(arms_and_legs(1)));
  test::Pose pose(rig);
  for (const std::string s : {"l", "r"}) {
    const double side = s == "l" ? 1 : -1;
    const std::string arm = "arm_" + s + "/ik_fk_limb";
    pose.move_to(arm + ".ik", {side * 0.5, 1.6, 0.5});
    pose.set(arm + ".ik@slide", 0.3).set(arm + ".ik@soft", 0.3).set(arm + ".ik@upper_length", 0.7);
    pose.set(arm + ".pole@pin", 0.4);
  }
  for (const char* joint : {".lower", ".end"}) {
    const Vec3 l = pose.position(std::string("arm_l") + joint),
               r = pose.position(std::string("arm_r") + joint);
    CHECK(test::distance({-l.x, l.y, l.z}, r) < 1e-6);
  }
}

TEST_CASE("modules limb_stretch: a limb stretches once, and only a limb does") {
  const test::Rig twice(test::limb(
      "[0, 1, 0]", "[0, 0.5, 0.1]", "[0, 0.1, 0]",
      {{"upper", limb_commands("limb", 1, true, "auto") +
                     "\n{command: limb_stretch, id: two, with: {limb: limb/ik_fk_limb.ik}}"}}));
  CHECK(test::codes(twice.diagnostics) == "RIG0464");
}

namespace {

/// A leg with a roll joint between hip and knee, whose foot hangs under the root: many models.
std::string odd_leg(double ik_fk) {
  return test::template_of(R"(joints:
  - name: base
    at: [0, 0, 0]
    local: base
    label: base
    tags:
      - {command: root, with: {drive: on}}
  - name: upper
    parent: base
    at: [0.1, 0.9, 0]
    local: limb
    label: upper
    tags:
      - {command: ik_fk_limb, with: {start: ., middle: limb.lower, end: limb.end, ik_fk: )" +
                           std::to_string(ik_fk) + R"(}}
      - {command: limb_stretch, with: {limb: limb/ik_fk_limb.ik}}
  - {name: roll, parent: upper, at: [0.1, 0.7, 0.01], local: limb, label: roll}
  - {name: lower, parent: roll, at: [0.1, 0.5, 0.03], local: limb, label: lower}
  - {name: end, parent: base, at: [0.1, 0.08, 0], local: limb, label: end}
)");
}

}  // namespace

TEST_CASE("modules limb_stretch: roll joints between, and a foot that hangs under the root") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(odd_leg(1), model.change);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
    const double tolerance = 5e-6 * rig.skeleton.character.height;
    const Lengths rest = lengths(test::Pose(rig), "limb");
    test::Pose pose(rig);
    const Vec3 far{0.4, -0.3, 0.5};
    pose.move_to("limb/ik_fk_limb.ik", model.by * far);
    CHECK(test::distance(pose.position("limb.end"), model.by * far) < tolerance);
    const Lengths now = lengths(pose, "limb");
    CHECK(now.upper / rest.upper == doctest::Approx(now.lower / rest.lower).epsilon(1e-6));
    // The roll joint stays on its part of the bone.
    const auto part = [](const test::Pose& of) {
      return test::distance(of.position("limb.roll"), of.position("limb.upper")) /
             lengths(of, "limb").upper;
    };
    CHECK(part(pose) == doctest::Approx(part(test::Pose(rig))).epsilon(1e-9));
    pose.set("base/root.world@master_scale", 2.0);
    CHECK(lengths(pose, "limb").upper == doctest::Approx(2 * now.upper).epsilon(1e-9));

    const test::Rig fk_rig(odd_leg(0), model.change);
    test::Pose fk(fk_rig);
    fk.set("limb.lower/ik_fk_limb.fk@length", 1.5).rotate("limb.lower/ik_fk_limb.fk", {30, 0, 40});
    CHECK(lengths(fk, "limb").lower == doctest::Approx(1.5 * rest.lower).epsilon(1e-9));
    CHECK(test::distance(fk.position("limb.end"), fk.position("limb.end/ik_fk_limb.fk")) <
          1e-3 * tolerance);
  }
}
