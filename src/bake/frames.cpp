// SPDX-License-Identifier: MIT
// The times at which a clip is baked. Test: tests/bake/frames_test.cpp
#include "bake/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bake/codes.h"
#include "bake/rounded.h"

namespace rigc::bake {
namespace {

constexpr double kMostFrames = 1'000'000;
constexpr double kMostNumbers = 1 << 28;  // 2 GB of doubles
constexpr double kNearly = 1e-4;          // of a frame: a frame so close to the end is the end

struct Window {
  double start = 0;
  double end = 0;
};

std::optional<Window> window_of(const anim::Clip& clip, const Options& options,
                                Diagnostics& diagnostics) {
  Window range;
  range.start = options.start.value_or(std::max(anim::first_time(clip), 0.0));
  range.end = options.end.value_or(std::max(anim::last_time(clip), range.start));
  // Written so that NaN fails.
  if (range.start >= 0 && range.end >= range.start && std::isfinite(range.end) && options.fps >= 0)
    return range;
  diagnostics.report(
      codes::kRange, {},
      fmt::format("a bake from {} to {} seconds at {} frames a second is not possible", range.start,
                  range.end, options.fps));
  return std::nullopt;
}

/// Frames k / fps from the start, and the end, also where it lies off that grid.
std::vector<double> grid(const Window& range, double fps) {
  std::vector<double> times;
  const double last = (range.end - range.start) * fps - kNearly;
  for (double k = 0; k < last; k += 1) times.push_back((range.start * fps + k) / fps);
  times.push_back(range.end);
  return times;
}

/// Right before keys that a step leads to: linear keys there play the step too.
void add_times_before_steps(const anim::Curve& curve, std::vector<double>& times) {
  if (curve.interpolation != anim::Interpolation::step) return;
  const auto width = static_cast<std::ptrdiff_t>(curve.width);
  for (std::size_t key = 1; key < curve.times->size(); ++key) {
    const auto value = curve.values.begin() + static_cast<std::ptrdiff_t>(key) * width;
    if (!std::equal(value - width, value, value))
      times.push_back(static_cast<double>(std::nextafter((*curve.times)[key], -1.0f)));
  }
}

std::vector<double> keys(const Window& range, const anim::Clip& animated) {
  std::vector<double> times = anim::key_times(animated);
  for (const anim::Channel& channel : animated.channels)
    add_times_before_steps(channel.curve, times);
  const auto is_outside = [&](double t) { return !(t > range.start && t < range.end); };
  times.erase(std::remove_if(times.begin(), times.end(), is_outside), times.end());
  times.push_back(range.start);
  times.push_back(range.end);
  std::sort(times.begin(), times.end());
  return times;
}

/// As glTF holds them, in 32 bits: a step of a control is a step at the very time of its key.
void round(std::vector<double>& times) {
  for (double& time : times) time = rounded(time);
  times.erase(std::unique(times.begin(), times.end()), times.end());
}

}  // namespace

bool check_frame_count(double count, std::size_t width, Diagnostics& diagnostics) {
  if (count <= kMostFrames && count * static_cast<double>(width) <= kMostNumbers) return true;
  diagnostics.report(codes::kTooLong, {},
                     fmt::format("the clip would have {:.0f} frames of {} numbers", count, width),
                     "bake it in parts with --start and --end, or at a lower --fps");
  return false;
}

std::optional<std::vector<double>> frame_times(const anim::Clip& clip, const anim::Clip& animated,
                                               const Options& options, std::size_t width,
                                               Diagnostics& diagnostics) {
  const auto range = window_of(clip, options, diagnostics);
  if (!range) return std::nullopt;
  const bool on_grid = options.fps > 0;
  std::vector<double> times;
  double count = (range->end - range->start) * options.fps + 1;
  if (!on_grid) {
    times = keys(*range, animated);
    count = static_cast<double>(times.size());
  }
  if (!check_frame_count(count, width, diagnostics)) return std::nullopt;
  if (on_grid) times = grid(*range, options.fps);
  round(times);
  return times;
}

}  // namespace rigc::bake
