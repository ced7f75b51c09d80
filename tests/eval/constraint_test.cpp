// SPDX-License-Identifier: MIT
// Weighted constraints against a twin, and as properties: rests come back, weights are relative.
#include <doctest/doctest.h>

#include "tests/eval/kernel_runner.h"
#include "tests/eval/twins.h"

namespace rigc {
namespace {

using eval::Op;
using math::Affine;
using test::Arguments;
using test::Numbers;
using test::Random;

struct Setup {
  Affine parent;
  std::vector<Affine> targets, offsets;
  Numbers weights;
  bool point = false;

  Arguments arguments() const {
    Arguments a{parent};
    for (std::size_t i = 0; i < targets.size(); ++i) {
      a.push_back(targets[i]);
      a.push_back(weights[i]);
    }
    return a;
  }
  Numbers data() const {
    Numbers d{static_cast<double>(targets.size()), point ? 1.0 : 0.0};
    for (const Affine& offset : offsets) {
      const Numbers n = eval::numbers_of(offset);
      d.insert(d.end(), n.begin(), n.end());
    }
    return d;
  }
  Numbers run() const { return test::run_kernel_once(Op::constraint, arguments(), data(), 10); }
};

Setup random_setup(Random& random, std::size_t count, bool uniform = true) {
  Setup s;
  s.parent = math::compose(random.trs(uniform));
  for (std::size_t i = 0; i < count; ++i) {
    s.targets.push_back(math::compose(random.trs()));
    s.offsets.push_back(math::compose(random.trs()));
    s.weights.push_back(random.between(0, 2));
  }
  return s;
}

struct Twin {
  math::Vec3 position, scale;
  twin::M rotation;
};

// In rig space first, and brought into the parent's space at the end.
Twin twin_of(const Setup& s) {
  double sum = 0;
  for (const double w : s.weights) sum += w;
  Twin out;
  double so_far = 0;
  math::Vec3 position, scale;
  twin::M rotation = twin::identity();
  for (std::size_t i = 0; i < s.targets.size(); ++i) {
    const twin::M world = twin::times(twin::from(s.targets[i]), twin::from(s.offsets[i]));
    const double w = s.weights[i] / sum;
    so_far += w;
    const math::Vec3 at = twin::column(world, 3);
    for (std::size_t c = 0; c < 3; ++c) {
      const math::Vec3 axis = twin::column(world, c);
      position[c] += w * at[c];
      scale[c] += w * std::sqrt(axis.x * axis.x + axis.y * axis.y + axis.z * axis.z);
    }
    rotation = i == 0 ? twin::rotation_of(world)
                      : twin::part_way(rotation, twin::rotation_of(world), w / so_far);
  }
  const twin::M back = twin::inverse(twin::from(s.parent));
  const twin::M local = twin::times(back, twin::place(position, rotation, {1, 1, 1}));
  out.position = twin::column(local, 3);
  out.rotation = twin::rotation_of(local);
  for (std::size_t c = 0; c < 3; ++c)
    out.scale[c] = scale[c] * std::sqrt(local[0][c] * local[0][c] + local[1][c] * local[1][c] +
                                        local[2][c] * local[2][c]);
  return out;
}

TEST_CASE("eval constraint: equals its twin") {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Setup s = random_setup(random, 1 + random.below(4));
    const Twin want = twin_of(s);
    const Numbers got = s.run();
    CHECK(test::distance(test::vec3_of(got, 0), want.position) < 1e-9);
    CHECK(twin::angle_between(twin::turn(test::quat_of(got, 3)), want.rotation) < 1e-9);
    CHECK(test::distance(test::vec3_of(got, 7), want.scale) < 1e-9);
  }
}

TEST_CASE("eval constraint: offsets that keep the rest give it back under any parent") {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    Setup s = random_setup(random, 1 + random.below(3), false);
    if (random.chance(30)) s.parent = s.parent * Affine{{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, {}};
    if (random.chance(30))
      s.parent = s.parent * Affine{{{0.01, 0, 0}, {0, 0.01, 0}, {0, 0, 0.01}}, {}};
    const math::Trs rest = random.trs(false);
    const Affine world = s.parent * math::compose(rest);
    for (std::size_t k = 0; k < s.targets.size(); ++k)
      s.offsets[k] = math::inverse(s.targets[k]) * world;
    const Numbers got = s.run();
    CHECK(test::distance(test::vec3_of(got, 0), rest.translation) < 1e-12);
    CHECK(test::distance(test::quat_of(got, 3), rest.rotation) < 1e-12);
    CHECK(test::distance(test::vec3_of(got, 7), rest.scale) < 1e-12);
  }
}

TEST_CASE("eval constraint: weights are relative to their sum") {
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    Setup s = random_setup(random, 3);
    const Numbers once = s.run();
    for (double& w : s.weights) w *= 7;
    CHECK(test::difference(s.run(), once) < 1e-13);
    for (double& w : s.weights) w = 0;
    const Numbers none = s.run();
    for (double& w : s.weights) w = 5;
    CHECK(test::difference(s.run(), none) < 1e-13);
    for (double& w : s.weights) w = -1;
    CHECK(test::difference(s.run(), none) < 1e-13);
  }
}

TEST_CASE("eval constraint: a target without weight counts nothing") {
  Random random(4);
  for (int i = 0; i < 300; ++i) {
    Setup s = random_setup(random, 3);
    s.weights[1] = random.chance(50) ? 0 : -2;
    const Numbers got = s.run();
    s.targets.erase(s.targets.begin() + 1);
    s.offsets.erase(s.offsets.begin() + 1);
    s.weights.erase(s.weights.begin() + 1);
    CHECK(got == s.run());
  }
}

TEST_CASE("eval constraint: two rotations blend by slerp, the shorter way") {
  Setup s;
  s.offsets = {{}, {}};
  s.targets = {math::rotation(math::axis_angle({0, 1, 0}, math::radians(170))),
               math::rotation(math::axis_angle({0, 1, 0}, math::radians(-170)))};
  s.weights = {0.75, 0.25};
  const math::Quat want = math::axis_angle({0, 1, 0}, math::radians(175));
  CHECK(test::distance(test::quat_of(s.run(), 3), want) < 1e-14);
}

TEST_CASE(
    "eval constraint: a point constraint puts its offset beside the target, in the parent's "
    "space") {
  Random random(6);
  for (int i = 0; i < 500; ++i) {
    Setup s = random_setup(random, 2);
    s.point = true;
    const double sum = s.weights[0] + s.weights[1];
    math::Vec3 expected;
    for (std::size_t t = 0; t < 2; ++t) {
      const twin::M to_parent = twin::inverse(twin::from(s.parent));
      const twin::M at = twin::times(to_parent, twin::from(math::translation(s.targets[t].origin)));
      expected = expected + (twin::column(at, 3) + s.offsets[t].origin) * (s.weights[t] / sum);
    }
    const double size = 1 + math::length(expected);
    CHECK(math::length(test::vec3_of(s.run(), 0) - expected) < 1e-9 * size);
  }
}

TEST_CASE("eval constraint: degenerate input leaves finite numbers") {
  Random random(5);
  const Affine flat{{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {1, 2, 3}};
  for (int i = 0; i < 500; ++i) {
    Setup s = random_setup(random, 2);
    if (random.chance(40)) s.parent = flat;
    if (random.chance(40)) s.targets[0] = flat;
    if (random.chance(40)) s.offsets[1] = flat;
    if (random.chance(40)) s.targets[1] = s.targets[0] * math::rotation({1, 0, 0, 0});
    if (random.chance(40)) s.weights = {0, 0};
    if (random.chance(20)) s.parent.linear.y = s.parent.linear.x;
    CHECK(test::all_finite(s.run()));
  }
  Setup s = random_setup(random, 1);
  s.parent = {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {1, 2, 3}};
  s.offsets = {{}};
  CHECK(test::distance(test::quat_of(s.run(), 3), math::decompose(s.targets[0]).rotation) < 1e-14);
}

}  // namespace
}  // namespace rigc
