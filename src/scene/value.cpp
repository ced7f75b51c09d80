// SPDX-License-Identifier: MIT
// Names and widths of the value types. Test: tests/scene/scene_test.cpp
#include "scene/value.h"

#include <array>

namespace rigc::scene {

namespace {

struct TypeRow {
  Type type;
  std::string_view name;
  int width;
};

constexpr std::array<TypeRow, 6> kTypes = {{
    {Type::number, "number", 1},
    {Type::vec3, "vec3", 3},
    {Type::quat, "quat", 4},
    {Type::matrix, "matrix", 12},
    {Type::text, "text", 0},
    {Type::numbers, "numbers", 0},
}};

constexpr bool in_order() {
  for (std::size_t i = 0; i < kTypes.size(); ++i) {
    if (static_cast<std::size_t>(kTypes[i].type) != i) return false;
  }
  return kTypes.size() == std::variant_size_v<Value>;
}
static_assert(in_order());

}  // namespace

std::string_view name_of(Type type) { return kTypes[static_cast<std::size_t>(type)].name; }

int width(Type type) { return kTypes[static_cast<std::size_t>(type)].width; }

}  // namespace rigc::scene
