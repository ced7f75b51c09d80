// SPDX-License-Identifier: MIT
// Reads one mesh as a surface. Test: tests/gltf/surface_test.cpp
#include "gltf/surface.h"

#include "base/trace.h"
#include "gltf/accessor.h"
#include "gltf/vertices.h"

namespace rigc::gltf {
namespace {

using json::Value;

/// Modes of a primitive.
constexpr std::int64_t kTriangles = 4, kStrip = 5, kFan = 6;
/// Indices are read as floats, which hold whole numbers up to here.
constexpr std::uint64_t kMostVertices = std::uint64_t{1} << 24;

using Triangle = std::array<std::uint32_t, 3>;

/// The triangles of a list of vertices (glTF 2.0, section 3.7.2.1).
std::vector<Triangle> triangles_of(const std::vector<std::uint32_t>& list, std::int64_t mode) {
  std::vector<Triangle> out;
  const std::size_t step = mode == kTriangles ? 3 : 1;
  for (std::size_t i = 0; i + 2 < list.size(); i += step) {
    if (mode == kFan)
      out.push_back({list[i + 1], list[i + 2], list[0]});
    else if (mode == kStrip && i % 2 != 0)
      out.push_back({list[i], list[i + 2], list[i + 1]});
    else
      out.push_back({list[i], list[i + 1], list[i + 2]});
  }
  return out;
}

class Reading {
 public:
  Reading(const File& file, const Slim& slim) : file_(file), slim_(slim) {}

  /// What keeps a primitive from being read; empty: nothing.
  std::string primitive(const Value& given) {
    const std::int64_t mode = given["mode"].integer().value_or(kTriangles);
    if (mode < kTriangles || mode > kFan) return {};  // points and lines are no surface
    if (given["extensions"]["KHR_draco_mesh_compression"])
      return "it is compressed: save the model without compression";
    const Value attributes = given["attributes"];
    if (!attributes["TEXCOORD_0"])
      return "it has no texture coordinates: unwrap it, with the strip straight along u or v";
    const std::uint64_t count = count_of(attributes["POSITION"]);
    const auto places = floats(attributes["POSITION"], 3, count);
    const auto texture = floats(attributes["TEXCOORD_0"], 2, count);
    if (places.empty() || texture.empty() || count > kMostVertices)
      return "its vertices cannot be read";
    auto list = indices(given["indices"], count);
    if (!list) return "its indices cannot be read";
    const auto first = static_cast<std::uint32_t>(out.places.size());
    for (std::uint32_t& index : *list) index += first;
    for (std::size_t v = 0; v < count; ++v) {
      out.places.push_back({places[3 * v], places[3 * v + 1], places[3 * v + 2]});
      out.texture.push_back({texture[2 * v], texture[2 * v + 1]});
    }
    const auto found = triangles_of(*list, mode);
    out.triangles.insert(out.triangles.end(), found.begin(), found.end());
    return {};
  }

  tags::Surface out;

 private:
  std::uint64_t count_of(const Value& accessor) const {
    const auto index = accessor.integer();
    return index ? slim_.accessors[static_cast<std::size_t>(*index)].count : 0;
  }

  std::vector<float> floats(const Value& accessor, int width, std::uint64_t count) const {
    const auto index = accessor.integer();
    if (!index || count == 0) return {};
    const SlimAccessor& facts = slim_.accessors[static_cast<std::size_t>(*index)];
    // Without a view the numbers are all zeros, or compressed.
    if (facts.width != width || facts.count != count || facts.view < 0) return {};
    Diagnostics unsaid;
    auto values = read_floats(file_, slim_, static_cast<int>(*index), count, unsaid);
    return values ? *std::move(values) : std::vector<float>{};
  }

  /// Indices of vertices in the order in which they are drawn; nothing where they are damaged.
  std::optional<std::vector<std::uint32_t>> indices(const Value& accessor,
                                                    std::uint64_t vertices) const {
    std::vector<std::uint32_t> list;
    if (!accessor) {
      for (std::uint64_t i = 0; i < vertices; ++i) list.push_back(static_cast<std::uint32_t>(i));
      return list;
    }
    const auto read = floats(accessor, 1, count_of(accessor));
    if (read.empty()) return std::nullopt;
    for (const float index : read) {
      if (!(index >= 0 && index < static_cast<float>(vertices))) return std::nullopt;
      list.push_back(static_cast<std::uint32_t>(index));
    }
    return list;
  }

  const File& file_;
  const Slim& slim_;
};

std::vector<std::pair<int, math::Affine>> bound_to(const File& file, const Slim& slim, int node) {
  const int skin = slim.node(node).skin;
  if (skin < 0) return ways_up(slim, node);
  const SlimSkin& of_node = slim.skins[static_cast<std::size_t>(skin)];
  const auto inverse = inverse_binds(file, slim, of_node);
  std::vector<std::pair<int, math::Affine>> out;
  for (std::size_t i = 0; i < inverse.size(); ++i) out.emplace_back(of_node.joints[i], inverse[i]);
  return out;
}

}  // namespace

std::vector<int> surface_nodes(const File& file, const std::string& name,
                               const std::set<int>& without) {
  const auto nodes = file.root()["nodes"].items();
  const auto meshes = file.root()["meshes"].items();
  std::vector<int> by_node, by_mesh;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto mesh = nodes[i]["mesh"].integer();
    if (!mesh || without.count(static_cast<int>(i)) != 0) continue;
    if (nodes[i]["name"].string() == name) by_node.push_back(static_cast<int>(i));
    if (meshes[static_cast<std::size_t>(*mesh)]["name"].string() == name)
      by_mesh.push_back(static_cast<int>(i));
  }
  return by_node.empty() ? by_mesh : by_node;
}

tags::Surface read_surface(const File& file, const Slim& slim, int node) {
  const trace::Span span("read surface");
  Reading reading(file, slim);
  const auto mesh = static_cast<std::size_t>(slim.node(node).mesh);
  std::string trouble;
  for (const Value& primitive : file.root()["meshes"].items()[mesh]["primitives"].items())
    if (trouble.empty()) trouble = reading.primitive(primitive);
  if (trouble.empty() && reading.out.triangles.empty()) trouble = "it has no triangles";
  tags::Surface out = trouble.empty() ? std::move(reading.out) : tags::Surface();
  out.bound = bound_to(file, slim, node);
  out.trouble = std::move(trouble);
  return out;
}

}  // namespace rigc::gltf
