// SPDX-License-Identifier: MIT
// Proxy meshes as skinned meshes. Test: tests/gltf/proxy_mesh_test.cpp
#include "gltf/proxy_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/json.h"
#include "gltf/float_text.h"

namespace rigc::gltf {
namespace {

using scene::NodeId;

constexpr int kVertexTarget = 34962, kIndexTarget = 34963;
constexpr double kLargest = 1e30;  // of a coordinate

ProxyPart part_of(const double* n) {
  ProxyPart part;
  part.style = n[0] == 2 ? ProxyStyle::cylinder : n[0] != 0 ? ProxyStyle::box : ProxyStyle::capsule;
  part.head = {n[1], n[2], n[3]};
  part.tail = {n[4], n[5], n[6]};
  part.side = {n[7], n[8], n[9]};
  part.width = n[10];
  part.depth = n[11];
  part.color = {n[12], n[13], n[14]};
  return part;
}

/// Triangles of one colour, in the rig's space at rest.
struct Colored {
  math::Vec3 color;
  Surface surface;
  std::vector<std::size_t> joints;  ///< of the skin, one for each point
};

void add(Colored& to, const Surface& from, const math::Affine& world, std::size_t joint) {
  const auto first = static_cast<std::uint32_t>(to.surface.points.size());
  const math::Mat3 for_normals = math::transposed(math::inverse(world.linear));
  for (std::size_t i = 0; i < from.points.size(); ++i) {
    to.surface.points.push_back(world * from.points[i]);
    to.surface.normals.push_back(math::normalised(for_normals * from.normals[i]));
    to.joints.push_back(joint);
  }
  const bool mirrored = math::determinant(world.linear) < 0;
  for (std::size_t i = 0; i < from.indices.size(); i += 3) {
    const std::uint32_t a = from.indices[i], b = from.indices[i + 1], c = from.indices[i + 2];
    to.surface.indices.insert(to.surface.indices.end(),
                              {first + a, first + (mirrored ? c : b), first + (mirrored ? b : c)});
  }
}

/// A skin's joints in the order first used, and the triangles by colour.
struct Body {
  std::vector<NodeId> joints;
  std::vector<Colored> colors;
};

Body body_of(const scene::Scene& scene, const ProxyGroup& group) {
  Body body;
  std::map<NodeId, std::size_t> numbers;
  for (std::size_t i = 0; i < group.parts.size(); ++i) {
    const auto [at, is_new] = numbers.emplace(group.joints[i], body.joints.size());
    if (is_new) body.joints.push_back(group.joints[i]);
    const math::Vec3 color = group.parts[i].color;
    auto found = std::find_if(body.colors.begin(), body.colors.end(),
                              [&](const Colored& c) { return c.color == color; });
    if (found == body.colors.end()) found = body.colors.insert(found, Colored{color, {}, {}});
    add(*found, surface(group.parts[i]), scene.rest_world(group.joints[i]), at->second);
  }
  return body;
}

bool writable(const Body& body) {
  for (const Colored& colored : body.colors) {
    for (const math::Vec3& p : colored.surface.points) {
      for (std::size_t c = 0; c < 3; ++c)
        if (!(std::abs(p[c]) <= kLargest)) return false;
    }
  }
  return true;
}

NewAccessor vectors(const std::vector<math::Vec3>& list, bool bounds) {
  NewAccessor accessor;
  accessor.type = "VEC3";
  accessor.count = list.size();
  accessor.target = kVertexTarget;
  math::Vec3 low = list[0], high = list[0];
  for (const math::Vec3& v : list) {
    for (std::size_t c = 0; c < 3; ++c) {
      append_float(accessor.data, v[c]);
      low[c] = std::min(low[c], v[c]);
      high[c] = std::max(high[c], v[c]);
    }
  }
  if (bounds) {
    accessor.min = {as_float(low.x), as_float(low.y), as_float(low.z)};
    accessor.max = {as_float(high.x), as_float(high.y), as_float(high.z)};
  }
  return accessor;
}

NewAccessor vertex_joints(const std::vector<std::size_t>& joints, bool small) {
  NewAccessor accessor;
  accessor.component = small ? ComponentType::unsigned_byte : ComponentType::unsigned_short;
  accessor.type = "VEC4";
  accessor.count = joints.size();
  accessor.target = kVertexTarget;
  for (const std::size_t joint : joints) {
    append_unsigned(accessor.data, static_cast<std::uint32_t>(joint), small ? 1 : 2);
    accessor.data.append(small ? 3 : 6, '\0');
  }
  return accessor;
}

NewAccessor vertex_weights(std::size_t count) {
  NewAccessor accessor;
  accessor.type = "VEC4";
  accessor.count = count;
  accessor.target = kVertexTarget;
  for (std::size_t i = 0; i < count; ++i)
    for (const double weight : {1.0, 0.0, 0.0, 0.0}) append_float(accessor.data, weight);
  return accessor;
}

NewAccessor triangles(const Surface& surface) {
  NewAccessor accessor;
  const bool small = surface.points.size() < 65535;
  accessor.component = small ? ComponentType::unsigned_short : ComponentType::unsigned_int;
  accessor.count = surface.indices.size();
  accessor.target = kIndexTarget;
  for (const std::uint32_t index : surface.indices)
    append_unsigned(accessor.data, index, small ? 2 : 4);
  return accessor;
}

int append_material(Patch& patch, const math::Vec3& color) {
  const double base[] = {linear_light(color.x), linear_light(color.y), linear_light(color.z), 1};
  return patch.append("materials", R"({"pbrMetallicRoughness":{"baseColorFactor":)" +
                                       float_list(base, 4) +
                                       R"(,"metallicFactor":0,"roughnessFactor":0.7}})");
}

int append_mesh(Patch& patch, const Body& body, const std::string& name) {
  json::Writer writer;
  writer.begin_object();
  if (!name.empty()) writer.member("name", name);
  writer.key("primitives").begin_array();
  for (const Colored& colored : body.colors) {
    const int position = patch.append(vectors(colored.surface.points, true));
    const int normal = patch.append(vectors(colored.surface.normals, false));
    const int joints = patch.append(vertex_joints(colored.joints, body.joints.size() <= 256));
    const int weights = patch.append(vertex_weights(colored.joints.size()));
    const int index = patch.append(triangles(colored.surface));
    const int material = append_material(patch, colored.color);
    writer.begin_object().key("attributes").begin_object();
    writer.member("POSITION", position).member("NORMAL", normal);
    writer.member("JOINTS_0", joints).member("WEIGHTS_0", weights).end_object();
    writer.member("indices", index).member("material", material).end_object();
  }
  writer.end_array().end_object();
  return patch.append("meshes", writer.take());
}

int append_skin(Patch& patch, const scene::Scene& scene, const std::vector<int>& nodes,
                const std::vector<NodeId>& joints) {
  NewAccessor accessor;
  accessor.type = "MAT4";
  accessor.count = joints.size();
  json::Writer writer;
  writer.begin_object().key("joints").begin_array();
  for (const NodeId joint : joints) {
    writer.value(nodes[joint.index]);
    const math::Affine bind = math::inverse(scene.rest_world(joint));
    const math::Vec3 columns[] = {bind.linear.x, bind.linear.y, bind.linear.z, bind.origin};
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t c = 0; c < 3; ++c) append_float(accessor.data, columns[i][c]);
      append_float(accessor.data, i == 3 ? 1 : 0);
    }
  }
  writer.end_array().member("inverseBindMatrices", patch.append(std::move(accessor)));
  return patch.append("skins", writer.end_object().take());
}

}  // namespace

std::vector<ProxyGroup> proxy_groups(const scene::Scene& scene, const std::vector<int>& roots) {
  std::vector<ProxyGroup> groups;
  for (const NodeId id : scene.nodes()) {
    const scene::Node& node = scene[id];
    if (node.kind != scene::Kind::mesh) continue;
    const auto& numbers = std::get<std::vector<double>>(node.attributes[scene::mesh::kParts][0]);
    const std::size_t count =
        std::min(node.attributes[scene::mesh::kJoints].size(), numbers.size() / kPartWidth);
    std::map<int, std::size_t> places;
    for (std::size_t i = 0; i < count; ++i) {
      const auto source = scene.source({id, scene::mesh::kJoints, static_cast<std::int32_t>(i)});
      if (!source || roots[source->node.index] < 0) continue;
      const auto [at, is_new] = places.emplace(roots[source->node.index], groups.size());
      if (is_new) groups.push_back({id, {}, {}});
      groups[at->second].joints.push_back(source->node);
      groups[at->second].parts.push_back(part_of(&numbers[i * kPartWidth]));
    }
  }
  return groups;
}

std::optional<std::string> write_proxy(Patch& patch, const scene::Scene& scene,
                                       const std::vector<int>& nodes, const ProxyGroup& group,
                                       const std::string& extras) {
  const Body body = body_of(scene, group);
  if (!writable(body)) return std::nullopt;
  const std::string& name = scene[group.mesh].name;
  json::Writer writer;
  writer.begin_object();
  if (!name.empty()) writer.member("name", name);
  writer.member("mesh", append_mesh(patch, body, name));
  writer.member("skin", append_skin(patch, scene, nodes, body.joints));
  if (!extras.empty()) writer.key("extras").raw(extras);
  return writer.end_object().take();
}

}  // namespace rigc::gltf
