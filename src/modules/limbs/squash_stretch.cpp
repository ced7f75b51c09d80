// SPDX-License-Identifier: MIT
// squash_stretch: a handle at the end of a joint's bone that makes it longer and thinner.
// Test: tests/modules/squash_stretch_test.cpp
#include <fmt/format.h>

#include <cmath>

#include "modules/codes.h"
#include "modules/registry.h"
#include "modules/wiring.h"

namespace rigc::modules {
namespace {

namespace transform = scene::transform;

/// A joint can be scaled along its own axes alone: the one nearest to its bone.
struct Axis {
  std::size_t index = 0;
  math::Vec3 direction;  ///< unit, rig space, along the bone
};

Axis axis_of(const Builder& b, NodeId joint) {
  const math::Mat3 axes = math::orthonormal(rest(b, joint).linear);
  const math::Vec3 bone = bone_direction(b, joint);
  Axis found;
  double most = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const math::Vec3 axis = i == 0 ? axes.x : i == 1 ? axes.y : axes.z;
    const double cosine = math::dot(axis, bone);
    if (std::abs(cosine) <= most) continue;
    most = std::abs(cosine);
    found = {i, cosine < 0 ? -axis : axis};
  }
  return found;
}

/// What turns below a joint that is scaled unevenly would be sheared.
bool check_leaf(Builder& b, NodeId joint) {
  for (const NodeId child : b.scene()[joint].children) {
    if (is_driven(b.scene(), child)) {
      b.fail(
          codes::kDrivenBelow, "joint",
          fmt::format("{} is below {} and moves by itself", traversal::describe(b.scene(), child),
                      traversal::describe(b.scene(), joint)),
          "name a joint without such children, or make one for the shape with `joint`");
      return false;
    }
    if (!check_leaf(b, child)) return false;
  }
  return true;
}

/// The control that turns a joint, which the handle goes with; else what its control would hang
/// under.
NodeId carrier_of(const Builder& b, NodeId joint) {
  const auto turned = b.scene().source({joint, transform::kRotation});
  if (turned && b.scene()[turned->node].kind == scene::Kind::parent_constraint) {
    const auto by = b.scene().source({turned->node, scene::constraint::kTargets, 0});
    if (by) return by->node;
  }
  return space_of(b, joint);
}

NodeId make_handle(Builder& b, NodeId joint, const Axis& axis, double length) {
  const Parameters& with = b.with();
  ControlSpec spec;
  spec.joint = joint;
  spec.role = "tweak";
  spec.suffix = "squash";
  spec.shape = with.text("shape");
  spec.size = with.number("size");
  spec.color = side_color(b, joint, "color");
  spec.axes = AxesFrom::bone;
  spec.frame = {bone_frame(b, joint, axis.direction), position(b, joint) + axis.direction * length};
  face(b, spec, "bone", axis.direction);
  spec.rotate = false;
  spec.space = space_from(b, "parent", carrier_of(b, joint));
  if (b.failed()) return {};
  return make_control(b, spec).control;
}

}  // namespace

void squash_stretch(Builder& b) {
  const Parameters& with = b.with();
  const NodeId joint = with.node("joint");
  if (!check_leaf(b, joint)) return;
  const Axis axis = axis_of(b, joint);
  const double length = with.has("length") ? with.number("length") : bone_length(b, joint);
  const NodeId handle = make_handle(b, joint, axis, length);
  if (b.failed()) return;
  const Plug active =
      add_number(b, handle, {.name = "active", .value = with.number("active"), .min = 0, .max = 1});
  const Plug squash = add_number(b, handle, {.name = "squash", .min = -0.9, .max = 10});
  const Plug volume =
      add_number(b, handle, {.name = "volume", .value = with.number("volume"), .min = 0, .max = 1});
  const math::Vec3 bone{is_mirrored(b, joint) ? -length : length, 0, 0};
  const std::string along = "clamp((ratio + squash) * active + 1 - active, least, most)";
  const std::string parts = axis.index == 0   ? "long, across, across"
                            : axis.index == 1 ? "across, long, across"
                                              : "across, across, long";
  const Plug scale{joint, transform::kScale};
  const Computed sized = compute(b, joint, "squash",
                                 {{"moved", Plug{handle, transform::kTranslate}},
                                  {"bone", scene::Value(bone)},
                                  {"size", length},
                                  {"active", active},
                                  {"squash", squash},
                                  {"volume", volume},
                                  {"least", with.number("least")},
                                  {"most", with.number("most")},
                                  now(b, "own", scale)},
                                 "ratio = length(bone + moved) / size;"
                                 "long = " +
                                     along +
                                     ";"
                                     "across = pow(max(long, 0.01), -0.5 * volume);"
                                     "out scale = multiply(own, vector(" +
                                     parts + "));");
  b.reconnect(sized["scale"], scale);
}

}  // namespace rigc::modules
