// SPDX-License-Identifier: MIT
// Values that are converted there and back are the same to the bit, however often. Test:
// tests/update/remap_test.cpp
#pragma once

#include "math/math.h"

namespace rigc::update {

/// Conversions round, and would move a value on with every way there and back. So a value is
/// *settled* where it has few digits (32-bit floats, as other programs write them, or a grid that
/// is finer than anything seen and coarser than rounding), and of two values that are converted
/// into each other one is: what was not settled becomes so (1e-14 of its size away at most), what
/// was becomes whatever it becomes, which the way back settles again where it was. `converted`:
/// what comes of `value`.
double settled(double value, double converted);
math::Vec3 settled(const math::Vec3& value, const math::Vec3& converted);
math::Quat settled(const math::Quat& value, const math::Quat& converted);

}  // namespace rigc::update
