// SPDX-License-Identifier: MIT
// Vertices of meshes, and those that some joints move. Test: tests/gltf/vertices_test.cpp
#include "gltf/vertices.h"

#include <algorithm>
#include <memory>
#include <set>

#include "base/trace.h"
#include "gltf/accessor.h"
#include "gltf/slim.h"
#include "gltf/surface.h"

namespace rigc::gltf {
namespace {

using json::Value;
using math::Vec3;

/// The first of the modes of a primitive that have surfaces, and the one that need not be said.
constexpr std::int64_t kTriangles = 4;

class Reading {
 public:
  Reading(const File& file, const Slim& slim) : file_(file), slim_(slim) {}

  void mesh(int mesh, const SlimSkin& skin) {
    if (!done_.insert({mesh, &skin}).second) return;
    const auto inverse = inverse_binds(file_, slim_, skin);
    if (inverse.empty()) return;
    const Value found = file_.root()["meshes"].items()[static_cast<std::size_t>(mesh)];
    for (const Value& each : found["primitives"].items()) {
      SkinnedVertices vertices;
      vertices.joints = skin.joints;
      vertices.inverse = inverse;
      if (primitive(each, vertices)) collected.push_back(std::move(vertices));
    }
  }

  /// A mesh without a skin moves with its node, which is bound to all above it as it stands.
  void rigid_mesh(int node) {
    SkinnedVertices vertices;
    for (const auto& [above, inverse] : ways_up(slim_, node)) {
      vertices.joints.push_back(above);
      vertices.inverse.push_back(inverse);
    }
    const auto mesh = static_cast<std::size_t>(slim_.node(node).mesh);
    for (const Value& each : file_.root()["meshes"].items()[mesh]["primitives"].items()) {
      if (each["mode"].integer().value_or(kTriangles) < kTriangles) continue;
      vertices.places.clear();
      if (!places(each, vertices)) continue;
      vertices.slots = 1;
      vertices.used.assign(vertices.places.size(), 0);
      vertices.weights.assign(vertices.places.size(), 1);
      collected.push_back(vertices);
    }
  }

  std::vector<SkinnedVertices> collected;

 private:
  std::vector<float> floats(const Value& accessor, int width, std::uint64_t count) {
    const auto index = accessor.integer();
    if (!index) return {};
    const SlimAccessor& facts = slim_.accessors[static_cast<std::size_t>(*index)];
    // Without a view the numbers are all zeros, or compressed.
    if (facts.width != width || facts.count != count || facts.view < 0) return {};
    Diagnostics unsaid;
    auto values = read_floats(file_, slim_, static_cast<int>(*index), count, unsaid);
    return values ? *std::move(values) : std::vector<float>{};
  }

  /// Adds the influences of one set to those of the sets before.
  static void append(std::vector<float>& all, std::size_t slots, const std::vector<float>& set) {
    std::vector<float> joined;
    joined.reserve(all.size() + set.size());
    for (std::size_t v = 0; v < set.size() / 4; ++v) {
      for (std::size_t i = 0; i < slots; ++i) joined.push_back(all[v * slots + i]);
      for (std::size_t i = 0; i < 4; ++i) joined.push_back(set[v * 4 + i]);
    }
    all = std::move(joined);
  }

  bool places(const Value& primitive, SkinnedVertices& out) {
    const auto index = primitive["attributes"]["POSITION"].integer();
    if (!index) return false;
    const std::uint64_t count = slim_.accessors[static_cast<std::size_t>(*index)].count;
    const std::vector<float> read = floats(primitive["attributes"]["POSITION"], 3, count);
    for (std::size_t i = 0; i + 2 < read.size(); i += 3)
      out.places.push_back({read[i], read[i + 1], read[i + 2]});
    return !out.places.empty();
  }

  bool primitive(const Value& primitive, SkinnedVertices& out) {
    if (!places(primitive, out)) return false;
    const Value attributes = primitive["attributes"];
    const std::uint64_t count = out.places.size();
    for (int set = 0;; ++set) {
      const std::string number = std::to_string(set);
      const std::vector<float> used = floats(attributes["JOINTS_" + number], 4, count);
      const std::vector<float> weights = floats(attributes["WEIGHTS_" + number], 4, count);
      if (used.empty() || weights.empty()) break;
      append(out.used, out.slots, used);
      append(out.weights, out.slots, weights);
      out.slots += 4;
    }
    return out.slots > 0 && check_joints(out);
  }

  /// Whether all joints are the skin's. Some exporters fill up with a joint of weight 0 that the
  /// skin does not have: it becomes the first.
  static bool check_joints(SkinnedVertices& out) {
    for (std::size_t i = 0; i < out.used.size(); ++i) {
      if (out.used[i] >= 0 && out.used[i] < static_cast<float>(out.joints.size())) continue;
      if (out.weights[i] > 0) return false;
      out.used[i] = 0;
    }
    return true;
  }

  const File& file_;
  const Slim& slim_;
  std::set<std::pair<int, const SlimSkin*>> done_;
};

/// What a reader keeps between uses.
struct Known {
  Known(const File& of, std::set<int> but) : file(of), without(std::move(but)) {}

  const Slim* read() {
    Diagnostics unsaid;
    if (!slim) slim = read_slim(file, unsaid, false);
    return slim ? &*slim : nullptr;
  }

  const File& file;
  std::set<int> without;
  std::optional<Slim> slim;
  std::optional<std::vector<SkinnedVertices>> primitives;
};

std::vector<SkinnedVertices> read_all(const File& file, const Slim& slim,
                                      const std::set<int>& without) {
  Reading reading(file, slim);
  for (std::size_t i = 0; i < slim.nodes.size(); ++i) {
    const SlimNode& node = slim.nodes[i];
    if (node.mesh >= 0 && node.skin >= 0 && without.count(static_cast<int>(i)) == 0)
      reading.mesh(node.mesh, slim.skins[static_cast<std::size_t>(node.skin)]);
  }
  return std::move(reading.collected);
}

std::vector<SkinnedVertices> read_rigid(const File& file, const Slim& slim,
                                        const std::set<int>& without,
                                        const std::vector<bool>& inside) {
  Reading reading(file, slim);
  for (std::size_t i = 0; i < slim.nodes.size(); ++i) {
    const SlimNode& node = slim.nodes[i];
    if (inside[i] && node.mesh >= 0 && node.skin < 0 && without.count(static_cast<int>(i)) == 0)
      reading.rigid_mesh(static_cast<int>(i));
  }
  return std::move(reading.collected);
}

/// By node: whether it is one of `nodes` or below one.
std::vector<bool> at_or_below(const Slim& slim, const std::vector<int>& nodes) {
  std::vector<bool> inside(slim.nodes.size(), false);
  for (int node : nodes) inside[static_cast<std::size_t>(node)] = true;
  for (int node : slim.preorder) {
    const int parent = slim.node(node).parent;
    if (parent >= 0 && inside[static_cast<std::size_t>(parent)])
      inside[static_cast<std::size_t>(node)] = true;
  }
  return inside;
}

void collect(const SkinnedVertices& from, const std::vector<bool>& inside, int first,
             std::vector<tags::BoundVertex>& out) {
  const auto at = std::find(from.joints.begin(), from.joints.end(), first);
  if (at == from.joints.end()) return;
  const math::Affine& bound = from.inverse[static_cast<std::size_t>(at - from.joints.begin())];
  for (std::size_t v = 0; v < from.places.size(); ++v) {
    double weight = 0;
    for (std::size_t i = v * from.slots; i < (v + 1) * from.slots; ++i) {
      const int node = from.joints[static_cast<std::size_t>(from.used[i])];
      if (inside[static_cast<std::size_t>(node)]) weight += static_cast<double>(from.weights[i]);
    }
    if (weight > 0) out.push_back({bound * from.places[v], weight});
  }
}

}  // namespace

std::vector<SkinnedVertices> read_vertices(const File& file, const std::set<int>& without) {
  Diagnostics unsaid;
  const auto slim = read_slim(file, unsaid, false);
  if (!slim) return {};
  auto out = read_all(file, *slim, without);
  const std::vector<bool> all(slim->nodes.size(), true);
  for (SkinnedVertices& each : read_rigid(file, *slim, without, all))
    out.push_back(std::move(each));
  return out;
}

std::vector<math::Affine> inverse_binds(const File& file, const Slim& slim, const SlimSkin& skin) {
  std::vector<math::Affine> out(skin.joints.size());
  if (skin.matrices < 0) return out;
  Diagnostics unsaid;
  const auto read = read_floats(file, slim, skin.matrices, out.size(), unsaid);
  if (!read) return {};
  for (std::size_t i = 0; i < out.size(); ++i) {
    const float* m = &(*read)[i * 16];
    const auto column = [&](int c) { return Vec3{m[4 * c], m[4 * c + 1], m[4 * c + 2]}; };
    out[i] = {{column(0), column(1), column(2)}, column(3)};
  }
  return out;
}

std::vector<std::pair<int, math::Affine>> ways_up(const Slim& slim, int node) {
  std::vector<std::pair<int, math::Affine>> out;
  math::Affine way;
  for (int above = node; above >= 0; above = slim.node(above).parent) {
    out.emplace_back(above, way);
    way = slim.node(above).matrix * way;
  }
  return out;
}

tags::Geometry geometry_of(const File& file, std::set<int> without) {
  auto known = std::make_shared<Known>(file, std::move(without));
  tags::Geometry out;
  out.vertices = [known](const std::vector<int>& nodes) {
    std::vector<tags::BoundVertex> found;
    const Slim* slim = known->read();
    if (!slim) return found;
    if (!known->primitives) {
      const trace::Span span("read vertices");
      known->primitives = read_all(known->file, *slim, known->without);
    }
    const std::vector<bool> inside = at_or_below(*slim, nodes);
    for (const SkinnedVertices& each : *known->primitives)
      collect(each, inside, nodes.front(), found);
    // Only what is asked for: a scene may be full of things that no rig moves.
    for (const SkinnedVertices& each : read_rigid(known->file, *slim, known->without, inside))
      collect(each, inside, nodes.front(), found);
    return found;
  };
  out.surfaces = [known](const std::string& name) {
    std::vector<tags::Surface> found;
    const Slim* slim = known->read();
    if (!slim) return found;
    for (const int node : surface_nodes(known->file, name, known->without))
      found.push_back(read_surface(known->file, *slim, node));
    return found;
  };
  return out;
}

}  // namespace rigc::gltf
