// SPDX-License-Identifier: MIT
// The kernels that clamp, against twins in plain matrices.
#include <doctest/doctest.h>

#include <algorithm>

#include "eval/limits.h"
#include "tests/eval/kernel_runner.h"
#include "tests/eval/twins.h"

namespace rigc {
namespace {

using eval::Op;
using math::LimitSpace;
using test::Numbers;
using test::Random;

constexpr double kPi = 3.14159265358979323846;

LimitSpace random_space(Random& random) {
  LimitSpace space;
  space.axes = random.trs().rotation;
  space.rest = random.trs().rotation;
  space.origin = random.trs().translation;
  const std::size_t first = random.below(3);
  const std::size_t step = 1 + random.below(2);
  for (std::size_t i = 0; i < 3; ++i) {
    space.order[i] = static_cast<int>((first + i * step) % 3);
    if (random.chance(60)) space.min[i] = -random.between(0, 150);
    if (random.chance(60)) space.max[i] = random.between(0, 150);
  }
  return space;
}

twin::M transposed(const twin::M& m) {
  twin::M t = twin::identity();
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) t[r][c] = m[c][r];
  }
  return t;
}

struct Angles {
  double angle[3];  ///< by axis
  bool certain;     ///< no tie, no gimbal lock
};

// R = R(order[2]) * R(order[1]) * R(order[0]): three entries give the angles.
Angles angles_of(const twin::M& m, const int* order) {
  const auto a = static_cast<std::size_t>(order[0]), b = static_cast<std::size_t>(order[1]),
             c = static_cast<std::size_t>(order[2]);
  const double s = (b + 3 - a) % 3 == 1 ? 1 : -1;
  const double degree = 180 / kPi;
  double first[3], second[3];
  first[a] = std::atan2(s * m[c][b], m[c][c]) * degree;
  first[b] = std::atan2(-s * m[c][a], std::hypot(m[a][a], m[b][a])) * degree;
  first[c] = std::atan2(s * m[b][a], m[a][a]) * degree;
  second[a] = first[a] > 0 ? first[a] - 180 : first[a] + 180;
  second[b] = (first[b] < 0 ? -180 : 180) - first[b];
  second[c] = first[c] > 0 ? first[c] - 180 : first[c] + 180;
  double sums[2] = {0, 0};
  for (std::size_t i = 0; i < 3; ++i)
    sums[0] += std::fabs(first[i]), sums[1] += std::fabs(second[i]);
  Angles out{};
  out.certain = std::fabs(sums[0] - sums[1]) > 1e-6 && std::fabs(std::fabs(first[b]) - 90) > 1e-3;
  std::copy_n(sums[1] < sums[0] ? second : first, 3, out.angle);
  return out;
}

struct Twin {
  twin::M rotation;
  bool certain;
};

Twin limited(const math::Quat& value, const LimitSpace& space) {
  const twin::M axes = twin::turn(space.axes), rest = twin::turn(space.rest);
  const twin::M turned = twin::times(twin::turn(value), transposed(rest));
  Angles angles = angles_of(twin::times(transposed(axes), twin::times(turned, axes)), space.order);
  twin::M m = twin::identity();
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<std::size_t>(space.order[i]);
    const double low = space.min[axis], high = space.max[axis];
    double best = angles.angle[axis], least = 1e300, next = 1e300;
    for (int turns = -1; turns <= 1; ++turns) {
      if (turns != 0 && (std::isinf(low) || std::isinf(high))) continue;
      const double tried = angles.angle[axis] + 360 * turns;
      const double off = std::max({low - tried, tried - high, 0.0});
      if (off < least)
        next = least, least = off, best = tried;
      else
        next = std::min(next, off);
    }
    angles.certain = angles.certain && next - least > 1e-6;
    best = std::min(std::max(best, low), high);
    m = twin::times(twin::turn(static_cast<int>(axis), best), m);
  }
  return {twin::times(twin::times(axes, twin::times(m, transposed(axes))), rest), angles.certain};
}

TEST_CASE("eval limit: a rotation equals its twin") {
  Random random(1);
  int compared = 0;
  for (int i = 0; i < 3000; ++i) {
    const LimitSpace space = random_space(random);
    const math::Quat value = random.trs().rotation;
    const Twin want = limited(value, space);
    if (!want.certain) continue;
    ++compared;
    const Numbers got =
        test::run_kernel_once(Op::limit_rotation, {value}, eval::limit_data(space), 4);
    CHECK(twin::angle_between(twin::turn(test::quat_of(got)), want.rotation) < 1e-9);
  }
  CHECK(compared > 2800);
}

TEST_CASE("eval limit: a vector equals its twin") {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const LimitSpace space = random_space(random);
    const math::Vec3 value = random.trs().translation;
    const twin::M axes = twin::place(space.origin, twin::turn(space.axes), {1, 1, 1});
    twin::M at = twin::times(twin::inverse(axes), twin::place(value, twin::identity(), {1, 1, 1}));
    for (std::size_t c = 0; c < 3; ++c)
      at[c][3] = std::min(std::max(at[c][3], space.min[c]), space.max[c]);
    const Numbers got =
        test::run_kernel_once(Op::limit_vector, {value}, eval::limit_data(space), 3);
    CHECK(test::distance(test::vec3_of(got), twin::column(twin::times(axes, at), 3)) < 1e-9);
  }
}

TEST_CASE("eval limit: every lane is clamped on its own") {
  Random random(3);
  const LimitSpace space = random_space(random);
  std::vector<test::Arguments> lanes;
  for (int lane = 0; lane < eval::kLanes; ++lane) lanes.push_back({random.trs().rotation});
  const auto all = test::run_kernel(Op::limit_rotation, lanes, eval::limit_data(space), 4);
  for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
    CHECK(all[lane] ==
          test::run_kernel_once(Op::limit_rotation, lanes[lane], eval::limit_data(space), 4));
  }
}

}  // namespace
}  // namespace rigc
