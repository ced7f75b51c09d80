// SPDX-License-Identifier: MIT
// Scenes whose inputs move smoothly, and how far anything in them moves from frame to frame.
// Test: tests/eval/continuity_test.cpp
#pragma once

#include <doctest/doctest.h>

#include <functional>

#include "eval/values.h"
#include "tests/eval/scene_builder.h"
#include "tests/math/random.h"

namespace rigc::test {

/// Values of the inputs at time 0..1, in their order.
using Inputs = std::function<std::vector<scene::Value>(double time)>;

/// A scene, what moves in it, and what is looked at: matrices and rotations.
class Sweep {
 public:
  Sweep(const scene::Scene& scene, const std::vector<scene::Plug>& inputs,
        const std::vector<scene::Plug>& outputs)
      : scene_(scene), outputs_(outputs) {
    Diagnostics diagnostics;
    program_ = eval::compile(scene, {inputs, outputs}, diagnostics);
    REQUIRE(program_);
  }

  /// Outputs of each frame, one after the other.
  using Frame = std::vector<scene::Value>;
  std::vector<Frame> run(std::size_t frames, const Inputs& inputs) const {
    std::vector<Frame> result(frames);
    eval::for_frames(
        *program_, frames,
        [&](eval::Instance& instance, std::size_t frame, int lane) {
          const double time = static_cast<double>(frame) / static_cast<double>(frames - 1);
          const std::vector<scene::Value> values = inputs(time);
          for (std::size_t i = 0; i < values.size(); ++i) {
            const std::vector<double> numbers = eval::numbers_of(values[i]);
            eval::set_lane(instance.input(i), lane, numbers.data(),
                           static_cast<int>(numbers.size()));
          }
        },
        [&](const eval::Instance& instance, std::size_t frame, int lane) {
          for (std::size_t i = 0; i < outputs_.size(); ++i) {
            double numbers[12];
            eval::get_lane(instance.output(i), lane, numbers,
                           static_cast<int>(program_->outputs[i].width));
            result[frame].push_back(eval::value_from(*scene_.type(outputs_[i]), numbers));
          }
        });
    return result;
  }

  /// The largest step from one frame to the next.
  double largest_step(std::size_t frames, const Inputs& inputs) const;

 private:
  const scene::Scene& scene_;
  std::vector<scene::Plug> outputs_;
  std::optional<eval::Program> program_;
};

/// How far a value moves: numbers and vectors by their difference, rotations by the angle in
/// radians, matrices by the largest way of their origin and of the points one unit along each axis.
inline double step_of(const scene::Value& a, const scene::Value& b) {
  if (const auto* n = std::get_if<double>(&a)) return std::fabs(*n - std::get<double>(b));
  if (const auto* v = std::get_if<math::Vec3>(&a)) return distance(*v, std::get<math::Vec3>(b));
  if (const auto* q = std::get_if<math::Quat>(&a)) return 2 * distance(*q, std::get<math::Quat>(b));
  const auto& from = std::get<math::Affine>(a);
  const auto& to = std::get<math::Affine>(b);
  double most = distance(from.origin, to.origin);
  for (const math::Vec3& axis : {math::Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
    most = std::fmax(most, distance(from * axis, to * axis));
  return most;
}

inline double step_of(const Sweep::Frame& a, const Sweep::Frame& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::fmax(most, step_of(a[i], b[i]));
  return most;
}

inline double Sweep::largest_step(std::size_t frames, const Inputs& inputs) const {
  const std::vector<Frame> all = run(frames, inputs);
  double most = 0;
  for (std::size_t i = 1; i < all.size(); ++i) most = std::fmax(most, step_of(all[i - 1], all[i]));
  return most;
}

/// Checks that no step is larger than `bound(step of time)`, for coarse and for fine frames: a jump
/// stays as large however fine they are.
template <class Bound>
void check_steps(const Sweep& sweep, const Inputs& inputs, Bound bound) {
  for (const std::size_t frames : {1001u, 20001u}) {
    const double largest = sweep.largest_step(frames, inputs);
    CAPTURE(frames);
    CHECK(largest <= bound(1.0 / static_cast<double>(frames - 1)));
    CHECK(largest > 0);
  }
}

inline constexpr double kTurn = 2 * math::kPi;  ///< in radians

/// A point on the unit circle from x to y.
inline math::Vec3 on_circle(double turns) {
  return {math::cos(kTurn * turns), math::sin(kTurn * turns), 0};
}

/// A two-bone limb of length 2 at the origin along x, which bends toward +y.
struct LimbScene : SceneBuilder {
  scene::NodeId base = transform("base"), goal = transform("goal"), pole = transform("pole"),
                limb = make(scene::Kind::ik_two_bone, "limb");

  explicit LimbScene(double upper = 1, double lower = 1) {
    namespace ik2 = scene::ik2;
    namespace at = scene::transform;
    edit.connect({base, at::kWorld}, {limb, ik2::kBase});
    edit.connect({goal, at::kWorld}, {limb, ik2::kGoal});
    edit.connect({pole, at::kWorld}, {limb, ik2::kPole});
    edit.set({goal, at::kTranslate}, math::Vec3{1.5, 0, 0});
    edit.set({pole, at::kTranslate}, math::Vec3{0, 3, 0});
    edit.set({limb, ik2::kMiddle}, math::Vec3{upper, 0, 0});
    edit.set({limb, ik2::kEnd}, math::Vec3{lower, 0, 0});
    edit.set({limb, ik2::kNormal}, math::Vec3{0, 0, 1});
    for (const std::int32_t i : {0, 1}) edit.set({limb, ik2::kOffsets, i}, math::Quat{});
  }
  scene::Plug goal_at() const { return {goal, scene::transform::kTranslate}; }
  scene::Plug pole_at() const { return {pole, scene::transform::kTranslate}; }
  Sweep sweep(const std::vector<scene::Plug>& inputs) const {
    return {scene, inputs, {{limb, scene::ik2::kStartWorld}, {limb, scene::ik2::kMiddleWorld}}};
  }
};

/// A chain of bones of length 1 along x, rests bent by an angle in degrees about z.
struct ChainScene : SceneBuilder {
  scene::NodeId goal = transform("goal"), pole = transform("pole"),
                chain = make(scene::Kind::ik_chain, "chain");
  std::vector<scene::NodeId> joints;

  ChainScene(int bones, double bend, bool has_pole) {
    namespace ik = scene::ik_chain;
    namespace at = scene::transform;
    edit.connect({goal, at::kWorld}, {chain, ik::kGoal});
    edit.connect({pole, at::kWorld}, {chain, ik::kPole});
    edit.set({pole, at::kTranslate}, math::Vec3{0, 5, 0});
    edit.set({chain, ik::kHasPole}, has_pole ? 1.0 : 0.0);
    edit.set({chain, ik::kIterations}, 16.0);
    for (std::int32_t i = 0; i <= bones; ++i) {
      const math::Vec3 bone{i == 0 ? 0.0 : 1.0, 0, 0};
      edit.set({chain, ik::kTranslates, i}, bone);
      const double half = bend * (bones - 1) / 2;
      edit.set({chain, ik::kRests, i}, math::from_euler_degrees({0, 0, i == 0 ? half : -bend}));
      joints.push_back(transform("joint", i == 0 ? scene::NodeId{} : joints.back()));
      edit.set({joints.back(), at::kTranslate}, bone);
      if (i < bones) edit.connect({chain, ik::kRotations, i}, {joints.back(), at::kRotation});
    }
  }
  scene::Plug goal_at() const { return {goal, scene::transform::kTranslate}; }
  Sweep sweep(const std::vector<scene::Plug>& inputs) const {
    std::vector<scene::Plug> outputs;
    for (const scene::NodeId joint : joints) outputs.push_back({joint, scene::transform::kWorld});
    return {scene, inputs, outputs};
  }
};

}  // namespace rigc::test
