// SPDX-License-Identifier: MIT
// What modules share: frames that mirror each other, what hangs under what, what drives what.
#include "modules/steps.h"

#include <doctest/doctest.h>

#include "modules/bodies_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

/// Both arms by FK chains and the given orientation of their controls.
std::string arms(const std::string& orient) {
  test::Commands commands;
  for (const std::string s : {"l", "r"}) {
    commands["clavicle_" + s] = "{command: fk_chain, with: {joints: [arm_" + s + ".clavicle, arm_" +
                                s + ".upper, arm_" + s + ".lower, arm_" + s +
                                ".end], translate: on, orient: " + orient + "}}";
  }
  return test::body(commands);
}

const std::vector<std::string> kArm{"clavicle", "upper", "lower", "end"};

std::string fk(const std::string& side, const std::string& label) {
  return "arm_" + side + "." + label + "/fk_chain";
}

std::vector<double> mirror_signs(const test::Rig& rig, const std::string& control) {
  return std::get<std::vector<double>>(rig.scene().value(rig.plug(control + "@mirror")));
}

/// Copies the same values to both sides, by the signs that the left control stores.
void pose_both_sides(const test::Rig& rig, test::Pose& pose) {
  test::Random random(21);
  for (const std::string& label : kArm) {
    const Vec3 degrees = random.vector(40), shift = random.vector(0.05);
    const std::vector<double> signs = mirror_signs(rig, fk("l", label));
    REQUIRE(signs.size() == 3);
    Vec3 other_degrees, other_shift;
    for (std::size_t i = 0; i < 3; ++i) {
      REQUIRE(signs[i] != 0);
      other_shift[i] = shift[i] * signs[i];
      other_degrees[i] = degrees[i] * -signs[i];
    }
    pose.rotate(fk("l", label), degrees).translate(fk("l", label), shift);
    pose.rotate(fk("r", label), other_degrees).translate(fk("r", label), other_shift);
  }
}

}  // namespace

TEST_CASE("modules steps: copied values mirror the pose, by the signs that controls store") {
  for (const char* orient : {"bone", "joint", "character", "world"}) {
    CAPTURE(std::string(orient));
    const test::Rig rig(arms(orient), test::mirror_right_side);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    test::Pose pose(rig);
    pose_both_sides(rig, pose);
    const auto motion = test::motion(rig, pose);
    CHECK(test::motion_difference(rig, motion, test::mirror_image(rig, motion)) < 1e-9);
    CHECK(test::motion_difference(rig, motion, std::vector<math::Affine>(motion.size())) > 0.05);
  }
}

TEST_CASE("modules steps: bone frames mirror without any sign, on fitted skeletons too") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const test::Rig rig(arms("bone"), [&](auto& s) {
      test::mirror_right_side(s);
      test::turn_axes(s, seed);  // a model's axes need not mirror each other
    });
    REQUIRE(rig.clean());
    for (const std::string& label : kArm) {
      CHECK(mirror_signs(rig, fk("l", label)) == std::vector<double>{-1, -1, -1});
    }
    test::Pose pose(rig);
    test::Random random(seed);
    for (const std::string& label : kArm) {
      const Vec3 degrees = random.vector(60);
      pose.rotate(fk("l", label), degrees).rotate(fk("r", label), degrees);
    }
    const auto motion = test::motion(rig, pose);
    CHECK(test::motion_difference(rig, motion, test::mirror_image(rig, motion)) < 1e-9);
  }
}

TEST_CASE("modules steps: opposite controls name each other") {
  const test::Rig rig(arms("bone"), test::mirror_right_side);
  const auto opposite = [&](const std::string& control) {
    return std::get<std::string>(rig.scene().value(rig.plug(control + "@opposite")));
  };
  for (const std::string& label : kArm) {
    const auto identity = [&](const std::string& s) {
      return to_text(rig.scene()[rig.node(fk(s, label))].identity);
    };
    CHECK(opposite(fk("l", label)) == identity("r"));
    CHECK(opposite(fk("r", label)) == identity("l"));
  }
  const test::Rig middle(test::body({{"head", "{command: control, with: {}}"}}));
  CHECK(std::get<std::string>(middle.scene().value(middle.plug("head/control@opposite"))).empty());
}

TEST_CASE("modules steps: offsets and shapes on mirrored joints mirror those on the other side") {
  for (const char* orient : {"bone", "joint", "character"}) {
    CAPTURE(std::string(orient));
    const std::string with =
        std::string("with: {shape: pin, size: 0.3, axis: y, orient: ") + orient;
    const auto commands = [&](double x) {  // expansion turns x round on mirrored joints
      const std::string offset = ", offset: [" + std::to_string(x) + ", 0.2, 0.3]}}";
      return "{command: control, " + with + offset +
             "\n{command: joint, with: {label: helper, orient: " + orient + offset;
    };
    const test::Rig rig(test::body({{"forearm_l", commands(0.1)}, {"forearm_r", commands(-0.1)}}),
                        test::mirror_right_side);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    const Vec3 left = rig.rest("arm_l.helper").origin;
    CHECK(test::distance(rig.rest("arm_r.helper").origin, {-left.x, left.y, left.z}) < 1e-9);
    const auto points = [&](const std::string& control) {
      return std::get<std::vector<double>>(rig.scene().value(rig.plug(control + "@points")));
    };
    const auto a = points("arm_l.lower/control"), b = points("arm_r.lower/control");
    REQUIRE(a.size() == b.size());
    for (std::size_t at = 0; at < a.size();) {
      const auto count = static_cast<std::size_t>(a[at++]);
      for (std::size_t i = 0; i < count; ++i, at += 3) {
        const Vec3 here = rig.rest("arm_l.lower/control") * Vec3{a[at], a[at + 1], a[at + 2]};
        const Vec3 there = rig.rest("arm_r.lower/control") * Vec3{b[at], b[at + 1], b[at + 2]};
        CHECK(test::distance(there, {-here.x, here.y, here.z}) < 1e-6);
      }
    }
  }
}

TEST_CASE("modules steps: a control hangs under the nearest control above, else under the root") {
  const std::string control = "{command: control, with: {}}";
  const test::Rig rig(test::body({{"root", "{command: root, with: {}}"},
                                  {"hips", control},
                                  {"head", control},
                                  {"foot_l", control}}));
  const auto parent = [&](const std::string& made) {
    return rig.scene()[rig.scene()[rig.node(made)].parent].parent;
  };
  CHECK(parent("torso.hips/control") == rig.node("root/root.offset"));
  CHECK(parent("head/control") == rig.node("torso.hips/control"));
  CHECK(parent("leg_l.end/control") == rig.node("torso.hips/control"));
}

TEST_CASE("modules steps: where a blend drives the joint above, a control follows that joint") {
  const test::Rig rig(
      test::body({{"root", "{command: root, with: {drive: on}}"},
                  {"upperarm_l",
                   "{command: ik_fk_limb, with: {start: ., middle: arm_l.lower, end: arm_l.end}}"},
                  {"hand_l", "{command: control, id: glove, with: {drive: off}}"}}));
  REQUIRE(rig.clean());
  // The glove's joint is driven by the limb; its control rides on the forearm, which a blend
  // drives.
  CHECK(rig.scene()[rig.node("arm_l/control#glove.zero")].parent == rig.node("root/root.offset"));
  test::Pose pose(rig);
  pose.set("arm_l/ik_fk_limb.settings@ik_fk", 0.4);
  pose.move_to("arm_l/ik_fk_limb.ik", {0.4, 1.2, 0.3})
      .rotate("arm_l.upper/ik_fk_limb.fk", {30, 0, 0});
  CHECK(test::distance(pose.position("arm_l/control#glove"), pose.position("arm_l.end")) < 1e-9);
}

TEST_CASE("modules steps: master scale enters a skeleton once") {
  const std::string control = "{command: control, with: {}}";
  const test::Rig rig(test::body({{"root", "{command: root, with: {drive: on}}"},
                                  {"hips", control},
                                  {"chest", control},
                                  {"head", control}}));
  int scaled = 0;
  for (const tags::TaggedJoint& joint : rig.skeleton.joints) {
    const scene::Plug scale{rig.index().joint(joint.key), scene::transform::kScale};
    scaled += rig.scene().source(scale) ? 1 : 0;
  }
  CHECK(scaled == 1);
  CHECK(rig.scene().source(rig.plug("root@scale")));
}
