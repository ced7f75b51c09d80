// SPDX-License-Identifier: MIT
// The degenerate cases of constraints, limits, curves and transforms by name, each with its answer
// written out: flat and mirrored parents, opposite rotations, weights of nothing.
#include <doctest/doctest.h>

#include <limits>

#include "tests/eval/answers.h"

namespace rigc {
namespace {

using eval::Op;
using exact::A;
using exact::M;
using exact::V;
using math::Affine;
using math::Quat;
using math::Vec3;
using test::Arguments;
using test::at;
using test::kTight;
using test::Numbers;
using test::off;
using test::turn_z;
using test::turned;

struct Aim {
  Affine parent, up_target;
  Vec3 position, up{0, 1, 0};
  double mode = 0;
  std::vector<std::pair<Vec3, double>> targets{{{1, 0, 0}, 1.0}};

  Numbers solve() const {
    Arguments a{parent, position, up_target, up};
    for (const auto& [target, weight] : targets) {
      a.push_back(at(target));
      a.push_back(weight);
    }
    Numbers data{static_cast<double>(targets.size()), mode};
    test::append(data, Quat{});
    return test::run_kernel_once(Op::aim, a, data, 4);
  }
};

TEST_CASE("eval degenerate: aim, the target on the node: along the parent's x") {
  Aim aim;
  aim.position = {2, 3, 4};
  aim.targets = {{{2, 3, 4}, 1.0}};
  CHECK(off({M{}}, aim.solve()) < kTight);
  // Two targets on both sides, whose mean is the node.
  aim.targets = {{{3, 3, 4}, 1.0}, {{1, 3, 4}, 1.0}};
  CHECK(off({M{}}, aim.solve()) < kTight);
  aim.parent = turned({0, 0, 1}, 30);
  aim.position = {};
  aim.targets = {{{0, 0, 0}, 1.0}};
  CHECK(test::distance(math::rotate(test::quat_of(aim.solve()), Vec3{1, 0, 0}), Vec3{1, 0, 0}) <
        kTight);
}

TEST_CASE("eval degenerate: aim, up along the line or nowhere: x is kept, y is at right angles") {
  for (const Vec3 up : {Vec3{1, 0, 0}, {-1, 0, 0}, {0, 0, 0}, {1e-40, 0, 0}}) {
    for (const double mode : {0.0, 1.0, 2.0}) {
      Aim aim;
      aim.mode = mode;
      aim.up = up;
      aim.up_target = at(up);
      const Quat q = test::quat_of(aim.solve());
      CHECK(test::distance(math::rotate(q, Vec3{1, 0, 0}), Vec3{1, 0, 0}) < kTight);
      CHECK(math::dot(q, q) == doctest::Approx(1).epsilon(1e-14));
    }
  }
}

TEST_CASE("eval degenerate: aim, weights of nothing and below nothing") {
  Aim aim;
  aim.targets = {{{1, 0, 0}, 0.0}, {{0, 1, 0}, -2.0}};
  aim.up = {0, 0, 1};
  const V middle = exact::unit({1, 1, 0});
  CHECK(off({exact::frame(middle, {0, 0, 1})}, aim.solve()) < kTight);
  aim.targets[1].second = 1e-300;
  CHECK(off({exact::frame({0, 1, 0}, {0, 0, 1})}, aim.solve()) < kTight);
}

TEST_CASE("eval degenerate: aim, a flat parent counts as its rotation") {
  Aim aim;
  aim.parent.linear = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  aim.targets = {{{0, 2, 0}, 1.0}};
  aim.up = {0, 0, 1};
  CHECK(off({exact::frame({0, 1, 0}, {0, 0, 1})}, aim.solve()) < kTight);
}

Numbers constrain(const Affine& parent, const std::vector<std::pair<Affine, double>>& targets) {
  Arguments a{parent};
  Numbers data{static_cast<double>(targets.size()), 0};
  for (const auto& [target, weight] : targets) {
    a.push_back(target);
    a.push_back(weight);
    test::append(data, Affine{});
  }
  return test::run_kernel_once(Op::constraint, a, data, 10);
}

TEST_CASE("eval degenerate: constraint, targets that are the same give it back") {
  const Affine target = math::compose({{1, 2, 3}, math::axis_angle({0, 1, 0}, 2), {2, 3, 4}});
  const Numbers one = constrain({}, {{target, 1.0}});
  CHECK(off({V{1, 2, 3}, exact::turn_degrees(1, 2 / exact::kDegree), V{2, 3, 4}}, one, 4) < kTight);
  CHECK(test::difference(constrain({}, {{target, 0.3}, {target, 0.7}, {target, 1e-9}}), one) <
        kTight);
}

TEST_CASE("eval degenerate: constraint, half a turn apart is a quarter turn from both") {
  for (const double weight : {0.5, 0.25, 0.9}) {
    const Numbers got = constrain({}, {{{}, 1 - weight}, {turned({0, 0, 1}, 180), weight}});
    const exact::Turn way = exact::axis_angle(exact::turn(test::quat_of(got, 3)));
    CHECK(static_cast<double>(way.angle) == doctest::Approx(weight * math::kPi).epsilon(1e-12));
    CHECK(std::fabs(static_cast<double>(way.axis.z)) == doctest::Approx(1).epsilon(1e-12));
  }
}

TEST_CASE("eval degenerate: constraint, a flat parent counts as its rotation") {
  const Affine flat{{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {1, 2, 3}};
  const Numbers got = constrain(flat, {{at({4, 4, 4}), 1.0}});
  CHECK(got == Numbers{3, 2, 1, 0, 0, 0, 1, 1, 1, 1});
  // Flat along one axis: the others say the rotation.
  const Affine leaf = turned({0, 0, 1}, 90) * math::compose({{}, {}, {2, 0, 3}});
  CHECK(off({V{}, turn_z(-90), V{1, 1, 1}}, constrain(leaf, {{{}, 1.0}})) < kTight);
}

TEST_CASE("eval degenerate: constraint, a target without scale keeps place and gives no scale") {
  const Affine target{{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {1, 2, 3}};
  CHECK(constrain({}, {{target, 1.0}}) == Numbers{1, 2, 3, 0, 0, 0, 1, 0, 0, 0});
}

TEST_CASE("eval degenerate: constraint, mirrored against mirrored is not mirrored") {
  const Affine mirrored = math::compose({{}, {}, {1, 1, -2}});
  CHECK(constrain(mirrored, {{mirrored, 1.0}}) == Numbers{0, 0, 0, 0, 0, 0, 1, 1, 1, 1});
  CHECK(constrain({}, {{mirrored, 1.0}}) == Numbers{0, 0, 0, 0, 0, 0, 1, 1, 1, -2});
}

math::LimitSpace about_z(double low, double high) {
  math::LimitSpace space;
  space.min.z = low;
  space.max.z = high;
  return space;
}
Numbers limit(const math::LimitSpace& space, const Quat& q) {
  return test::run_kernel_once(Op::limit_rotation, {q}, eval::limit_data(space), 4);
}
Quat about_z(double degrees) { return math::from_euler_degrees({0, 0, degrees}); }

TEST_CASE("eval degenerate: limits, a rotation at its bound or inside comes back bit for bit") {
  const Quat inside = about_z(29.9999);
  for (const Quat& q : {inside, -inside, Quat{}, Quat{0, 0, 0, -1}})
    CHECK(limit(about_z(-30, 30), q) == eval::numbers_of(q));
  CHECK(limit({}, {0, 0, 0, 0}) == Numbers{0, 0, 0, 0});
}

TEST_CASE("eval degenerate: limits, opposite quaternions are clamped alike") {
  const Quat outside = about_z(100.0);
  for (const Quat& q : {outside, -outside})
    CHECK(off({turn_z(30)}, limit(about_z(-30, 30), q)) < kTight);
}

TEST_CASE("eval degenerate: limits, a locked angle") {
  for (const double degrees : {-179.0, -10.0, 0.0, 45.0, 180.0})
    CHECK(off({turn_z(25)}, limit(about_z(25, 25), about_z(degrees))) < kTight);
}

TEST_CASE("eval degenerate: limits, beyond half a turn") {
  // 200 to 300 degrees: -100 lies inside, 10 is nearer to 370 - 360 = 10 below 200 than to 300.
  CHECK(off({turn_z(-100)}, limit(about_z(200, 300), about_z(-100.0))) < kTight);
  CHECK(off({turn_z(300)}, limit(about_z(200, 300), about_z(-10.0))) < kTight);
  CHECK(off({turn_z(200)}, limit(about_z(200, 300), about_z(150.0))) < kTight);
}

TEST_CASE("eval degenerate: limits, at the gimbal") {
  math::LimitSpace space;
  space.max.y = 90;
  space.min.x = -10;
  space.max.x = 10;
  const Quat q = math::from_euler_degrees({0, 90, 0});
  CHECK(off({exact::turn_degrees(1, 90)}, limit(space, q)) < 1e-7);
  CHECK(test::all_finite(limit(space, math::from_euler_degrees({50, 90, 20}))));
  CHECK(test::all_finite(limit(space, math::from_euler_degrees({50, -90, 20}))));
}

TEST_CASE("eval degenerate: limits, vectors") {
  math::LimitSpace space;
  space.min = {-1, -1, -1};
  space.max = {1, 1, 1};
  const auto clamped = [&](Vec3 v) {
    return test::run_kernel_once(Op::limit_vector, {v}, eval::limit_data(space), 3);
  };
  CHECK(clamped({1, -1, 0.1}) == Numbers{1, -1, 0.1});
  CHECK(clamped({1e300, -1e300, 5e-324}) == Numbers{1, -1, 5e-324});
  space.min = space.max = {2, 2, 2};
  CHECK(clamped({0, 9, -9}) == Numbers{2, 2, 2});
}

double remapped(const Numbers& points, bool clamp, double x, double low = 0, double high = 1) {
  Numbers data{clamp ? 1.0 : 0.0, static_cast<double>(points.size() / 4)};
  data.insert(data.end(), points.begin(), points.end());
  return test::run_kernel_once(Op::remap, {x, low, high, 0.0, 1.0}, data, 1)[0];
}

TEST_CASE("eval degenerate: remap") {
  const Numbers step{0, 1, 0, 0, 0.5, 3, 0, 0}, line{0, 1, 1, 0, 1, 3, 1, 0};
  CHECK(remapped({}, false, 7) == 7);
  CHECK(remapped({}, true, 7) == 1);
  CHECK(remapped({0.5, 4, 1, 0}, false, 7) == 4);
  // A range of nothing is its lower end; so is one that overflows.
  CHECK(remapped(line, true, 9, 2, 2) == 1);
  CHECK(remapped(line, true, 9, -1e308, 1.7e308) == doctest::Approx(1).epsilon(1e-14));
  // Steps hold until the next point, and are there at the point.
  CHECK(remapped(step, true, std::nextafter(0.5, 0)) == 1);
  CHECK(remapped(step, true, 0.5) == 3);
  CHECK(remapped(line, false, -1) == -1);
  CHECK(remapped(line, false, 3) == 7);
  CHECK(remapped(line, true, -1) == 1);
  CHECK(remapped(line, false, 1e308) < std::numeric_limits<double>::infinity());
  CHECK(remapped(line, true, 0.25, 1, 0) == 2.5);
}

TEST_CASE("eval degenerate: compose, rotations that are none, long, opposite") {
  const auto composed = [](Quat q, Vec3 s) {
    return test::run_kernel_once(Op::compose, {Vec3{}, q, s}, {}, 12);
  };
  const Quat q = math::axis_angle({0, 0, 1}, 1);
  CHECK(composed(q, {1, 2, 3}) == composed(-q, {1, 2, 3}));
  for (const double length : {1e-29, 1e-10, 3.0, 1e140}) {
    const Quat longer{0, 0, q.z * length, q.w * length};
    CHECK(test::difference(composed(longer, {1, 1, 1}), composed(q, {1, 1, 1})) < kTight);
  }
  CHECK(composed({0, 0, 0, 0}, {1, 2, 3}) == composed({}, {1, 2, 3}));
  CHECK(composed({1e-31, 0, 0, 0}, {1, 1, 1}) == composed({}, {1, 1, 1}));
  CHECK(off({A(exact::scaled(exact::turn(q), {-1, 0, 1e-12L}), {})}, composed(q, {-1, 0, 1e-12})) <
        kTight);
}

}  // namespace
}  // namespace rigc
