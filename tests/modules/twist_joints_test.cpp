// SPDX-License-Identifier: MIT
// twist_joints: a forearm rolls along its length with the hand, a shoulder stays while the elbow
// turns, and nothing flips on the way.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>

#include "modules/bodies_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Affine;
using math::Quat;
using math::Vec3;

namespace {

const std::string kForearm = "arm_l.lower/twist_joints.twist";
const std::string kUpperArm = "arm_l.upper/twist_joints.twist";
const std::string kUpper = "arm_l.upper/ik_fk_limb.fk";
const std::string kHand = "arm_l.end/ik_fk_limb.fk";

/// Arms that roll at the hand and stay at the shoulder.
test::Commands arms(const std::string& more = {}) {
  test::Commands commands{{"root", "{command: root, with: {drive: on}}"},
                          {"hips", "{command: control, with: {}}"}};
  for (const std::string s : {"l", "r"}) {
    const std::string g = "arm_" + s;
    commands["clavicle_" + s] = "{command: control, with: {}}";
    commands["upperarm_" + s] = fmt::format(
        "{{command: ik_fk_limb, with: {{start: ., middle: {0}.lower, end: {0}.end, bend: "
        "backward}}}}\n"
        "{{command: twist_joints, with: {{start: ., end: {0}.lower, mode: counter_roll{1}}}}}",
        g, more);
    commands["forearm_" + s] =
        fmt::format("{{command: twist_joints, with: {{start: ., end: {}.end{}}}}}", g, more);
  }
  return commands;
}

std::string nth(const std::string& role, std::size_t i) { return fmt::format("{}[{}]", role, i); }

Vec3 bone(const test::Rig& rig, const std::string& from, const std::string& to) {
  return math::normalised(rig.rest(to).origin - rig.rest(from).origin);
}

/// What a node does: the rotation that leads from its rest to where it is.
Quat turn_of(const test::Rig& rig, const test::Pose& pose, const std::string& node) {
  return math::quaternion(math::orthonormal(pose.world(node).linear) *
                          math::transposed(math::orthonormal(rig.rest(node).linear)));
}

double angle_between(Quat a, Quat b) {
  const Quat difference = a * math::conjugate(b);
  return 2 *
         math::degrees(math::asin(math::length(Vec3{difference.x, difference.y, difference.z})));
}

Quat about(Vec3 axis, double degrees) { return math::axis_angle(axis, math::radians(degrees)); }

}  // namespace

TEST_CASE("modules twist_joints: at rest nothing moves, on every model") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(test::body(arms()), model.change);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
    const test::Pose pose(rig);
    for (const std::string& role : {kForearm, kUpperArm})
      for (std::size_t i = 0; i < 3; ++i)
        CHECK(test::difference(pose.world(nth(role, i)), rig.rest(nth(role, i)),
                               rig.skeleton.character.height) < 1e-9);
  }
}

TEST_CASE("modules twist_joints: thirds of a forearm turn by thirds, on every model") {
  const test::Rig plain(test::body(arms()));
  const Vec3 axis = bone(plain, "arm_l.lower", "arm_l.end");
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(test::body(arms()), model.change);
    for (const double degrees : {-170.0, -90.0, 30.0, 120.0, 170.0}) {
      CAPTURE(degrees);
      test::Pose pose(rig);
      pose.turn_in_world(kHand, test::mapped(model.by, about(axis, degrees)));
      for (std::size_t i = 0; i < 3; ++i) {
        const double part = static_cast<double>(i + 1) / 3;
        const Quat expected = test::mapped(model.by, about(axis, degrees * part));
        CHECK(angle_between(turn_of(rig, pose, nth(kForearm, i)), expected) < 1e-6);
        CHECK(test::distance(pose.position(nth(kForearm, i)), rig.rest(nth(kForearm, i)).origin) <
              1e-9 * rig.skeleton.character.height);
      }
    }
  }
}

TEST_CASE("modules twist_joints: no joint flips while the hand turns from -170 to 170 degrees") {
  const test::Rig rig(test::body(arms()));
  const Vec3 axis = bone(rig, "arm_l.lower", "arm_l.end");
  // The hand is bent to the side meanwhile.
  const Quat bend = about(math::perpendicular(axis), 50);
  std::vector<Quat> last;
  for (int degrees = -170; degrees <= 170; degrees += 2) {
    CAPTURE(degrees);
    test::Pose pose(rig);
    pose.turn_in_world(kHand, bend * about(axis, degrees));
    std::vector<Quat> now;
    for (std::size_t i = 0; i < 3; ++i) {
      now.push_back(turn_of(rig, pose, nth(kForearm, i)));
      const double part = static_cast<double>(i + 1) / 3;
      CHECK(angle_between(now[i], about(axis, degrees * part)) < 1e-6);
      if (!last.empty()) CHECK(angle_between(now[i], last[i]) < 2.001);
    }
    last = now;
  }
}

TEST_CASE("modules twist_joints: a shoulder stays while its arm turns about itself") {
  const test::Rig plain(test::body(arms()));
  const Vec3 axis = bone(plain, "arm_l.upper", "arm_l.lower");
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(test::body(arms()), model.change);
    for (const double degrees : {-170.0, -60.0, 100.0, 170.0}) {
      // It is lifted forward too, and the clavicle with all that hangs on it goes up.
      const Quat lift = about({0, 1, 0}, -40), shrug = about({0, 0, 1}, 20);
      test::Pose pose(rig);
      pose.turn_in_world("arm_l.clavicle/control", test::mapped(model.by, shrug));
      pose.turn_in_world(kUpper, test::mapped(model.by, lift * about(axis, degrees)));
      const Quat swing = math::conjugate(math::between(axis, axis)) *
                         math::between(axis, math::matrix(lift) * axis);
      // What the arm turns about itself: the lift has a part of it too.
      const Quat whole = lift * about(axis, degrees);
      const Quat twist = math::conjugate(swing) * whole;
      const double turned =
          2 * math::degrees(math::atan2(
                  math::dot(Vec3{twist.x, twist.y, twist.z}, axis) * (twist.w < 0 ? -1.0 : 1.0),
                  std::abs(twist.w)));
      for (std::size_t i = 0; i < 3; ++i) {
        const double part = static_cast<double>(i) / 3;
        const Quat expected = test::mapped(model.by, shrug * swing * about(axis, turned * part));
        CHECK(angle_between(turn_of(rig, pose, nth(kUpperArm, i)), expected) < 1e-6);
      }
      CHECK(angle_between(turn_of(rig, pose, "arm_l.upper"),
                          test::mapped(model.by, shrug * whole)) < 1e-6);
    }
  }
}

TEST_CASE("modules twist_joints: in IK too, and both sides mirror each other") {
  const test::Rig rig(test::body(arms()), test::mirror_right_side);
  test::Pose pose(rig);
  for (const std::string s : {"l", "r"}) {
    pose.set("arm_" + s + "/ik_fk_limb.settings@ik_fk", 1.0);
    pose.set("arm_" + s + "/ik_fk_limb.ik@lower_twist", 40.0);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string right = "arm_r.lower/twist_joints.twist";
    const Quat l = turn_of(rig, pose, nth(kForearm, i)), r = turn_of(rig, pose, nth(right, i));
    if (i < 2) CHECK(angle_between(l, {}) > 10);  // the last is as the hand, which stays
    CHECK(angle_between({l.x, -l.y, -l.z, l.w}, r) < 1e-6);
  }
}

TEST_CASE("modules twist_joints: they keep their places along a bone that grows") {
  test::Commands commands = arms();
  commands["hand_l"] =
      "{command: connect, with: {from: torso.hips/control@translate, to: "
      "arm_l.end@translate}}";
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(test::body(commands), model.change);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.listed());
    const Vec3 long_bone = rig.scene().local(rig.node("arm_l.end")).translation * 1.7;
    test::Pose pose(rig);
    pose.translate("torso.hips/control", long_bone);
    const Vec3 elbow = pose.position("arm_l.lower"), wrist = pose.position("arm_l.end");
    CHECK(test::distance(elbow, wrist) >
          1.6 * test::distance(rig.rest("arm_l.lower").origin, rig.rest("arm_l.end").origin));
    for (std::size_t i = 0; i < 3; ++i) {
      const double part = static_cast<double>(i + 1) / 3;
      CHECK(test::distance(pose.position(nth(kForearm, i)), elbow + (wrist - elbow) * part) <
            1e-9 * rig.skeleton.character.height);
    }
  }
}

TEST_CASE("modules twist_joints: the animator says how much, for several bones at once") {
  const test::Rig rig(test::body(arms(", settings: \"arm_l/ik_fk_limb.settings\"")));
  INFO(test::text(rig.diagnostics));
  const Vec3 axis = bone(rig, "arm_l.lower", "arm_l.end");
  const Vec3 upper = bone(rig, "arm_l.upper", "arm_l.lower");
  for (const double amount : {0.0, 0.5, 1.0}) {
    test::Pose pose(rig);
    pose.set("arm_l/ik_fk_limb.settings@twist", amount);
    pose.turn_in_world(kHand, about(axis, 150));
    CHECK(angle_between(turn_of(rig, pose, nth(kForearm, 2)), about(axis, 150 * amount)) < 1e-6);
    test::Pose raised(rig);
    raised.set("arm_l/ik_fk_limb.settings@twist", amount);
    raised.turn_in_world(kUpper, about(upper, 100));
    CHECK(angle_between(turn_of(rig, raised, nth(kUpperArm, 0)), about(upper, 100 - 100 * amount)) <
          1e-6);
  }
}

namespace {

/// Puts a joint that no template knows between two others, or beside the second.
void add_rider(tags::TaggedSkeleton& skeleton, const std::string& from, const std::string& to,
               double fraction, bool between) {
  std::vector<Affine> worlds = test::worlds(skeleton);
  const auto index = [&](const std::string& name) {
    for (std::size_t i = 0; i < skeleton.joints.size(); ++i)
      if (skeleton.joints[i].name == name) return i;
    FAIL("no joint " << name);
    return std::size_t{0};
  };
  const std::size_t start = index(from), end = index(to);
  tags::TaggedJoint rider;
  rider.name = from + "_roll";
  rider.key.uid = hash64(rider.name + std::to_string(fraction));
  rider.ids.global = skeleton.global;
  rider.parent = skeleton.joints[end].parent;
  REQUIRE(static_cast<std::size_t>(rider.parent) >= start);
  Affine world = worlds[end];
  world.linear = math::matrix(math::from_euler_degrees({20, 30, 40}));
  world.origin = worlds[start].origin + (worlds[end].origin - worlds[start].origin) * fraction;
  // Before the end, so that parents stay first.
  const auto at = static_cast<std::ptrdiff_t>(end);
  skeleton.joints.insert(skeleton.joints.begin() + at, rider);
  worlds.insert(worlds.begin() + at, world);
  for (tags::TaggedJoint& joint : skeleton.joints)
    if (joint.parent >= static_cast<int>(end)) ++joint.parent;
  if (between) skeleton.joints[end + 1].parent = static_cast<int>(end);
  test::set_worlds(skeleton, worlds);
}

scene::NodeId node_named(const test::Rig& rig, const std::string& name, std::size_t nth) {
  for (const scene::NodeId id : rig.scene().nodes())
    if (rig.scene()[id].name == name && nth-- == 0) return id;
  FAIL("no node " << name);
  return {};
}

}  // namespace

TEST_CASE("modules twist_joints: the model's own twist joints are used where it has some") {
  for (const bool between : {false, true})
    for (const test::Model& model : test::models()) {
      CAPTURE(between);
      CAPTURE(model.name);
      const test::Rig rig(test::body(arms()), [&](tags::TaggedSkeleton& skeleton) {
        add_rider(skeleton, "forearm_l", "hand_l", 0.25, between);
        add_rider(skeleton, "forearm_l", "hand_l", 0.75, between);
        model.change(skeleton);
      });
      INFO(test::text(rig.diagnostics));
      REQUIRE(rig.clean());
      CHECK(rig.nodes(kForearm + "?").empty());
      CHECK(rig.nodes(kUpperArm).size() == 3);
      CHECK(test::rest_error(rig) < 1e-9);
      const Vec3 axis = bone(rig, "arm_l.lower", "arm_l.end");
      test::Pose pose(rig);
      pose.turn_in_world(kHand, about(axis, 160));
      CHECK(angle_between(turn_of(rig, pose, "arm_l.end"), about(axis, 160)) < 1e-6);
      for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
        const scene::NodeId rider = node_named(rig, "forearm_l_roll", i);
        const Affine now = pose.worlds({rider})[0], rest = rig.scene().rest_world(rider);
        const Quat turned = math::quaternion(math::orthonormal(now.linear) *
                                             math::transposed(math::orthonormal(rest.linear)));
        CHECK(angle_between(turned, about(axis, 160 * (i == 0 ? 0.25 : 0.75))) < 1e-6);
        CHECK(test::distance(now.origin, rest.origin) < 1e-9 * rig.skeleton.character.height);
      }
    }
}

TEST_CASE("modules twist_joints: a ribbon's joints share out the twist, and bend as without") {
  const auto ribboned = [](bool twisted) {
    test::Commands commands = arms();
    for (const std::string s : {"l", "r"}) {
      std::string& upper = commands["upperarm_" + s];
      const std::size_t twist = upper.find('\n') + 1;
      const std::string ribbon = fmt::format(
          "{{command: ribbon, with: {{along: [., arm_{0}.lower, arm_{0}.end], count: 9}}}}\n", s);
      upper = twisted ? upper.insert(twist, ribbon) : upper.substr(0, twist) + ribbon;
      if (!twisted) commands.erase("forearm_" + s);
    }
    return commands;
  };
  const std::string pins = "arm_l.upper/ribbon.joint", bend = "arm_l.lower/ribbon.tweak";
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(test::body(ribboned(true)), model.change);
    const test::Rig plain(test::body(ribboned(false)), model.change);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
    CHECK(rig.nodes(kForearm + "?").empty());
    auto joints = rig.nodes(pins), plain_joints = plain.nodes(pins);
    for (const auto& [of, list] : {std::pair(&rig, &joints), std::pair(&plain, &plain_joints)})
      for (const scene::NodeId more : of->nodes("arm_l.lower/ribbon.joint")) list->push_back(more);
    REQUIRE(joints.size() == 9);
    const auto turned = [&](const test::Pose& pose, scene::NodeId joint) {
      const Affine now = pose.worlds({joint})[0], rest = rig.scene().rest_world(joint);
      return math::quaternion(math::orthonormal(now.linear) *
                              math::transposed(math::orthonormal(rest.linear)));
    };
    for (const double degrees : {-170.0, 60.0, 170.0}) {
      CAPTURE(degrees);
      const Vec3 lower = bone(rig, "arm_l.lower", "arm_l.end");
      const Vec3 upper = bone(rig, "arm_l.upper", "arm_l.lower");
      test::Pose hand(rig), shoulder(rig);
      hand.turn_in_world(kHand, about(lower, degrees));
      shoulder.turn_in_world(kUpper, about(upper, degrees));
      for (const scene::NodeId joint : joints) {
        const Vec3 at = rig.scene().rest_world(joint).origin;
        const auto part = [&](const std::string& from, const std::string& to) {
          const Vec3 way = rig.rest(to).origin - rig.rest(from).origin;
          return math::dot(at - rig.rest(from).origin, way) / math::dot(way, way);
        };
        const double on_lower = std::clamp(part("arm_l.lower", "arm_l.end"), 0.0, 1.0);
        const double on_upper = std::clamp(part("arm_l.upper", "arm_l.lower"), 0.0, 1.0);
        CHECK(angle_between(turned(hand, joint), about(lower, degrees * on_lower)) < 1.5);
        if (on_upper < 1)
          CHECK(angle_between(turned(shoulder, joint), about(upper, degrees * on_upper)) < 1.5);
      }
    }
    test::Pose bow(rig), plain_bow(plain);
    for (test::Pose* pose : {&bow, &plain_bow}) pose->translate(nth(bend, 1), {0, 0.2, 0.1});
    const auto places = bow.worlds(joints), expected = plain_bow.worlds(plain_joints);
    for (std::size_t i = 0; i < joints.size(); ++i) {
      CHECK(test::distance(places[i].origin, expected[i].origin) <
            1e-9 * rig.skeleton.character.height);
      CHECK(math::length(places[i].linear.y - expected[i].linear.y) < 1e-9);
    }
    // Both at once. What lies a little beside the curve at rest goes round it.
    bow.turn_in_world(kHand, about(bone(rig, "arm_l.lower", "arm_l.end"), 150));
    const auto both = bow.worlds(joints);
    for (std::size_t i = 0; i < joints.size(); ++i)
      CHECK(test::distance(both[i].origin, expected[i].origin) <
            1e-3 * rig.skeleton.character.height);
  }
}
