// SPDX-License-Identifier: MIT
// Measures gaps between keys, and fills them.
// Test: tests/bake/transfer_test.cpp, tests/bake/match_test.cpp
#include "bake/gap_fill.h"

#include <algorithm>
#include <numeric>

namespace rigc::bake {
namespace {

constexpr std::size_t kBlock = 256;  // gaps that a thread measures in a row

/// Between two frames of unit axes, radians.
double angle_between(const math::Mat3& a, const math::Mat3& b) {
  double sum = 0;  // 8 sin^2 of half the angle
  for (const math::Vec3& apart : {a.x - b.x, a.y - b.y, a.z - b.z}) sum += math::dot(apart, apart);
  return 2 * math::asin(math::sqrt(sum / 8));
}

Gap gap_at(const std::vector<double>& times, std::size_t i) {
  return {times[i], times[std::min(i + 1, times.size() - 1)]};
}

/// Gives the new gaps as they are counted when `more`, their middles, are among the times; so is
/// `off` then.
std::vector<std::size_t> split(const std::vector<std::size_t>& gaps, const Filling& filling,
                               const std::vector<double>& times, std::vector<GapOff>& off,
                               std::vector<double>& more) {
  std::vector<std::size_t> halves;
  std::vector<GapOff> after;
  std::size_t copied = 0;
  for (const std::size_t i : gaps) {
    const Gap gap = gap_at(times, i);
    if (!gap.is_wide(filling.shortest) || !(off[i].excess > filling.tolerance)) continue;
    const auto at = [&](std::size_t index) {
      return off.begin() + static_cast<std::ptrdiff_t>(index);
    };
    after.insert(after.end(), at(copied), at(i));
    copied = i + 1;
    more.push_back(gap.middle());
    halves.push_back(after.size());
    halves.push_back(after.size() + 1);
    after.resize(after.size() + 2);
  }
  after.insert(after.end(), off.begin() + static_cast<std::ptrdiff_t>(copied), off.end());
  off = std::move(after);
  return halves;
}

}  // namespace

Deviation deviation(scene::NodeId node, const math::Affine& wanted, const math::Affine& got,
                    double seconds) {
  const double angle =
      angle_between(math::orthonormal(wanted.linear), math::orthonormal(got.linear));
  return {math::length(wanted.origin - got.origin), angle, node, node, seconds, seconds};
}

void keep_larger(const Deviation& one, Deviation& largest) {
  if (one.farthest.valid() && (one.distance > largest.distance || !largest.farthest.valid())) {
    largest.distance = one.distance;
    largest.farthest = one.farthest;
    largest.farthest_at = one.farthest_at;
  }
  if (one.most_turned.valid() && (one.angle > largest.angle || !largest.most_turned.valid())) {
    largest.angle = one.angle;
    largest.most_turned = one.most_turned;
    largest.most_turned_at = one.most_turned_at;
  }
}

std::vector<std::size_t> all_gaps(const std::vector<double>& times) {
  std::vector<std::size_t> gaps(std::max<std::size_t>(times.size() - 1, 1));
  std::iota(gaps.begin(), gaps.end(), std::size_t{0});
  return gaps;
}

std::vector<double> times_in(const std::vector<std::size_t>& gaps, std::size_t first,
                             std::size_t last, const std::vector<double>& times) {
  std::vector<double> out;
  for (std::size_t i = first; i < last; ++i) {
    const Gap gap = gap_at(times, gaps[i]);
    out.push_back(gap.begin);
    for (std::size_t k = 0; k < Gap::kInside; ++k) out.push_back(gap.inside(k));
    out.push_back(gap.end);
  }
  return out;
}

GapOff measure_gap(const std::function<double(std::size_t, Deviation&)>& compare,
                   std::size_t frame) {
  GapOff off;
  const double at_begin = compare(frame, off.at_ends);
  const double at_end = compare(frame + Gap::kInside + 1, off.at_ends);
  double inside = 0;
  for (std::size_t k = 1; k <= Gap::kInside; ++k)
    inside = std::max(inside, compare(frame + k, off.inside));
  off.excess = inside - std::max(at_begin, at_end);
  return off;
}

bool for_gaps(std::size_t count, Threads& threads, Diagnostics& diagnostics,
              const std::function<void(std::size_t first, std::size_t last, Diagnostics&)>& run) {
  std::vector<Diagnostics> reported((count + kBlock - 1) / kBlock,
                                    Diagnostics(diagnostics.sources()));
  threads.for_each(reported.size(), [&](std::size_t i) {
    run(i * kBlock, std::min((i + 1) * kBlock, count), reported[i]);
  });
  for (const Diagnostics& one : reported) {
    diagnostics.append(one);
    if (!one.ok()) return false;
  }
  return true;
}

bool fill_gaps(const std::vector<double>& times, const Filling& filling, std::vector<GapOff>& off,
               const std::function<bool(const std::vector<std::size_t>& gaps,
                                        std::vector<GapOff>& off)>& measure,
               const std::function<bool(const std::vector<double>& more)>& add) {
  std::vector<std::size_t> gaps = all_gaps(times);
  off.assign(gaps.size(), {});
  for (;;) {
    if (!measure(gaps, off)) return false;
    std::vector<double> more;
    gaps = split(gaps, filling, times, off, more);
    if (more.empty()) return true;
    if (!add(more)) return false;
  }
}

}  // namespace rigc::bake
