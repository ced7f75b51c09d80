// SPDX-License-Identifier: MIT
// Products of matrices, constants folded into them. Test: tests/eval/worlds_test.cpp
#include "eval/worlds.h"

#include <array>
#include <cmath>

#include "eval/direct.h"
#include "eval/similarity.h"
#include "eval/values.h"

namespace rigc::eval {

namespace {

// What rounding leaves of a matrix times its inverse.
constexpr double kRounding = 0x1p-50;

bool is_identity(const math::Mat3& m) {
  const math::Mat3 none;
  for (std::size_t i = 0; i < 3; ++i) {
    const bool near = std::fabs(m.x[i] - none.x[i]) <= kRounding &&
                      std::fabs(m.y[i] - none.y[i]) <= kRounding &&
                      std::fabs(m.z[i] - none.z[i]) <= kRounding;
    if (!near) return false;
  }
  return true;
}

// The parts of a value that is T * R * S.
struct Local {
  Operand translate, rotation;
  std::optional<Operand> scale;  // none: 1
};

std::optional<Local> local_of(const Emitter& emitter, const Operand& matrix) {
  const Definition& d = emitter.definition(matrix);
  if (d.source != Source::computed || matrix.width != d.width) return std::nullopt;
  const std::span<const Operand> a = emitter.arguments(d);
  if (d.op == Op::compose_rigid) return Local{a[0], a[1], std::nullopt};
  if (d.op == Op::compose) return Local{a[0], a[1], a[2]};
  return std::nullopt;
}

// The linear part of a local matrix that only moves.
std::optional<math::Mat3> linear_of(Emitter& emitter, const Local& local) {
  if (!emitter.is_constant(local.rotation)) return std::nullopt;
  if (local.scale && !emitter.is_constant(*local.scale)) return std::nullopt;
  const Operand none = emitter.constant({0, 0, 0}), unit = emitter.constant({1, 1, 1});
  const Operand folded =
      emitter.emit(Op::compose, {none, local.rotation, local.scale.value_or(unit)}, {}, 12, 0);
  return emitter.matrix(folded).linear;
}

// A value that is another one times a constant.
struct Split {
  Operand moving;
  math::Affine constant;
};

std::optional<Split> split(const Emitter& emitter, const Operand& matrix) {
  const Definition& d = emitter.definition(matrix);
  if (d.source != Source::computed || matrix.width != d.width) return std::nullopt;
  if (d.op != Op::hang && d.op != Op::hang_straight) return std::nullopt;
  const std::span<const Operand> a = emitter.arguments(d);
  if (a[0] != a[1]) return std::nullopt;
  const double* n = emitter.data(d).data();
  if (d.op == Op::hang_straight) return Split{a[0], {{}, vec3_from(n)}};
  return Split{a[0], affine_from(n)};
}

// a * constant.
Operand times_constant(Emitter& emitter, const Operand& a, const math::Affine& b,
                       std::uint32_t node) {
  const auto parts = split(emitter, a);
  const math::Affine constant = parts ? parts->constant * b : b;
  const Operand& moving = parts ? parts->moving : a;
  if (is_identity(constant.linear) && constant.origin == math::Vec3{}) return moving;
  const math::Vec3 t = constant.origin;
  return emit_hang(emitter, moving, moving, constant.linear, emitter.constant({t.x, t.y, t.z}),
                   node);
}

// constant * T * R in one instruction, where the constant is rigid.
std::optional<Operand> compose_under(Emitter& emitter, const math::Affine& constant,
                                     const Operand& rigid, std::uint32_t node) {
  if (emitter.definition(rigid).op != Op::compose_rigid) return std::nullopt;
  if (uniform_scale(constant.linear) != 1) return std::nullopt;
  const auto local = local_of(emitter, rigid);
  if (!local) return std::nullopt;
  const math::Quat q = math::quaternion(math::orthonormal(constant.linear));
  const math::Vec3 t = constant.origin;
  const std::array<double, 7> data{t.x, t.y, t.z, q.x, q.y, q.z, q.w};
  return emitter.emit(Op::compose_under, {local->translate, local->rotation}, data, 12, node);
}

}  // namespace

Operand emit_hang(Emitter& emitter, const Operand& parent, const Operand& turned,
                  const math::Mat3& linear, const Operand& translate, std::uint32_t node) {
  const bool straight = is_identity(linear);
  if (!emitter.is_constant(translate)) {
    const math::Affine turn{linear, {}};
    const Operand axes = straight ? turned : times_constant(emitter, turned, turn, node);
    return emitter.emit(Op::place, {parent, axes, translate}, {}, 12, node);
  }
  const math::Vec3 t = vec3_from(emitter.numbers(translate).data());
  if (straight) {
    return emitter.emit(Op::hang_straight, {parent, turned}, std::array{t.x, t.y, t.z}, 12, node);
  }
  return emitter.emit(Op::hang, {parent, turned}, columns_of(math::Affine{linear, t}), 12, node);
}

Operand emit_product(Emitter& emitter, const Operand& a, const Operand& b, std::uint32_t node) {
  const bool under_constant = emitter.is_constant(a);
  if (under_constant && emitter.matrix(a) == math::Affine{}) return b;
  if (emitter.is_constant(b)) {
    return under_constant ? emitter.emit(Op::multiply, {a, b}, {}, 12, node)
                          : times_constant(emitter, a, emitter.matrix(b), node);
  }
  const auto local = local_of(emitter, b);
  if (local) {
    if (const auto linear = linear_of(emitter, *local))
      return emit_hang(emitter, a, a, *linear, local->translate, node);
  }
  if (under_constant) {
    if (const auto under = compose_under(emitter, emitter.matrix(a), b, node)) return *under;
  } else if (const auto parts = split(emitter, a)) {
    if (const auto under = compose_under(emitter, parts->constant, b, node))
      return emitter.emit(Op::multiply, {parts->moving, *under}, {}, 12, node);
  }
  return emitter.emit(Op::multiply, {a, b}, {}, 12, node);
}

Operand emit_compose(Emitter& emitter, const Placement& p, std::uint32_t node) {
  const bool unit = emitter.is_constant(p.scale) &&
                    vec3_from(emitter.numbers(p.scale).data()) == math::Vec3{1, 1, 1};
  if (unit) return emitter.emit(Op::compose_rigid, {p.translate, p.rotation}, {}, 12, node);
  return emitter.emit(Op::compose, {p.translate, p.rotation, p.scale}, {}, 12, node);
}

Operand emit_world(Emitter& emitter, const Placement& placement, std::uint32_t node) {
  if (const auto driven = emit_driven(emitter, placement, node)) return *driven;
  const Operand local = emit_compose(emitter, placement, node);
  return placement.parent ? emit_product(emitter, *placement.parent, local, node) : local;
}

}  // namespace rigc::eval
