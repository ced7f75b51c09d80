// SPDX-License-Identifier: MIT
// The table of the spline kernel: what rules_spline.cpp writes and spline.h reads.
// Test: tests/eval/spline_test.cpp
#pragma once

#include <cstddef>
#include <cstdint>

namespace rigc::eval::spline {

/// The most controls and outputs; checked when a program is compiled.
inline constexpr std::size_t kMostControls = 32, kMostOutputs = 256;

/// The row of the result where worlds begin: after length and stretch.
inline constexpr std::uint32_t kFirstWorld = 2;

// Arguments: base, preserve, least, most, the controls, and where kTwisted is not 0 a number for
// each of them.
enum Argument : std::size_t { kBase, kPreserve, kLeast, kMost, kControls };

enum Table : std::size_t {
  kCount,    ///< of controls
  kOutputs,  ///< number of them
  kAims,     ///< 1: x of an output points at the next one, 0: along the curve
  kMoves,    ///< 0: outputs keep their places between the controls in every frame
  kTwisted,
  kMeasures,  ///< 0: nobody reads length and stretch, which then are not written where kMoves is 0
  kLength,    ///< of the curve at rest, in the base's units
  kRows       ///< of the controls, then of the outputs
};

enum ControlRow : std::size_t {
  kDirection,    ///< of the curve at rest, seen from the control: 3
  kFollows = 3,  ///< how much the direction turns with the control
  kAxes = 4,     ///< x along the curve and y across it at rest, seen from the control: 6
  kControlRow = 10
};

enum OutputRow : std::size_t {
  kSegment,
  kPart,            ///< of the segment, 0..1
  kPlaceBasis,      ///< 4
  kSlopeBasis = 6,  ///< 4
  kPassed = 10,     ///< the curve's length from its start to the output at rest
  kBone,            ///< distance to the next output at rest
  kTurned,          ///< the output's axes at rest, seen from the curve's: 9
  kOffset = 21,     ///< its place at rest, seen from the curve's place and axes: 3
  kOutputRow = 24
};

}  // namespace rigc::eval::spline
