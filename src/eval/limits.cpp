// SPDX-License-Identifier: MIT
// Limits of transforms, read from their scene and checked. Test: tests/eval/limits_test.cpp
#include "eval/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "base/text.h"
#include "eval/rules_of_kinds.h"
#include "scene/access.h"

namespace rigc::eval {

namespace {

using math::LimitSpace;
using scene::NodeId;
namespace at = scene::limits;
namespace transform = scene::transform;

constexpr std::array<std::uint16_t, 3> kAttributes = {transform::kTranslate, transform::kRotation,
                                                      transform::kScale};

/// Places of x, y and z in the order; false where the text is none of the six orders.
bool parse_order(std::string_view text, int* order) {
  if (text.size() != 3) return false;
  unsigned seen = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t axis = std::string_view("xyz").find(text[i]);
    if (axis == std::string_view::npos) return false;
    order[i] = static_cast<int>(axis);
    seen |= 1u << axis;
  }
  return seen == 7;
}

/// Adds bounds to the spaces of translate, rotation and scale; what is wrong with them, or nothing.
std::string add_bounds(const std::vector<double>& bounds, std::array<LimitSpace, 3>& spaces) {
  if (bounds.size() % 3 != 0) return "its bounds are not three numbers each";
  for (std::size_t i = 0; i < bounds.size(); i += 3) {
    const double channel = bounds[i], side = bounds[i + 1];
    std::size_t number = 0;
    while (number < scene::kAllComponents && static_cast<double>(number) != channel) ++number;
    if (number == scene::kAllComponents) return fmt::format("there is no channel {}", channel);
    if (side != 0 && side != 1) return fmt::format("there is no side {}", side);
    LimitSpace& space = spaces[number / 3];
    (side == 0 ? space.min : space.max)[number % 3] = bounds[i + 2];
  }
  for (std::size_t i = 0; i < 9; ++i) {
    const LimitSpace& space = spaces[i / 3];
    if (space.min[i % 3] > space.max[i % 3])
      return fmt::format("the least {} is above the largest",
                         scene::component_name(static_cast<unsigned>(i)));
  }
  return {};
}

}  // namespace

std::vector<double> limit_data(const LimitSpace& s) {
  std::vector<double> data;
  for (const math::Vec3& v : {s.min, s.max}) data.insert(data.end(), {v.x, v.y, v.z});
  data.insert(data.end(), {s.axes.x, s.axes.y, s.axes.z, s.axes.w});
  data.insert(data.end(), {s.origin.x, s.origin.y, s.origin.z});
  data.insert(data.end(), {s.rest.x, s.rest.y, s.rest.z, s.rest.w});
  for (const int axis : s.order) data.push_back(axis);
  return data;
}

Limits::Limits(const scene::Scene& scene, Diagnostics& diagnostics) {
  for (const NodeId id : scene.nodes()) {
    if (scene[id].kind == scene::Kind::limits) read_limits(scene, id, diagnostics);
  }
  for (const NodeId id : scene.nodes()) {
    if (scene[id].kind == scene::Kind::control) read_locks(scene, id);
  }
}

void Limits::read_limits(const scene::Scene& scene, NodeId id, Diagnostics& diagnostics) {
  const auto named = scene.source({id, at::kNode});
  if (!named || !scene::spec(scene[named->node].kind).is_transform) {
    bad_node(scene, id, "it names no transform", diagnostics);
    return;
  }
  std::array<LimitSpace, 3> spaces;
  const auto order = std::get<std::string>(scene.value({id, at::kOrder}));
  if (!parse_order(order, spaces[1].order)) {
    bad_node(scene, id, fmt::format("there is no order of axes \"{}\"", printable(order)),
             diagnostics);
    return;
  }
  spaces[0].axes = spaces[1].axes =
      math::normalised(std::get<math::Quat>(scene.value({id, at::kAxes})));
  spaces[0].origin = std::get<math::Vec3>(scene.value({id, at::kOrigin}));
  spaces[1].rest = math::normalised(std::get<math::Quat>(scene.value({id, at::kRest})));
  const auto bounds = std::get<std::vector<double>>(scene.value({id, at::kBounds}));
  if (const std::string wrong = add_bounds(bounds, spaces); !wrong.empty()) {
    bad_node(scene, id, wrong, diagnostics);
    return;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (spaces[i].bounded()) limits_[named->node.index].push_back({kAttributes[i], id, spaces[i]});
  }
}

void Limits::read_locks(const scene::Scene& scene, NodeId id) {
  const unsigned locked = scene::bits_at(scene, id, scene::control::kLocked);
  if (locked == 0) return;
  // What a connection decides about is not the lock's.
  const unsigned held = locked & ~scene::driven_bits(scene, id);
  for (unsigned i = 0; i < 3; ++i) {
    const std::uint16_t shown = i == 1 ? transform::kRotate : kAttributes[i];
    const auto value = std::get<math::Vec3>(scene.value({id, shown}));
    LimitSpace space;
    for (unsigned c = 0; c < 3; ++c) {
      if (held & (1u << (3 * i + c))) space.min[c] = space.max[c] = value[c];
    }
    if (space.bounded()) limits_[id.index].push_back({kAttributes[i], id, space});
  }
}

const std::vector<Limit>* Limits::of(NodeId transform) const {
  const auto found = limits_.find(transform.index);
  return found == limits_.end() ? nullptr : &found->second;
}

bool Limits::apply_to(const scene::Plug& plug) const {
  const std::vector<Limit>* found = of(plug.node);
  const std::uint16_t attribute =
      plug.attribute == transform::kRotate ? transform::kRotation : plug.attribute;
  return found && std::any_of(found->begin(), found->end(),
                              [&](const Limit& limit) { return limit.attribute == attribute; });
}

}  // namespace rigc::eval
