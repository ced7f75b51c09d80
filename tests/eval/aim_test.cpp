// SPDX-License-Identifier: MIT
// The aim constraint as properties in world space, against directions worked out by hand.
#include <doctest/doctest.h>

#include "tests/eval/kernel_runner.h"
#include "tests/eval/twins.h"

namespace rigc {
namespace {

using eval::Op;
using math::Affine;
using math::Vec3;
using test::Arguments;
using test::Numbers;
using test::Random;

struct Setup {
  Affine parent;
  Vec3 position;
  Affine up_target;
  Vec3 up_vector{0, 1, 0};
  std::vector<Affine> targets;
  Numbers weights;
  double mode = 0;
  math::Quat offset;

  math::Quat run() const {
    Arguments a{parent, position, up_target, up_vector};
    for (std::size_t i = 0; i < targets.size(); ++i) {
      a.push_back(targets[i]);
      a.push_back(weights[i]);
    }
    const Numbers data{
        static_cast<double>(targets.size()), mode, offset.x, offset.y, offset.z, offset.w};
    const Numbers got = test::run_kernel_once(Op::aim, a, data, 4);
    CHECK(test::all_finite(got));
    return test::quat_of(got);
  }
  /// World rotation of the driven node.
  twin::M world() const { return twin::times(twin::from(parent), twin::turn(run())); }
};

Setup random_setup(Random& random) {
  Setup s;
  s.parent = math::compose(random.trs());
  s.position = random.vector();
  s.up_target = math::compose(random.trs());
  s.up_vector = random.direction();
  s.mode = static_cast<double>(random.below(3));
  for (std::size_t i = 1 + random.below(3); i > 0; --i) {
    s.targets.push_back(math::compose(random.trs()));
    s.weights.push_back(random.between(0.1, 2));
  }
  return s;
}

Vec3 unit(Vec3 v) { return v * (1 / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z)); }

TEST_CASE("eval aim: x points at the weighted mean and y leans toward up") {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Setup s = random_setup(random);
    Vec3 mean;
    double sum = 0;
    for (std::size_t k = 0; k < s.targets.size(); ++k) {
      mean = mean + s.targets[k].origin * s.weights[k];
      sum += s.weights[k];
    }
    const Vec3 at = s.parent * s.position;
    const Vec3 toward = unit(mean * (1 / sum) - at);
    Vec3 up = s.up_vector;
    if (s.mode == 1) up = s.up_target.origin - at;
    if (s.mode == 2) up = unit(s.up_target.linear * s.up_vector);
    const Vec3 side = unit(math::cross(toward, up));
    const twin::M world = s.world();
    CHECK(test::distance(unit(twin::column(world, 0)), toward) < 1e-9);
    CHECK(test::distance(unit(twin::column(world, 2)), side) < 1e-9);
  }
}

TEST_CASE("eval aim: the offset turns the node inside the aim frame") {
  Random random(2);
  for (int i = 0; i < 500; ++i) {
    Setup s = random_setup(random);
    const twin::M plain = twin::rotation_of(s.world());
    s.offset = random.rotation();
    CHECK(twin::angle_between(twin::rotation_of(s.world()),
                              twin::times(plain, twin::turn(s.offset))) < 1e-9);
  }
}

TEST_CASE("eval aim: an offset that keeps the rest gives it back under any parent") {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    Setup s = random_setup(random);
    s.parent = math::compose(random.trs(false));
    if (random.chance(30)) s.parent = s.parent * Affine{{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, {}};
    s.mode = 0;
    s.targets.resize(1);
    s.weights.resize(1);
    const math::Quat rest = random.rotation();
    const math::Mat3 world = math::orthonormal(s.parent.linear * math::matrix(rest));
    const Vec3 toward = math::normalised(s.targets[0].origin - s.parent * s.position);
    s.offset = math::quaternion(math::transposed(math::frame(toward, s.up_vector)) * world);
    CHECK(test::distance(s.run(), rest) < 1e-12);
  }
}

TEST_CASE("eval aim: degenerate input leaves finite unit rotations") {
  Random random(4);
  const Affine flat{{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {1, 2, 3}};
  for (int i = 0; i < 600; ++i) {
    Setup s = random_setup(random);
    if (random.chance(40)) s.targets.assign(s.targets.size(), {{}, s.parent * s.position});
    if (random.chance(30)) s.up_vector = {};
    if (random.chance(30)) s.up_vector = s.targets[0].origin - s.parent * s.position;
    if (random.chance(30)) s.up_target = flat;
    if (random.chance(30)) s.parent = flat;
    if (random.chance(30)) s.weights.assign(s.weights.size(), 0);
    const math::Quat q = s.run();
    CHECK(math::dot(q, q) == doctest::Approx(1));
  }
}

}  // namespace
}  // namespace rigc
