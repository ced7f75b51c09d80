// SPDX-License-Identifier: MIT
// neck_head: FK controls of a neck and a head on top, which bends the neck as it turns. The head's
// own turn counts from where the neck's controls bring it, however much of it the neck takes.
// Test: tests/modules/neck_head_test.cpp
#include <fmt/format.h>

#include "modules/layers.h"
#include "modules/registry.h"

namespace rigc::modules {
namespace {

namespace transform = scene::transform;
using math::Quat;

struct Neck {
  std::vector<NodeId> joints, zeros, controls;
  NodeId space;  ///< what the next control hangs under
};

Quat rotation_of(const Builder& b, NodeId node) {
  return math::quaternion(math::orthonormal(rest(b, node).linear));
}

Neck make_neck(Builder& b) {
  const Parameters& with = b.with();
  Neck neck;
  neck.joints = with.nodes("neck");
  const NodeId first = neck.joints.empty() ? with.node("head") : neck.joints.front();
  neck.space = space_from(b, "parent", space_of(b, first));
  ControlSpec spec;
  spec.role = "fk";
  spec.shape = with.text("neck_shape");
  spec.shape_parameter = "neck_shape";
  spec.size = with.number("neck_size");
  spec.axes = AxesFrom::bone;
  spec.translate = false;
  for (std::size_t i = 0; i < neck.joints.size() && !b.failed(); ++i) {
    spec.joint = neck.joints[i];
    const math::Vec3 bone = chain_direction(b, neck.joints, i);
    spec.frame = oriented(b, spec.joint, "bone", bone);
    spec.color = side_color(b, spec.joint, "color");
    face(b, spec, "bone", bone);
    spec.space = neck.space;
    const ControlNodes made = make_control(b, spec);
    if (b.failed()) break;
    drive(b, spec, made.control);
    neck.zeros.push_back(made.zero);
    neck.controls.push_back(made.control);
    neck.space = made.control;
  }
  return neck;
}

ControlNodes make_head(Builder& b, const Neck& neck) {
  const Parameters& with = b.with();
  ControlSpec spec;
  spec.joint = with.node("head");
  spec.frame = oriented(b, spec.joint, "character");
  spec.space = neck.space;
  spec.shape = with.text("shape");
  spec.size = with.number("size");
  spec.color = side_color(b, spec.joint, "color");
  spec.offset = with.vec3("offset");
  spec.translate = with.flag("translate");
  const ControlNodes made = make_control(b, spec);
  if (!b.failed()) drive(b, spec, made.control);
  return made;
}

/// Each neck joint takes an equal part of what `neck_bend` of the head's turn is; the head's zero
/// takes that back.
void bend_neck(Builder& b, const Neck& neck, const ControlNodes& head) {
  std::vector<Given> given;
  given.emplace_back("head", Plug{head.control, transform::kRotation});
  given.emplace_back(
      "part",
      add_number(b, head.control,
                 {.name = "neck_bend", .value = b.with().number("neck_bend"), .min = 0, .max = 1}));
  const Quat head_axes = rotation_of(b, head.zero);
  std::string text = fmt::format("share = part / {};", neck.controls.size());
  text += "still = axis_angle(vector(1, 0, 0), 0);";
  std::string with_bend, without_bend;
  for (std::size_t i = 0; i < neck.controls.size(); ++i) {
    const Quat axes = rotation_of(b, neck.zeros[i]);
    // How axes of the zero below are turned to those of this one: where the neck begins not at all.
    const Quat step = i == 0 ? Quat{} : math::conjugate(rotation_of(b, neck.zeros[i - 1])) * axes;
    given.emplace_back(fmt::format("seen{}", i), scene::Value(math::conjugate(axes) * head_axes));
    given.emplace_back(fmt::format("step{}", i), scene::Value(step));
    given.emplace_back(fmt::format("fk{}", i), Plug{neck.controls[i], transform::kRotation});
    text += fmt::format("out bend{0} = slerp(still, seen{0} * head * inverse(seen{0}), share);", i);
    const std::string joint = i == 0 ? "" : " * ";
    with_bend += joint + fmt::format("step{0} * bend{0} * fk{0}", i);
    without_bend += joint + fmt::format("step{0} * fk{0}", i);
  }
  const Quat last = math::conjugate(rotation_of(b, neck.zeros.back())) * head_axes;
  given.emplace_back("last", scene::Value(last));
  text += "out zero = inverse(" + with_bend + ") * (" + without_bend + ") * last;";
  const Computed bent = compute(b, neck.joints.front(), "neck_bend", given, text);
  for (std::size_t i = 0; i < neck.controls.size(); ++i) {
    const NodeId layer = make_layer(b, neck.controls[i], "bend");
    b.connect(bent[fmt::format("bend{}", i)], {layer, transform::kRotation});
  }
  b.connect(bent["zero"], {head.zero, transform::kRotation});
}

}  // namespace

void neck_head(Builder& b) {
  std::vector<NodeId> joints = b.with().nodes("neck");
  joints.push_back(b.with().node("head"));
  if (!check_order(b, joints, "neck")) return;
  const Neck neck = make_neck(b);
  if (b.failed()) return;
  const ControlNodes head = make_head(b, neck);
  if (!b.failed() && !neck.controls.empty()) bend_neck(b, neck, head);
}

}  // namespace rigc::modules
