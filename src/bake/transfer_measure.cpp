// SPDX-License-Identifier: MIT
// How far a transferred clip is from what the joints played. Test: tests/bake/transfer_test.cpp
#include "bake/transfer_measure.h"

#include <algorithm>

#include "bake/motion.h"

namespace rigc::bake {
namespace {

using scene::NodeId;

double angle_between(const math::Affine& a, const math::Affine& b) {
  const math::Quat turn = math::conjugate(math::quaternion(math::orthonormal(a.linear))) *
                          math::quaternion(math::orthonormal(b.linear));
  const double sine = math::length({turn.x, turn.y, turn.z});
  return 2 * math::atan2(sine, turn.w < 0 ? -turn.w : turn.w);
}

void compare(const Aim& aim, const math::Affine& wanted, const math::Affine& got,
             Deviation& deviation) {
  const double distance = math::length(wanted.origin - got.origin);
  const double angle = angle_between(wanted, got);
  if (distance > deviation.distance || !deviation.farthest.valid()) {
    deviation.distance = distance;
    deviation.farthest = aim.id;
  }
  if (angle > deviation.angle || !deviation.most_turned.valid()) {
    deviation.angle = angle;
    deviation.most_turned = aim.id;
  }
}

/// Without times there is nothing to compare.
bool compare_at(const Measure& m, const std::vector<Body>& bodies,
                const std::vector<eval::ClipInput>& inputs, const std::vector<double>& times,
                Deviation& deviation, Diagnostics& diagnostics) {
  if (times.empty()) return true;
  const auto motion = evaluate(m.scene, bodies, inputs, times, diagnostics);
  if (!motion) return false;
  const auto wanted = play(m.aims, times);
  std::vector<int> places(m.scene.size(), -1);
  for (std::size_t b = 0; b < bodies.size(); ++b) places[bodies[b].id.index] = static_cast<int>(b);
  for (std::size_t i = 0; i < m.aims.size(); ++i) {
    const int place = places[m.aims[i].id.index];
    if (place < 0) continue;
    const auto& got = motion->worlds[static_cast<std::size_t>(place)];
    for (std::size_t f = 0; f < times.size(); ++f)
      compare(m.aims[i], wanted[i][f], got[f], deviation);
  }
  return true;
}

std::vector<double> middles(const std::vector<double>& times) {
  std::vector<double> out;
  for (std::size_t i = 1; i < times.size(); ++i) out.push_back((times[i - 1] + times[i]) / 2);
  return out;
}

}  // namespace

bool measure_deviation(const Measure& m, const std::vector<double>& times, TransferReport& report,
                       Diagnostics& diagnostics) {
  const auto inputs = eval::clip_inputs(m.scene, m.nodes, m.clip);
  std::vector<bool> animated(m.scene.size(), false);
  for (const eval::ClipInput& input : inputs)
    if (input.plug.attribute < scene::transform::kCount) animated[input.plug.node.index] = true;
  Options options;
  options.standings = m.standings;
  const std::vector<Body> bodies = find_bodies(m.scene, m.nodes, animated, options);
  return compare_at(m, bodies, inputs, times, report.at_keys, diagnostics) &&
         compare_at(m, bodies, inputs, middles(times), report.between, diagnostics);
}

}  // namespace rigc::bake
