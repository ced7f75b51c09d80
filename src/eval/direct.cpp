// SPDX-License-Identifier: MIT
// Driven worlds. Test: tests/eval/direct_test.cpp
#include "eval/direct.h"

#include <cmath>
#include <vector>

#include "eval/kernels/constraint_table.h"
#include "eval/similarity.h"
#include "eval/values.h"

namespace rigc::eval {

namespace {

namespace table = constraint_table;

// Places in a constraint's result.
constexpr std::uint32_t kTranslate = 0, kRotation = 3, kScale = 7;
// Sizes that differ by less are equal.
constexpr double kSameSize = 1e-12;

// A matrix whose linear part times `linear` is the driven one's, before its own scale, and whose
// product with `origin` is where its translate would take it.
struct Target {
  Operand matrix;
  Factor scale;         // of the matrix
  math::Mat3 rotation;  // of the offset
  math::Vec3 size;      // of the offset
  math::Vec3 origin;    // of the offset
};

// What all are given.
struct Driven {
  const Placement& placement;
  Factor parent_scale;
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

// The targets of a constraint.
std::optional<std::vector<Target>> sources_of(Emitter& emitter, const Definition& d) {
  const std::vector<double> data(emitter.data(d).begin(), emitter.data(d).end());
  const std::vector<Operand> arguments(emitter.arguments(d).begin(), emitter.arguments(d).end());
  if (data[table::kWay] == table::kPoint) return std::nullopt;
  std::vector<Target> sources;
  for (std::size_t i = 0; 2 + 2 * i < arguments.size(); ++i) {
    const math::Affine offset = affine_from(data.data() + table::offset(i));
    const Factor scale = emitter.factor(arguments[1 + 2 * i]);
    if (scale.number == 0 || !spans_space(offset.linear)) return std::nullopt;
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
  const math::Vec3 size = sources[0].size * sources[0].scale.number;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const Target& s = sources[i];
    if (s.scale.powers != 0 || !same_size(s.size * s.scale.number, size)) return std::nullopt;
    arguments.insert(arguments.end(), {s.matrix, weights[i]});
    for (const double n : columns_of(s.rotation)) data.push_back(n / s.scale.number);
    data.insert(data.end(), {s.origin.x, s.origin.y, s.origin.z});
  }
  const Operand mean = emitter.emit(Op::blend, arguments, data, 12, node);
  return Target{mean, {1, 0}, {}, size, {}};
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

// The instruction that gives a part of a transform in its parent's space.
bool solves(const Emitter& emitter, const Placement& placement, const Operand& part) {
  const Definition& d = emitter.definition(part);
  if (d.source != Source::computed || (d.op != Op::constraint && d.op != Op::aim)) return false;
  return same_parent(emitter, placement, emitter.arguments(d)[0]);
}

// The mean of what point constraints follow, where their weights are constant: the place, and
// beside it in the parent's space.
struct Mean {
  Operand at;
  math::Vec3 beside;
};

std::optional<Mean> mean_point(Emitter& emitter, const Definition& d, std::uint32_t node) {
  const std::vector<double> data(emitter.data(d).begin(), emitter.data(d).end());
  const std::vector<Operand> arguments(emitter.arguments(d).begin(), emitter.arguments(d).end());
  Mean mean;
  double sum = 0, size = 0;
  for (std::size_t i = 0; 2 + 2 * i < arguments.size(); ++i) {
    if (!emitter.is_constant(arguments[2 + 2 * i])) return std::nullopt;
    const double weight = emitter.numbers(arguments[2 + 2 * i])[0];
    if (!(weight > 0)) return std::nullopt;
    sum += weight;
    const Operand origin = slice(arguments[1 + 2 * i], 9, 3);
    const math::Vec3 offset = vec3_from(data.data() + table::offset(i) + 9);
    const double share = weight / sum;
    mean.at = i == 0 ? origin
                     : emitter.emit(Op::vector_lerp, {mean.at, origin, emitter.constant({share})},
                                    {}, 3, node);
    mean.beside = mean.beside + (offset - mean.beside) * share;
    size = std::fmax(size, math::length(offset));
  }
  if (math::length(mean.beside) <= kSameSize * size) mean.beside = {};
  return mean;
}

// Where an origin is: there, or where a matrix takes a point.
struct Origin {
  std::optional<Operand> at;
  Operand matrix, point;
};

// That of a transform whose translate comes from a constraint.
std::optional<Origin> driven_origin(Emitter& emitter, const Driven& driven) {
  const Placement& p = driven.placement;
  if (!solves(emitter, p, p.translate)) return std::nullopt;
  const Definition d = emitter.definition(p.translate);
  if (d.op != Op::constraint || p.translate.offset != kTranslate) return std::nullopt;
  if (emitter.data(d)[table::kWay] == table::kPoint) {
    const auto mean = mean_point(emitter, d, driven.node);
    if (!mean || mean->beside != math::Vec3{}) return std::nullopt;
    return Origin{mean->at, {}, {}};
  }
  if (d.argument_count != 3) return std::nullopt;
  const Operand target = emitter.arguments(d)[1];
  const math::Vec3 offset = vec3_from(emitter.data(d).data() + table::offset(0) + 9);
  return Origin{std::nullopt, target, emitter.constant({offset.x, offset.y, offset.z})};
}

// The axes of `turned` times `linear`, at an origin.
Operand placed(Emitter& emitter, const Operand& turned, const math::Mat3& linear,
               const Origin& origin, std::uint32_t node) {
  if (!origin.at) return emit_hang(emitter, origin.matrix, turned, linear, origin.point, node);
  const Operand none = emitter.constant({0, 0, 0});
  const bool straight = linear == math::Mat3{};
  const Operand axes = straight ? turned : emit_hang(emitter, turned, turned, linear, none, node);
  return emitter.emit(Op::gather, {slice(axes, 0, 9), *origin.at}, {}, 12, node);
}

// A driven transform's axes before its own origin: a matrix, and a constant behind it.
struct Axes {
  Operand turned;
  math::Mat3 linear;
};

// Those of what follows a target with its own scale, which may vary, as may the sizes of parent and
// target: `more` times it is what the target's axes lack.
Axes scaled_axes(Emitter& emitter, const Target& target, const Operand& scale, Factor more,
                 std::uint32_t node) {
  const Factor even = emitter.product(emitter.even_factor(scale), more);
  if (even.number != 0 && even.powers == 0) {
    const double n = even.number;
    return {target.matrix, scaled(target.rotation, {n, n, n})};
  }
  if (emitter.is_constant(scale) && more.powers == 0) {
    const math::Vec3 size = vec3_from(emitter.numbers(scale).data()) * more.number;
    return {target.matrix, scaled(target.rotation, size)};
  }
  const Operand by = emitter.number_of(even.number != 0 ? even : more, node);
  const Operand size = even.number != 0 ? emitter.emit(Op::gather, {by, by, by}, {}, 3, node)
                                        : emitter.emit(Op::vector_scale, {scale, by}, {}, 3, node);
  const math::Quat q = math::quaternion(target.rotation);
  const Operand turn = emitter.constant({q.x, q.y, q.z, q.w}), none = emitter.constant({0, 0, 0});
  const Operand own = emitter.emit(Op::compose, {none, turn, size}, {}, 12, node);
  return {emit_product(emitter, target.matrix, own, node), {}};
}

std::optional<Operand> constrained(Emitter& emitter, const Driven& driven) {
  const Placement& p = driven.placement;
  const Operand result{p.rotation.value, 0, 10};
  const bool scale_too = p.scale == slice(result, kScale, 3);
  if (p.rotation != slice(result, kRotation, 4)) return std::nullopt;
  const auto source = followed(emitter, result, driven.node);
  if (!source) return std::nullopt;
  Axes axes{source->matrix, scaled(source->rotation, source->size)};
  if (!scale_too) {
    const Factor more = emitter.product(driven.parent_scale, emitter.inverse(source->scale));
    axes = scaled_axes(emitter, *source, p.scale, more, driven.node);
  }
  const Operand& m = source->matrix;
  if (p.translate == slice(result, kTranslate, 3)) {
    const math::Vec3 t = source->origin;
    if (axes.turned == m)
      return emit_product(emitter, m, emitter.constant_matrix({axes.linear, t}), driven.node);
    const Operand at = emitter.constant({t.x, t.y, t.z});
    return emit_hang(emitter, m, axes.turned, axes.linear, at, driven.node);
  }
  const Operand parent = p.parent ? *p.parent : emitter.constant_matrix({});
  const Origin own{std::nullopt, parent, p.translate};
  const Origin origin = driven_origin(emitter, driven).value_or(own);
  return placed(emitter, axes.turned, axes.linear, origin, driven.node);
}

// The table of aim: count, mode, offset; of aim_world: count, mode, linear part.
std::optional<Operand> aimed(Emitter& emitter, const Driven& driven) {
  const Placement& p = driven.placement;
  const Definition& d = emitter.definition(p.rotation);
  const std::span<const Operand> arguments = emitter.arguments(d);
  if (p.rotation.offset != 0 || !emitter.is_constant(p.scale)) return std::nullopt;
  if (driven.parent_scale.powers != 0) return std::nullopt;
  if (arguments[1] != p.translate) return std::nullopt;
  const std::span<const double> of_aim = emitter.data(d);
  const math::Quat offset{of_aim[2], of_aim[3], of_aim[4], of_aim[5]};
  const math::Vec3 scale = vec3_from(emitter.numbers(p.scale).data());
  const auto linear = columns_of(scaled(math::matrix(offset), scale * driven.parent_scale.number));
  std::vector<double> data{of_aim[0], of_aim[1]};
  data.insert(data.end(), linear.begin(), linear.end());
  const std::vector<Operand> same(arguments.begin(), arguments.end());
  return emitter.emit(Op::aim_world, same, data, 12, driven.node);
}

// A transform whose translate alone comes from a constraint: its axes are its own.
std::optional<Operand> pointed(Emitter& emitter, const Driven& driven) {
  const Placement& p = driven.placement;
  const auto origin = driven_origin(emitter, driven);
  if (!origin) return std::nullopt;
  const Placement axes{p.parent, emitter.constant({0, 0, 0}), p.rotation, p.scale};
  return placed(emitter, emit_world(emitter, axes, driven.node), {}, *origin, driven.node);
}

}  // namespace

std::optional<Operand> emit_driven(Emitter& emitter, const Placement& placement,
                                   std::uint32_t node) {
  const bool turned = solves(emitter, placement, placement.rotation);
  const bool moved = solves(emitter, placement, placement.translate);
  if (!turned && !moved) return std::nullopt;
  const Factor parent_scale = placement.parent ? emitter.factor(*placement.parent) : Factor{1, 0};
  if (parent_scale.number == 0) return std::nullopt;
  const Driven driven{placement, parent_scale, node};
  if (turned) {
    const bool aims = emitter.definition(placement.rotation).op == Op::aim;
    if (const auto world = aims ? aimed(emitter, driven) : constrained(emitter, driven))
      return world;
  }
  return moved ? pointed(emitter, driven) : std::nullopt;
}

}  // namespace rigc::eval
