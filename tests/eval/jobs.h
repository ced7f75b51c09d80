// SPDX-License-Identifier: MIT
// A valid instruction for every operation of the table of kernels: the types of its arguments, its
// table of data, the width of its result. Formulas need no row of their own here; a new solver
// does, and the tests say so. Test: tests/eval/hostile_test.cpp
#pragma once

#include "eval/kernels/constraint_table.h"
#include "eval/limits.h"
#include "math/generic/spline.h"
#include "tests/eval/kernel_runner.h"

namespace rigc::test {

struct Job {
  eval::Op op;
  std::vector<scene::Type> arguments;
  Numbers data;
  std::uint32_t width = 0;
  /// Not 0: matrices among the arguments are rotations times this, with an origin.
  double even = 0;
};

/// Over numbers alone.
inline bool is_formula(eval::Op op) { return op >= eval::Op::negate; }
/// Over vectors, rotations and matrices too.
inline bool is_vector_formula(eval::Op op) {
  return op >= eval::Op::vector_add && op <= eval::Op::choose;
}

inline math::Mat3 even_linear(Random& random, double even) {
  const math::Mat3 m = math::matrix(random.rotation());
  return {m.x * even, m.y * even, m.z * even};
}

/// Where the numbers of a job come from.
class Source {
 public:
  explicit Source(Random& random) : random_(random) {}
  virtual ~Source() = default;
  virtual double number() = 0;
  Random& random() { return random_; }

  virtual math::Vec3 vector() {
    const double x = number(), y = number(), z = number();
    return {x, y, z};
  }
  virtual math::Quat rotation() {
    const double x = number(), y = number(), z = number(), w = number();
    return {x, y, z, w};
  }
  virtual math::Affine matrix() {
    const math::Vec3 x = vector(), y = vector(), z = vector(), origin = vector();
    return {{x, y, z}, origin};
  }
  scene::Value value(scene::Type type, double even = 0) {
    switch (type) {
      case scene::Type::number:
        return number();
      case scene::Type::vec3:
        return vector();
      case scene::Type::quat:
        return rotation();
      default:
        REQUIRE(type == scene::Type::matrix);
        return even == 0 ? matrix() : even_matrix(even);
    }
  }
  Arguments arguments(const Job& job) {
    Arguments values;
    for (const scene::Type type : job.arguments) values.push_back(value(type, job.even));
    return values;
  }

 private:
  math::Affine even_matrix(double even) {
    math::Affine a = matrix();
    a.linear = even_linear(random_, even);
    return a;
  }

  Random& random_;
};

inline void append(Numbers& data, const scene::Value& value) {
  const Numbers numbers = eval::numbers_of(value);
  data.insert(data.end(), numbers.begin(), numbers.end());
}

/// Bounds as the compiler lets them through: the least not above the largest.
inline math::LimitSpace random_limits(Source& source, double size) {
  Random& random = source.random();
  math::LimitSpace space;
  space.axes = random.rotation();
  space.rest = random.rotation();
  space.origin = random.vector(size);
  const std::size_t first = random.below(3), step = 1 + random.below(2);
  for (std::size_t i = 0; i < 3; ++i) {
    space.order[i] = static_cast<int>((first + i * step) % 3);
    const double a = random.between(-size, size), b = random.between(-size, size);
    if (random.chance(60)) space.min[i] = std::fmin(a, b);
    if (random.chance(60)) space.max[i] = std::fmax(a, b);
    if (random.chance(10)) space.min[i] = space.max[i] = a;
  }
  return space;
}

/// Points of a curve: position, value, interpolation, tangent; positions rise.
inline Numbers random_curve(Source& source) {
  Random& random = source.random();
  Numbers data{static_cast<double>(random.below(2)), static_cast<double>(random.below(6))};
  double position = random.between(-1, 1);
  for (double i = 0; i < data[1]; ++i) {
    data.push_back(position);
    data.push_back(random.between(-2, 2));
    data.push_back(static_cast<double>(random.below(4)));
    data.push_back(random.chance(30) ? 0 : random.between(-3, 3));
    position += random.chance(20) ? 1e-9 : random.between(0.05, 0.6);
  }
  return data;
}

inline void append(Numbers& data, const math::Mat3& m) {
  for (const math::Vec3& column : {m.x, m.y, m.z})
    data.insert(data.end(), {column.x, column.y, column.z});
}

/// The offsets of even ones are taken apart for them.
inline Job constraint_job(Source& source) {
  using scene::Type;
  const std::size_t count = 1 + source.random().below(4);
  const auto way = static_cast<double>(source.random().below(3));
  Job job{eval::Op::constraint, {Type::matrix}, {}, 10};
  const bool is_even = way == eval::constraint_table::kEven;
  if (is_even) job.even = source.random().between(0.1, 10);
  job.data = {static_cast<double>(count), way};
  Numbers more{1 / (job.even * job.even)};
  for (std::size_t i = 0; i < count; ++i) {
    job.arguments.insert(job.arguments.end(), {Type::matrix, Type::number});
    if (!is_even) {
      append(job.data, source.matrix());
      continue;
    }
    const math::Trs offset = source.random().trs(source.random().chance(50));
    const math::Mat3 turned = math::matrix(offset.rotation);
    append(job.data, math::compose(offset));
    const double smaller = more[0];
    append(more, {turned.x * smaller, turned.y * smaller, turned.z * smaller});
    append(more, offset.scale);
  }
  if (is_even) job.data.insert(job.data.end(), more.begin(), more.end());
  return job;
}

/// Rotations times a factor, which the offsets take back.
inline Job blend_job(Source& source) {
  using scene::Type;
  const std::size_t count = 1 + source.random().below(4);
  Job job{eval::Op::blend, {}, {static_cast<double>(count)}, 12, source.random().between(0.1, 10)};
  for (std::size_t i = 0; i < count; ++i) {
    job.arguments.insert(job.arguments.end(), {Type::matrix, Type::number});
    append(job.data, even_linear(source.random(), 1 / job.even));
    append(job.data, source.vector());
  }
  return job;
}

inline Job aim_job(eval::Op op, Source& source) {
  using scene::Type;
  const std::size_t count = 1 + source.random().below(4);
  Job job{op, {Type::matrix, Type::vec3, Type::matrix, Type::vec3}, {}, 4};
  job.data = {static_cast<double>(count), static_cast<double>(source.random().below(3))};
  if (op == eval::Op::aim) {
    append(job.data, source.random().rotation());
  } else {
    append(job.data, source.matrix().linear);
    job.width = 12;
  }
  for (std::size_t i = 0; i < count; ++i)
    job.arguments.insert(job.arguments.end(), {Type::matrix, Type::number});
  return job;
}

inline Job two_bone_job(Source& source) {
  using scene::Type;
  // Of the limb's plane alone, or of its joints too.
  const Type twist = source.random().chance(50) ? Type::number : Type::vec3;
  Job job{eval::Op::ik_two_bone, {Type::matrix, Type::matrix, Type::matrix, twist}, {}, 24};
  job.arguments.insert(job.arguments.end(), 5, Type::vec3);
  append(job.data, source.vector());
  append(job.data, source.random().rotation());
  append(job.data, source.random().rotation());
  append(job.data, source.vector());
  return job;
}

inline Job compose_under_job(Source& source) {
  Job job{eval::Op::compose_under, {scene::Type::vec3, scene::Type::quat}, {}, 12};
  append(job.data, source.vector());
  append(job.data, source.random().rotation());
  return job;
}

inline Job hang_job(Source& source) {
  Job job{eval::Op::hang, {scene::Type::matrix, scene::Type::matrix}, {}, 12};
  append(job.data, source.matrix());
  return job;
}

inline Job hang_straight_job(Source& source) {
  Job job{eval::Op::hang_straight, {scene::Type::matrix, scene::Type::matrix}, {}, 12};
  append(job.data, source.vector());
  return job;
}

inline Job chain_job(Source& source) {
  using scene::Type;
  const std::size_t count = 2 + source.random().below(6);
  Job job{eval::Op::ik_chain, {Type::matrix, Type::matrix, Type::matrix, Type::number}, {}, 0};
  job.arguments.insert(job.arguments.end(), count, Type::vec3);
  job.data = {static_cast<double>(count), static_cast<double>(source.random().below(2)),
              static_cast<double>(source.random().below(12))};
  append(job.data, source.vector());
  for (std::size_t i = 0; i < count; ++i) append(job.data, source.random().rotation());
  job.width = static_cast<std::uint32_t>(4 * (count - 1));
  return job;
}

/// What goes into the operations of kernels/vectors.h, and what comes out.
inline Job vector_job(eval::Op op, Source& source) {
  using eval::Op;
  using scene::Type;
  const Type n = Type::number, v = Type::vec3, q = Type::quat, m = Type::matrix;
  const auto job = [op](std::vector<Type> arguments, Type result) {
    return Job{op, std::move(arguments), {}, static_cast<std::uint32_t>(scene::width(result))};
  };
  switch (op) {
    case Op::vector_add:
    case Op::vector_subtract:
    case Op::vector_multiply:
    case Op::cross:
      return job({v, v}, v);
    case Op::vector_scale:
      return job({v, n}, v);
    case Op::vector_lerp:
      return job({v, v, n}, v);
    case Op::dot:
      return job({v, v}, n);
    case Op::length:
      return job({v}, n);
    case Op::normalise:
      return job({v}, v);
    case Op::rotation_multiply:
      return job({q, q}, q);
    case Op::rotation_inverse:
      return job({q}, q);
    case Op::rotation_apply:
      return job({q, v}, v);
    case Op::rotation_slerp:
      return job({q, q, n}, q);
    case Op::axis_angle:
      return job({v, n}, q);
    case Op::twist_angle:
      return job({q, v}, n);
    case Op::between:
    case Op::aim_rotation:
      return job({v, v}, q);
    case Op::matrix_rotation:
      return job({m}, q);
    case Op::matrix_scale:
      return job({m}, v);
    case Op::matrix_inverse:
      return job({m}, m);
    case Op::transform_point:
    case Op::transform_vector:
      return job({m, v}, v);
    default:
      break;
  }
  REQUIRE_MESSAGE(op == Op::choose, "a new formula needs a row here: " << eval::row(op).name);
  const Type types[] = {n, v, q, m};
  const Type chosen = types[source.random().below(4)];
  return job({n, chosen, chosen}, chosen);
}

/// Outputs of a random curve at rest, in order.
inline void append_outputs(Numbers& data, Source& source, std::size_t controls,
                           std::size_t outputs) {
  Random& random = source.random();
  double x = 0, passed = 0;
  for (std::size_t k = 0; k < outputs; ++k) {
    x = random.between(x, static_cast<double>(controls - 1));
    const double segment = std::fmin(std::floor(x), static_cast<double>(controls - 2));
    data.insert(data.end(), {segment, x - segment});
    for (const auto& b :
         {math::generic::place_basis(x - segment), math::generic::slope_basis(x - segment)})
      data.insert(data.end(), {b.from, b.leaving, b.to, b.arriving});
    passed += std::fabs(source.number());
    data.insert(data.end(), {passed, std::fabs(source.number())});
    append(data, math::matrix(random.rotation()));
    append(data, random.chance(50) ? math::Vec3{} : source.vector());
  }
}

inline Job spline_job(Source& source) {
  using scene::Type;
  Random& random = source.random();
  const std::size_t controls = random.chance(10) ? 9 : 2 + random.below(5);
  const std::size_t outputs = 1 + random.below(5);
  const bool twisted = random.chance(30);
  Job job{eval::Op::spline, {Type::matrix, Type::number, Type::number, Type::number}, {}, 0};
  job.arguments.insert(job.arguments.end(), controls, Type::matrix);
  if (twisted) job.arguments.insert(job.arguments.end(), controls, Type::number);
  job.data = {static_cast<double>(controls),
              static_cast<double>(outputs),
              static_cast<double>(random.below(2)),
              static_cast<double>(random.below(2)),
              twisted ? 1.0 : 0.0,
              1.0,
              std::fabs(source.number())};
  const double follows[] = {0, 0.3, 1};
  for (std::size_t i = 0; i < controls; ++i) {
    const math::Mat3 axes = math::matrix(random.rotation());
    append(job.data, axes.x * random.between(0.5, 1));
    job.data.push_back(follows[random.below(3)]);
    append(job.data, axes.x);
    append(job.data, axes.y);
  }
  append_outputs(job.data, source, controls, outputs);
  job.width = static_cast<std::uint32_t>(2 + 12 * outputs);
  return job;
}

/// An instruction as the compiler emits it. Rests and offsets that are rotations are at unit
/// length, as there; what else comes from a scene comes from the source.
inline Job job_of(eval::Op op, Source& source) {
  using eval::Op;
  using scene::Type;
  if (is_vector_formula(op)) return vector_job(op, source);
  switch (op) {
    case Op::compose:
      return {op, {Type::vec3, Type::quat, Type::vec3}, {}, 12};
    case Op::compose_rigid:
      return {op, {Type::vec3, Type::quat}, {}, 12};
    case Op::compose_under:
      return compose_under_job(source);
    case Op::hang:
      return hang_job(source);
    case Op::hang_straight:
      return hang_straight_job(source);
    case Op::place:
      return {op, {Type::matrix, Type::matrix, Type::vec3}, {}, 12};
    case Op::multiply:
      return {op, {Type::matrix, Type::matrix}, {}, 12};
    case Op::gather:
      return {op, {Type::number, Type::vec3, Type::number}, {}, 5};
    case Op::from_euler:
      return {op, {Type::vec3}, {}, 4};
    case Op::to_euler:
      return {op, {Type::quat}, {}, 3};
    case Op::constraint:
      return constraint_job(source);
    case Op::aim:
    case Op::aim_world:
      return aim_job(op, source);
    case Op::blend:
      return blend_job(source);
    case Op::ik_two_bone:
      return two_bone_job(source);
    case Op::ik_chain:
      return chain_job(source);
    case Op::spline:
      return spline_job(source);
    case Op::limit_vector:
      return {op, {Type::vec3}, eval::limit_data(random_limits(source, 3)), 3};
    case Op::limit_rotation:
      return {op, {Type::quat}, eval::limit_data(random_limits(source, 200)), 4};
    case Op::remap:
      return {op, std::vector<Type>(5, Type::number), random_curve(source), 1};
    default:
      break;
  }
  REQUIRE_MESSAGE(is_formula(op), "a new solver needs a row here: " << eval::row(op).name);
  const auto count = static_cast<std::size_t>(eval::row(op).arguments);
  return {op, std::vector<Type>(count, Type::number), {}, 1};
}

/// Calls `f` with every operation of the table.
template <class F>
void for_every_op(F f) {
  for (int op = 0; op < static_cast<int>(eval::Op::count); ++op) f(static_cast<eval::Op>(op));
}

}  // namespace rigc::test
