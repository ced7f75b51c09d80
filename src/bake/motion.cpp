// SPDX-License-Identifier: MIT
// Evaluates a clip on a scene, ranges of frames over threads. Test: tests/bake/bake_test.cpp
#include "bake/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bake/codes.h"
#include "base/text.h"
#include "base/trace.h"
#include "eval/evaluate.h"
#include "eval/rows.h"

namespace rigc::bake {

using eval::kLanes;
namespace transform = scene::transform;

namespace {

constexpr double kLargest = 1e30;

bool fits(const math::Vec3& v) {
  return std::abs(v.x) <= kLargest && std::abs(v.y) <= kLargest && std::abs(v.z) <= kLargest;
}

bool fits(const math::Quat& q) { return std::isfinite(q.x + q.y + q.z + q.w); }

/// Players of plain glTF and people who look at curves want no jumps between q and -q.
void make_continuous(math::Quat before, std::vector<math::Quat>& rotations) {
  for (math::Quat& rotation : rotations) {
    if (math::dot(before, rotation) < 0) rotation = -rotation;
    before = rotation;
  }
}

}  // namespace

/// What of a range is reported.
struct Found {
  std::size_t bad_frame = SIZE_MAX, bad_body = 0;  ///< the first that cannot be written
  Shear shear;
};

/// Fills a range of frames of a motion, block by block, bodies in their order: bases first.
class RangeWorker {
 public:
  RangeWorker(const Evaluator& evaluator, eval::Instance& instance, Motion& motion, Found& found)
      : evaluator_(evaluator),
        bodies_(*evaluator.bodies_),
        instance_(instance),
        motion_(motion),
        found_(found),
        worlds_(bodies_.size() * kLanes) {
    for (const eval::ClipInput& input : *evaluator.inputs_)
      samplers_.emplace_back(*input.curve, input.plug.attribute == transform::kRotation);
    set(0, kLanes, true);
  }

  void set(std::size_t first, int lanes) { set(first, lanes, false); }

  void take(std::size_t first, int lanes) {
    if (found_.bad_frame != SIZE_MAX) return;
    first_ = first;
    lanes_ = lanes;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (bodies_[b].source == Body::Source::local) take_local(b);
      if (bodies_[b].source == Body::Source::world) take_world(b);
      if (evaluator_.plans_[b].is_followed) follow(b);
    }
  }

 private:
  void set(std::size_t first, int lanes, bool constant) {
    for (std::size_t i = 0; i < samplers_.size(); ++i) {
      if (samplers_[i].is_constant() != constant) continue;
      double* rows = instance_.input(i);
      const int width = (*evaluator_.inputs_)[i].curve->width;
      for (int lane = 0; lane < lanes; ++lane) {
        double numbers[4];
        samplers_[i].at(constant ? 0 : motion_.times[first + static_cast<std::size_t>(lane)],
                        numbers);
        eval::set_lane(rows, lane, numbers, width);
      }
    }
  }

  void take_local(std::size_t b) {
    const Evaluator::Plan& plan = evaluator_.plans_[b];
    Moves& moves = motion_.bodies[b];
    if (plan.varies[0]) take(plan.output, b, moves.translation.values, eval::read_vec3);
    if (plan.varies[1]) take(plan.output + 1, b, moves.rotation.values, read_rotation);
    if (plan.varies[2]) take(plan.output + 2, b, moves.scale.values, eval::read_vec3);
  }

  template <class T>
  void take(std::size_t output, std::size_t body, std::vector<T>& values,
            T (*read)(const double*, int)) {
    const double* rows = instance_.output(output);
    for (int lane = 0; lane < lanes_; ++lane) {
      const T value = read(rows, lane);
      if (!fits(value)) report_bad(body, lane);
      values[frame(lane)] = value;
    }
  }

  static math::Quat read_rotation(const double* rows, int lane) {
    return math::normalised(eval::read_quat(rows, lane));
  }

  void take_world(std::size_t b) {
    const Body& body = bodies_[b];
    const double* rows = instance_.output(evaluator_.plans_[b].output);
    Moves& moves = motion_.bodies[b];
    for (int lane = 0; lane < lanes_; ++lane) {
      const math::Affine world = eval::read_affine(rows, lane);
      const math::Affine* base = base_world(body, lane);
      const math::Affine parent = base ? *base * body.between : body.between;
      const math::Affine matrix = math::inverse(parent) * world;
      const math::Trs local = math::decompose(matrix);
      if (!fits(local.translation) || !fits(local.rotation) || !fits(local.scale))
        report_bad(b, lane);
      note_shear(b, lane, matrix, local, parent);
      moves.translation.values[frame(lane)] = local.translation;
      moves.rotation.values[frame(lane)] = local.rotation;
      moves.scale.values[frame(lane)] = local.scale;
    }
  }

  void note_shear(std::size_t b, int lane, const math::Affine& matrix, const math::Trs& local,
                  const math::Affine& parent) {
    const double relative = math::shear(matrix);
    const double off =
        distance(parent * math::compose(local), parent * matrix, evaluator_.reaches()[b]);
    Shear& shear = found_.shear;
    shear.relative = std::max(shear.relative, relative);
    if (off <= shear.distance) return;
    shear.distance = off;
    shear.seconds = motion_.times[frame(lane)];
    shear.joint = bodies_[b].id;
  }

  void follow(std::size_t b) {
    for (int lane = 0; lane < lanes_; ++lane)
      worlds_[b * kLanes + static_cast<std::size_t>(lane)] =
          world_of(bodies_[b], motion_.bodies[b][frame(lane)], base_world(bodies_[b], lane));
  }

  const math::Affine* base_world(const Body& body, int lane) const {
    if (body.base < 0) return nullptr;
    return &worlds_[static_cast<std::size_t>(body.base) * kLanes + static_cast<std::size_t>(lane)];
  }

  void report_bad(std::size_t body, int lane) {
    if (frame(lane) >= found_.bad_frame) return;
    found_.bad_frame = frame(lane);
    found_.bad_body = body;
  }

  std::size_t frame(int lane) const { return first_ + static_cast<std::size_t>(lane); }

  const Evaluator& evaluator_;
  const std::vector<Body>& bodies_;
  eval::Instance& instance_;
  Motion& motion_;
  Found& found_;
  std::vector<anim::Sampler> samplers_;  // by input
  std::vector<math::Affine> worlds_;     // [bodies][kLanes], of those that are followed
  std::size_t first_ = 0;                // frame of the block
  int lanes_ = 0;
};

Evaluator::Evaluator(const scene::Scene& scene, const std::vector<Body>& bodies,
                     const std::vector<eval::ClipInput>& inputs, const std::vector<Reach>& reaches)
    : scene_(&scene),
      bodies_(&bodies),
      inputs_(&inputs),
      reaches_(&reaches),
      plans_(bodies.size()) {}

eval::Request Evaluator::request() {
  eval::Request request;
  for (const eval::ClipInput& input : *inputs_) request.inputs.push_back(input.plug);
  for (std::size_t b = 0; b < bodies_->size(); ++b) {
    const Body& body = (*bodies_)[b];
    plans_[b].output = request.outputs.size();
    if (body.source == Body::Source::local)
      for (const std::uint16_t attribute :
           {transform::kTranslate, transform::kRotation, transform::kScale})
        request.outputs.push_back({body.id, attribute});
    if (body.source == Body::Source::world) request.outputs.push_back({body.id, transform::kWorld});
  }
  return request;
}

void Evaluator::find_what_varies() {
  const std::vector<bool> varies = eval::varying_outputs(program_);
  for (std::size_t b = bodies_->size(); b-- > 0;) {
    const Body& body = (*bodies_)[b];
    Plan& plan = plans_[b];
    const bool world = body.source == Body::Source::world;
    for (std::size_t path = 0; path < 3; ++path)
      plan.varies[path] =
          world || (body.source == Body::Source::local && varies[plan.output + path]);
    if ((world || plan.is_followed) && body.base >= 0)
      plans_[static_cast<std::size_t>(body.base)].is_followed = true;
  }
}

std::optional<Evaluator> Evaluator::make(const scene::Scene& scene, const std::vector<Body>& bodies,
                                         const std::vector<eval::ClipInput>& inputs,
                                         const std::vector<Reach>& reaches,
                                         Diagnostics& diagnostics) {
  Evaluator evaluator(scene, bodies, inputs, reaches);
  auto program = eval::compile(scene, evaluator.request(), diagnostics);
  if (!program) return std::nullopt;
  evaluator.program_ = std::move(*program);
  evaluator.find_what_varies();
  return evaluator;
}

/// Room for what varies, and the values of what does not.
void Evaluator::prepare(Motion& motion, Found& found) const {
  const eval::Instance instance(program_);
  const std::size_t frames = motion.times.size();
  motion.bodies.resize(bodies_->size());
  for (std::size_t b = 0; b < bodies_->size(); ++b) {
    const Plan& plan = plans_[b];
    Moves& moves = motion.bodies[b];
    math::Trs fixed = (*bodies_)[b].standing;
    if ((*bodies_)[b].source == Body::Source::local) {
      fixed.translation = eval::read_vec3(instance.output(plan.output), 0);
      fixed.rotation = math::normalised(eval::read_quat(instance.output(plan.output + 1), 0));
      fixed.scale = eval::read_vec3(instance.output(plan.output + 2), 0);
    }
    if (!fits(fixed.translation) || !fits(fixed.rotation) || !fits(fixed.scale)) {
      found.bad_frame = 0;
      found.bad_body = b;
    }
    moves.translation.values.assign(plan.varies[0] ? frames : 1, fixed.translation);
    moves.rotation.values.assign(plan.varies[1] ? frames : 1, fixed.rotation);
    moves.scale.values.assign(plan.varies[2] ? frames : 1, fixed.scale);
  }
}

std::optional<Motion> Evaluator::run(std::vector<double> times, Threads& threads,
                                     Diagnostics& diagnostics) const {
  const trace::Span span("evaluate");
  Motion motion;
  motion.times = std::move(times);
  const std::size_t frames = motion.times.size();
  std::vector<Found> found(eval::range_count(frames));
  prepare(motion, found[0]);
  eval::for_ranges(program_, frames, threads, [&](eval::Instance& instance, std::size_t range) {
    return RangeWorker(*this, instance, motion, found[range]);
  });
  for (const Found& one : found) {
    motion.shear.add(one.shear);
    if (one.bad_frame == SIZE_MAX) continue;
    const scene::Node& node = (*scene_)[(*bodies_)[one.bad_body].id];
    diagnostics.report(
        codes::kNotFinite, node.origin.span,
        fmt::format("\"{}\" cannot be written at {:.3f} seconds: it is not finite or above 1e30",
                    printable(node.name), motion.times[one.bad_frame]));
    return std::nullopt;
  }
  for (std::size_t b = 0; b < bodies_->size(); ++b)
    make_continuous((*bodies_)[b].standing.rotation, motion.bodies[b].rotation.values);
  return motion;
}

std::vector<math::Affine> worlds_at(const std::vector<Body>& bodies, const Motion& motion,
                                    std::size_t frame) {
  std::vector<math::Affine> worlds;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const int base = bodies[b].base;
    worlds.push_back(world_of(bodies[b], motion.bodies[b][frame],
                              base < 0 ? nullptr : &worlds[static_cast<std::size_t>(base)]));
  }
  return worlds;
}

}  // namespace rigc::bake
