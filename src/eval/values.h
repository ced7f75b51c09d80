// SPDX-License-Identifier: MIT
// Values of a scene as the numbers that registers hold, and back.
// Test: tests/eval/evaluate_test.cpp
#pragma once

#include <vector>

#include "scene/scene.h"

namespace rigc::eval {

/// 1, 3, 4 or 12 numbers; a matrix by its columns x, y, z, origin. None for text and data.
std::vector<double> numbers_of(const scene::Value& value);

/// The reverse; `type` is one that is evaluated.
scene::Value value_from(scene::Type type, const double* numbers);

}  // namespace rigc::eval
