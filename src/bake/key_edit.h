// SPDX-License-Identifier: MIT
// Puts new keys into a range of a curve; what plays outside of the range stays exactly as it was.
// Test: tests/bake/key_edit_test.cpp
#pragma once

#include <vector>

#include "anim/clip.h"

namespace rigc::bake {

struct KeyEdit {
  const anim::Curve* curve = nullptr;  ///< null: there is none yet
  bool rotation = false;
  std::vector<double> rest;    ///< [width]: what is played without a curve
  std::vector<double> times;   ///< seconds, rising, 32-bit floats, at least one: the range
  std::vector<double> values;  ///< [times][width]
  bool opens = false;          ///< nothing is played before the range
  bool closes = false;         ///< or after it
  bool steps = false;          ///< each new value holds until the next
};

/// The curve with the new keys. One 32-bit float before the range and one after it there are keys
/// that hold what was there. A new curve is linear, or one of steps; what is none of steps within
/// and without plays its steps by two keys each, one 32-bit float apart. In a cubic curve the new
/// keys are joined by straight lines.
anim::Curve edited(const KeyEdit& edit);

}  // namespace rigc::bake
