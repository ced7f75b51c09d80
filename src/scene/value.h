// SPDX-License-Identifier: MIT
// Values of attributes and the types they have. Test: tests/scene/scene_test.cpp
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "math/math.h"

namespace rigc::scene {

/// `numbers` is plain data (points of a curve), `text` too; the others are evaluated.
enum class Type : std::uint8_t { number, vec3, quat, matrix, text, numbers };

using Value =
    std::variant<double, math::Vec3, math::Quat, math::Affine, std::string, std::vector<double>>;

inline Type type_of(const Value& value) { return static_cast<Type>(value.index()); }
std::string_view name_of(Type type);

/// Numbers that a plug of this type holds: 1, 3, 4, 12; 0 for data.
int width(Type type);

}  // namespace rigc::scene
