// SPDX-License-Identifier: MIT
// How far a transferred clip is from what the joints played. Test: tests/bake/transfer_test.cpp
#include "bake/transfer_measure.h"

#include <algorithm>

#include "bake/motion.h"

namespace rigc::bake {
namespace {

constexpr std::size_t kInside = 3;   // times in a gap at which it is looked at
constexpr std::size_t kBlock = 256;  // gaps that a thread measures in a row
constexpr double kShortest = 1e-3;   // seconds

double angle_between(const math::Affine& a, const math::Affine& b) {
  const math::Quat turn = math::conjugate(math::quaternion(math::orthonormal(a.linear))) *
                          math::quaternion(math::orthonormal(b.linear));
  const double sine = math::length({turn.x, turn.y, turn.z});
  return 2 * math::atan2(sine, turn.w < 0 ? -turn.w : turn.w);
}

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

std::vector<bool> animated_nodes(const scene::Scene& scene,
                                 const std::vector<eval::ClipInput>& inputs) {
  std::vector<bool> animated(scene.size(), false);
  for (const eval::ClipInput& input : inputs)
    if (input.plug.attribute < scene::transform::kCount) animated[input.plug.node.index] = true;
  return animated;
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

double inside(double begin, double end, std::size_t i) {
  const double share = static_cast<double>(i + 1) / (kInside + 1);
  return static_cast<double>(static_cast<float>(begin + (end - begin) * share));
}

/// What a thread finds.
struct Block {
  Deviation at_keys, between;
  Diagnostics diagnostics;
};

class Measurement {
 public:
  Measurement(const MeasureInput& input, const Rig& rig, const std::vector<double>& times,
              std::vector<double>& gaps)
      : aims_(input.aims), rig_(rig), times_(times), gaps_(gaps) {}

  /// Gaps from `first` on.
  void run(std::size_t first, Threads& threads, Block& block) {
    const std::size_t last = std::min(first + kBlock, times_.size() - 1);
    std::vector<double> times{times_[first]};
    for (std::size_t gap = first; gap < last; ++gap) {
      for (std::size_t i = 0; i < kInside; ++i)
        times.push_back(inside(times_[gap], times_[gap + 1], i));
      times.push_back(times_[gap + 1]);
    }
    const auto motion = rig_.run(std::move(times), threads, block.diagnostics);
    if (!motion) return;
    const auto wanted = play(aims_, motion->times);
    std::vector<double> off;
    for (std::size_t f = 0; f < motion->times.size(); ++f) {
      const bool is_key = f % (kInside + 1) == 0;
      off.push_back(compare(wanted, *motion, f, is_key ? block.at_keys : block.between));
    }
    for (std::size_t gap = first; gap < last; ++gap) {
      const auto begin = off.begin() + static_cast<std::ptrdiff_t>((gap - first) * (kInside + 1));
      const double at_ends = std::max(*begin, *(begin + kInside + 1));
      gaps_[gap] = *std::max_element(begin + 1, begin + kInside + 1) - at_ends;
    }
  }

 private:
  double compare(const std::vector<std::vector<math::Affine>>& wanted, const Motion& motion,
                 std::size_t frame, Deviation& deviation) const {
    const std::vector<math::Affine> got = rig_.worlds(motion, frame);
    const double seconds = motion.times[frame];
    double off = 0;
    for (std::size_t i = 0; i < aims_.size(); ++i) {
      const math::Affine& aim = wanted[i][frame];
      const NodeId id = aims_[i].id;
      const double distance = math::length(aim.origin - got[i].origin);
      keep_larger({distance, angle_between(aim, got[i]), id, id, seconds, seconds}, deviation);
      off = std::max(off, rig_.off(i, aim, got[i]));
    }
    return off;
  }

  using NodeId = scene::NodeId;
  const std::vector<Aim>& aims_;
  const Rig& rig_;
  const std::vector<double>& times_;
  std::vector<double>& gaps_;
};

}  // namespace

std::optional<std::vector<double>> measure(const MeasureInput& input,
                                           const std::vector<double>& times, Threads& threads,
                                           TransferReport& report, Diagnostics& diagnostics) {
  Rig rig(input);
  if (!rig.compile(diagnostics)) return std::nullopt;
  std::vector<double> gaps(times.size() - 1, 0);
  std::vector<Block> blocks(std::max<std::size_t>((gaps.size() + kBlock - 1) / kBlock, 1),
                            Block{{}, {}, Diagnostics(diagnostics.sources())});
  Measurement measurement(input, rig, times, gaps);
  threads.for_each(blocks.size(),
                   [&](std::size_t i) { measurement.run(i * kBlock, threads, blocks[i]); });
  for (const Block& block : blocks) {
    diagnostics.append(block.diagnostics);
    if (!block.diagnostics.ok()) return std::nullopt;
    keep_larger(block.at_keys, report.at_keys);
    keep_larger(block.between, report.between);
  }
  return gaps;
}

bool split(const std::vector<double>& gaps, double tolerance, std::vector<double>& times) {
  std::vector<double> more;
  for (std::size_t gap = 0; gap < gaps.size(); ++gap) {
    const double begin = times[gap], end = times[gap + 1];
    const double middle = inside(begin, end, kInside / 2);
    const bool is_wide = end - begin > kShortest && middle > begin && middle < end;
    if (is_wide && gaps[gap] > tolerance) more.push_back(middle);
  }
  times.insert(times.end(), more.begin(), more.end());
  std::sort(times.begin(), times.end());
  return !more.empty();
}

}  // namespace rigc::bake
