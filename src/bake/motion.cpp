// SPDX-License-Identifier: MIT
// Evaluates a clip on a scene frame by frame. Test: tests/bake/bake_test.cpp
#include "bake/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "bake/codes.h"
#include "base/text.h"
#include "base/trace.h"
#include "eval/evaluate.h"

namespace rigc::bake {
namespace {

using scene::NodeId;
using scene::Plug;
namespace transform = scene::transform;

constexpr double kLargest = 1e30;
constexpr std::size_t kOutputs = 4;  // of each body: translate, rotation, scale, world

math::Vec3 vector_at(const double* n) { return {n[0], n[1], n[2]}; }

/// What the scene gives for one body in one frame.
struct Evaluated {
  math::Trs local;
  math::Affine world;
};

Evaluated take(const eval::Instance& instance, std::size_t first, int lane) {
  double n[12];
  Evaluated out;
  eval::get_lane(instance.output(first), lane, n, 3);
  out.local.translation = vector_at(n);
  eval::get_lane(instance.output(first + 1), lane, n, 4);
  out.local.rotation = math::normalised(math::Quat{n[0], n[1], n[2], n[3]});
  eval::get_lane(instance.output(first + 2), lane, n, 3);
  out.local.scale = vector_at(n);
  eval::get_lane(instance.output(first + 3), lane, n, 12);
  out.world.linear = {vector_at(n), vector_at(n + 3), vector_at(n + 6)};
  out.world.origin = vector_at(n + 9);
  return out;
}

bool fits(const math::Trs& trs) {
  for (std::size_t c = 0; c < 3; ++c)
    if (!(std::abs(trs.translation[c]) <= kLargest && std::abs(trs.scale[c]) <= kLargest))
      return false;
  return std::isfinite(trs.rotation.x + trs.rotation.y + trs.rotation.z + trs.rotation.w);
}

/// Fills one frame of a motion, bases first.
class FrameMaker {
 public:
  FrameMaker(const std::vector<Body>& bodies, Motion& motion) : bodies_(bodies), motion_(motion) {}

  /// Gives the first body whose transform cannot be written, or -1.
  int make(const eval::Instance& instance, std::size_t frame, int lane) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Body& body = bodies_[i];
      const math::Affine* base =
          body.base < 0 ? nullptr : &motion_.worlds[static_cast<std::size_t>(body.base)][frame];
      const Evaluated evaluated = take(instance, i * kOutputs, lane);
      math::Trs local = body.standing;
      if (body.source == Body::Source::local) local = evaluated.local;
      if (body.source == Body::Source::world) local = local_of(body, evaluated.world, base);
      if (!fits(local)) return static_cast<int>(i);
      keep_near(local.rotation, i, frame);
      motion_.locals[i][frame] = local;
      motion_.worlds[i][frame] = world_of(body, local, base);
    }
    return -1;
  }

 private:
  math::Trs local_of(const Body& body, const math::Affine& world, const math::Affine* base) {
    const math::Affine parent = base ? *base * body.between : body.between;
    const math::Affine local = math::inverse(parent) * world;
    motion_.shear = std::max(motion_.shear, math::shear(local));
    return math::decompose(local);
  }

  /// Players of plain glTF and people who look at curves want no jumps between q and -q.
  void keep_near(math::Quat& rotation, std::size_t body, std::size_t frame) const {
    const math::Quat& before =
        frame == 0 ? bodies_[body].standing.rotation : motion_.locals[body][frame - 1].rotation;
    if (math::dot(before, rotation) < 0) rotation = -rotation;
  }

  const std::vector<Body>& bodies_;
  Motion& motion_;
};

}  // namespace

math::Affine world_of(const Body& body, const math::Trs& local, const math::Affine* base) {
  const math::Affine matrix = math::compose(local);
  if (body.between == math::Affine{}) return base ? *base * matrix : matrix;
  return base ? *base * body.between * matrix : body.between * matrix;
}

std::optional<Motion> evaluate(const scene::Scene& scene, const std::vector<Body>& bodies,
                               const std::vector<eval::ClipInput>& inputs,
                               std::vector<double> times, Diagnostics& diagnostics) {
  const trace::Span span("evaluate");
  eval::Request request;
  for (const eval::ClipInput& input : inputs) request.inputs.push_back(input.plug);
  for (const Body& body : bodies) {
    for (const std::uint16_t attribute :
         {transform::kTranslate, transform::kRotation, transform::kScale, transform::kWorld})
      request.outputs.push_back({body.id, attribute});
  }
  const auto program = eval::compile(scene, request, diagnostics);
  if (!program) return std::nullopt;

  Motion motion;
  motion.times = std::move(times);
  const std::size_t frames = motion.times.size();
  motion.locals.assign(bodies.size(), std::vector<math::Trs>(frames));
  motion.worlds.assign(bodies.size(), std::vector<math::Affine>(frames));
  const auto set = [&](eval::Instance& instance, std::size_t frame, int lane) {
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      double numbers[4];
      const bool rotation = inputs[i].plug.attribute == transform::kRotation;
      anim::sample(*inputs[i].curve, rotation, motion.times[frame], numbers);
      eval::set_lane(instance.input(i), lane, numbers, inputs[i].curve->width);
    }
  };
  FrameMaker maker(bodies, motion);
  int bad = -1;
  double bad_time = 0;
  const auto take_frame = [&](const eval::Instance& instance, std::size_t frame, int lane) {
    if (bad >= 0) return;
    bad = maker.make(instance, frame, lane);
    bad_time = motion.times[frame];
  };
  eval::for_frames(*program, frames, set, take_frame);
  if (bad < 0) return motion;
  const scene::Node& node = scene[bodies[static_cast<std::size_t>(bad)].id];
  diagnostics.report(
      codes::kNotFinite, node.origin.span,
      fmt::format("\"{}\" cannot be written at {:.3f} seconds: it is not finite or above 1e30",
                  printable(node.name), bad_time));
  return std::nullopt;
}

}  // namespace rigc::bake
