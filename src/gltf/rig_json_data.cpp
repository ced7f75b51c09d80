// SPDX-License-Identifier: MIT
// Checks of controls' and meshes' data. Test: tests/hostile/rig_test.cpp
#include "gltf/rig_json_data.h"

#include <fmt/format.h>

#include <cmath>

#include "base/text.h"
#include "gltf/proxy_mesh.h"
#include "gltf/rig_codes.h"

namespace rigc::gltf {
namespace {

/// Attributes of controls that are bits, added up.
struct Bits {
  std::uint16_t attribute;
  int all;
};
constexpr Bits kBits[] = {
    {scene::control::kKeyable, 7}, {scene::control::kLocked, 511}, {scene::control::kHidden, 511}};

void check_bits(const json::Value& values, JsonReader& reader) {
  for (const Bits& bits : kBits) {
    const std::string_view name = scene::spec(scene::Kind::control).attributes[bits.attribute].name;
    const auto number = values[name].number();
    if (number && !(*number >= 0 && *number <= bits.all && *number == std::floor(*number)))
      reader.fail(codes::kRigValue, values[name],
                  fmt::format("\"{}\" is a whole number from 0 to {}", name, bits.all));
  }
}

/// Whether numbers are polylines: a count, then as many points, repeated.
bool are_lines(const std::vector<double>& numbers) {
  for (std::size_t i = 0; i < numbers.size();) {
    const double count = numbers[i];
    const auto room = static_cast<double>((numbers.size() - i - 1) / 3);
    if (!(count >= 1 && count <= room && count == std::floor(count))) return false;
    i += 1 + 3 * static_cast<std::size_t>(count);
  }
  return true;
}

template <class T>
const T& stored(const scene::Node& node, std::uint16_t attribute) {
  return std::get<T>(node.attributes[attribute][0]);
}

void check_control(const json::Value& values, JsonReader& reader, const scene::Node& node) {
  namespace control = scene::control;
  check_bits(values, reader);
  if (!are_lines(stored<std::vector<double>>(node, control::kPoints)))
    reader.fail(codes::kRigValue, values["points"], "lines are a count, then as many points each");
  const std::size_t signs = stored<std::vector<double>>(node, control::kMirror).size();
  if (signs != 0 && signs != 3)
    reader.fail(codes::kRigValue, values["mirror"], "\"mirror\" has 3 numbers, or none");
  const auto& opposite = stored<std::string>(node, control::kOpposite);
  if (!opposite.empty() && !parse_identity(opposite))
    reader.fail(codes::kRigText, values["opposite"],
                fmt::format("\"{}\" is no identity", printable(opposite)));
}

void check_mesh(const json::Value& values, JsonReader& reader, const scene::Node& node) {
  const std::size_t joints = node.attributes[scene::mesh::kJoints].size();
  const std::size_t numbers = stored<std::vector<double>>(node, scene::mesh::kParts).size();
  if (numbers != joints * kPartWidth)
    reader.fail(codes::kRigValue, values["parts"],
                fmt::format("{} numbers for {} parts, not {} each", numbers, joints, kPartWidth));
}

}  // namespace

void check_data(const json::Value& values, JsonReader& reader, const scene::Scene& scene,
                scene::NodeId id) {
  const scene::Node& node = scene[id];
  if (node.kind == scene::Kind::control) check_control(values, reader, node);
  if (node.kind == scene::Kind::mesh) check_mesh(values, reader, node);
}

}  // namespace rigc::gltf
