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

/// One side: its program, and which inputs of it are animated.
struct Side {
  std::vector<ClipInput> inputs;
  std::optional<eval::Program> program;
};

bool prepare(const Player& player, const std::vector<JointPair>& joints, bool is_old, Side& side,
             Diagnostics& diagnostics) {
  side.inputs = eval::clip_inputs(*player.scene, *player.nodes, *player.clip);
  eval::Request request;
  for (const ClipInput& input : side.inputs) request.inputs.push_back(input.plug);
  for (const JointPair& joint : joints)
    request.outputs.push_back({is_old ? joint.old : joint.fresh, transform::kWorld});
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

/// Runs both programs over blocks of times and adds up what differs.
class Comparer {
 public:
  Comparer(const Side& old, const Side& fresh, const std::vector<JointPair>& joints, double unit)
      : old_(old), fresh_(fresh), to_mm_(1000 / unit) {
    for (const JointPair& joint : joints) out_.joints.push_back({joint.name, 0, 0, 0, 0});
    for (std::size_t i = 0; i < fresh.inputs.size(); ++i) same_.push_back(same_as(i));
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
    if (old_.inputs.size() != fresh_.inputs.size()) return false;
    for (std::size_t i = 0; i < same_.size(); ++i)
      if (!same_keys(old_.inputs[i], fresh_.inputs[i])) return false;
    return same(*old_.program, *fresh_.program);
  }

  /// The input of the old rig with the same keys, -1: none.
  int same_as(std::size_t index) const {
    for (std::size_t i = 0; i < old_.inputs.size(); ++i)
      if (same_keys(old_.inputs[i], fresh_.inputs[index])) return static_cast<int>(i);
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
    sampled_.resize(old_.inputs.size() * 4);
    for (std::size_t i = 0; i < old_.inputs.size(); ++i) {
      double* const numbers = sampled_.data() + 4 * i;
      const anim::Curve& curve = *old_.inputs[i].curve;
      anim::sample(curve, is_rotation(old_.inputs[i]), time, numbers);
      eval::set_lane(old.input(i), lane, numbers, curve.width);
    }
    for (std::size_t i = 0; i < fresh_.inputs.size(); ++i) {
      const anim::Curve& curve = *fresh_.inputs[i].curve;
      double own[4];
      const double* numbers = own;
      if (same_[i] >= 0)
        numbers = sampled_.data() + 4 * same_[i];
      else
        anim::sample(curve, is_rotation(fresh_.inputs[i]), time, own);
      eval::set_lane(fresh.input(i), lane, numbers, curve.width);
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
  double to_mm_;
  std::vector<int> same_;        ///< by input of the new rig
  std::vector<double> sampled_;  ///< [inputs of the old rig][4]
  Comparison out_;
};

}  // namespace

std::optional<Comparison> compare(const Player& old, const Player& fresh,
                                  const std::vector<JointPair>& joints, double unit,
                                  Diagnostics& diagnostics) {
  Side before, now;
  if (!prepare(old, joints, true, before, diagnostics) ||
      !prepare(fresh, joints, false, now, diagnostics))
    return std::nullopt;
  std::size_t all = 0;
  const std::vector<double> times = times_of({&before.inputs, &now.inputs}, all);
  Comparison out = Comparer(before, now, joints, unit).run(times);
  out.all_times = all;
  return out;
}

}  // namespace rigc::update
