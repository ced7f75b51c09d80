// SPDX-License-Identifier: MIT
// Law 7: every kernel of the table is within its bound (bounds.h) of its twin (twin_formulas.h,
// twin_solvers.h), for characters of every size and far from the origin.
#include <doctest/doctest.h>

#include "eval/kernels/bounds.h"
#include "tests/eval/twin_formulas.h"

namespace rigc {
namespace {

using eval::Op;
using exact::Real;
using test::Arguments;
using test::Job;
using test::Random;

// Where a character is and how large: everything in rig space is scaled, then moved.
struct World {
  const char* name;
  double unit;
  math::Vec3 at;
};
constexpr World kWorlds[] = {{"metres at the origin", 1, {0, 0, 0}},
                             {"a kilometre away", 1, {600, -250, 760}},
                             {"centimetres, a kilometre away", 100, {60000, -25000, 76000}},
                             {"huge units", 1e9, {0, 0, 0}},
                             {"tiny units", 1e-9, {0, 0, 0}}};

// Characters as they come: scales that are uneven and mirrored, repeated numbers.
class Plausible : public test::Source {
 public:
  Plausible(Random& random, const World& world) : Source(random), world_(world) {}
  double number() override {
    return random().chance(20) ? static_cast<double>(random().below(5)) - 2
                               : random().between(-20, 20);
  }
  math::Quat rotation() override {
    const math::Quat q = random().rotation();
    return random().chance(50) ? -q : q;
  }
  math::Affine matrix() override {
    math::Affine a = math::compose(random().trs(random().chance(50)));
    if (random().chance(25)) a.linear.z = -a.linear.z;
    for (math::Vec3* column : {&a.linear.x, &a.linear.y, &a.linear.z, &a.origin})
      *column = *column * world_.unit;
    a.origin = a.origin + world_.at;
    return a;
  }

 private:
  const World& world_;
};

// Where answers turn steep: vectors that are nearly along the one before or against it, of lengths
// far apart, rotations nearly the same or nearly half a turn on, matrices that are nearly flat,
// parts of 1 and angles of several turns.
class Edgy : public test::Source {
 public:
  using Source::Source;
  double number() override {
    return random().chance(60) ? random().between(-0.1, 1.1) : random().between(-800, 800);
  }
  math::Vec3 vector() override {
    Random& r = random();
    const double close = std::exp2(r.between(-14, 0)), size = std::exp2(r.between(-60, 60));
    const double along = r.chance(60) ? (r.chance(50) ? 1 : -1) : 0;
    const math::Vec3 off = r.vector(close);
    return last_ = (last_ * (along / std::fmax(math::length(last_), 1e-30)) + off) * size;
  }
  math::Quat rotation() override {
    Random& r = random();
    const math::Quat half{r.chance(50) ? 1.0 : 0.0, 0, 0, 0}, turn = r.rotation();
    const double close = std::exp2(r.between(-14, 0)), size = std::exp2(r.between(-30, 30));
    const math::Quat near = math::normalised(
        math::Quat{turn.x * close, turn.y * close, turn.z * close, 1 + turn.w * close});
    const math::Quat next = half.x > 0 ? half * near : near;
    before_ = math::normalised(r.chance(70) ? before_ * next : turn);
    return {before_.x * size, before_.y * size, before_.z * size, before_.w * size};
  }
  math::Affine matrix() override {
    Random& r = random();
    math::Affine a = math::compose(r.trs(r.chance(30)));
    if (r.chance(25)) a.linear.z = -a.linear.z;
    const double close = std::exp2(r.between(-14, 0));
    if (r.chance(30)) a.linear.y = a.linear.x * 0.7 + a.linear.z * 0.2 + a.linear.y * close;
    if (r.chance(30)) a.linear.z = a.linear.z * close;
    return a;
  }

 private:
  math::Vec3 last_{1, 0, 0};
  math::Quat before_;
};

// Largest error in units of the bound, and in 2^-20, which is what a rig may be off by in all.
// `share` of the inputs must have an answer.
double worst_error(Op op, test::Source& source, double share) {
  Real worst = 0;
  int compared = 0;
  constexpr int kBlocks = 400;
  for (int i = 0; i < kBlocks; ++i) {
    const Job job = test::job_of(op, source);
    std::vector<Arguments> lanes;
    for (int lane = 0; lane < eval::kLanes; ++lane) lanes.push_back(source.arguments(job));
    const auto got = test::run_kernel(op, lanes, job.data, job.width);
    for (std::size_t lane = 0; lane < got.size(); ++lane) {
      const exact::Result want = exact::twin_of(op, lanes[lane], job.data);
      if (!want.certain) continue;
      ++compared;
      const Real error = exact::error_of(want, got[lane]);
      CHECK_MESSAGE(error < 0x1p-20L, eval::row(op).name);
      worst = fmaxl(worst, error / fmaxl(1, want.condition));
    }
  }
  CHECK_MESSAGE(compared > kBlocks * eval::kLanes * share, eval::row(op).name);
  return static_cast<double>(worst) * 0x1p52;
}

TEST_CASE("eval twins: every kernel is within its bound of its twin") {
  for (const World& world : kWorlds) {
    CAPTURE(std::string(world.name));
    test::for_every_op([&](Op op) {
      if (test::is_formula(op) && &world != kWorlds) return;
      Random random(static_cast<std::uint64_t>(op) + 1);
      Plausible source(random, world);
      const double worst = worst_error(op, source, 2.0 / 3);
      CHECK_MESSAGE(worst <= eval::bound(op).error, eval::row(op).name, ": ", worst);
    });
  }
}

TEST_CASE("eval twins: formulas over vectors and rotations near where their answers turn steep") {
  test::for_every_op([&](Op op) {
    if (!test::is_vector_formula(op)) return;
    Random random(static_cast<std::uint64_t>(op) + 100);
    Edgy source(random);
    const double worst = worst_error(op, source, 0.9);
    CHECK_MESSAGE(worst <= eval::bound(op).error, eval::row(op).name, ": ", worst);
  });
}

// Numbers of every size, and the corners of each formula.
TEST_CASE("eval twins: formulas on numbers of every size") {
  Random random(77);
  const double corners[] = {0, 1, -1, 0.5, 2, 3, -2, 90, 180, -270, 45, 1e-200, 1e9, -1e9};
  const auto draw = [&] {
    if (random.chance(30)) return corners[random.below(std::size(corners))];
    return random.chance(50) ? random.between(-1000, 1000) : random.any_size(60, 0);
  };
  test::for_every_op([&](Op op) {
    if (!test::is_formula(op)) return;
    CAPTURE(eval::row(op).name);
    Real worst = 0;
    for (int i = 0; i < 5000; ++i) {
      Arguments a;
      for (int k = 0; k < eval::row(op).arguments; ++k) a.push_back(draw());
      const exact::Result want = exact::twin_of(op, a, {});
      if (fabsl(std::get<Real>(want.parts[0])) > 1e307L) continue;
      worst = fmaxl(worst, exact::error_of(want, test::run_kernel_once(op, a, {}, 1)));
    }
    CHECK_MESSAGE(static_cast<double>(worst) * 0x1p52 <= eval::bound(op).error, eval::row(op).name,
                  ": ", static_cast<double>(worst) * 0x1p52);
  });
}

}  // namespace
}  // namespace rigc
