// SPDX-License-Identifier: MIT
// Driven worlds. Test: tests/eval/direct_test.cpp
#include "eval/direct.h"

#include <cmath>
#include <vector>

#include "eval/similarity.h"
#include "eval/values.h"

namespace rigc::eval {

namespace {

// Places in a constraint's result.
constexpr std::uint32_t kTranslate = 0, kRotation = 3, kScale = 7;
// Sizes that differ by less are equal.
constexpr double kSameSize = 1e-12;

// A matrix whose linear part times `linear` is the driven one's, before its own scale, and whose
// product with `origin` is where its translate would take it.
struct Target {
  Operand matrix;
  double scale;         // of the matrix
  math::Mat3 rotation;  // of the offset
  math::Vec3 size;      // of the offset
  math::Vec3 origin;    // of the offset
};

// What all are given.
struct Driven {
  const Placement& placement;
  double parent_scale;
  std::uint32_t node;
};

bool same_parent(const Emitter& emitter, const Placement& placement, const Operand& parent) {
  if (placement.parent) return parent == *placement.parent;
  return emitter.is_constant(parent) && emitter.matrix(parent) == math::Affine{};
}

bool same_size(const math::Vec3& a, const math::Vec3& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::fabs(a[i] - b[i]) > kSameSize * std::fabs(b[i])) return false;
  }
  return true;
}

math::Mat3 scaled(const math::Mat3& m, math::Vec3 by) {
  return {m.x * by.x, m.y * by.y, m.z * by.z};
}

// The targets of a constraint, whose table is: count, whether it is a point constraint, offsets.
std::optional<std::vector<Target>> sources_of(const Emitter& emitter, const Definition& d) {
  const std::span<const double> data = emitter.data(d);
  const std::span<const Operand> arguments = emitter.arguments(d);
  if (data[1] != 0) return std::nullopt;
  std::vector<Target> sources;
  for (std::size_t i = 0; 2 + 2 * i < arguments.size(); ++i) {
    const math::Affine offset = affine_from(data.data() + 2 + 12 * i);
    const double scale = emitter.scale(arguments[1 + 2 * i]);
    if (scale == 0 || !spans_space(offset.linear)) return std::nullopt;
    const math::Trs parts = math::decompose(offset);
    sources.push_back({arguments[1 + 2 * i], scale, math::orthonormal(offset.linear), parts.scale,
                       parts.translation});
  }
  return sources;
}

// The weighted mean of the targets as one matrix without scale. The table of `blend`: of each
// target what turns it into a rotation, and its offset's origin.
std::optional<Target> blend(Emitter& emitter, const std::vector<Target>& sources,
                            const std::vector<Operand>& weights, std::uint32_t node) {
  std::vector<Operand> arguments;
  std::vector<double> data{static_cast<double>(sources.size())};
  const math::Vec3 size = sources[0].size * sources[0].scale;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const Target& s = sources[i];
    if (!same_size(s.size * s.scale, size)) return std::nullopt;
    arguments.insert(arguments.end(), {s.matrix, weights[i]});
    for (const double n : columns_of(s.rotation)) data.push_back(n / s.scale);
    data.insert(data.end(), {s.origin.x, s.origin.y, s.origin.z});
  }
  const Operand mean = emitter.emit(Op::blend, arguments, data, 12, node);
  return Target{mean, 1, {}, size, {}};
}

// The one matrix that a constraint's driven transform follows.
std::optional<Target> followed(Emitter& emitter, const Operand& result, std::uint32_t node) {
  const Definition d = emitter.definition(result);
  const auto sources = sources_of(emitter, d);
  if (!sources) return std::nullopt;
  if (sources->size() == 1) return sources->front();
  std::vector<Operand> weights;
  for (std::size_t i = 0; i < sources->size(); ++i)
    weights.push_back(emitter.arguments(d)[2 + 2 * i]);
  return blend(emitter, *sources, weights, node);
}

std::optional<Operand> constrained(Emitter& emitter, const Driven& driven) {
  const Placement& p = driven.placement;
  const Operand result{p.rotation.value, 0, 10};
  const bool scale_too = p.scale == slice(result, kScale, 3);
  if (p.rotation != slice(result, kRotation, 4)) return std::nullopt;
  if (!scale_too && !emitter.is_constant(p.scale)) return std::nullopt;
  const auto source = followed(emitter, result, driven.node);
  if (!source) return std::nullopt;
  math::Vec3 size = source->size;
  if (!scale_too) {
    size = vec3_from(emitter.numbers(p.scale).data()) * (driven.parent_scale / source->scale);
  }
  const math::Mat3 linear = scaled(source->rotation, size);
  const Operand& m = source->matrix;
  if (p.translate == slice(result, kTranslate, 3)) {
    return emit_product(emitter, m, emitter.constant_matrix({linear, source->origin}), driven.node);
  }
  const Operand parent = p.parent ? *p.parent : emitter.constant_matrix({});
  return emit_hang(emitter, parent, m, linear, p.translate, driven.node);
}

// The table of aim: count, mode, offset; of aim_world: count, mode, linear part.
std::optional<Operand> aimed(Emitter& emitter, const Driven& driven) {
  const Placement& p = driven.placement;
  const Definition& d = emitter.definition(p.rotation);
  const std::span<const Operand> arguments = emitter.arguments(d);
  if (p.rotation.offset != 0 || !emitter.is_constant(p.scale)) return std::nullopt;
  if (arguments[1] != p.translate) return std::nullopt;
  const std::span<const double> of_aim = emitter.data(d);
  const math::Quat offset{of_aim[2], of_aim[3], of_aim[4], of_aim[5]};
  const math::Vec3 scale = vec3_from(emitter.numbers(p.scale).data());
  const auto linear = columns_of(scaled(math::matrix(offset), scale * driven.parent_scale));
  std::vector<double> data{of_aim[0], of_aim[1]};
  data.insert(data.end(), linear.begin(), linear.end());
  const std::vector<Operand> same(arguments.begin(), arguments.end());
  return emitter.emit(Op::aim_world, same, data, 12, driven.node);
}

// A transform whose translate alone comes from a constraint: its axes are its own, its origin is
// the target's place, without a way into the parent's space either.
std::optional<Operand> pointed(Emitter& emitter, const Driven& driven) {
  const Placement& p = driven.placement;
  const Definition d = emitter.definition(p.translate);
  if (d.op != Op::constraint || p.translate.offset != kTranslate || d.argument_count != 3)
    return std::nullopt;
  const std::span<const double> table = emitter.data(d);
  const bool point = table[1] != 0;
  const math::Vec3 offset = vec3_from(table.data() + 11);
  // That of a point constraint lies in the parent's space.
  if (point && offset != math::Vec3{}) return std::nullopt;
  const Operand target = emitter.arguments(d)[1];
  const Placement axes{p.parent, emitter.constant({0, 0, 0}), p.rotation, p.scale};
  const Operand turned = emit_world(emitter, axes, driven.node);
  const Operand at = emitter.constant({offset.x, offset.y, offset.z});
  return emit_hang(emitter, target, turned, {}, at, driven.node);
}

// The instruction that gives a part of a transform in its parent's space.
bool solves(const Emitter& emitter, const Placement& placement, const Operand& part) {
  const Definition& d = emitter.definition(part);
  if (d.source != Source::computed || (d.op != Op::constraint && d.op != Op::aim)) return false;
  return same_parent(emitter, placement, emitter.arguments(d)[0]);
}

}  // namespace

std::optional<Operand> emit_driven(Emitter& emitter, const Placement& placement,
                                   std::uint32_t node) {
  const bool turned = solves(emitter, placement, placement.rotation);
  const bool moved = solves(emitter, placement, placement.translate);
  if (!turned && !moved) return std::nullopt;
  const double parent_scale = placement.parent ? emitter.scale(*placement.parent) : 1;
  if (parent_scale == 0) return std::nullopt;
  const Driven driven{placement, parent_scale, node};
  if (turned) {
    const bool aims = emitter.definition(placement.rotation).op == Op::aim;
    if (const auto world = aims ? aimed(emitter, driven) : constrained(emitter, driven))
      return world;
  }
  return moved ? pointed(emitter, driven) : std::nullopt;
}

}  // namespace rigc::eval
