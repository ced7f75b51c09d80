// SPDX-License-Identifier: MIT
// Evaluating a scene without ceremony: one frame of given values, or many frames block by block.
// Test: tests/eval/evaluate_test.cpp
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "base/threads.h"
#include "eval/program.h"

namespace rigc::eval {

/// A value that an animator gives an input: translate, rotation, rotate, scale or a user attribute,
/// whole.
struct Setting {
  scene::Plug plug;
  scene::Value value;
};

/// Values of plugs in one frame, in their order.
std::optional<std::vector<scene::Value>> evaluate(const scene::Scene& scene,
                                                  const std::vector<scene::Plug>& plugs,
                                                  const std::vector<Setting>& settings,
                                                  Diagnostics& diagnostics);

/// World matrices of transforms in one frame; empty where the scene cannot be compiled.
std::vector<math::Affine> worlds(const scene::Scene& scene, const std::vector<scene::NodeId>& nodes,
                                 const std::vector<Setting>& settings = {});

/// One lane of an input or output register.
inline void set_lane(double* rows, int lane, const double* numbers, int width) {
  for (int i = 0; i < width; ++i) rows[i * kLanes + lane] = numbers[i];
}
inline void get_lane(const double* rows, int lane, double* numbers, int width) {
  for (int i = 0; i < width; ++i) numbers[i] = rows[i * kLanes + lane];
}

/// Runs frames 0 to `count` - 1, kLanes at a time: `set(instance, frame, lane)` before a block for
/// each of its frames, `take(instance, frame, lane)` after it. Lanes past the end keep what they
/// had.
template <class Set, class Take>
void for_frames(const Program& program, std::size_t count, Set set, Take take) {
  Instance instance(program);
  for (std::size_t first = 0; first < count; first += kLanes) {
    const int lanes = static_cast<int>(std::min<std::size_t>(kLanes, count - first));
    for (int lane = 0; lane < lanes; ++lane)
      set(instance, first + static_cast<std::size_t>(lane), lane);
    instance.run();
    for (int lane = 0; lane < lanes; ++lane)
      take(instance, first + static_cast<std::size_t>(lane), lane);
  }
}

/// By output of a program, whether it can change from frame to frame: an instruction or an input
/// writes it. Others hold their value from the beginning.
std::vector<bool> varying_outputs(const Program& program);

/// Frames that one instance runs in a row in for_ranges().
inline constexpr std::size_t kRange = 8 * kLanes;

/// How many ranges `count` frames are.
inline std::size_t range_count(std::size_t count) { return (count + kRange - 1) / kRange; }

/// Runs frames 0 to `count` - 1 over threads, each range of them on an instance of its own.
/// `begin(instance, range)` gives a worker with `set(first, lanes)`, called before the block of the
/// frames `first` to `first + lanes` - 1, and `take(first, lanes)`, called after it. What a range
/// gives depends on nothing but its frames.
template <class Begin>
void for_ranges(const Program& program, std::size_t count, Threads& threads, Begin begin) {
  threads.for_each(range_count(count), [&](std::size_t range) {
    Instance instance(program);
    auto worker = begin(instance, range);
    const std::size_t end = std::min(count, (range + 1) * kRange);
    for (std::size_t first = range * kRange; first < end; first += kLanes) {
      const int lanes = static_cast<int>(std::min<std::size_t>(kLanes, end - first));
      worker.set(first, lanes);
      instance.run();
      worker.take(first, lanes);
    }
  });
}

}  // namespace rigc::eval
