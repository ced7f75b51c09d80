// SPDX-License-Identifier: MIT
// Chain IK: lengths never change, goals in reach are reached, the rest pose comes back.
#include <doctest/doctest.h>

#define RIGC_ONE_LANE  // its geometry alone, in plain doubles
#include "eval/kernels/chain_steps.h"
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

struct Chain {
  Affine base, goal, pole;
  double twist = 0;
  bool has_pole = false;
  double iterations = 32;
  Vec3 goal_offset;
  std::vector<Vec3> translates;
  std::vector<Quat> rests;

  std::vector<Quat> solve() const {
    Arguments a{base, goal, pole, twist};
    for (const Vec3& t : translates) a.push_back(t);
    Numbers data{static_cast<double>(translates.size()),
                 has_pole ? 1.0 : 0.0,
                 iterations,
                 goal_offset.x,
                 goal_offset.y,
                 goal_offset.z};
    for (const Quat& q : rests) data.insert(data.end(), {q.x, q.y, q.z, q.w});
    const auto width = static_cast<std::uint32_t>(4 * (translates.size() - 1));
    const Numbers got = test::run_kernel_once(Op::ik_chain, a, data, width);
    CHECK(test::all_finite(got));
    std::vector<Quat> rotations;
    for (std::size_t i = 0; i < got.size(); i += 4) rotations.push_back(test::quat_of(got, i));
    return rotations;
  }

  /// World positions of the joints under these rotations.
  std::vector<Vec3> positions(std::vector<Quat> rotations) const {
    rotations.push_back(rests.back());
    std::vector<Vec3> at;
    twin::M world = twin::from(base);
    for (std::size_t i = 0; i < translates.size(); ++i) {
      world = twin::times(world, twin::place(translates[i], twin::turn(rotations[i]), {1, 1, 1}));
      at.push_back(twin::column(world, 3));
    }
    return at;
  }
  std::vector<Vec3> rest_positions() const { return positions({rests.begin(), rests.end() - 1}); }
  double length() const {
    double sum = 0;
    for (std::size_t i = 1; i < translates.size(); ++i) sum += math::length(translates[i]);
    return sum * math::length(base.linear.x);
  }
  Vec3 root() const { return base * translates[0]; }
  void aim_at(Vec3 world) { goal = {goal.linear, world - goal.linear * goal_offset}; }
};

Chain random_chain(Random& random, std::size_t joints) {
  Chain chain;
  chain.base = math::compose(random.trs());
  for (std::size_t i = 0; i < joints; ++i) {
    chain.translates.push_back(random.arrow(0.3, 1));
    chain.rests.push_back(random.rotation());
  }
  chain.goal = math::compose(random.trs());
  chain.goal_offset = math::inverse(chain.goal) * chain.rest_positions().back();
  return chain;
}

// Bones along Y with a slight bend, like a tail or a spine.
Chain gentle_chain(Random& random, std::size_t joints) {
  Chain chain = random_chain(random, joints);
  for (std::size_t i = 0; i < joints; ++i) {
    chain.translates[i] = {0, random.between(0.3, 1), 0};
    const Vec3 axis = random.direction();
    chain.rests[i] = math::axis_angle(axis, random.between(-0.4, 0.4));
  }
  chain.goal_offset = math::inverse(chain.goal) * chain.rest_positions().back();
  return chain;
}

TEST_CASE("eval chain: at rest the chain stays at rest") {
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    const Chain chain = random_chain(random, 2 + random.below(9));
    const auto got = chain.solve();
    for (std::size_t k = 0; k < got.size(); ++k)
      CHECK(test::distance(got[k], chain.rests[k]) < 1e-11);
  }
}

TEST_CASE("eval chain: a straight chain at rest stays at rest") {
  Random random(2);
  for (int i = 0; i < 300; ++i) {
    Chain chain = random_chain(random, 2 + random.below(9));
    for (std::size_t k = 0; k < chain.rests.size(); ++k) {
      chain.translates[k] = {0, random.between(0.3, 1), 0};
      chain.rests[k] = math::axis_angle({0, 1, 0}, random.between(-3, 3));
    }
    chain.goal_offset = math::inverse(chain.goal) * chain.rest_positions().back();
    const auto got = chain.solve();
    for (std::size_t k = 0; k < got.size(); ++k)
      CHECK(test::distance(got[k], chain.rests[k]) < 1e-12);
  }
}

TEST_CASE("eval chain: a goal in reach is reached") {
  Random random(3);
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    Chain chain = random.chance(50) ? random_chain(random, 3 + random.below(8))
                                    : gentle_chain(random, 3 + random.below(8));
    const Vec3 target = chain.root() + random.arrow(0.5, 0.98) * chain.length();
    chain.aim_at(target);
    chain.has_pole = random.chance(50);
    chain.pole.origin = chain.root() + random.vector(3);
    chain.twist = random.between(-90, 90);
    double longest = 0, rest = 0;
    for (std::size_t k = 1; k < chain.translates.size(); ++k)
      longest = std::fmax(longest, math::length(chain.translates[k]));
    for (std::size_t k = 1; k < chain.translates.size(); ++k)
      rest += math::length(chain.translates[k]);
    if (2 * longest > rest * 1.4) continue;
    const double off =
        test::distance(chain.positions(chain.solve()).back(), target) / chain.length();
    worst = std::fmax(worst, off);
    CHECK(off < 1e-5);
  }
  MESSAGE("largest distance from the goal, in lengths of the chain: ", worst);
}

TEST_CASE("eval chain: out of reach it is exactly straight") {
  Random random(4);
  for (int i = 0; i < 500; ++i) {
    Chain chain = random_chain(random, 2 + random.below(8));
    const Vec3 along = random.direction();
    chain.aim_at(chain.root() + along * (chain.length() * random.between(1, 4)));
    const auto at = chain.positions(chain.solve());
    const double size = chain.length() + math::length(chain.root());
    CHECK(test::distance(at.back(), chain.root() + along * chain.length()) < 1e-12 * size);
    for (const Vec3& p : at) {
      const Vec3 v = p - chain.root();
      CHECK(math::length(v - along * math::dot(v, along)) < 1e-12 * size);
    }
  }
}

TEST_CASE("eval chain: a straight chain bends toward its pole") {
  for (const Vec3 side : {Vec3{1, 0, 0}, Vec3{0, 0, 1}, Vec3{-1, 0, 1}}) {
    Chain chain;
    for (int i = 0; i < 5; ++i) {
      chain.translates.push_back({0, i == 0 ? 0.0 : 1.0, 0});
      chain.rests.push_back({});
    }
    chain.has_pole = true;
    chain.pole.origin = Vec3{0, 2, 0} + side * 3.0;
    chain.aim_at({0, 3, 0});
    const auto at = chain.positions(chain.solve());
    CHECK(test::distance(at.back(), Vec3{0, 3, 0}) < 1e-6);
    const Vec3 flat{at[2].x, 0, at[2].z};
    CHECK(math::dot(math::normalised(flat), math::normalised(side)) == doctest::Approx(1));
    CHECK(math::length(flat) > 0.3);
  }
}

TEST_CASE("eval chain: a bent planar chain turns its bend to the pole") {
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    Chain chain;
    for (int k = 0; k < 5; ++k) {
      chain.translates.push_back({0, k == 0 ? 0.0 : 1.0, 0});
      chain.rests.push_back(math::axis_angle({1, 0, 0}, k == 0 ? -0.5 : 0.3));
    }
    chain.has_pole = true;
    const Vec3 along = random.direction();
    chain.aim_at(along * 3.0);
    chain.pole.origin = random.vector(4);
    const auto at = chain.positions(chain.solve());
    const Vec3 pole = chain.pole.origin - along * math::dot(chain.pole.origin, along);
    const Vec3 middle = at[2] - along * math::dot(at[2], along);
    CHECK(math::dot(math::normalised(pole), math::normalised(middle)) ==
          doctest::Approx(1).epsilon(1e-6));
  }
}

TEST_CASE("eval chain: twist turns about the line to the goal") {
  Random random(6);
  for (int i = 0; i < 200; ++i) {
    Chain chain = gentle_chain(random, 5);
    const Vec3 along = random.direction();
    chain.aim_at(chain.root() + along * (chain.length() * 0.8));
    const auto plain = chain.positions(chain.solve());
    chain.twist = random.between(-180, 180);
    const auto twisted = chain.positions(chain.solve());
    const twin::M turn = twin::turn(along, chain.twist * 3.14159265358979323846 / 180);
    for (std::size_t k = 0; k < plain.size(); ++k) {
      const Vec3 want = twin::column(
          twin::times(turn, twin::place(plain[k] - chain.root(), twin::identity(), {1, 1, 1})), 3);
      CHECK(test::distance(twisted[k] - chain.root(), want) < 1e-6 * chain.length());
    }
  }
}

TEST_CASE("eval chain: degenerate input leaves finite numbers") {
  Random random(7);
  for (int i = 0; i < 1500; ++i) {
    Chain chain = random_chain(random, 2 + random.below(5));
    if (random.chance(30)) chain.aim_at(chain.root());
    if (random.chance(30)) chain.translates[random.below(chain.translates.size())] = {};
    if (random.chance(10)) chain.translates.assign(chain.translates.size(), {});
    if (random.chance(20)) chain.base.linear = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    if (random.chance(30)) chain.has_pole = true;
    if (random.chance(30)) chain.pole.origin = chain.root();
    if (random.chance(10)) chain.iterations = 0;
    chain.solve();
  }
}

// FABRIK as the paper has it, on points alone.
std::vector<Vec3> fabrik(std::vector<Vec3> p, Vec3 goal, int iterations) {
  const Vec3 root = p[0];
  std::vector<double> d;
  for (std::size_t i = 0; i + 1 < p.size(); ++i) d.push_back(test::distance(p[i], p[i + 1]));
  for (int k = 0; k < iterations; ++k) {
    p.back() = goal;
    for (std::size_t i = p.size() - 1; i-- > 0;) {
      const double r = d[i] / test::distance(p[i + 1], p[i]);
      p[i] = p[i + 1] * (1 - r) + p[i] * r;
    }
    p[0] = root;
    for (std::size_t i = 0; i + 1 < p.size(); ++i) {
      const double r = d[i] / test::distance(p[i + 1], p[i]);
      p[i + 1] = p[i] * (1 - r) + p[i + 1] * r;
    }
  }
  return p;
}

TEST_CASE("eval chain: the iterations are those of the paper") {
  Random random(8);
  for (int i = 0; i < 300; ++i) {
    eval::chain::Points points;
    points.count = 6;
    std::vector<Vec3> p(6);
    for (std::size_t k = 1; k < 6; ++k) p[k] = p[k - 1] + random.arrow(0.4, 1);
    for (int k = 0; k < 6; ++k) points.at[k] = p[static_cast<std::size_t>(k)];
    double total = 0;
    for (int k = 0; k < 5; ++k)
      total += points.lengths[k] = test::distance(points.at[k], points.at[k + 1]);
    const Vec3 goal = random.direction() * (total * 0.7);
    // Enough iterations that the closing step has nothing left to do.
    eval::chain::reach(points, goal, {}, 200);
    const std::vector<Vec3> want = fabrik(p, goal, 200);
    if (test::distance(want.back(), goal) > 1e-12) continue;
    for (int k = 0; k < 6; ++k)
      CHECK(test::distance(points.at[k], want[static_cast<std::size_t>(k)]) < 1e-9);
  }
}

}  // namespace
}  // namespace rigc
