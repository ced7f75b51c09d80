// SPDX-License-Identifier: MIT
// The degenerate cases of the IK solvers by name, each with its answer written out: straight and
// folded limbs, bones without length, mirrored and uneven scale, targets at the root. Where several
// answers are as good, the one that is documented.
#include <doctest/doctest.h>

#include "tests/eval/answers.h"

namespace rigc {
namespace {

using eval::Op;
using exact::A;
using exact::M;
using exact::Part;
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

// A limb in the plane of x and y with bones along x: the answer is angles about z.
struct Limb {
  Affine base, goal = at({1, 1, 0}), pole = at({0, 5, 0});
  double twist = 0;
  Vec3 start, middle{1, 0, 0}, end{1, 0, 0}, start_scale{1, 1, 1}, middle_scale{1, 1, 1};
  Quat offsets[2];
  Vec3 normal{0, 0, 1};

  Numbers solve() const {
    Numbers data{0, 0, 0};
    test::append(data, offsets[0]);
    test::append(data, offsets[1]);
    test::append(data, normal);
    const Arguments a{base, goal, pole, twist, start, middle, end, start_scale, middle_scale};
    return test::run_kernel_once(Op::ik_two_bone, a, data, 24);
  }
};
// Worlds of the joints of such a limb: the first bone's angle, the second's, where the middle is.
std::vector<Part> bent(double first, double second, V middle, V start = {}) {
  return {A(turn_z(first), start), A(turn_z(second), middle)};
}

TEST_CASE("eval degenerate: two bones, straight") {
  Limb limb;
  for (const double reach : {2.0, 2.0000001, 3.0, 1e6, 1e100}) {
    limb.goal = at({reach, 0, 0});
    CHECK(off(bent(0, 0, {1, 0, 0}), limb.solve()) == 0);
  }
  limb.goal = at({0, -7, 0});
  limb.pole = at({4, 0, 0});
  CHECK(off(bent(-90, -90, {0, -1, 0}), limb.solve()) < kTight);
}

TEST_CASE("eval degenerate: two bones, nearly straight: the knee is the root of what is left") {
  Limb limb;
  for (int k = 8; k < 40; ++k) {
    const double left = std::ldexp(1.0, -k);
    limb.goal = at({2 - left, 0, 0});
    const double angle = std::acos(1 - left / 2) * 180 / math::kPi;
    const Numbers got = limb.solve();
    CHECK(off(bent(angle, -angle, {1 - left / 2, std::sqrt(left - left * left / 4), 0}), got) <
          4e-16 / std::sqrt(left));
  }
}

TEST_CASE("eval degenerate: two bones, folded") {
  Limb limb;
  limb.end = {0.25, 0, 0};
  for (const double reach : {0.75, 0.5, 1e-3, 1e-9}) {
    limb.goal = at({reach, 0, 0});
    CHECK(off(bent(0, 180, {1, 0, 0}), limb.solve()) < kTight);
  }
  // The longer bone is the second: the first points away from the goal.
  limb.middle = {0.25, 0, 0};
  limb.end = {1, 0, 0};
  limb.goal = at({0.5, 0, 0});
  CHECK(off(bent(180, 0, {-0.25, 0, 0}), limb.solve()) < kTight);
}

TEST_CASE("eval degenerate: two bones, the goal at the root") {
  Limb limb;
  limb.goal = at({0, 0, 0});
  // Equal bones: out to the pole and back, in the plane of rest.
  CHECK(off(bent(90, -90, {0, 1, 0}), limb.solve()) < kTight);
  limb.pole = at({-3, 0, 0});
  CHECK(off(bent(180, 0, {-1, 0, 0}), limb.solve()) < kTight);
  // Unequal bones cannot reach it: folded at right angles to the pole, as a goal near by would be.
  limb.end = {0.5, 0, 0};
  limb.pole = at({0, 5, 0});
  CHECK(off(bent(0, 180, {1, 0, 0}), limb.solve()) < kTight);
}

TEST_CASE("eval degenerate: two bones, no plane: the normal of rest") {
  Limb limb;
  const std::vector<Part> up = bent(60, -60, {0.5, 0.75 / std::sqrt(0.75), 0});
  limb.goal = at({1, 0, 0});
  for (const Vec3 pole : {Vec3{3, 0, 0}, {-3, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1e9, 100, 0}}) {
    limb.pole = at(pole);
    CHECK(off(up, limb.solve()) < kTight);
  }
  // No normal of rest either: z.
  limb.normal = {};
  CHECK(off(up, limb.solve()) < kTight);
}

TEST_CASE("eval degenerate: two bones, bones without length") {
  Limb limb;
  limb.goal = at({0.5, 0, 0});
  limb.middle = {};
  // Nearer than the second bone is long: the first points away from the goal, as any shorter one.
  CHECK(off(bent(180, 0, {}), limb.solve()) < kTight);
  limb.goal = at({0, 3, 0});
  limb.pole = at({-3, 0, 0});
  CHECK(off(bent(90, 90, {}), limb.solve()) < kTight);
  limb = {};
  limb.end = {};
  limb.goal = at({0, 0.5, 0});
  limb.pole = at({-3, 0, 0});
  CHECK(off({A(turn_z(90), {}), A(turn_z(-90), {0, 1, 0})}, limb.solve()) < kTight);
  limb.middle = {};
  limb.start = {3, 4, 5};
  CHECK(test::all_finite(limb.solve()));
  CHECK(test::vec3_of(limb.solve(), 9) == Vec3{3, 4, 5});
  CHECK(test::vec3_of(limb.solve(), 21) == Vec3{3, 4, 5});
}

TEST_CASE("eval degenerate: two bones, joints scaled by nothing, below nothing, unevenly") {
  Limb limb;
  limb.goal = at({1.5, 0, 0});
  limb.start_scale = {0, 0, 0};
  Numbers got = limb.solve();
  CHECK(test::vec3_of(got, 0) == Vec3{});
  CHECK(test::vec3_of(got, 21) == Vec3{});
  // A bone turned over by its joint's scale is as long; its child still lands on it.
  limb.start_scale = {-1, 1, 1};
  got = limb.solve();
  const Affine start = test::affine_of(got), middle = test::affine_of(got, 12);
  CHECK(test::distance(start * limb.middle, middle.origin) < kTight);
  CHECK(test::distance(middle * limb.end, Vec3{1.5, 0, 0}) < kTight);
  limb.start_scale = {1, 5, 0.1};
  limb.middle_scale = {1, 0.2, 10};
  got = limb.solve();
  CHECK(test::distance(test::affine_of(got, 12) * limb.end, Vec3{1.5, 0, 0}) < kTight);
  CHECK(math::length(test::vec3_of(got, 3)) == doctest::Approx(5).epsilon(1e-14));
}

TEST_CASE("eval degenerate: two bones, a mirrored base is a mirrored limb") {
  Limb limb;
  const Numbers plain = limb.solve();
  limb.base.linear.z = {0, 0, -1};
  const Numbers got = limb.solve();
  for (const std::size_t origin : {9u, 21u})
    CHECK(test::distance(test::vec3_of(got, origin), test::vec3_of(plain, origin)) < kTight);
  CHECK(math::determinant(test::affine_of(got).linear) == doctest::Approx(-1));
}

TEST_CASE("eval degenerate: two bones, a flat base") {
  Limb limb;
  limb.base.linear = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  limb.base.origin = {1, 2, 3};
  const Numbers got = limb.solve();
  CHECK(got == Numbers{0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3});
}

TEST_CASE("eval degenerate: two bones, opposite offsets are the same rotations") {
  Limb limb;
  limb.offsets[0] = math::axis_angle({1, 0, 0}, 1);
  limb.offsets[1] = math::axis_angle({1, 0, 0}, -2);
  const Numbers one = limb.solve();
  limb.offsets[0] = -limb.offsets[0];
  limb.offsets[1] = -limb.offsets[1];
  CHECK(test::difference(limb.solve(), one) < kTight);
}

// A chain in the plane of x and y, bones along x.
struct Chain {
  Affine base, goal, pole;
  double twist = 0, iterations = 16;
  bool has_pole = false;
  std::vector<double> bones{1, 1, 1};

  Numbers solve() const {
    Arguments a{base, goal, pole, twist, Vec3{}};
    for (const double bone : bones) a.push_back(Vec3{bone, 0, 0});
    Numbers data{static_cast<double>(bones.size() + 1), has_pole ? 1.0 : 0.0, iterations, 0, 0, 0};
    for (std::size_t i = 0; i <= bones.size(); ++i) test::append(data, Quat{});
    return test::run_kernel_once(Op::ik_chain, a, data,
                                 static_cast<std::uint32_t>(4 * bones.size()));
  }
  std::vector<V> places(const Numbers& rotations) const {
    std::vector<V> result{V{}};
    A now = base;
    for (std::size_t i = 0; i < bones.size(); ++i) {
      now = now * A(exact::turn(test::quat_of(rotations, 4 * i)), {});
      now = now * A(M{}, {bones[i], 0, 0});
      result.push_back(now.origin);
    }
    return result;
  }
  double miss() const {
    return static_cast<double>(length(places(solve()).back() - V(goal.origin)));
  }
};

TEST_CASE("eval degenerate: chain, out of reach and at full reach it is straight") {
  Chain chain;
  for (const double reach : {3.0, 3.5, 1e6, 1e100}) {
    chain.goal = at({reach, 0, 0});
    CHECK(chain.solve() == Numbers{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
  }
  chain.goal = at({0, 9, 0});
  CHECK(off({turn_z(90), M{}, M{}}, chain.solve()) < kTight);
  // Straight back: half a turn, about any axis.
  chain.goal = at({-9, 0, 0});
  CHECK(length(chain.places(chain.solve())[3] - V{-3, 0, 0}) < kTight);
}

TEST_CASE("eval degenerate: chain, a straight one bends to its pole, or somewhere without") {
  Chain chain;
  for (const double reach : {2.9, 2.0, 0.5, 0.1}) {
    chain.goal = at({reach, 0, 0});
    chain.has_pole = false;
    CHECK(chain.miss() < kTight);
    chain.has_pole = true;
    chain.pole = at({0, 4, 0});
    CHECK(chain.miss() < kTight);
    const auto up = chain.places(chain.solve());
    CHECK(up[1].y > 0);
    CHECK(up[2].y > 0);
    CHECK(fabsl(up[1].z) + fabsl(up[2].z) < kTight);
  }
}

TEST_CASE("eval degenerate: chain, nearly straight") {
  Chain chain;
  chain.has_pole = true;
  chain.pole = at({0, 4, 0});
  for (int k = 4; k < 40; ++k) {
    const double left = std::ldexp(1.0, -k);
    chain.goal = at({3 - left, 0, 0});
    CHECK(chain.miss() < 1e-6);
    // A bow over 3 that is longer by `left` is about sqrt(left) high.
    const auto up = chain.places(chain.solve());
    for (const std::size_t i : {1u, 2u}) {
      // Up to the root of rounding noise.
      CHECK(up[i].y > -1e-6);
      CHECK(up[i].y < 2 * std::sqrt(left));
    }
  }
}

TEST_CASE("eval degenerate: chain, the goal at the root") {
  Chain chain;
  chain.bones = {1, 1, 1, 1};
  chain.goal = at({0, 0, 0});
  const Numbers got = chain.solve();
  CHECK(test::all_finite(got));
  for (std::size_t i = 0; i < got.size(); i += 4) {
    const Quat q = test::quat_of(got, i);
    CHECK(math::dot(q, q) == doctest::Approx(1).epsilon(1e-14));
  }
}

TEST_CASE("eval degenerate: chain, bones without length turn nothing") {
  Chain chain;
  chain.goal = at({1, 1, 0});
  chain.bones = {1, 0, 1};
  CHECK(chain.miss() < 1e-9);
  // What has no bones at all is turned as a whole.
  chain.bones = {0, 0, 0};
  CHECK(off({turn_z(45), M{}, M{}}, chain.solve()) < kTight);
  chain.bones = {2};
  chain.goal = at({0, 1, 0});
  CHECK(off({turn_z(90)}, chain.solve()) < kTight);
}

// A straight chain is bowed without regard to its lengths; iterations put them right.
TEST_CASE("eval degenerate: chain, one iteration is enough to reach, none is finite") {
  Chain chain;
  chain.goal = at({0.3, 1.2, 0.4});
  chain.iterations = 1;
  CHECK(chain.miss() < kTight);
  chain.iterations = 0;
  CHECK(chain.miss() < 0.1);
}

}  // namespace
}  // namespace rigc
