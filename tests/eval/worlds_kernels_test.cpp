// SPDX-License-Identifier: MIT
// Kernels of transforms with constants folded into them, each against what it replaces.
#include <doctest/doctest.h>

#include "tests/eval/kernel_runner.h"

namespace rigc {
namespace {

using eval::Op;
using math::Affine;
using math::Vec3;
using test::Arguments;
using test::Numbers;
using test::Random;

std::vector<Arguments> lanes_of(Random& random, Arguments (*make)(Random&)) {
  std::vector<Arguments> lanes;
  for (int lane = 0; lane < eval::kLanes; ++lane) lanes.push_back(make(random));
  return lanes;
}

Numbers joined(const math::Mat3& linear, Vec3 t) { return eval::numbers_of(Affine{linear, t}); }

Affine any_affine(Random& random) { return math::compose(random.trs(random.chance(50))); }

TEST_CASE("eval worlds kernels: compose_rigid is compose with scale 1, bit for bit") {
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const auto lanes = lanes_of(random, [](Random& r) {
      math::Quat q = r.rotation();
      const double size = r.chance(20) ? 0 : r.between(0.1, 10);
      q = {q.x * size, q.y * size, q.z * size, q.w * size};
      return Arguments{r.vector(5), q};
    });
    std::vector<Arguments> scaled = lanes;
    for (Arguments& lane : scaled) lane.push_back(Vec3{1, 1, 1});
    CHECK(test::run_kernel(Op::compose_rigid, lanes, {}, 12) ==
          test::run_kernel(Op::compose, scaled, {}, 12));
  }
}

TEST_CASE("eval worlds kernels: compose_under") {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const math::Quat q = random.rotation();
    const Vec3 t = random.vector(3);
    const auto lanes = lanes_of(random, [](Random& r) {
      return Arguments{r.vector(5), r.rotation()};
    });
    const auto got =
        test::run_kernel(Op::compose_under, lanes, {t.x, t.y, t.z, q.x, q.y, q.z, q.w}, 12);
    for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
      const Affine expected =
          Affine{math::matrix(q), t} *
          math::compose(
              {std::get<Vec3>(lanes[lane][0]), std::get<math::Quat>(lanes[lane][1]), {1, 1, 1}});
      CHECK(test::distance(test::affine_of(got[lane]), expected) < 1e-14);
    }
  }
  // A lost rotation is none.
  const Numbers lost = test::run_kernel_once(
      Op::compose_under, {Vec3{1, 2, 3}, math::Quat{0, 0, 0, 0}}, {1, 0, 0, 0, 0, 0, 1}, 12);
  CHECK(test::affine_of(lost) == math::translation({2, 2, 3}));
}

TEST_CASE("eval worlds kernels: hang, hang_straight, place") {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const auto lanes = lanes_of(random, [](Random& r) {
      return Arguments{any_affine(r), any_affine(r), r.vector(3)};
    });
    std::vector<Arguments> two = lanes;
    for (Arguments& lane : two) lane.pop_back();
    const math::Mat3 linear = any_affine(random).linear;
    const Vec3 t = random.vector(3);
    const auto hung = test::run_kernel(Op::hang, two, joined(linear, t), 12);
    const auto straight = test::run_kernel(Op::hang_straight, two, {t.x, t.y, t.z}, 12);
    const auto placed = test::run_kernel(Op::place, lanes, {}, 12);
    for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
      const auto parent = std::get<Affine>(lanes[lane][0]);
      const auto turned = std::get<Affine>(lanes[lane][1]);
      CHECK(test::distance(test::affine_of(hung[lane]),
                           Affine{turned.linear * linear, parent * t}) < 1e-13);
      CHECK(test::affine_of(straight[lane]).linear == turned.linear);
      CHECK(test::distance(test::affine_of(straight[lane]).origin, parent * t) < 1e-13);
      CHECK(test::affine_of(placed[lane]) ==
            Affine{turned.linear, parent * std::get<Vec3>(lanes[lane][2])});
    }
  }
}

TEST_CASE("eval worlds kernels: blend is the constraint in the world's own space") {
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const auto count = 1 + random.below(4);
    Arguments blended, constrained{Affine{}};
    Numbers table{static_cast<double>(count)}, offsets{static_cast<double>(count), 0};
    for (std::size_t k = 0; k < count; ++k) {
      math::Trs target = random.trs();
      const math::Quat turn = random.rotation();
      const Vec3 at = random.vector();
      const double weight = random.between(-1, 2), inverse = 1 / target.scale.x;
      for (Arguments* arguments : {&blended, &constrained})
        arguments->insert(arguments->end(), {math::compose(target), weight});
      const math::Mat3 r = math::matrix(turn);
      const Numbers rigid = joined({r.x * inverse, r.y * inverse, r.z * inverse}, at);
      const Numbers offset = joined(r, at);
      table.insert(table.end(), rigid.begin(), rigid.end());
      offsets.insert(offsets.end(), offset.begin(), offset.end());
    }
    const Numbers got = test::run_kernel_once(Op::blend, blended, table, 12);
    const Numbers expected = test::run_kernel_once(Op::constraint, constrained, offsets, 10);
    const Affine world{math::matrix(test::quat_of(expected, 3)), test::vec3_of(expected)};
    CHECK(test::distance(test::affine_of(got), world) < 1e-12);
  }
}

TEST_CASE("eval worlds kernels: aim_world is aim, put together again") {
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    const math::Trs parent = random.trs();
    const Vec3 position = random.vector();
    const Arguments arguments{math::compose(parent), position,           any_affine(random),
                              random.direction(),    any_affine(random), 1.0};
    const auto mode = static_cast<double>(random.below(3));
    const math::Quat offset = random.rotation();
    const math::Mat3 r = math::matrix(offset);
    Numbers table{1, mode};
    const Numbers linear =
        joined({r.x * parent.scale.x, r.y * parent.scale.x, r.z * parent.scale.x}, {});
    table.insert(table.end(), linear.begin(), linear.begin() + 9);
    const Numbers got = test::run_kernel_once(Op::aim_world, arguments, table, 12);
    const Numbers local = test::run_kernel_once(
        Op::aim, arguments, {1, mode, offset.x, offset.y, offset.z, offset.w}, 4);
    const Affine world =
        math::compose(parent) * math::compose({position, test::quat_of(local), {1, 1, 1}});
    CHECK(test::distance(test::affine_of(got), world) < 1e-11);
  }
}

}  // namespace
}  // namespace rigc
