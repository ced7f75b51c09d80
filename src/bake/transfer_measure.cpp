// SPDX-License-Identifier: MIT
// How far a transferred clip is from what the joints played. Test: tests/bake/transfer_test.cpp
#include "bake/transfer_measure.h"

#include <algorithm>
#include <set>

#include "base/trace.h"

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

/// Its value at all of these times.
anim::Curve resampled(const anim::Curve& curve, bool rotation, const std::vector<double>& times) {
  anim::Curve out;
  out.interpolation = curve.interpolation;
  out.width = curve.width;
  std::vector<float> at;
  for (const double time : times) {
    double n[4];
    anim::sample(curve, rotation, time, n);
    at.push_back(static_cast<float>(time));
    for (int i = 0; i < curve.width; ++i) out.values.push_back(static_cast<float>(n[i]));
  }
  out.times = std::make_shared<const std::vector<float>>(std::move(at));
  return out;
}

/// The times, and the middle between each two.
std::vector<double> with_middles(const std::vector<double>& times) {
  std::vector<double> out{times.front()};
  for (std::size_t i = 1; i < times.size(); ++i) {
    out.push_back((times[i - 1] + times[i]) / 2);
    out.push_back(times[i]);
  }
  return out;
}

/// What plays in the file after a bake with a frame at each of these times.
std::optional<anim::Clip> bake_back(const Measure& m, const std::vector<double>& times,
                                    Diagnostics& diagnostics) {
  anim::Clip clip = m.clip;
  // A bake has frames where the controls have keys.
  const auto moving =
      std::find_if(clip.channels.begin(), clip.channels.end(), [&](const anim::Channel& c) {
        return c.curve.times->size() > 1 && c.path <= anim::Path::scale && c.node == m.keyed_node &&
               c.curve.interpolation != anim::Interpolation::cubic;
      });
  if (moving != clip.channels.end())
    moving->curve = resampled(moving->curve, moving->path == anim::Path::rotation, times);
  Options options;
  options.fps = 0;
  options.start = times.front();
  options.end = times.back();
  options.standings = m.standings;
  Report report;
  auto baked = bake(m.scene, m.nodes, clip, options, report, diagnostics);
  if (!baked) return std::nullopt;
  const std::set<int> driven(report.driven.begin(), report.driven.end());
  for (const anim::Channel& channel : m.clip.channels)
    if (!driven.contains(channel.node)) baked->channels.push_back(channel);
  return baked;
}

}  // namespace

bool measure_deviation(const Measure& m, const std::vector<double>& times, TransferReport& report,
                       Diagnostics& diagnostics) {
  const trace::Span span("measure");
  const std::vector<double> all = with_middles(times);
  const auto back = bake_back(m, all, diagnostics);
  if (!back) return false;
  const auto wanted = play(m.aims, all);
  const auto got = play(find_aims(m.scene, m.nodes, *back, m.standings), all);
  for (std::size_t i = 0; i < m.aims.size(); ++i)
    for (std::size_t f = 0; f < all.size(); ++f)
      compare(m.aims[i], wanted[i][f], got[i][f], f % 2 == 0 ? report.at_keys : report.between);
  return true;
}

}  // namespace rigc::bake
