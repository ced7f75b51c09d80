// SPDX-License-Identifier: MIT
// Plays two rigs side by side. Test: tests/update/verify_test.cpp
#include "update/verify.h"

#include <algorithm>
#include <cmath>

#include "eval/clip_inputs.h"
#include "eval/evaluate.h"

namespace rigc::update {
namespace {

using eval::ClipInput;
namespace transform = scene::transform;

/// Times of the keys of all inputs and midway between them, and how many they were before thinning.
std::vector<double> times_of(const std::vector<const std::vector<ClipInput>*>& sides,
                             std::size_t& all) {
  std::vector<const std::vector<float>*> seen;
  std::vector<double> keys;
  for (const auto* inputs : sides) {
    for (const ClipInput& input : *inputs) {
      const std::vector<float>* times = input.curve->times.get();
      if (std::find(seen.begin(), seen.end(), times) != seen.end()) continue;
      seen.push_back(times);
      keys.insert(keys.end(), times->begin(), times->end());
    }
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  if (keys.empty()) keys.push_back(0);
  std::vector<double> times;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (i > 0) times.push_back((keys[i - 1] + keys[i]) / 2);
    times.push_back(keys[i]);
  }
  all = times.size();
  if (all <= kMostTimes) return times;
  std::vector<double> thinned;
  for (std::size_t i = 0; i < kMostTimes; ++i)
    thinned.push_back(times[i * (all - 1) / (kMostTimes - 1)]);
  return thinned;
}

/// One side: its program, and what each clip animates of it.
struct Side {
  std::optional<eval::Program> program;
  std::vector<scene::Plug> plugs;             ///< inputs of the program, sorted
  std::vector<std::vector<ClipInput>> clips;  ///< inputs by clip
};

bool prepare(const Player& player, const std::vector<const anim::Clip*>& clips,
             const std::vector<scene::NodeId>& joints, Side& side, Diagnostics& diagnostics) {
  for (const anim::Clip* clip : clips) {
    side.clips.push_back(eval::clip_inputs(*player.scene, *player.nodes, *clip));
    for (const ClipInput& input : side.clips.back()) side.plugs.push_back(input.plug);
  }
  std::sort(side.plugs.begin(), side.plugs.end());
  side.plugs.erase(std::unique(side.plugs.begin(), side.plugs.end()), side.plugs.end());
  eval::Request request;
  request.inputs = side.plugs;
  for (const scene::NodeId joint : joints) request.outputs.push_back({joint, transform::kWorld});
  side.program = eval::compile(*player.scene, request, diagnostics);
  return side.program.has_value();
}

bool same(const eval::Register& a, const eval::Register& b) {
  return a.row == b.row && a.width == b.width;
}

bool same(const std::vector<eval::Register>& a, const std::vector<eval::Register>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& x, const auto& y) { return same(x, y); });
}

/// Whether two programs do the same, number for number.
bool same(const eval::Program& a, const eval::Program& b) {
  const auto steps = [](const eval::Instruction& x, const eval::Instruction& y) {
    return x.op == y.op && same(x.out, y.out) && x.first_argument == y.first_argument &&
           x.argument_count == y.argument_count && x.data == y.data;
  };
  const auto constants = [](const eval::Program::Constant& x, const eval::Program::Constant& y) {
    return x.row == y.row && x.value == y.value;
  };
  return a.rows == b.rows && a.data == b.data && same(a.arguments, b.arguments) &&
         same(a.inputs, b.inputs) && same(a.outputs, b.outputs) &&
         std::equal(a.instructions.begin(), a.instructions.end(), b.instructions.begin(),
                    b.instructions.end(), steps) &&
         std::equal(a.constants.begin(), a.constants.end(), b.constants.begin(), b.constants.end(),
                    constants);
}

/// Angle of the rotation that leads from one frame to another, degrees.
double angle(const math::Mat3& a, const math::Mat3& b) {
  if (a == b) return 0;
  const math::Quat p = math::quaternion(math::orthonormal(a));
  const math::Quat q = math::quaternion(math::orthonormal(b));
  const math::Quat d = conjugate(p) * q;
  const double sine = math::length({d.x, d.y, d.z});
  return math::degrees(2 * math::atan2(sine, std::abs(d.w)));
}

math::Affine matrix_at(const double* n) {
  return {{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}}, {n[9], n[10], n[11]}};
}

/// Runs both programs over blocks of times of one clip and adds up what differs.
class Comparer {
 public:
  Comparer(const Side& old, const Side& fresh, std::size_t clip, bool same_programs,
           const std::vector<JointPair>& joints, double unit)
      : old_(old),
        fresh_(fresh),
        old_inputs_(old.clips[clip]),
        fresh_inputs_(fresh.clips[clip]),
        same_programs_(same_programs),
        to_mm_(1000 / unit) {
    for (const JointPair& joint : joints) out_.joints.push_back({joint.name, 0, 0, 0, 0});
    for (std::size_t i = 0; i < fresh_inputs_.size(); ++i) same_.push_back(same_as(i));
    old_places_ = places(old_, old_inputs_);
    fresh_places_ = places(fresh_, fresh_inputs_);
  }

  Comparison run(const std::vector<double>& times) {
    out_.times = times.size();
    // The same program on the same keys gives the same numbers at every time.
    if (is_same()) return std::move(out_);
    eval::Instance old(*old_.program), fresh(*fresh_.program);
    for (std::size_t first = 0; first < times.size(); first += eval::kLanes) {
      const std::size_t lanes = std::min<std::size_t>(eval::kLanes, times.size() - first);
      for (std::size_t lane = 0; lane < lanes; ++lane)
        set(old, fresh, static_cast<int>(lane), times[first + lane]);
      old.run();
      fresh.run();
      for (std::size_t lane = 0; lane < lanes; ++lane) add(old, fresh, static_cast<int>(lane));
    }
    for (Difference& joint : out_.joints) {
      joint.mean_mm /= static_cast<double>(times.size());
      joint.mean_degrees /= static_cast<double>(times.size());
    }
    return std::move(out_);
  }

 private:
  bool is_same() const {
    if (!same_programs_ || old_places_ != fresh_places_) return false;
    for (std::size_t i = 0; i < fresh_inputs_.size(); ++i)
      if (!same_keys(old_inputs_[i], fresh_inputs_[i])) return false;
    return true;
  }

  /// Which inputs of the program a clip's inputs are.
  static std::vector<std::size_t> places(const Side& side, const std::vector<ClipInput>& inputs) {
    std::vector<std::size_t> out;
    for (const ClipInput& input : inputs) {
      const auto at = std::lower_bound(side.plugs.begin(), side.plugs.end(), input.plug);
      out.push_back(static_cast<std::size_t>(at - side.plugs.begin()));
    }
    return out;
  }

  /// The input of the old rig with the same keys, -1: none.
  int same_as(std::size_t index) const {
    for (std::size_t i = 0; i < old_inputs_.size(); ++i)
      if (same_keys(old_inputs_[i], fresh_inputs_[index])) return static_cast<int>(i);
    return -1;
  }

  static bool same_keys(const ClipInput& a, const ClipInput& b) {
    return is_rotation(a) == is_rotation(b) && a.curve->times == b.curve->times &&
           a.curve->interpolation == b.curve->interpolation && a.curve->values == b.curve->values;
  }

  static bool is_rotation(const ClipInput& input) {
    return input.plug.attribute == transform::kRotation;
  }

  void set(eval::Instance& old, eval::Instance& fresh, int lane, double time) {
    sampled_.resize(old_inputs_.size() * 4);
    for (std::size_t i = 0; i < old_inputs_.size(); ++i) {
      double* const numbers = sampled_.data() + 4 * i;
      const anim::Curve& curve = *old_inputs_[i].curve;
      anim::sample(curve, is_rotation(old_inputs_[i]), time, numbers);
      eval::set_lane(old.input(old_places_[i]), lane, numbers, curve.width);
    }
    for (std::size_t i = 0; i < fresh_inputs_.size(); ++i) {
      const anim::Curve& curve = *fresh_inputs_[i].curve;
      double own[4];
      const double* numbers = own;
      if (same_[i] >= 0)
        numbers = sampled_.data() + 4 * same_[i];
      else
        anim::sample(curve, is_rotation(fresh_inputs_[i]), time, own);
      eval::set_lane(fresh.input(fresh_places_[i]), lane, numbers, curve.width);
    }
  }

  void add(const eval::Instance& old, const eval::Instance& fresh, int lane) {
    for (std::size_t i = 0; i < out_.joints.size(); ++i) {
      double a[12], b[12];
      eval::get_lane(old.output(i), lane, a, 12);
      eval::get_lane(fresh.output(i), lane, b, 12);
      if (std::equal(a, a + 12, b)) continue;
      const math::Affine p = matrix_at(a), q = matrix_at(b);
      Difference& joint = out_.joints[i];
      const double mm = math::length(p.origin - q.origin) * to_mm_;
      const double degrees = angle(p.linear, q.linear);
      joint.largest_mm = std::max(joint.largest_mm, mm);
      joint.largest_degrees = std::max(joint.largest_degrees, degrees);
      joint.mean_mm += mm;
      joint.mean_degrees += degrees;
    }
  }

  const Side& old_;
  const Side& fresh_;
  const std::vector<ClipInput>& old_inputs_;
  const std::vector<ClipInput>& fresh_inputs_;
  bool same_programs_;
  double to_mm_;
  std::vector<std::size_t> old_places_, fresh_places_;  ///< by input of the clip: the program's
  std::vector<int> same_;                               ///< by input of the new rig
  std::vector<double> sampled_;                         ///< [inputs of the old rig][4]
  Comparison out_;
};

}  // namespace

std::optional<std::vector<Comparison>> compare(const Player& old, const Player& fresh,
                                               const std::vector<ClipPair>& clips,
                                               const std::vector<JointPair>& joints, double unit,
                                               Diagnostics& diagnostics) {
  std::vector<const anim::Clip*> old_clips, fresh_clips;
  for (const ClipPair& clip : clips) {
    old_clips.push_back(clip.old);
    fresh_clips.push_back(clip.fresh);
  }
  std::vector<scene::NodeId> old_joints, fresh_joints;
  for (const JointPair& joint : joints) {
    old_joints.push_back(joint.old);
    fresh_joints.push_back(joint.fresh);
  }
  Side before, now;
  if (!prepare(old, old_clips, old_joints, before, diagnostics) ||
      !prepare(fresh, fresh_clips, fresh_joints, now, diagnostics))
    return std::nullopt;
  const bool same_programs = same(*before.program, *now.program);
  std::vector<Comparison> out;
  for (std::size_t i = 0; i < clips.size(); ++i) {
    std::size_t all = 0;
    const std::vector<double> times = times_of({&before.clips[i], &now.clips[i]}, all);
    out.push_back(Comparer(before, now, i, same_programs, joints, unit).run(times));
    out.back().all_times = all;
  }
  return out;
}

}  // namespace rigc::update
