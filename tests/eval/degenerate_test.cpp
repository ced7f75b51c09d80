// SPDX-License-Identifier: MIT
// The degenerate cases of the solvers by name, each with its answer written out: straight and
// folded limbs, bones without length, mirrored and uneven scale, opposite rotations, targets at the
// root. Where several answers are as good, the one that is documented.
#include <doctest/doctest.h>

#include <limits>

#include "tests/eval/twin_formulas.h"

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
using test::Numbers;

constexpr double kTight = 1e-14;

Affine at(Vec3 p) { return {{}, p}; }
Affine turned(Vec3 axis, double degrees) {
  return math::rotation(math::axis_angle(axis, math::radians(degrees)));
}
M turn_z(double degrees) { return exact::turn_degrees(2, degrees); }

double off(const std::vector<Part>& want, const Numbers& got, double size = 1) {
  exact::Result result;
  result.parts = want;
  result.size = size;
  return static_cast<double>(exact::error_of(result, got));
}

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

// Near full extension FABRIK converges slowly and the closing step, which bends one joint, cannot
// straighten two: the chain stays bent by 3e-3 of its length, to the other side than its pole, and
// misses its goal by 3e-5, until the goal is exactly at full reach, where it snaps straight.
TEST_CASE("eval degenerate: chain, nearly straight" * doctest::should_fail()) {
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
      CHECK(up[i].y > 0);
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
