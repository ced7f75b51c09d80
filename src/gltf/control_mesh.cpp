// SPDX-License-Identifier: MIT
// Control shapes as line meshes. Test: tests/gltf/control_mesh_test.cpp
#include "gltf/control_mesh.h"

#include <algorithm>

#include "base/json.h"
#include "gltf/float_text.h"

namespace rigc::gltf {
namespace {

constexpr int kLines = 1;  // primitive mode
constexpr int kIndexTarget = 34963, kVertexTarget = 34962;

/// Polylines as points and pairs of their indices.
struct Lines {
  std::vector<math::Vec3> points;
  std::vector<std::uint32_t> indices;
};

/// Stops where a count does not fit what follows it.
Lines unpack(const std::vector<double>& numbers) {
  Lines lines;
  for (std::size_t at = 0; at < numbers.size();) {
    const double most = static_cast<double>((numbers.size() - at - 1) / 3);
    if (!(numbers[at] >= 1 && numbers[at] <= most)) break;
    const auto count = static_cast<std::size_t>(numbers[at++]);
    for (std::size_t i = 0; i < count; ++i, at += 3) {
      const auto index = static_cast<std::uint32_t>(lines.points.size());
      if (i > 0) lines.indices.insert(lines.indices.end(), {index - 1, index});
      lines.points.push_back({numbers[at], numbers[at + 1], numbers[at + 2]});
    }
  }
  return lines;
}

NewAccessor positions(const std::vector<math::Vec3>& points) {
  NewAccessor accessor;
  accessor.type = "VEC3";
  accessor.count = points.size();
  accessor.target = kVertexTarget;
  for (std::size_t c = 0; c < 3; ++c) {
    accessor.min.push_back(as_float(points[0][c]));
    accessor.max.push_back(as_float(points[0][c]));
  }
  for (const math::Vec3& point : points) {
    for (std::size_t c = 0; c < 3; ++c) {
      append_float(accessor.data, point[c]);
      accessor.min[c] = std::min(accessor.min[c], as_float(point[c]));
      accessor.max[c] = std::max(accessor.max[c], as_float(point[c]));
    }
  }
  return accessor;
}

NewAccessor indices(const Lines& lines) {
  NewAccessor accessor;
  // 65535 would restart the primitive.
  const bool small = lines.points.size() < 65535;
  accessor.component = small ? ComponentType::unsigned_short : ComponentType::unsigned_int;
  accessor.count = lines.indices.size();
  accessor.target = kIndexTarget;
  for (const std::uint32_t index : lines.indices)
    append_unsigned(accessor.data, index, small ? 2 : 4);
  return accessor;
}

}  // namespace

int ControlMeshes::material(const math::Vec3& color) {
  const double light[] = {linear_light(color.x), linear_light(color.y), linear_light(color.z)};
  // Viewers that light lines need the glow, those that do not read the base colour alone.
  std::string base = float_list(light, 3);
  base.insert(base.size() - 1, ",1");
  const std::string text = R"({"emissiveFactor":)" + float_list(light, 3) +
                           R"(,"pbrMetallicRoughness":{"baseColorFactor":)" + base +
                           R"(,"metallicFactor":0}})";
  const auto found = materials_.find(text);
  if (found != materials_.end()) return found->second;
  return materials_[text] = patch_.append("materials", text);
}

int ControlMeshes::mesh(const std::vector<double>& points, const math::Vec3& color,
                        const std::string& name) {
  const Lines lines = unpack(points);
  if (lines.indices.empty()) return -1;
  NewAccessor index_accessor = indices(lines);
  NewAccessor point_accessor = positions(lines.points);
  const int color_material = material(color);
  const std::string key = std::to_string(color_material) + ':' +
                          std::to_string(lines.points.size()) + ':' + point_accessor.data +
                          index_accessor.data;
  const auto found = meshes_.find(key);
  if (found != meshes_.end()) return found->second;

  json::Writer writer;
  writer.begin_object();
  if (!name.empty()) writer.member("name", name);
  writer.key("primitives").begin_array().begin_object();
  const int position = patch_.append(std::move(point_accessor));
  const int index = patch_.append(std::move(index_accessor));
  writer.key("attributes").begin_object().member("POSITION", position).end_object();
  writer.member("indices", index).member("material", color_material).member("mode", kLines);
  writer.end_object().end_array().end_object();
  return meshes_[key] = patch_.append("meshes", writer.take());
}

}  // namespace rigc::gltf
