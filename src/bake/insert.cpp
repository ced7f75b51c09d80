// SPDX-License-Identifier: MIT
// Inserts frames, gap by gap, each round halving those that are too wide.
// Test: tests/bake/insert_test.cpp
#include "bake/insert.h"

#include <algorithm>
#include <utility>

#include "bake/frames.h"
#include "bake/gaps.h"
#include "base/trace.h"

namespace rigc::bake {
namespace {

std::vector<double> times_of(const std::vector<Gap>& gaps) {
  std::vector<double> times;
  for (const Gap& gap : gaps) {
    times.push_back(gap.begin);
    for (std::size_t i = 0; i < Gap::kInside; ++i) times.push_back(gap.inside(i));
    times.push_back(gap.end);
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

math::Trs between(const math::Trs& a, const math::Trs& b, double t) {
  return {a.translation + (b.translation - a.translation) * t,
          math::slerp(a.rotation, b.rotation, t), a.scale + (b.scale - a.scale) * t};
}

/// Compares one frame of a motion with what plays between two others.
class Comparison {
 public:
  Comparison(const Evaluator& evaluator, const Motion& motion)
      : bodies_(evaluator.bodies()), reaches_(evaluator.reaches()), motion_(motion) {}

  double error(std::size_t begin, std::size_t end, std::size_t frame) const {
    const auto& times = motion_.times;
    const double t = (times[frame] - times[begin]) / (times[end] - times[begin]);
    const std::vector<math::Affine> wanted = worlds_at(bodies_, motion_, frame);
    std::vector<math::Affine> played(bodies_.size());
    double error = 0;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const Moves& moves = motion_.bodies[b];
      const int base = bodies_[b].base;
      const math::Trs local =
          bodies_[b].is_output ? between(moves[begin], moves[end], t) : moves[frame];
      played[b] =
          world_of(bodies_[b], local, base < 0 ? nullptr : &played[static_cast<std::size_t>(base)]);
      error = std::max(error, distance(played[b], wanted[b], reaches_[b]));
    }
    return error;
  }

 private:
  const std::vector<Body>& bodies_;
  const std::vector<Reach>& reaches_;
  const Motion& motion_;
};

/// By gap, whether what plays in it is too far off.
std::vector<char> find_bad(const Evaluator& evaluator, const Motion& motion,
                           const std::vector<Gap>& gaps, double tolerance, Threads& threads) {
  const Comparison comparison(evaluator, motion);
  const auto index = [&](double time) {
    const auto at = std::lower_bound(motion.times.begin(), motion.times.end(), time);
    return static_cast<std::size_t>(at - motion.times.begin());
  };
  std::vector<char> bad(gaps.size(), 0);
  threads.for_each(gaps.size(), [&](std::size_t g) {
    const Gap& gap = gaps[g];
    for (std::size_t i = 0; i < Gap::kInside && !bad[g]; ++i)
      if (comparison.error(index(gap.begin), index(gap.end), index(gap.inside(i))) > tolerance)
        bad[g] = 1;
  });
  return bad;
}

}  // namespace

std::optional<std::vector<double>> insert_frames(const Evaluator& evaluator,
                                                 std::vector<double> times, double tolerance,
                                                 Threads& threads, Diagnostics& diagnostics) {
  const trace::Span span("insert frames");
  std::vector<Gap> gaps;
  const auto add = [&gaps](const Gap& gap) {
    if (gap.is_wide()) gaps.push_back(gap);
  };
  for (std::size_t i = 1; i < times.size(); ++i) add({times[i - 1], times[i]});
  while (!gaps.empty()) {
    const auto count = static_cast<double>(times.size() + gaps.size() * (Gap::kInside + 1));
    if (!check_frame_count(count, evaluator.width(), diagnostics)) return std::nullopt;
    const auto motion = evaluator.run(times_of(gaps), threads, diagnostics);
    if (!motion) return std::nullopt;
    const std::vector<char> bad = find_bad(evaluator, *motion, gaps, tolerance, threads);
    const std::vector<Gap> looked_at = std::exchange(gaps, {});
    for (std::size_t g = 0; g < looked_at.size(); ++g) {
      if (!bad[g]) continue;
      const double middle = looked_at[g].middle();
      times.push_back(middle);
      add({looked_at[g].begin, middle});
      add({middle, looked_at[g].end});
    }
  }
  std::sort(times.begin(), times.end());
  return times;
}

}  // namespace rigc::bake
