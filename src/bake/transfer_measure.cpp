// SPDX-License-Identifier: MIT
// How far a transferred clip is from what the joints played. Test: tests/bake/transfer_test.cpp
#include "bake/transfer_measure.h"

#include <algorithm>
#include <numeric>

#include "bake/gaps.h"
#include "bake/joints.h"
#include "bake/motion.h"
#include "base/trace.h"

namespace rigc::bake {
namespace {

constexpr std::size_t kBlock = 256;  // gaps that a thread measures in a row

/// Between two frames of unit axes, radians.
double angle_between(const math::Mat3& a, const math::Mat3& b) {
  double sum = 0;  // 8 sin^2 of half the angle
  for (const math::Vec3& apart : {a.x - b.x, a.y - b.y, a.z - b.z}) sum += math::dot(apart, apart);
  return 2 * math::asin(math::sqrt(sum / 8));
}

/// The rig under its clip, ready to be evaluated as a bake would.
class Rig {
 public:
  explicit Rig(const MeasureInput& input)
      : input_(input), aims_(find_aims(input.scene, input.nodes, input.clip, input.standings)) {
    Options options;
    options.standings = input.standings;
    inputs_ = eval::clip_inputs(input.scene, input.nodes, input.clip);
    bodies_ = find_bodies(input.scene, input.nodes, animated_nodes(input.scene, inputs_), options);
    reaches_ = bake::reaches(input.scene, input.nodes, bodies_, options);
    std::vector<int> by_node(input.scene.size(), -1);
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      by_node[bodies_[b].id.index] = static_cast<int>(b);
    for (const Aim& aim : aims_) places_.push_back(by_node[aim.id.index]);
  }

  bool compile(Diagnostics& diagnostics) {
    evaluator_ = Evaluator::make(input_.scene, bodies_, inputs_, reaches_, diagnostics);
    return evaluator_.has_value();
  }

  std::optional<Motion> run(std::vector<double> times, Threads& threads,
                            Diagnostics& diagnostics) const {
    return evaluator_->run(std::move(times), threads, diagnostics);
  }

  /// Of all aims, in the file after a bake. What no bake touches keeps its own channels.
  std::vector<math::Affine> worlds(const Motion& motion, std::size_t frame) const {
    const std::vector<math::Affine> of_bodies = worlds_at(bodies_, motion, frame);
    std::vector<math::Affine> worlds;
    for (std::size_t i = 0; i < aims_.size(); ++i) {
      const Aim& aim = aims_[i];
      if (places_[i] >= 0) {
        worlds.push_back(of_bodies[static_cast<std::size_t>(places_[i])]);
        continue;
      }
      const math::Affine local =
          aim.standing.between * math::compose(local_at(aim, motion.times[frame]));
      worlds.push_back(aim.base < 0 ? local : worlds[static_cast<std::size_t>(aim.base)] * local);
    }
    return worlds;
  }

  /// How far a joint or what hangs on it is off.
  double off(std::size_t aim, const math::Affine& wanted, const math::Affine& got) const {
    if (places_[aim] < 0) return math::length(wanted.origin - got.origin);
    return distance(got, wanted, reaches_[static_cast<std::size_t>(places_[aim])]);
  }

 private:
  const MeasureInput& input_;
  std::vector<Aim> aims_;
  std::vector<eval::ClipInput> inputs_;
  std::vector<Body> bodies_;
  std::vector<Reach> reaches_;
  std::optional<Evaluator> evaluator_;
  std::vector<int> places_;  // in bodies_, by aim; -1: a bake does not touch it
};

Gap gap_at(const std::vector<double>& times, std::size_t i) {
  return {times[i], times[std::min(i + 1, times.size() - 1)]};
}

class Measurement {
 public:
  Measurement(const MeasureInput& input, const Rig& rig, const std::vector<double>& times,
              const std::vector<std::size_t>& gaps, std::vector<GapOff>& off)
      : aims_(input.aims), rig_(rig), times_(times), gaps_(gaps), off_(off) {}

  /// Gaps number `first` to `last` of the list.
  void run(std::size_t first, std::size_t last, Threads& threads, Diagnostics& diagnostics) {
    std::vector<double> times;
    for (std::size_t i = first; i < last; ++i) {
      const Gap gap = gap_at(times_, gaps_[i]);
      times.push_back(gap.begin);
      for (std::size_t k = 0; k < Gap::kInside; ++k) times.push_back(gap.inside(k));
      times.push_back(gap.end);
    }
    const auto motion = rig_.run(std::move(times), threads, diagnostics);
    if (!motion) return;
    const auto wanted = play(aims_, motion->times);
    for (std::size_t i = first; i < last; ++i)
      off_[gaps_[i]] = measure_gap(wanted, *motion, (i - first) * (Gap::kInside + 2));
  }

 private:
  using Worlds = std::vector<std::vector<math::Affine>>;

  /// `frame`: of the gap's begin.
  GapOff measure_gap(const Worlds& wanted, const Motion& motion, std::size_t frame) const {
    GapOff off;
    const double at_begin = compare(wanted, motion, frame, off.at_ends);
    const double at_end = compare(wanted, motion, frame + Gap::kInside + 1, off.at_ends);
    double inside = 0;
    for (std::size_t k = 1; k <= Gap::kInside; ++k)
      inside = std::max(inside, compare(wanted, motion, frame + k, off.inside));
    off.excess = inside - std::max(at_begin, at_end);
    return off;
  }

  double compare(const Worlds& wanted, const Motion& motion, std::size_t frame,
                 Deviation& deviation) const {
    const std::vector<math::Affine> got = rig_.worlds(motion, frame);
    const double seconds = motion.times[frame];
    double off = 0;
    for (std::size_t i = 0; i < aims_.size(); ++i) {
      const math::Affine& aim = wanted[i][frame];
      const scene::NodeId id = aims_[i].id;
      const double distance = math::length(aim.origin - got[i].origin);
      const double angle =
          angle_between(math::orthonormal(aim.linear), math::orthonormal(got[i].linear));
      keep_larger({distance, angle, id, id, seconds, seconds}, deviation);
      off = std::max(off, rig_.off(i, aim, got[i]));
    }
    return off;
  }

  const std::vector<Aim>& aims_;
  const Rig& rig_;
  const std::vector<double>& times_;
  const std::vector<std::size_t>& gaps_;
  std::vector<GapOff>& off_;
};

}  // namespace

void keep_larger(const Deviation& one, Deviation& largest) {
  if (one.farthest.valid() && (one.distance > largest.distance || !largest.farthest.valid())) {
    largest.distance = one.distance;
    largest.farthest = one.farthest;
    largest.farthest_at = one.farthest_at;
  }
  if (one.most_turned.valid() && (one.angle > largest.angle || !largest.most_turned.valid())) {
    largest.angle = one.angle;
    largest.most_turned = one.most_turned;
    largest.most_turned_at = one.most_turned_at;
  }
}

std::vector<std::size_t> all_gaps(const std::vector<double>& times) {
  std::vector<std::size_t> gaps(std::max<std::size_t>(times.size() - 1, 1));
  std::iota(gaps.begin(), gaps.end(), std::size_t{0});
  return gaps;
}

bool measure(const MeasureInput& input, const std::vector<double>& times,
             const std::vector<std::size_t>& gaps, Threads& threads, std::vector<GapOff>& off,
             Diagnostics& diagnostics) {
  const trace::Span span("measure");
  Rig rig(input);
  if (!rig.compile(diagnostics)) return false;
  std::vector<Diagnostics> reported((gaps.size() + kBlock - 1) / kBlock,
                                    Diagnostics(diagnostics.sources()));
  Measurement measurement(input, rig, times, gaps, off);
  threads.for_each(reported.size(), [&](std::size_t i) {
    measurement.run(i * kBlock, std::min((i + 1) * kBlock, gaps.size()), threads, reported[i]);
  });
  for (const Diagnostics& one : reported) {
    diagnostics.append(one);
    if (!one.ok()) return false;
  }
  return true;
}

std::vector<std::size_t> split(const std::vector<std::size_t>& gaps, double tolerance,
                               const std::vector<double>& times, std::vector<GapOff>& off,
                               std::vector<double>& more) {
  std::vector<std::size_t> halves;
  std::vector<GapOff> after;
  std::size_t copied = 0;
  for (const std::size_t i : gaps) {
    const Gap gap = gap_at(times, i);
    if (!gap.is_wide() || !(off[i].excess > tolerance)) continue;
    const auto at = [&](std::size_t index) {
      return off.begin() + static_cast<std::ptrdiff_t>(index);
    };
    after.insert(after.end(), at(copied), at(i));
    copied = i + 1;
    more.push_back(gap.middle());
    halves.push_back(after.size());
    halves.push_back(after.size() + 1);
    after.resize(after.size() + 2);
  }
  after.insert(after.end(), off.begin() + static_cast<std::ptrdiff_t>(copied), off.end());
  off = std::move(after);
  return halves;
}

}  // namespace rigc::bake
