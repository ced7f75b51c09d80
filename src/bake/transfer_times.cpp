// SPDX-License-Identifier: MIT
// When a transfer looks at a clip. Test: tests/bake/transfer_test.cpp
#include "bake/transfer_times.h"

#include <algorithm>
#include <cmath>

#include "bake/frames.h"

namespace rigc::bake {
namespace {

/// Cubic curves are sampled this often, a second.
constexpr double kCubicRate = 60;
constexpr double kMostSamples = 1'000'000;

std::vector<const anim::Curve*> curves_on(const std::vector<Aim>& aims) {
  std::vector<const anim::Curve*> curves;
  for (const Aim& aim : aims)
    for (const anim::Path path : kPaths)
      if (const anim::Curve* curve = curve_on(aim, path)) curves.push_back(curve);
  return curves;
}

void add_times(anim::Clip& clip, std::vector<float> times) {
  anim::Channel& channel = clip.channels.emplace_back();
  channel.curve.times = std::make_shared<const std::vector<float>>(std::move(times));
}

/// Before each step but the first, so that its value ends where it did.
std::vector<float> ends_of_steps(const std::vector<float>& times) {
  std::vector<float> ends;
  for (std::size_t i = 1; i < times.size(); ++i)
    ends.push_back(std::nextafter(times[i], times[i - 1]));
  return ends;
}

std::vector<float> cubic_samples(const std::vector<float>& times) {
  const auto first = static_cast<double>(times.front()), last = static_cast<double>(times.back());
  std::vector<float> samples;
  if (!((last - first) * kCubicRate <= kMostSamples)) return samples;
  for (double k = 1; first + k / kCubicRate < last; k += 1)
    samples.push_back(static_cast<float>(first + k / kCubicRate));
  return samples;
}

/// A clip with only the times that count: of the joints' keys, and where between keys a line is not
/// what plays.
anim::Clip timing(const std::vector<const anim::Curve*>& curves, bool steps, bool samples) {
  anim::Clip clip;
  for (const anim::Curve* curve : curves) {
    clip.channels.emplace_back().curve.times = curve->times;
    if (curve->interpolation == anim::Interpolation::step && !steps && curve->times->size() > 1)
      add_times(clip, ends_of_steps(*curve->times));
    if (samples && curve->interpolation == anim::Interpolation::cubic && curve->times->size() > 1)
      add_times(clip, cubic_samples(*curve->times));
  }
  std::erase_if(clip.channels, [](const anim::Channel& c) { return c.curve.times->empty(); });
  return clip;
}

}  // namespace

bool only_steps(const std::vector<Aim>& aims) {
  const std::vector<const anim::Curve*> curves = curves_on(aims);
  return std::all_of(curves.begin(), curves.end(), [](const anim::Curve* curve) {
    return curve->interpolation == anim::Interpolation::step;
  });
}

std::optional<std::vector<double>> transfer_times(const std::vector<Aim>& aims,
                                                  const TransferOptions& options, std::size_t width,
                                                  Diagnostics& diagnostics) {
  Options timed;
  timed.fps = options.fps;
  timed.start = options.start;
  timed.end = options.end;
  const anim::Clip keys = timing(curves_on(aims), only_steps(aims), options.tolerance == 0);
  return frame_times(keys, keys, timed, width, diagnostics);
}

}  // namespace rigc::bake
