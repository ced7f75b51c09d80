// SPDX-License-Identifier: MIT
// wheel: a joint that rolls as far as what carries it has travelled, with a control to turn it by
// hand. Test: tests/modules/wheel_test.cpp
#include "modules/codes.h"
#include "modules/registry.h"
#include "modules/wiring.h"

namespace rigc::modules {
namespace {

/// From the parameter, else as high as the axle rests above what carries it.
double radius_of(Builder& b, NodeId carrier) {
  if (b.with().has("radius")) return b.with().number("radius");
  const math::Vec3 above = position(b, b.joint()) - position(b, carrier);
  const double height = math::dot(above, b.character().up);
  if (!(height > 1e-6 * b.character().height))
    b.fail(codes::kNoRadius, {}, "the axle does not rest above its carrier", "give `radius`");
  return height;
}

/// Turns `roller` by how far the carrier has gone along the wheel's heading. Angles are
/// right-handed about the axle, so that the top of the wheel goes forward.
void roll(Builder& b, NodeId base, NodeId roller, NodeId carrier, const Plug& amount,
          double radius) {
  const Computed rolled = compute(b, b.joint(), "roll",
                                  {{"base", base},
                                   {"carrier", carrier},
                                   {"started", position(b, carrier)},
                                   {"radius", radius},
                                   {"amount", amount}},
                                  "size = length(base.z);"
                                  "gone = dot(carrier.origin - started, base.z) / size;"
                                  "degrees = gone / (radius * size) * (180 / pi);"
                                  "out turn = axis_angle(vector(1, 0, 0), degrees * amount);");
  b.connect(rolled["turn"], {roller, scene::transform::kRotation});
}

}  // namespace

void wheel(Builder& b) {
  const Parameters& with = b.with();
  const NodeId space = space_from(b, "parent", space_of(b, b.joint()));
  const NodeId root = root_control(b);
  const NodeId carrier = space_from(b, "carrier", root.valid() ? root : space);
  if (b.failed()) return;
  if (!carrier.valid()) {
    b.fail(codes::kNoRadius, {}, "nothing carries the wheel", "add a `root`, or give `carrier`");
    return;
  }
  const double radius = radius_of(b, carrier);
  if (b.failed()) return;
  const math::Affine frame{character_axes(b), position(b, b.joint())};
  const NodeId base = make_place(b, b.joint(), "base", space, frame);
  const NodeId roller = b.make({.kind = scene::Kind::transform,
                                .role = "driver",
                                .joint = b.joint(),
                                .parent = base,
                                .suffix = "roller"});
  ControlSpec spec;
  spec.joint = b.joint();
  spec.shape = with.text("shape");
  spec.size = with.has("size") ? with.number("size") : 2.2 * radius;
  spec.color = side_color(b, b.joint(), "color");
  spec.facing = {1, 0, 0};
  spec.frame = frame;
  spec.space = roller;
  spec.translate = false;
  const ControlNodes made = make_control(b, spec);
  if (b.failed()) return;
  const Plug amount =
      add_number(b, made.control, {.name = "auto_roll", .value = 1, .min = 0, .max = 1});
  roll(b, base, roller, carrier, amount, radius);
  drive(b, spec, made.control);
}

}  // namespace rigc::modules
