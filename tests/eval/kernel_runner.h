// SPDX-License-Identifier: MIT
// Runs one kernel on rows of its own, with different values in every lane.
#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "eval/kernels/table.h"
#include "eval/values.h"
#include "tests/math/random.h"

namespace rigc::test {

using Numbers = std::vector<double>;

/// One lane's arguments.
using Arguments = std::vector<scene::Value>;

/// What the kernel gives for each lane, `width` numbers each. Every lane has its own arguments
/// (kLanes of them).
inline std::vector<Numbers> run_kernel(eval::Kernel kernel, const std::vector<Arguments>& lanes,
                                       const Numbers& data, std::uint32_t width) {
  std::vector<eval::Register> places;
  Numbers registers;
  for (std::size_t a = 0; a < lanes[0].size(); ++a) {
    const auto rows = static_cast<std::uint32_t>(eval::numbers_of(lanes[0][a]).size());
    places.push_back({static_cast<std::uint32_t>(registers.size() / eval::kLanes), rows});
    const std::size_t base = registers.size();
    registers.resize(base + static_cast<std::size_t>(rows) * eval::kLanes);
    for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
      const Numbers numbers = eval::numbers_of(lanes[lane][a]);
      for (std::size_t r = 0; r < rows; ++r) registers[base + r * eval::kLanes + lane] = numbers[r];
    }
  }
  const eval::Register out{static_cast<std::uint32_t>(registers.size() / eval::kLanes), width};
  const double nothing = 12345.678;
  registers.resize(registers.size() + static_cast<std::size_t>(width + 1) * eval::kLanes, nothing);
  kernel({registers.data(), out, places.data(), static_cast<std::uint32_t>(places.size()),
          data.data()});
  for (int lane = 0; lane < eval::kLanes; ++lane) {
    REQUIRE(registers[static_cast<std::size_t>(out.row + width) * eval::kLanes +
                      static_cast<std::size_t>(lane)] == nothing);
  }
  std::vector<Numbers> results;
  for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
    results.emplace_back();
    for (std::size_t r = 0; r < width; ++r)
      results.back().push_back(registers[(out.row + r) * eval::kLanes + lane]);
  }
  return results;
}

inline std::vector<Numbers> run_kernel(eval::Op op, const std::vector<Arguments>& lanes,
                                       const Numbers& data, std::uint32_t width) {
  return run_kernel(eval::row(op).kernel, lanes, data, width);
}

/// The same for one set of arguments.
inline Numbers run_kernel_once(eval::Op op, const Arguments& arguments, const Numbers& data,
                               std::uint32_t width) {
  const std::vector<Numbers> results =
      run_kernel(op, std::vector<Arguments>(eval::kLanes, arguments), data, width);
  for (const Numbers& lane : results) REQUIRE(lane == results[0]);
  return results[0];
}

inline bool all_finite(const Numbers& numbers) {
  for (const double n : numbers) {
    if (!std::isfinite(n)) return false;
  }
  return true;
}

/// Largest difference, relative to the largest number of either or 1.
inline double difference(const Numbers& a, const Numbers& b) {
  REQUIRE(a.size() == b.size());
  double most = 0, size = 1;
  for (std::size_t i = 0; i < a.size(); ++i) {
    most = std::fmax(most, std::fabs(a[i] - b[i]));
    size = std::fmax(size, std::fmax(std::fabs(a[i]), std::fabs(b[i])));
  }
  return most / size;
}

inline math::Affine affine_of(const Numbers& n, std::size_t at = 0) {
  return std::get<math::Affine>(eval::value_from(scene::Type::matrix, n.data() + at));
}
inline math::Quat quat_of(const Numbers& n, std::size_t at = 0) {
  return {n[at], n[at + 1], n[at + 2], n[at + 3]};
}
inline math::Vec3 vec3_of(const Numbers& n, std::size_t at = 0) {
  return {n[at], n[at + 1], n[at + 2]};
}

}  // namespace rigc::test
