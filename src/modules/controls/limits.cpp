// SPDX-License-Identifier: MIT
// limits: least and largest values of a control's or joint's translate, rotate and scale.
// Test: tests/modules/limits_test.cpp
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "base/text.h"
#include "modules/codes.h"
#include "modules/registry.h"
#include "modules/steps.h"
#include "scene/access.h"

namespace rigc::modules {
namespace {

namespace attribute = scene::limits;
namespace transform = scene::transform;
using math::Vec3;

constexpr std::size_t kChannels = scene::kAllComponents;
enum Group : std::size_t { kTranslate, kRotate, kScale };
/// Rest values beyond a limit by less than this are rounding.
constexpr double kRounding = 1e-9;
/// Cosine above which two axes count as one.
constexpr double kAligned = 0.999;

struct Bound {
  std::optional<double> min, max;
};
using Bounds = std::array<Bound, kChannels>;

/// `min_rotate_x` for side "min" and channel 3.
std::string parameter_of(std::string_view side, std::size_t channel) {
  std::string name(scene::component_name(static_cast<unsigned>(channel)));
  name[name.size() - 2] = '_';
  return fmt::format("{}_{}", side, name);
}

/// The bounds as written; fails where one is no range, or nothing is given at all.
std::optional<Bounds> read_bounds(Builder& b) {
  const Parameters& with = b.with();
  Bounds bounds;
  bool any = false;
  for (std::size_t i = 0; i < kChannels; ++i) {
    const std::string min = parameter_of("min", i), max = parameter_of("max", i);
    if (with.has(min)) bounds[i].min = with.number(min);
    if (with.has(max)) bounds[i].max = with.number(max);
    any = any || bounds[i].min || bounds[i].max;
    if (bounds[i].min && bounds[i].max && *bounds[i].min > *bounds[i].max)
      b.fail(codes::kEmptyRange, min, fmt::format("{} is above {}", min, max));
  }
  if (!any) b.fail(codes::kNoLimit, {}, "the command limits nothing");
  if (b.failed()) return std::nullopt;
  return bounds;
}

/// What limits are measured in: for a control its own values, for anything else the way from its
/// rest along axes that do not depend on how a model's joints are turned.
struct Measure {
  math::Quat axes;
  Vec3 origin;
  math::Quat rest;
  Vec3 scale{1, 1, 1};  ///< that counts as 1
  Vec3 unit{1, 1, 1};   ///< rig units of a unit along each axis
  math::Mat3 world;     ///< the axes in rig space
};

Measure measure_of(const Builder& b, NodeId node) {
  Measure m;
  const NodeId parent = b.scene()[node].parent;
  const math::Mat3 space = parent.valid() ? rest(b, parent).linear : math::Mat3{};
  if (b.scene()[node].kind == scene::Kind::control) {
    m.world = math::orthonormal(rest(b, node).linear);
  } else {
    const std::string& axes = b.with().text("axes");
    const NodeId owner = b.index().joint(b.scene()[node].identity.owner);
    m.world = oriented(b, axes == "joint" ? node : owner, axes).linear;
    m.axes = math::quaternion(math::orthonormal(math::inverse(space) * m.world));
    const math::Trs local = b.scene().local(node);
    m.origin = local.translation;
    m.rest = local.rotation;
    m.scale = local.scale;
  }
  const math::Mat3 along = space * math::matrix(m.axes);
  const Vec3 axes[3] = {along.x, along.y, along.z};
  for (std::size_t i = 0; i < 3; ++i) {
    const double unit = math::length(axes[i]);
    if (unit > 0 && std::abs(unit - 1) > kRounding) m.unit[i] = unit;
  }
  return m;
}

/// The axes of the joint on the other side that stand for those of this one's.
math::Mat3 opposite_axes(const Builder& b, NodeId node, const Measure& m) {
  if (b.with().text("axes") != "joint") return m.world;
  const tags::TaggedJoint* tagged = b.tagged(b.index().joint(b.scene()[node].identity.owner));
  const NodeId opposite = tagged ? b.index().joint(tagged->mirror.opposite) : NodeId{};
  return opposite.valid() ? math::orthonormal(rest(b, opposite).linear) : m.world;
}

/// Signs with which translations along the axes mirror, 0 where they do not; rotations take the
/// other sign.
Vec3 mirror_signs(const Builder& b, NodeId node, const Measure& m) {
  const bool is_control = b.scene()[node].kind == scene::Kind::control;
  if (is_control) {
    const auto signs =
        std::get<std::vector<double>>(b.scene().value({node, scene::control::kMirror}));
    if (signs.size() == 3) return {signs[0], signs[1], signs[2]};
  } else if (b.with().text("axes") == "bone") {
    return {-1, -1, -1};
  }
  const math::Mat3 other = is_control ? m.world : opposite_axes(b, node, m);
  const Vec3 left = b.character().left;
  const Vec3 own_axes[3] = {m.world.x, m.world.y, m.world.z};
  const Vec3 other_axes[3] = {other.x, other.y, other.z};
  Vec3 signs;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 reflected = own_axes[i] - left * (2 * math::dot(left, own_axes[i]));
    const double cosine = math::dot(reflected, other_axes[i]);
    signs[i] = cosine > kAligned ? 1 : cosine < -kAligned ? -1 : 0;
  }
  return signs;
}

Bound negated(const Bound& bound) {
  Bound out;
  if (bound.max) out.min = -*bound.max;
  if (bound.min) out.max = -*bound.min;
  return out;
}

/// The bounds of the same movement on the other side.
void mirror(Builder& b, NodeId node, const Measure& m, Bounds& bounds) {
  const Vec3 signs = mirror_signs(b, node, m);
  for (std::size_t i = 0; i < 2 * 3; ++i) {
    const double sign = i / 3 == kTranslate ? signs[i % 3] : -signs[i % 3];
    if (sign > 0 || !(bounds[i].min || bounds[i].max)) continue;
    if (sign == 0) {
      b.warn(codes::kNotMirrored, parameter_of(bounds[i].min ? "min" : "max", i),
             fmt::format("the limit of {} is left away for {}",
                         scene::component_name(static_cast<unsigned>(i)),
                         traversal::describe(b.scene(), node)));
      bounds[i] = {};
    } else {
      bounds[i] = negated(bounds[i]);
    }
  }
}

/// From rig units and factors to the values that are clamped.
void scale(const Measure& m, Bounds& bounds) {
  const auto by = [](Bound& bound, double factor) {
    if (bound.min) *bound.min *= factor;
    if (bound.max) *bound.max *= factor;
    if (factor < 0) std::swap(bound.min, bound.max);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    if (m.unit[i] != 1) by(bounds[i], 1 / m.unit[i]);
    if (m.scale[i] != 1) by(bounds[6 + i], m.scale[i]);
  }
}

/// A limit must not move what nobody has touched.
bool check_rest(Builder& b, NodeId node, const Bounds& bounds) {
  const bool is_control = b.scene()[node].kind == scene::Kind::control;
  const math::Trs local = b.scene().local(node);
  const Vec3 angles = std::get<Vec3>(b.scene().value({node, transform::kRotate}));
  const Vec3 rests[3] = {is_control ? local.translation : Vec3{}, is_control ? angles : Vec3{},
                         local.scale};
  for (std::size_t i = 0; i < kChannels; ++i) {
    const double value = rests[i / 3][i % 3];
    const bool below = bounds[i].min && value < *bounds[i].min - kRounding;
    const bool above = bounds[i].max && value > *bounds[i].max + kRounding;
    if (!below && !above) continue;
    b.fail(
        codes::kRestOutside, parameter_of(below ? "min" : "max", i),
        fmt::format("{} of {} rests {} its limit", scene::component_name(static_cast<unsigned>(i)),
                    traversal::describe(b.scene(), node), below ? "below" : "above"));
    return false;
  }
  return true;
}

void make_node(Builder& b, NodeId limited, const Measure& m, const Bounds& bounds) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < kChannels; ++i) {
    const auto channel = static_cast<double>(i);
    if (bounds[i].min) numbers.insert(numbers.end(), {channel, 0, *bounds[i].min});
    if (bounds[i].max) numbers.insert(numbers.end(), {channel, 1, *bounds[i].max});
  }
  if (numbers.empty()) return;
  const NodeId node = b.make({.kind = scene::Kind::limits,
                              .role = "limits",
                              .joint = b.index().joint(b.scene()[limited].identity.owner),
                              .parent = {},
                              .suffix = "limits"});
  b.connect(world_of(limited), {node, attribute::kNode});
  b.set({node, attribute::kBounds}, std::move(numbers));
  b.set({node, attribute::kOrder}, b.with().text("order"));
  b.set({node, attribute::kAxes}, m.axes);
  b.set({node, attribute::kOrigin}, m.origin);
  b.set({node, attribute::kRest}, m.rest);
}

}  // namespace

void limits(Builder& b) {
  const auto written = read_bounds(b);
  if (!written) return;
  for (NodeId node : b.with().nodes("nodes")) {
    if (!check_place(b, node, "nodes")) return;
    const Measure measure = measure_of(b, node);
    Bounds bounds = *written;
    if (is_mirrored(b, b.joint())) mirror(b, node, measure, bounds);
    scale(measure, bounds);
    if (!check_rest(b, node, bounds)) return;
    make_node(b, node, measure, bounds);
  }
}

}  // namespace rigc::modules
