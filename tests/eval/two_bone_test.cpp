// SPDX-License-Identifier: MIT
// Two-bone IK: what a limb must do, whatever the axes of its joints and the space it hangs in.
#include <doctest/doctest.h>

#include "tests/eval/kernel_runner.h"
#include "tests/eval/twins.h"

namespace rigc {
namespace {

using eval::Op;
using math::Affine;
using math::Quat;
using math::Vec3;
using test::Arguments;
using test::Numbers;
using test::Random;

// A limb at rest, measured as the modules do it.
struct Limb {
  Affine base;
  math::Trs start, middle;
  Vec3 end;
  Affine goal, pole;
  double twist = 0;
  Vec3 goal_offset, normal;
  Quat offsets[2];

  struct Solved {
    Affine start, middle;
  };
  Solved solve() const {
    const Arguments a{base, goal,        pole,        twist, start.translation, middle.translation,
                      end,  start.scale, middle.scale};
    Numbers data;
    for (const Numbers& part : {eval::numbers_of(goal_offset), eval::numbers_of(offsets[0]),
                                eval::numbers_of(offsets[1]), eval::numbers_of(normal)}) {
      data.insert(data.end(), part.begin(), part.end());
    }
    const Numbers got = test::run_kernel_once(Op::ik_two_bone, a, data, 24);
    CHECK(test::all_finite(got));
    return {test::affine_of(got), test::affine_of(got, 12)};
  }
  Affine rest_start() const { return base * math::compose(start); }
  Affine rest_middle() const { return rest_start() * math::compose(middle); }
  double upper() const {
    return math::length(base.linear * (math::matrix(start.rotation) *
                                       math::scaled(middle.translation, start.scale)));
  }
  double lower() const { return math::length(rest_middle() * end - rest_middle().origin); }
  double length() const { return upper() + lower(); }
  void aim_at(Vec3 world) { goal = {goal.linear, world - goal.linear * goal_offset}; }
  Vec3 root() const { return base * start.translation; }
};

Vec3 unit(Vec3 v) { return v * (1 / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z)); }

void measure(Limb& limb, Random& random, Vec3 bend) {
  const Vec3 p0 = limb.root(), p1 = limb.rest_middle().origin, p2 = limb.rest_middle() * limb.end;
  const Vec3 normal = unit(math::cross(p2 - p0, bend));
  const Affine worlds[] = {limb.rest_start(), limb.rest_middle()};
  const Vec3 bones[] = {unit(p1 - p0), unit(p2 - p1)};
  for (int i = 0; i < 2; ++i) {
    const math::Mat3 frame = math::frame(bones[i], math::cross(normal, bones[i]));
    limb.offsets[i] =
        math::quaternion(math::transposed(frame) * math::orthonormal(worlds[i].linear));
  }
  limb.normal = math::transposed(math::orthonormal(limb.base.linear)) * normal;
  limb.goal = math::compose(random.trs());
  limb.goal_offset = math::inverse(limb.goal) * p2;
  limb.pole = {math::matrix(random.rotation()),
               p1 + unit(math::cross(normal, unit(p2 - p0))) * limb.length()};
}

Limb random_limb(Random& random, bool straight = false) {
  Limb limb;
  const double size = random.chance(50) ? 1 : random.chance(50) ? 0.01 : 100;
  limb.base = {math::matrix(random.rotation()), random.vector(2)};
  for (Vec3* column : {&limb.base.linear.x, &limb.base.linear.y, &limb.base.linear.z})
    *column = *column * size;
  if (random.chance(25)) limb.base.linear.z = -limb.base.linear.z;
  limb.start = {random.vector() * (1 / size), random.rotation(), {1, 1, 1}};
  limb.middle = {random.arrow(0.5, 2) * (1 / size), random.rotation(), {1, 1, 1}};
  limb.end = random.arrow(0.5, 2) * (1 / size);
  if (straight) {
    // The lower bone goes on where the upper one points to.
    limb.end = math::rotate(math::conjugate(limb.middle.rotation),
                            math::normalised(limb.middle.translation)) *
               math::length(limb.end);
  }
  const Vec3 p0 = limb.root(), p1 = limb.rest_middle().origin, p2 = limb.rest_middle() * limb.end;
  const Vec3 along = unit(p2 - p0);
  Vec3 bend = (p1 - p0) - along * math::dot(p1 - p0, along);
  if (straight) bend = math::perpendicular(along);
  measure(limb, random, bend);
  return limb;
}

double bend_sine(const Limb& limb) {
  const Vec3 p0 = limb.root(), p1 = limb.rest_middle().origin, p2 = limb.rest_middle() * limb.end;
  return math::length(math::cross(unit(p1 - p0), unit(p2 - p1)));
}

// Where the joints land when they get these rotations in their parents, and nothing else changes.
struct Landed {
  Vec3 middle, end;
};
Landed apply(const Limb& limb, const Limb::Solved& solved) {
  const Quat first = math::decompose(math::inverse(limb.base) * solved.start).rotation;
  const Affine start = limb.base * math::compose({limb.start.translation, first, limb.start.scale});
  const Quat second = math::decompose(math::inverse(start) * solved.middle).rotation;
  const Affine middle = start * math::compose({limb.middle.translation, second, limb.middle.scale});
  return {middle.origin, middle * limb.end};
}

TEST_CASE("eval two bones: at rest the limb stays at rest") {
  Random random(1);
  int bent = 0;
  for (int i = 0; i < 2000; ++i) {
    const Limb limb = random_limb(random);
    // Near straight the knee is the square root of rounding noise.
    if (bend_sine(limb) < 0.05) continue;
    ++bent;
    const Limb::Solved solved = limb.solve();
    const double size = limb.length() + math::length(limb.root());
    const double scale = math::length(limb.base.linear.x);
    CHECK(test::distance(solved.start.origin, limb.rest_start().origin) < 1e-12 * size);
    CHECK(test::distance(solved.middle.origin, limb.rest_middle().origin) < 1e-12 * size);
    CHECK(test::distance(solved.start.linear, limb.rest_start().linear) < 1e-11 * scale);
    CHECK(test::distance(solved.middle.linear, limb.rest_middle().linear) < 1e-11 * scale);
  }
  CHECK(bent > 1500);
}

TEST_CASE("eval two bones: a straight limb at rest stays exactly where it is") {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Limb limb = random_limb(random, true);
    const Limb::Solved solved = limb.solve();
    const double size = limb.length() + math::length(limb.root());
    CHECK(test::distance(solved.middle.origin, limb.rest_middle().origin) < 1e-12 * size);
    CHECK(test::distance(solved.start.linear, limb.rest_start().linear) <
          1e-11 * math::length(limb.base.linear.x));
  }
}

TEST_CASE("eval two bones: a goal in reach is reached and lengths stay") {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    Limb limb = random_limb(random);
    const double shortest = std::fabs(limb.upper() - limb.lower()), longest = limb.length();
    const Vec3 target = limb.root() + random.arrow(shortest + (longest - shortest) * 0.01,
                                                   longest - (longest - shortest) * 0.01);
    limb.aim_at(target);
    limb.pole.origin = limb.root() + random.vector(3);
    limb.twist = random.between(-180, 180);
    const Landed landed = apply(limb, limb.solve());
    CHECK(test::distance(landed.end, target) < 1e-10 * (longest + math::length(limb.root())));
    CHECK(test::distance(landed.middle, limb.root()) ==
          doctest::Approx(limb.upper()).epsilon(1e-11));
    CHECK(test::distance(landed.middle, landed.end) == doctest::Approx(limb.lower()).epsilon(1e-9));
  }
}

TEST_CASE("eval two bones: positions equal the law of cosines") {
  Random random(4);
  for (int i = 0; i < 1000; ++i) {
    Limb limb = random_limb(random);
    const double a = limb.upper(), b = limb.lower();
    const double c = std::fabs(a - b) + (a + b - std::fabs(a - b)) * random.between(0.05, 0.95);
    const Vec3 along = random.direction();
    limb.aim_at(limb.root() + along * c);
    const Vec3 to_pole = random.vector(3);
    limb.pole.origin = limb.root() + to_pole;
    limb.twist = random.chance(50) ? 0 : random.between(-90, 90);
    // Turn the direction to the goal by the angle at the root, in the plane of the pole.
    const double angle = std::acos((a * a + c * c - b * b) / (2 * a * c));
    Vec3 normal = unit(math::cross(along, to_pole));
    normal = twin::column(twin::times(twin::turn(along, limb.twist * 3.14159265358979323846 / 180),
                                      twin::place(normal, twin::identity(), {1, 1, 1})),
                          3);
    const twin::M turned =
        twin::times(twin::turn(normal, angle), twin::place(along, twin::identity(), {1, 1, 1}));
    const Vec3 want = limb.root() + twin::column(turned, 3) * a;
    CHECK(test::distance(apply(limb, limb.solve()).middle, want) <
          1e-9 * (a + b + math::length(limb.root())));
  }
}

TEST_CASE("eval two bones: the knee is on the pole's side") {
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    Limb limb = random_limb(random);
    const Vec3 along = random.direction();
    limb.aim_at(limb.root() + along * (limb.length() * 0.9));
    if (std::fabs(limb.upper() - limb.lower()) > limb.length() * 0.85) continue;
    limb.pole.origin = limb.root() + random.vector(3);
    const Landed landed = apply(limb, limb.solve());
    const Vec3 to_pole = limb.pole.origin - limb.root(), to_knee = landed.middle - limb.root();
    const Vec3 pole_side = to_pole - along * math::dot(to_pole, along);
    const Vec3 knee_side = to_knee - along * math::dot(to_knee, along);
    CHECK(math::dot(unit(pole_side), unit(knee_side)) == doctest::Approx(1).epsilon(1e-7));
  }
}

TEST_CASE("eval two bones: out of reach it is exactly straight, too near it is folded") {
  Random random(6);
  for (int i = 0; i < 1000; ++i) {
    Limb limb = random_limb(random);
    const Vec3 along = random.direction();
    limb.aim_at(limb.root() + along * (limb.length() * random.between(1, 5)));
    Landed landed = apply(limb, limb.solve());
    const double size = limb.length() + math::length(limb.root());
    CHECK(test::distance(landed.middle, limb.root() + along * limb.upper()) < 1e-11 * size);
    CHECK(test::distance(landed.end, limb.root() + along * limb.length()) < 1e-11 * size);
    const double shortest = std::fabs(limb.upper() - limb.lower());
    if (shortest < 0.01 * limb.length()) continue;
    limb.aim_at(limb.root() + along * (shortest * random.between(0.01, 1)));
    landed = apply(limb, limb.solve());
    CHECK(test::distance(landed.end, limb.root() + along * shortest) < 1e-10 * size);
  }
}

TEST_CASE("eval two bones: straightening is continuous") {
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    Limb limb = random_limb(random);
    const Vec3 along = random.direction();
    const double size = limb.length() + math::length(limb.root());
    Vec3 before;
    for (int k = 0; k < 40; ++k) {
      limb.aim_at(limb.root() + along * (limb.length() * (1 - std::ldexp(1.0, -k - 10))));
      const Vec3 middle = limb.solve().middle.origin;
      // The knee moves like the square root of what is left.
      if (k > 0)
        CHECK(test::distance(middle, before) < 2 * size * std::sqrt(std::ldexp(1.0, -k - 8)));
      before = middle;
    }
  }
}

TEST_CASE("eval two bones: a child moved off its rest direction still lands on the solution") {
  Random random(8);
  for (int i = 0; i < 500; ++i) {
    Limb limb = random_limb(random);
    limb.middle.translation =
        limb.middle.translation + random.vector(0.2) * math::length(limb.middle.translation);
    limb.end = limb.end + random.vector(0.2) * math::length(limb.end);
    const Vec3 target = limb.root() + random.direction() * (limb.length() * 0.9);
    if (std::fabs(limb.upper() - limb.lower()) > limb.length() * 0.85) continue;
    limb.aim_at(target);
    CHECK(test::distance(apply(limb, limb.solve()).end, target) <
          1e-10 * (limb.length() + math::length(limb.root())));
  }
}

TEST_CASE("eval two bones: uniform scale of the joints counts as length") {
  Random random(9);
  for (int i = 0; i < 500; ++i) {
    Limb limb = random_limb(random);
    const double s = random.between(0.5, 2);
    limb.start.scale = {s, s, s};
    limb.middle.scale = {1.5, 1.5, 1.5};
    if (std::fabs(limb.upper() - limb.lower()) > limb.length() * 0.75) continue;
    const Vec3 target = limb.root() + random.direction() * (limb.length() * 0.8);
    limb.aim_at(target);
    CHECK(test::distance(apply(limb, limb.solve()).end, target) <
          1e-10 * (limb.length() + math::length(limb.root())));
  }
}

TEST_CASE("eval two bones: degenerate input leaves finite numbers") {
  Random random(10);
  for (int i = 0; i < 3000; ++i) {
    Limb limb = random_limb(random, random.chance(30));
    if (random.chance(30)) limb.aim_at(limb.root());
    if (random.chance(30)) limb.aim_at(limb.root() + random.direction() * 1e-300);
    if (random.chance(20)) limb.middle.translation = {};
    if (random.chance(20)) limb.end = {};
    if (random.chance(20)) limb.middle.translation = limb.end;
    if (random.chance(20)) limb.start.scale = {};
    if (random.chance(20)) limb.middle.scale.y = 0;
    if (random.chance(20)) limb.base.linear = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    if (random.chance(20)) limb.base.linear.x = {};
    if (random.chance(30)) limb.pole.origin = limb.root();
    if (random.chance(30)) limb.pole.origin = limb.goal * limb.goal_offset;
    if (random.chance(20)) limb.normal = {};
    limb.solve();
  }
}

TEST_CASE("eval two bones: a goal at the start folds equal bones toward the pole") {
  Limb limb;
  limb.middle.translation = {0, -1, 0};
  limb.end = {0, -1, 0};
  Random random(11);
  measure(limb, random, {0, 0, 1});
  limb.aim_at({0, 0, 0});
  limb.pole.origin = {0, 0, 5};
  CHECK(test::distance(apply(limb, limb.solve()).middle, Vec3{0, 0, 1}) < 1e-12);
}

TEST_CASE("eval two bones: a pole on the line falls back to the rest normal") {
  Limb limb;
  limb.middle.translation = {0, -1, 0.1};
  limb.end = {0, -1, -0.1};
  Random random(12);
  measure(limb, random, {0, 0, 1});
  limb.aim_at({0, -1.5, 0});
  limb.pole.origin = {0, -3, 0};
  const Landed landed = apply(limb, limb.solve());
  CHECK(landed.middle.z > 0.5);
  CHECK(std::fabs(landed.middle.x) < 1e-12);
}

}  // namespace
}  // namespace rigc
