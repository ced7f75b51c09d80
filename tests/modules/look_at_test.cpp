// SPDX-License-Identifier: MIT
// look_at: the eyes look where the target is, on every model.
#include <doctest/doctest.h>

#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

const std::string kHead = R"(rigc: 1
name: test
version: 1
joints:
  - name: head
    at: [0, 1.6, 0]
    local: head
    label: head
    tags:
      - {command: control, with: {}}
      - {command: look_at, with: {eyes: [eye_l.eye, eye_r.eye], distance: 0.4}}
  - name: eye_l
    parent: head
    at: [0.03, 1.66, 0.08]
    local: eye_l
    label: eye
  - name: eye_r
    parent: head
    at: [-0.03, 1.66, 0.08]
    local: eye_r
    label: eye
)";

const std::string kTarget = "head/look_at.target";

/// Where an eye looks: what was ahead of it at rest.
Vec3 gaze(const test::Rig& rig, const test::Pose& pose, const std::string& eye) {
  const math::Affine motion = pose.world(eye) * math::inverse(rig.rest(eye));
  return math::normalised(motion.linear * rig.skeleton.character.forward);
}

}  // namespace

TEST_CASE("modules look_at: both eyes look at the target, with their distance kept") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(kHead, model.change);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    test::Pose pose(rig);
    pose.move_to(kTarget, model.by * Vec3{0.3, 1.9, 0.6});
    for (const std::string eye : {"eye_l.eye", "eye_r.eye"}) {
      const Vec3 aim = pose.position(eye + "/look_at.aim");
      CHECK(math::dot(gaze(rig, pose, eye), math::normalised(aim - pose.position(eye))) >
            1 - 1e-12);
    }
    const Vec3 left = pose.position("eye_l.eye/look_at.aim");
    const Vec3 middle = pose.position(kTarget);
    CHECK(test::distance(left - middle, model.by.linear * Vec3{0.03, 0, 0}) <
          1e-9 * rig.skeleton.character.height);
  }
}

TEST_CASE("modules look_at: an eye's own control moves that eye alone") {
  const test::Rig rig(kHead);
  test::Pose pose(rig);
  const Vec3 right = gaze(rig, pose, "eye_r.eye");
  pose.translate("eye_l.eye/look_at.aim", {0.1, 0, 0});
  CHECK(gaze(rig, pose, "eye_l.eye").x > 0.2);
  CHECK(test::distance(gaze(rig, pose, "eye_r.eye"), right) < 1e-12);
}

TEST_CASE("modules look_at: the head turns, the eyes stay on the target and upright in the head") {
  const test::Rig rig(kHead);
  test::Pose pose(rig);
  pose.rotate("head.head/control", {0, 30, 0});
  const Vec3 aim = pose.position("eye_l.eye/look_at.aim");
  CHECK(math::dot(gaze(rig, pose, "eye_l.eye"),
                  math::normalised(aim - pose.position("eye_l.eye"))) > 1 - 1e-12);
  test::Pose rolled(rig);
  rolled.rotate("head.head/control", {0, 0, 90});
  const math::Affine eye = rolled.world("eye_l.eye");
  CHECK(eye.linear.y.x < -0.95);  // its up lies where the head's up lies
}

TEST_CASE("modules look_at: under a parent the target follows it") {
  std::string text = kHead;
  text.replace(text.find("distance: 0.4"), 13, "parent: ./control");
  const test::Rig rig(text);
  REQUIRE(rig.clean());
  test::Pose pose(rig);
  pose.rotate("head.head/control", {0, 30, 0});
  CHECK(test::distance(gaze(rig, pose, "eye_l.eye"),
                       math::rotate(math::from_euler_degrees({0, 30, 0}), Vec3{0, 0, 1})) < 1e-9);
}

TEST_CASE("modules look_at: parallel eyes, or eyes that cross at the target, and between") {
  const test::Rig rig(kHead);
  const auto apart = [&](double converge) {
    test::Pose pose(rig);
    pose.move_to(kTarget, {0, 1.66, 0.3}).set(kTarget + "@converge", converge);
    return math::degrees(std::acos(
        std::min(1.0, math::dot(gaze(rig, pose, "eye_l.eye"), gaze(rig, pose, "eye_r.eye")))));
  };
  CHECK(apart(0) < 1e-5);
  CHECK(apart(1) == doctest::Approx(2 * math::degrees(std::atan2(0.03, 0.22))));
  CHECK(apart(0.5) > 0.4 * apart(1));
  CHECK(apart(0.5) < 0.6 * apart(1));
}

namespace {

/// With lids of which the joints lie in the eyes' middles, and at their edges.
std::string with_lids(const std::string& more = {}) {
  std::string text = kHead;
  text.replace(
      text.find(", distance: 0.4"), 15,
      ", upper_lids: [eye_r.upper, eye_l.upper], lower_lids: [eye_l.lower, eye_r.lower]" + more);
  for (const bool left : {true, false}) {
    const std::string side = left ? "l" : "r", x = left ? "0.03" : "-0.03";
    for (const auto& [name, place] :
         {std::pair{"upper_", "1.66, 0.08"}, std::pair{"lower_", "1.65, 0.09"}}) {
      text += "  - {name: " + (name + side) + ", parent: head, at: [" + x + ", " + place +
              "], local: eye_" + side + ", label: " + std::string(name, 5) + "}\n";
    }
  }
  return text;
}

/// Degrees by which what a lid carries in front of the eye went up.
double lifted(const test::Rig& rig, const test::Pose& pose, const std::string& lid,
              const math::Affine& by = {}) {
  const math::Affine motion =
      math::inverse(by) * pose.world(lid) * math::inverse(rig.rest(lid)) * by;
  const Vec3 eye{lid.starts_with("eye_l") ? 0.03 : -0.03, 1.66, 0.08};
  CHECK(test::distance(motion * eye, eye) < 1e-9);  // it turns about the eye
  const Vec3 moved = motion.linear * Vec3{0, 0, 1};
  return math::degrees(std::asin(moved.y / math::length(moved)));
}

}  // namespace

TEST_CASE("modules look_at: lids follow the eyes, the upper ones more, on every model") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(with_lids(), model.change);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
    test::Pose pose(rig);
    pose.move_to(kTarget, model.by * Vec3{0, 1.36, 0.58});
    const double eye = -math::degrees(std::atan2(0.3, 0.5));
    for (const std::string side : {"eye_l", "eye_r"}) {
      CHECK(lifted(rig, pose, side + ".upper", model.by) == doctest::Approx(0.8 * eye));
      CHECK(lifted(rig, pose, side + ".lower", model.by) == doctest::Approx(0.35 * eye));
    }
    pose.set(kTarget + "@lids", 0.0);
    CHECK(std::abs(lifted(rig, pose, "eye_l.upper", model.by)) < 1e-9);
  }
}

TEST_CASE("modules look_at: a lid's own control closes it on top of that") {
  const test::Rig rig(with_lids(", parent: ./control"));
  test::Pose pose(rig);
  pose.rotate("eye_l.upper/look_at", {40, 0, 0});
  CHECK(lifted(rig, pose, "eye_l.upper") == doctest::Approx(-40));
  CHECK(std::abs(lifted(rig, pose, "eye_r.upper")) < 1e-9);
  pose.translate(kTarget, {0, 0.2, 0});
  CHECK(lifted(rig, pose, "eye_l.upper") > -40 + 10);
}

TEST_CASE("modules look_at: each lid goes with the eye that it lies nearest to") {
  const test::Rig rig(with_lids());
  test::Pose pose(rig);
  pose.translate("eye_l.eye/look_at.aim", {0, -0.1, 0});
  for (const std::string lid : {"upper", "lower"}) {
    CHECK(lifted(rig, pose, "eye_l." + lid) < -3);
    CHECK(std::abs(lifted(rig, pose, "eye_r." + lid)) < 1e-9);
  }
}

TEST_CASE("modules look_at: eyes and lids name each other, the target between them nobody") {
  std::string held = with_lids();  // by the head; then by an eye, as in templates
  const std::string command = "      - {command: look_at";
  const std::size_t from = held.find(command), to = held.find('\n', from) + 1;
  const std::string moved = held.substr(from, to - from);
  held.erase(from, to - from);
  const std::string eye = "    local: eye_l\n    label: eye\n";
  held.insert(held.find(eye) + eye.size(), "    tags:\n" + moved);
  for (const bool by_eye : {false, true}) {
    CAPTURE(by_eye);
    const test::Rig rig(by_eye ? held : with_lids());
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    const auto opposite = [&](const std::string& control) {
      return std::get<std::string>(rig.scene().value(rig.plug(control + "@opposite")));
    };
    for (const std::string own : {"eye_l", "eye_r"}) {
      const std::string other = own == "eye_l" ? "eye_r" : "eye_l";
      for (const std::string control : {".eye/look_at.aim", ".upper/look_at.fk"})
        CHECK(opposite(own + control) == to_text(rig.scene()[rig.node(other + control)].identity));
    }
    const scene::Node& target = rig.scene()[rig.node(kTarget)];
    CHECK(target.name == "head_target");
    CHECK(opposite(kTarget).empty());
  }
}
