// SPDX-License-Identifier: MIT
// leg_3: an animal's leg of three bones, as an animator sees it.
#include <doctest/doctest.h>

#include <algorithm>

#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

/// Hip, knee, hock, paw and toe tip of a left leg, `more` commands of the paw.
std::string animal(const std::string& more, double spring = 1) {
  return test::template_of(R"(joints:
  - name: root
    at: [0, 0, 0]
    local: root
    label: root
    tags:
      - {command: root, with: {drive: on}}
  - name: body
    parent: root
    at: [0, 0.5, 0]
    local: body
    label: body
    tags:
      - {command: control, with: {}}
  - {name: hip, parent: body, at: [0.05, 0.4, 0], local: leg, label: hip}
  - {name: knee, parent: hip, at: [0.055, 0.26, 0.05], local: leg, label: knee}
  - {name: hock, parent: knee, at: [0.05, 0.14, -0.05], local: leg, label: hock}
  - name: paw
    parent: hock
    at: [0.055, 0.02, -0.02]
    local: leg
    label: paw
    tags:
      - {command: control, id: paw, with: {drive: off, parent: root/root.offset}}
      - {command: ik_fk_limb, with: {start: leg.hip, middle: leg.knee, end: leg.hock, bend: forward, ik_fk: 1, ik_parent: ./control#paw}}
      - {command: control, id: toes, with: {parent: leg.hock, translate: off}}
      - {command: leg_3, with: {limb: leg/ik_fk_limb.ik, paw: ., control: ./control#paw, spring: )" +
                           std::to_string(spring) + "}}\n" + more + R"(
  - {name: tip, parent: paw, at: [0.055, 0, 0.05], local: tip, label: toe}
)");
}

const std::string kPaw = "leg.paw/control#paw";

double angle_at(const test::Pose& pose, const std::string& a, const std::string& at,
                const std::string& b) {
  const Vec3 to_a = math::normalised(pose.position(a) - pose.position(at));
  const Vec3 to_b = math::normalised(pose.position(b) - pose.position(at));
  return math::degrees(math::acos(math::dot(to_a, to_b)));
}
double knee(const test::Pose& pose) { return angle_at(pose, "leg.hip", "leg.knee", "leg.hock"); }
double hock(const test::Pose& pose) { return angle_at(pose, "leg.knee", "leg.hock", "leg.paw"); }

}  // namespace

TEST_CASE("modules leg_3: at rest nothing moves") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(animal(""), model.change);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
  }
}

TEST_CASE("modules leg_3: knee and hock open and close by the same angle, the paw stands") {
  const test::Rig rig(animal(""));
  const test::Pose rest(rig);
  for (const double down : {0.03, -0.06, -0.12, -0.2}) {
    CAPTURE(down);
    test::Pose pose(rig);
    pose.translate("body.body/control", {0, down, 0});
    CHECK(test::distance(pose.position("leg.paw"), rest.position("leg.paw")) < 1e-9);
    CHECK(std::abs(knee(pose) - knee(rest)) > 5);
    // Equal in the plane of the leg; these joints lie a little beside it.
    CHECK(std::abs((hock(pose) - hock(rest)) - (knee(pose) - knee(rest))) < 0.3);
  }
}

TEST_CASE("modules leg_3: without spring the bone over the paw keeps its direction") {
  const test::Rig rig(animal("", 0));
  test::Pose pose(rig);
  const Vec3 before = pose.position("leg.hock") - pose.position("leg.paw");
  pose.translate("body.body/control", {0, -0.1, 0});
  CHECK(test::distance(pose.position("leg.hock") - pose.position("leg.paw"), before) < 1e-6);
}

TEST_CASE("modules leg_3: hock turns the bone over the paw, the paw stays") {
  const test::Rig rig(animal(""));
  const test::Pose rest(rig);
  test::Pose pose(rig);
  pose.set(kPaw + "@hock", 20.0);
  CHECK(test::distance(pose.position("leg.paw"), rest.position("leg.paw")) < 1e-9);
  CHECK(test::distance(pose.position("leg.hock"), rest.position("leg.hock")) > 0.03);
}

TEST_CASE("modules leg_3: stepping about, the leg follows without a jump and keeps its lengths") {
  const test::Rig rig(animal(""));
  const auto lengths = test::bone_lengths(rig, test::Pose(rig).joints());
  Vec3 last;
  double most = 0;
  for (int i = 0; i <= 360; ++i) {
    test::Pose pose(rig);
    pose.translate(kPaw, {0, 0.1 + 0.08 * math::sin_degrees(i), 0.1 * math::cos_degrees(i)});
    CHECK(test::largest_difference(test::bone_lengths(rig, pose.joints()), lengths) < 1e-9);
    const Vec3 now = pose.position("leg.hock");
    if (i > 0) most = std::max(most, test::distance(now, last));
    last = now;
  }
  CHECK(most < 0.01);
}

TEST_CASE("modules leg_3: the paw rolls by foot_roll under its own control") {
  const std::string roll =
      "      - {command: foot_roll, with: {limb: leg/ik_fk_limb.ik, control: ./control#paw, toes: "
      "./control#toes, tip: tip.toe}}\n";
  const test::Rig rig(animal(roll));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(test::rest_error(rig) < 1e-9);
  const test::Pose rest(rig);
  test::Pose pose(rig);
  pose.set(kPaw + "@roll", 30.0);
  CHECK(test::difference(pose.world("leg.paw"), rest.world("leg.paw"), 1) < 1e-6);
  CHECK(test::distance(pose.position("leg.hock"), rest.position("leg.hock")) > 0.03);
  test::Pose tiptoe(rig);
  tiptoe.set(kPaw + "@toe_lift", 30.0);
  CHECK(test::distance(tiptoe.position("tip.toe"), rest.position("tip.toe")) < 1e-6);
  CHECK(tiptoe.position("leg.paw").y > rest.position("leg.paw").y + 0.02);
}

TEST_CASE("modules leg_3: the same motion on every model") {
  const auto posed = [](const test::Rig& rig, const math::Affine& by) {
    test::Pose pose(rig);
    pose.move_to(kPaw, by * Vec3{0.1, 0.12, 0.08});
    pose.turn_in_world(kPaw, test::mapped(by, math::from_euler_degrees({10, 15, 5})));
    pose.set(kPaw + "@hock", 8.0).set(kPaw + "@spring", 0.7);
    return pose;
  };
  const test::Rig plain(animal(""));
  const auto expected = test::motion(plain, posed(plain, {}));
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(animal(""), model.change);
    CHECK(test::motion_difference(rig, test::motion(rig, posed(rig, model.by)),
                                  test::mapped(model.by, expected)) < 1e-6);
  }
}

TEST_CASE(
    "modules leg_3: a limb has one, its paw lies below the hock, and rolls under what holds it") {
  const std::string again =
      "      - {command: leg_3, id: again, with: {limb: leg/ik_fk_limb.ik, paw: ., control: "
      "./control#paw}}\n";
  CHECK(test::codes(test::Rig(animal(again)).diagnostics) == "RIG0464");
  const std::string beside =
      "      - {command: foot_roll, with: {limb: leg/ik_fk_limb.ik, control: ./control#toes}}\n";
  CHECK(test::codes(test::Rig(animal(beside)).diagnostics) == "RIG0890");
}
