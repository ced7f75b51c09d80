// SPDX-License-Identifier: MIT
// Solves the unknowns of a transfer. Each level is a program of its own, which computes no more
// than the parents of that level. Test: tests/bake/transfer_test.cpp
#include "bake/transfer_solve.h"

#include <algorithm>
#include <cmath>

#include "bake/joints.h"
#include "bake/rounded.h"
#include "bake/transfer_limb.h"
#include "bake/transfer_order.h"
#include "bake/transfer_tidy.h"
#include "base/trace.h"
#include "eval/evaluate.h"

namespace rigc::bake {
namespace {

using math::Affine;
using math::Vec3;
using scene::NodeId;
namespace transform = scene::transform;

/// Worlds of all aims in one frame.
class Pose {
 public:
  Pose(const std::vector<std::vector<Affine>>& worlds, std::size_t frame)
      : worlds_(worlds), frame_(frame) {}
  const Affine& operator[](int aim) const { return worlds_[static_cast<std::size_t>(aim)][frame_]; }

 private:
  const std::vector<std::vector<Affine>>& worlds_;
  std::size_t frame_;
};

/// What the rig says of an unknown's surroundings in one frame.
struct Known {
  Affine parent;
  Affine relay;     ///< parent of what moves the joint in place of the control
  Affine carrier;   ///< seen from the control: what the joints' offsets are seen from
  Limb limb;        ///< of those that move one
  double turn = 0;  ///< degrees by which that limb swivels from the side of its pole
};

/// A constraint takes a rotation from a matrix by its x, then its y. So it comes back also where
/// joint and control hang under uneven scale, by the same rule from what the control's parent sees.
math::Trs follow(const Unknown& u, const Pose& pose, const Known& known, math::Trs local) {
  const Affine to_parent = math::inverse(known.parent);
  const math::Mat3 offset = (known.carrier * u.offset).linear;
  const Vec3 control_point = known.carrier * u.control_point;
  if (u.turns) {
    const math::Mat3 seen = math::orthonormal(to_parent.linear * pose[u.turn_aim].linear);
    local.rotation = math::quaternion(seen * math::transposed(math::orthonormal(offset)));
  }
  if (u.scales) {
    const math::Mat3 wanted = pose[u.turn_aim].linear * math::inverse(offset);
    local.scale = math::decompose({to_parent.linear * wanted, {}}).scale;
  }
  if (!u.moves) return local;
  if (u.relay.valid()) {
    local.translation = math::inverse(known.relay) * pose[u.move_aim].origin - u.control_point;
    return local;
  }
  const math::Mat3 axes = math::compose({{}, local.rotation, local.scale}).linear;
  if (u.solver.valid()) {
    const Bones bones = bones_of(known.limb, pose[u.start], pose[u.middle]);
    const Affine to_point{known.parent.linear,
                          known.parent.linear * (axes * control_point) + known.parent.origin};
    local.translation = rounded_goal(bones, to_point);
    return local;
  }
  local.translation = to_parent * pose[u.move_aim].origin - axes * control_point;
  return local;
}

math::Trs pole(const Unknown& u, const Pose& pose, const Known& known, math::Trs local) {
  const Bones bones = bones_of(known.limb, pose[u.start], pose[u.middle]);
  const Vec3 direction = math::normalised(bones.end - bones.start, bones.first);
  const math::Quat back = math::axis_angle(direction, math::radians(-known.turn));
  const Vec3 side = math::rotate(back, bent_side(bones, pose[u.start], u.bone_offset));
  const Vec3 to_middle = math::rotate(back, bones.middle - bones.start);
  const Vec3 foot = bones.start + direction * math::dot(to_middle, direction);
  const double out = math::dot(to_middle, side);
  local.translation = math::inverse(known.parent) * (foot + side * (out + u.distance));
  return local;
}

/// Value of the attribute.
double twist(const Unknown& u, const Pose& pose, const Known& known) {
  const Bones bones = bones_of(known.limb, pose[u.start], pose[u.middle]);
  const Vec3 side = bent_side(bones, pose[u.start], u.bone_offset);
  const Vec3 bone = u.of_middle ? bones.second : bones.first;
  const Vec3 child = u.of_middle ? bones.second_child : bones.first_child;
  const Affine& joint = pose[u.of_middle ? u.middle : u.start];
  const double degrees = twist_of(bones, side, bone, child, u.joint_offset, joint);
  return u.at + (degrees + known.turn) * u.per_degree;
}

/// Value of the attribute: bones keep their direction.
double bone_length(const Unknown& u, const Pose& pose) {
  const Vec3 bone = math::inverse(pose[u.upper]) * pose[u.lower].origin;
  const double length = math::dot(u.bone, u.bone);
  return length > 0 ? std::max(math::dot(bone, u.bone) / length, u.least) : 1;
}

math::Trs look(const Unknown& u, const Pose& pose, const Known& known, math::Trs local) {
  const math::Mat3 axes = math::orthonormal(pose[u.turn_aim].linear) *
                          math::transposed(math::matrix(math::normalised(u.bone_offset)));
  const Vec3 target = pose[u.turn_aim].origin + axes.x * u.distance;
  local.translation = math::inverse(known.parent) * target;
  return local;
}

/// `played`: what the joint plays, seen from its parent in the scene.
math::Trs own(const Unknown& u, const math::Trs& played, math::Trs local) {
  if (u.moves) local.translation = played.translation;
  if (u.turns) local.rotation = played.rotation;
  if (u.scales) local.scale = played.scale;
  return local;
}

math::Trs solve_one(const Unknown& u, const Pose& pose, const Known& known, const math::Trs& rest) {
  switch (u.rule) {
    case Unknown::Rule::own:
      return own(u, math::decompose(math::inverse(known.parent) * pose[u.turn_aim]), rest);
    case Unknown::Rule::pole:
      return pole(u, pose, known, rest);
    case Unknown::Rule::twist:
    case Unknown::Rule::length:
      return rest;
    case Unknown::Rule::look:
      return look(u, pose, known, rest);
    case Unknown::Rule::follow:
      break;
  }
  return follow(u, pose, known, rest);
}

Affine affine_at(const double* rows, int lane) {
  double n[12];
  eval::get_lane(rows, lane, n, 12);
  return {{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}}, {n[9], n[10], n[11]}};
}

Vec3 vector_at(const double* rows, int lane) {
  double n[3];
  eval::get_lane(rows, lane, n, 3);
  return {n[0], n[1], n[2]};
}

Affine rotation_at(const double* rows, int lane) {
  double n[4];
  eval::get_lane(rows, lane, n, 4);
  return {math::matrix(math::normalised(math::Quat{n[0], n[1], n[2], n[3]})), {}};
}

/// Outputs from `at` on, which goes past them.
Known read_known(const eval::Instance& instance, const Unknown& u, std::size_t& at, int lane) {
  Known known;
  if (is_length(u)) return known;
  known.parent = affine_at(instance.output(at++), lane);
  if (u.relay.valid()) known.relay = affine_at(instance.output(at++), lane);
  if (u.turned.valid()) known.carrier = u.before * rotation_at(instance.output(at++), lane);
  if (!u.solver.valid()) return known;
  known.limb.base = affine_at(instance.output(at++), lane);
  for (Vec3* vector : {&known.limb.start, &known.limb.middle, &known.limb.end,
                       &known.limb.start_scale, &known.limb.middle_scale})
    *vector = vector_at(instance.output(at++), lane);
  if (u.swivels) eval::get_lane(instance.output(at++), lane, &known.turn, 1);
  return known;
}

/// Two lists in the order that their times give.
template <class T>
std::vector<T> interleaved(const std::vector<T>& a, const std::vector<double>& times_of_a,
                           const std::vector<T>& b, const std::vector<double>& times_of_b) {
  std::vector<T> out;
  for (std::size_t i = 0, k = 0; i < a.size() || k < b.size();) {
    const bool from_a = k == b.size() || (i < a.size() && times_of_a[i] < times_of_b[k]);
    out.push_back(from_a ? a[i++] : b[k++]);
  }
  return out;
}

class Solver {
 public:
  Solver(const scene::Scene& scene, const SolveInput& input)
      : scene_(scene), input_(input), unknowns_(input.plan.unknowns), tidy_(scene, input.aims) {
    solution_.locals.resize(unknowns_.size());
    solution_.numbers.resize(unknowns_.size());
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      if (is_number(unknowns_[i]))
        solution_.numbers[i].resize(input.times.size());
      else
        solution_.locals[i].resize(input.times.size());
    }
  }

  /// What the clip moves besides: every level needs it.
  void sample(Threads& threads) {
    samples_.resize(input_.clip.size());
    threads.for_each(samples_.size(), [&](std::size_t i) {
      const eval::ClipInput& input = input_.clip[i];
      const auto width = static_cast<std::size_t>(input.curve->width);
      const bool rotation = input.plug.attribute == transform::kRotation;
      samples_[i].resize(input_.times.size() * width);
      for (std::size_t f = 0; f < input_.times.size(); ++f) {
        double n[4];
        anim::sample(*input.curve, rotation, input_.times[f], n);
        std::copy_n(n, width, samples_[i].data() + f * width);
      }
    });
  }

  /// `pass`: the first knows of the levels below alone; a later one of all unknowns.
  bool solve_level(int pass, int level, Threads& threads, Diagnostics& diagnostics) {
    const auto below = [](const Unknown& u, int at) { return u.level < at; };
    const auto at = [&](int l) {
      return static_cast<std::size_t>(
          std::lower_bound(unknowns_.begin(), unknowns_.end(), l, below) - unknowns_.begin());
    };
    const std::size_t first = at(level), last = at(level + 1);
    const std::size_t known = pass == 0 ? first : unknowns_.size();
    const auto program = eval::compile(scene_, request(known, first, last), diagnostics);
    if (!program) return false;
    eval::for_ranges(*program, input_.times.size(), threads,
                     [&](eval::Instance& instance, std::size_t) {
                       return Worker{*this, instance, known, first, last};
                     });
    for (std::size_t i = first; i < last; ++i) {
      const Solution* others = input_.others;
      tidy_.make_continuous(unknowns_[i], solution_.locals[i]);
      tidy_.settle(unknowns_[i], solution_.locals[i], others ? &others->locals[i] : nullptr);
      tidy_.make_continuous(unknowns_[i], solution_.numbers[i]);
      tidy_.settle(unknowns_[i], solution_.numbers[i], others ? &others->numbers[i] : nullptr);
    }
    return true;
  }

  const std::vector<std::vector<math::Trs>>& locals() const { return solution_.locals; }
  Solution take_solution() { return std::move(solution_); }

 private:
  /// A range of frames for the unknowns `first` to `last`; writes to these frames alone.
  struct Worker {
    Solver& solver;
    eval::Instance& instance;
    std::size_t known, first_unknown, last_unknown;

    void set(std::size_t first, int lanes) {
      for (int lane = 0; lane < lanes; ++lane)
        solver.set_inputs(instance, known, first + static_cast<std::size_t>(lane), lane);
    }
    void take(std::size_t first, int lanes) {
      for (int lane = 0; lane < lanes; ++lane)
        solver.take(instance, first_unknown, last_unknown, first + static_cast<std::size_t>(lane),
                    lane);
    }
  };

  void take(const eval::Instance& instance, std::size_t first, std::size_t last, std::size_t frame,
            int lane) {
    const Pose pose(input_.worlds, frame);
    std::size_t output = 0;
    for (std::size_t i = first; i < last; ++i) {
      const Unknown& u = unknowns_[i];
      const Known known = read_known(instance, u, output, lane);
      const math::Trs rest = scene_.local(u.node);
      if (is_number(u))
        solution_.numbers[i][frame] = is_length(u) ? bone_length(u, pose) : twist(u, pose, known);
      else if (u.plays)
        solution_.locals[i][frame] = as_played(u, own(u, played(u, frame), rest));
      else
        solution_.locals[i][frame] = as_written(solve_one(u, pose, known, rest));
    }
  }

  math::Trs played(const Unknown& u, std::size_t frame) const {
    return local_at(input_.aims[static_cast<std::size_t>(u.turn_aim)], input_.times[frame]);
  }

  /// Parents of unknowns `first` to `last`, from the first `known` of all.
  eval::Request request(std::size_t known, std::size_t first, std::size_t last) const {
    eval::Request request;
    for (const eval::ClipInput& input : input_.clip) request.inputs.push_back(input.plug);
    for (const SwitchValue& value : input_.switches) request.inputs.push_back(value.attribute);
    for (std::size_t i = 0; i < known; ++i) {
      const Unknown& u = unknowns_[i];
      if (is_number(u)) request.inputs.push_back(u.attribute);
      for (const anim::Path path : kPaths)
        if (solves(u, path)) request.inputs.push_back(plug_of(u.node, path));
    }
    for (std::size_t i = first; i < last; ++i) {
      if (is_length(unknowns_[i])) continue;
      request.outputs.push_back({unknowns_[i].node, transform::kParent});
      if (unknowns_[i].relay.valid())
        request.outputs.push_back({unknowns_[i].relay, transform::kParent});
      if (unknowns_[i].turned.valid())
        request.outputs.push_back({unknowns_[i].turned, transform::kRotation});
      if (!unknowns_[i].solver.valid()) continue;
      for (const std::uint16_t read : kLimbReads)
        request.outputs.push_back({unknowns_[i].solver, read});
      if (unknowns_[i].swivels)
        request.outputs.push_back({unknowns_[i].solver, scene::ik2::kTwist});
    }
    return request;
  }

  void set_inputs(eval::Instance& instance, std::size_t count, std::size_t frame, int lane) const {
    std::size_t at = 0;
    for (std::size_t i = 0; i < input_.clip.size(); ++i) {
      const int width = input_.clip[i].curve->width;
      const double* n = samples_[i].data() + frame * static_cast<std::size_t>(width);
      eval::set_lane(instance.input(at++), lane, n, width);
    }
    for (const SwitchValue& value : input_.switches)
      eval::set_lane(instance.input(at++), lane, &value.value, 1);
    for (std::size_t i = 0; i < count; ++i) {
      if (is_number(unknowns_[i])) {
        eval::set_lane(instance.input(at++), lane, &solution_.numbers[i][frame], 1);
        continue;
      }
      const math::Trs& local = solution_.locals[i][frame];
      const double t[3] = {local.translation.x, local.translation.y, local.translation.z};
      const double r[4] = {local.rotation.x, local.rotation.y, local.rotation.z, local.rotation.w};
      const double s[3] = {local.scale.x, local.scale.y, local.scale.z};
      if (unknowns_[i].moves) eval::set_lane(instance.input(at++), lane, t, 3);
      if (unknowns_[i].turns) eval::set_lane(instance.input(at++), lane, r, 4);
      if (unknowns_[i].scales) eval::set_lane(instance.input(at++), lane, s, 3);
    }
  }

  /// The numbers that players read, so that the levels above make good what rounding does below; a
  /// rotation is not of length 1 then.
  static math::Trs as_written(const math::Trs& local) {
    return {rounded(local.translation), rounded(local.rotation), rounded(local.scale)};
  }

  /// The same of a joint that keeps the curves it has: between their keys nothing is rounded.
  math::Trs as_played(const Unknown& u, const math::Trs& local) const {
    math::Trs out = as_written(local);
    const Aim& aim = input_.aims[static_cast<std::size_t>(u.turn_aim)];
    if (aim.translation) out.translation = local.translation;
    if (aim.rotation) out.rotation = local.rotation;
    if (aim.scale) out.scale = local.scale;
    return out;
  }

  const scene::Scene& scene_;
  const SolveInput& input_;
  const std::vector<Unknown>& unknowns_;
  Tidy tidy_;
  std::vector<std::vector<double>> samples_;  // of what the clip moves besides, [inputs][frames]
  Solution solution_;
};

constexpr int kMostPasses = 32;
/// 1 - cosine of half the angle of rotations; of translations and scales relative to themselves.
constexpr double kSettled = 1e-13;

double largest_change(const std::vector<std::vector<math::Trs>>& a,
                      const std::vector<std::vector<math::Trs>>& b) {
  double most = 0;
  const auto vectors = [&](Vec3 x, Vec3 y) {
    most = std::max(most, math::length(x - y) / std::max(1e-30, math::length(x)));
  };
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t f = 0; f < a[i].size(); ++f) {
      vectors(a[i][f].translation, b[i][f].translation);
      vectors(a[i][f].scale, b[i][f].scale);
      const math::Quat p = math::normalised(a[i][f].rotation);  // rounding leaves it longer
      most = std::max(most, 1 - std::abs(math::dot(p, math::normalised(b[i][f].rotation))));
    }
  return most;
}

}  // namespace

void point_bones(const TransferPlan& plan, std::vector<std::vector<Affine>>& worlds) {
  for (const Unknown& u : plan.unknowns) {
    if (!is_length(u) || !u.is_single) continue;
    std::vector<Affine>& upper = worlds[static_cast<std::size_t>(u.upper)];
    const std::vector<Affine>& lower = worlds[static_cast<std::size_t>(u.lower)];
    for (std::size_t f = 0; f < upper.size(); ++f) {
      const Vec3 now = math::normalised(upper[f].linear * u.bone);
      const Vec3 wanted = math::normalised(lower[f].origin - upper[f].origin, now);
      upper[f].linear = math::matrix(math::between(now, wanted)) * upper[f].linear;
    }
  }
}

std::optional<Solution> solve(const scene::Scene& scene, const SolveInput& input, Threads& threads,
                              Diagnostics& diagnostics) {
  const trace::Span span("solve");
  Solver solver(scene, input);
  solver.sample(threads);
  const auto pass = [&](int number) {
    for (int level = 0; level < input.plan.levels; ++level)
      if (!solver.solve_level(number, level, threads, diagnostics)) return false;
    return true;
  };
  if (!pass(0)) return std::nullopt;
  // Where a parent moves with its own child's values, as a neck that bends with the head, the first
  // pass took the child at rest; each later one knows what the one before it found.
  for (int number = 1; input.plan.feedback && number < kMostPasses; ++number) {
    const std::vector<std::vector<math::Trs>> before = solver.locals();
    if (!pass(number)) return std::nullopt;
    if (largest_change(before, solver.locals()) < kSettled) break;
  }
  return solver.take_solution();
}

Solution merged(const scene::Scene& scene, const std::vector<Aim>& aims, const TransferPlan& plan,
                const Solution& a, const std::vector<double>& times_of_a, const Solution& b,
                const std::vector<double>& times_of_b) {
  const Tidy tidy(scene, aims);
  Solution out;
  for (std::size_t i = 0; i < plan.unknowns.size(); ++i) {
    out.locals.push_back(interleaved(a.locals[i], times_of_a, b.locals[i], times_of_b));
    out.numbers.push_back(interleaved(a.numbers[i], times_of_a, b.numbers[i], times_of_b));
    tidy.make_continuous(plan.unknowns[i], out.locals.back());
    tidy.make_continuous(plan.unknowns[i], out.numbers.back());
  }
  return out;
}

}  // namespace rigc::bake
