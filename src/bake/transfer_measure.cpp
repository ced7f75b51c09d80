// SPDX-License-Identifier: MIT
// How far a transferred clip is from what the joints played. Test: tests/bake/transfer_test.cpp
#include "bake/transfer_measure.h"

#include <algorithm>

#include "bake/joints.h"
#include "bake/motion.h"
#include "base/trace.h"

namespace rigc::bake {
namespace {

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

class Measurement {
 public:
  Measurement(const MeasureInput& input, const Rig& rig, const std::vector<double>& times,
              const std::vector<std::size_t>& gaps, std::vector<GapOff>& off)
      : aims_(input.aims), rig_(rig), times_(times), gaps_(gaps), off_(off) {}

  /// Gaps number `first` to `last` of the list.
  void run(std::size_t first, std::size_t last, Threads& threads, Diagnostics& diagnostics) {
    const auto motion = rig_.run(times_in(gaps_, first, last, times_), threads, diagnostics);
    if (!motion) return;
    const auto wanted = play(aims_, motion->times);
    const auto compare_at = [&](std::size_t frame, Deviation& deviation) {
      return compare(wanted, *motion, frame, deviation);
    };
    for (std::size_t i = first; i < last; ++i)
      off_[gaps_[i]] = measure_gap(compare_at, (i - first) * kGapTimes);
  }

 private:
  using Worlds = std::vector<std::vector<math::Affine>>;

  double compare(const Worlds& wanted, const Motion& motion, std::size_t frame,
                 Deviation& largest) const {
    const std::vector<math::Affine> got = rig_.worlds(motion, frame);
    const double seconds = motion.times[frame];
    double off = 0;
    for (std::size_t i = 0; i < aims_.size(); ++i) {
      const math::Affine& aim = wanted[i][frame];
      keep_larger(deviation(aims_[i].id, aim, got[i], seconds), largest);
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

bool measure(const MeasureInput& input, const std::vector<double>& times,
             const std::vector<std::size_t>& gaps, Threads& threads, std::vector<GapOff>& off,
             Diagnostics& diagnostics) {
  const trace::Span span("measure");
  Rig rig(input);
  if (!rig.compile(diagnostics)) return false;
  Measurement measurement(input, rig, times, gaps, off);
  return for_gaps(gaps.size(), threads, diagnostics,
                  [&](std::size_t first, std::size_t last, Diagnostics& own) {
                    measurement.run(first, last, threads, own);
                  });
}

}  // namespace rigc::bake
