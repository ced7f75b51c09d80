// SPDX-License-Identifier: MIT
// The table of the kernels that clamp. Test: tests/eval/limit_test.cpp
#pragma once

#include <vector>

#include "math/limit.h"

namespace rigc::eval {

/// What limit_vector and limit_rotation take as their data.
std::vector<double> limit_data(const math::LimitSpace& space);

}  // namespace rigc::eval
