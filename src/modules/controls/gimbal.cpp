// SPDX-License-Identifier: MIT
// gimbal: a second control under a control, for a turn of its own axes. What followed the first
// follows both. Test: tests/modules/gimbal_test.cpp
#include "modules/layers.h"
#include "modules/made.h"
#include "modules/registry.h"

namespace rigc::modules {
namespace {

namespace transform = scene::transform;
using scene::Kind;

/// The same lines, smaller.
std::vector<double> shrunk(std::vector<double> points, double size) {
  std::size_t left = 0;  // numbers until the next count of points
  for (double& number : points) {
    if (left == 0) {
      left = 3 * static_cast<std::size_t>(number);
    } else {
      number *= size;
      --left;
    }
  }
  return points;
}

/// Where the control is, with its axes and its looks.
NodeId make_gimbal(Builder& b, NodeId control, NodeId joint) {
  namespace attribute = scene::control;
  const auto of_control = [&](std::uint16_t at) { return b.scene().value({control, at}); };
  ControlSpec spec;
  spec.joint = joint;
  spec.suffix = "gimbal";
  spec.frame = rest(b, control);
  spec.space = control;
  spec.shape = std::get<std::string>(of_control(attribute::kShape));
  spec.color = b.with().vec3("color");
  spec.translate = false;
  const NodeId gimbal = make_control(b, spec).control;
  if (b.failed()) return {};
  const auto points = std::get<std::vector<double>>(of_control(attribute::kPoints));
  b.set({gimbal, attribute::kPoints}, shrunk(points, b.with().number("size")));
  b.set({gimbal, attribute::kMirror}, of_control(attribute::kMirror));
  return gimbal;
}

/// Members of layers and sets, what is limited and what is keyed to match stay the control itself.
bool is_about_control(Kind kind) {
  return kind == Kind::display_layer || kind == Kind::control_set || kind == Kind::limits ||
         kind == Kind::match || kind == Kind::spaces;
}

/// What hangs under the control or follows it now does so under `turned`.
void hand_over(Builder& b, NodeId control, NodeId turned, NodeId zero) {
  const std::vector<NodeId> children = b.scene()[control].children;
  for (NodeId child : children) {
    if (child != turned && child != zero) b.reparent(child, turned);
  }
  for (NodeId node : b.scene().nodes()) {
    if (is_about_control(b.scene()[node].kind)) continue;
    const std::vector<scene::Connection> inputs = b.scene()[node].inputs;
    for (const scene::Connection& input : inputs) {
      if (input.from == world_of(control)) b.reconnect(world_of(turned), input.to);
    }
  }
}

}  // namespace

void gimbal(Builder& b) {
  const NodeId control = b.with().node("control");
  const NodeId joint = owner(b, control);
  const NodeId made = make_gimbal(b, control, joint);
  if (b.failed()) return;
  const Plug shown = add_to(b, control,
                            {.name = "gimbal_visible",
                             .value = b.with().flag("visible") ? 1.0 : 0.0,
                             .flavour = scene::UserAttribute::Flavour::boolean},
                            "control");
  if (b.failed()) return;
  b.connect(shown, {made, transform::kVisible});
  // A hidden control hides what is under it, so that others hang beside it.
  const NodeId turned = b.make({.kind = Kind::transform,
                                .role = "driver",
                                .joint = joint,
                                .parent = control,
                                .suffix = "gimbal_turn"});
  b.connect({made, transform::kRotation}, {turned, transform::kRotation});
  hand_over(b, control, turned, b.scene()[made].parent);
}

}  // namespace rigc::modules
