// SPDX-License-Identifier: MIT
// Binds skins to joints along a bone. Test: tests/gltf/split_weights_test.cpp
#include "gltf/split_weights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <set>

#include "base/text.h"
#include "base/trace.h"
#include "gltf/accessor.h"
#include "gltf/rig_codes.h"
#include "gltf/share_weights.h"
#include "gltf/slim.h"
#include "gltf/splice.h"
#include "gltf/surface.h"

namespace rigc::gltf {
namespace {

using json::Value;
using math::Affine;
using math::Vec3;
using scene::NodeId;

constexpr int kVertexTarget = 34962;
constexpr int kByte = 5121, kShort = 5123, kReal = 5126;

int index_of(const Value& value) { return static_cast<int>(value.integer().value_or(-1)); }

/// A bone, or a line that stands for one, whose weights are to be shared.
struct Bone {
  NodeId joint;            ///< whose weights are shared
  Vec3 end;                ///< end of the bone in its space, at rest
  std::vector<Vec3> line;  ///< in its space, at rest; empty: the bone
  std::string surface;     ///< whose vertices alone share; empty: all
  std::set<int> meshes;    ///< the surface's
  double fraction = 0;     ///< of the joint's own stop; less than 0: it has none
  std::vector<NodeId> joints;
  std::vector<double> fractions;
  bool shared = false;  ///< a weight was shared, or was before
};

std::optional<Bone> bone_of(const scene::Scene& scene, NodeId id) {
  namespace skin_split = scene::skin_split;
  Bone bone;
  std::vector<NodeId> joints;
  for (const scene::Connection& connection : scene[id].inputs)
    if (connection.to.attribute == skin_split::kJoints &&
        scene::spec(scene[connection.from.node].kind).is_transform)
      joints.push_back(connection.from.node);
  const auto& fractions =
      std::get<std::vector<double>>(scene[id].attributes[skin_split::kFractions][0]);
  if (joints.size() < 3 || fractions.size() + 1 != joints.size()) return std::nullopt;
  bone.joint = joints[0];
  bone.end = (math::inverse(scene.rest_world(joints[0])) * scene.rest_world(joints[1])).origin;
  bone.fraction = fractions[0];
  bone.joints.assign(joints.begin() + 2, joints.end());
  bone.fractions.assign(fractions.begin() + 1, fractions.end());
  bone.surface = std::get<std::string>(scene[id].attributes[skin_split::kSurface][0]);
  const auto& line = std::get<std::vector<double>>(scene[id].attributes[skin_split::kLine][0]);
  for (std::size_t i = 0; i + 2 < line.size(); i += 3)
    bone.line.push_back({line[i], line[i + 1], line[i + 2]});
  if (bone.line.size() < 2 && !(math::length(bone.end) > 0)) return std::nullopt;
  return bone;
}

/// The meshes of a surface in the model; `rig`'s own are no part of it.
std::set<int> meshes_of(const File& file, const Rig& rig, const std::string& surface) {
  std::set<int> own, out;
  for (const NodeId id : rig.scene.nodes())
    if (!rig.scene[id].is_skeleton()) own.insert(rig.nodes[id.index]);
  const auto nodes = file.root()["nodes"].items();
  for (const int node : surface_nodes(file, surface, own))
    out.insert(index_of(nodes[static_cast<std::size_t>(node)]["mesh"]));
  return out;
}

Affine affine(const float* m) {
  return {{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}}, {m[12], m[13], m[14]}};
}

void append_matrix(std::vector<float>& out, const Affine& a) {
  const Vec3 columns[4] = {a.linear.x, a.linear.y, a.linear.z, a.origin};
  for (std::size_t c = 0; c < 4; ++c)
    for (std::size_t r = 0; r < 4; ++r)
      out.push_back(r == 3 ? (c == 3 ? 1.0f : 0.0f) : static_cast<float>(columns[c][r]));
}

template <class T>
std::string packed(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// A slice of four slots of each vertex, as an accessor of components `T`.
template <class T, class From>
NewAccessor slice(const std::vector<From>& values, std::size_t slots, std::size_t set) {
  std::vector<T> out;
  out.reserve(values.size() / slots * 4);
  for (std::size_t v = 0; v < values.size(); v += slots)
    for (std::size_t i = 0; i < 4; ++i) out.push_back(static_cast<T>(values[v + 4 * set + i]));
  NewAccessor accessor;
  accessor.count = values.size() / slots;
  accessor.data = packed(out);
  accessor.type = "VEC4";
  accessor.target = kVertexTarget;
  return accessor;
}

/// Accessors of a primitive that is bound to a skin.
struct Bound {
  std::vector<int> joints, weights;  ///< by set
  int positions = -1;
  std::vector<bool> shares;  ///< by bone: whether it may share them
  auto operator<=>(const Bound&) const = default;
};

class Splitter {
 public:
  Splitter(Patch& patch, const Slim& slim, Rig& rig, std::vector<Bone>& bones,
           Diagnostics& diagnostics)
      : patch_(patch), slim_(slim), rig_(rig), bones_(bones), diagnostics_(diagnostics) {}

  void run() {
    std::map<int, std::set<int>> meshes, skins;  // of each skin, of each mesh
    for (const Value& node : patch_.file().root()["nodes"].items()) {
      const int mesh = index_of(node["mesh"]), skin = index_of(node["skin"]);
      if (mesh < 0 || skin < 0 || rig_.owned.stays.skins.contains(skin)) continue;
      if (mesh >= patch_.count("meshes") || skin >= patch_.count("skins")) continue;
      meshes[skin].insert(mesh);
      skins[mesh].insert(skin);
    }
    for (const auto& [skin, bound] : meshes) {
      std::set<int> own;
      for (const int mesh : bound) {
        if (skins[mesh].size() == 1)
          own.insert(mesh);
        else if (choose_bones(skin, {mesh}))
          warn("meshes", mesh, "it is drawn with several skins");
      }
      split_skin(skin, own);
    }
  }

 private:
  void warn(const char* array, int index, const std::string& why) {
    if (!warned_.emplace(array, index).second) return;
    const char* what = std::strcmp(array, "skins") == 0 ? "skin" : "mesh";
    diagnostics_.report(codes::kNotShared,
                        Place(patch_.file().path, fmt::format("/{}/{}", array, index)),
                        fmt::format("weights of {} {} are not shared: {}", what, index, why));
  }

  /// The bones that a skin is to be split along for some meshes, and their joints in its list.
  /// False where it has none, or has their new joints already.
  bool choose_bones(int skin, const std::set<int>& meshes) {
    joints_.clear();
    of_skin_.clear();
    const json::Document document = parsed(patch_.element("skins", skin));
    for (const Value& joint : document.root()["joints"].items())
      joints_.emplace(index_of(joint), joints_.size());
    for (Bone& bone : bones_) {
      if (joints_.count(node(bone.joint)) == 0) continue;
      if (!bone.surface.empty() && std::none_of(meshes.begin(), meshes.end(), [&](int mesh) {
            return bone.meshes.count(mesh) != 0;
          }))
        continue;
      const bool known = std::any_of(bone.joints.begin(), bone.joints.end(),
                                     [&](NodeId joint) { return joints_.count(node(joint)) != 0; });
      bone.shared = bone.shared || known;
      if (!known) of_skin_.push_back(&bone);
    }
    return !of_skin_.empty();
  }

  int node(NodeId id) const { return rig_.nodes[id.index]; }

  void split_skin(int skin, const std::set<int>& meshes) {
    if (!choose_bones(skin, meshes) || meshes.empty()) return;
    const json::Document document = parsed(patch_.element("skins", skin));
    const int matrices = index_of(document.root()["inverseBindMatrices"]);
    const std::size_t count = document.root()["joints"].size();
    if (matrices < 0) return warn("skins", skin, "it has no inverse bind matrices");
    Diagnostics reading;
    auto floats = read_floats(patch_.file(), slim_, matrices, count, reading);
    if (!floats) return warn("skins", skin, "its inverse bind matrices cannot be read");
    floats->resize(count * 16);

    Splice list(document.root()["joints"]);
    std::vector<Sharing> sharings;
    joint_count_ = count;
    added_.clear();
    for (const Bone* bone : of_skin_) sharings.push_back(add_joints(*bone, list, *floats));
    known_.clear();
    const std::size_t before = rig_.rebound.primitives.size();
    for (const int mesh : meshes) split_mesh(mesh, sharings);
    if (rig_.rebound.primitives.size() == before) return;

    NewAccessor accessor;
    accessor.count = floats->size() / 16;
    accessor.data = packed(*floats);
    accessor.type = "MAT4";
    const int now = patch_.append(std::move(accessor));
    patch_.set_member("skins", skin, "joints", list.text());
    patch_.set_member("skins", skin, "inverseBindMatrices", std::to_string(now));
    rig_.rebound.skins.push_back({skin, static_cast<int>(count), matrices, now});
  }

  /// Appends a bone's new joints to a skin's list and matrices.
  Sharing add_joints(const Bone& bone, Splice& list, std::vector<float>& matrices) {
    Sharing out;
    out.joint = joints_.at(node(bone.joint));
    const Affine inverse_bind = affine(matrices.data() + 16 * out.joint);
    if (bone.line.empty()) {
      const Vec3 end = bone.end * (1 / math::dot(bone.end, bone.end));
      out.along = math::transposed(inverse_bind.linear) * end;
      out.begin = math::dot(inverse_bind.origin, end);
    }
    const Affine to_mesh = math::inverse(inverse_bind);
    for (const Vec3& point : bone.line) out.line.push_back(to_mesh * point);
    if (bone.fraction >= 0) out.stops.push_back({bone.fraction, out.joint});
    const Affine to_joint = math::inverse(rig_.scene.rest_world(bone.joint));
    for (std::size_t i = 0; i < bone.joints.size(); ++i) {
      const auto [known, is_new] = added_.try_emplace(bone.joints[i], joint_count_);
      out.stops.push_back({bone.fractions[i], known->second});
      if (!is_new) continue;  // of another bone; or a line that goes round has one at both ends
      ++joint_count_;
      list.append(std::to_string(node(bone.joints[i])));
      const Affine local = to_joint * rig_.scene.rest_world(bone.joints[i]);
      append_matrix(matrices, math::inverse(local) * inverse_bind);
    }
    std::stable_sort(out.stops.begin(), out.stops.end(),
                     [](const auto& a, const auto& b) { return a.fraction < b.fraction; });
    return out;
  }

  void split_mesh(int mesh, const std::vector<Sharing>& sharings) {
    const json::Document document = parsed(patch_.element("meshes", mesh));
    const auto items = document.root()["primitives"].items();
    Splice primitives(document.root()["primitives"]);
    const std::size_t before = rig_.rebound.primitives.size();
    for (std::size_t i = 0; i < items.size(); ++i) {
      const auto bound = bound_of(items[i], mesh);
      if (!bound) continue;
      auto known = known_.find(*bound);
      if (known == known_.end())
        known = known_.emplace(*bound, split(*bound, mesh, sharings)).first;
      if (known->second.empty()) continue;
      Splice attributes(items[i]["attributes"]);
      for (const Rebound::Attribute& attribute : known->second)
        attributes.set(attribute.name, std::to_string(attribute.now));
      primitives.replace(
          i, with_member(std::string(items[i].text()), "attributes", attributes.text()));
      rig_.rebound.primitives.push_back({mesh, static_cast<int>(i), known->second});
    }
    if (rig_.rebound.primitives.size() != before)
      patch_.set_member("meshes", mesh, "primitives", primitives.text());
  }

  /// Accessors of a primitive; none where its weights cannot be shared, which is said.
  std::optional<Bound> bound_of(const Value& primitive, int mesh) {
    const Value attributes = primitive["attributes"];
    Bound out;
    out.positions = index_of(attributes["POSITION"]);
    for (const Bone* bone : of_skin_)
      out.shares.push_back(bone->surface.empty() || bone->meshes.count(mesh) != 0);
    for (;;) {
      const std::string set = std::to_string(out.joints.size());
      const int joints = index_of(attributes["JOINTS_" + set]);
      const int weights = index_of(attributes["WEIGHTS_" + set]);
      if (joints < 0 || weights < 0) break;
      out.joints.push_back(joints);
      out.weights.push_back(weights);
    }
    if (out.joints.empty() || out.positions < 0) return std::nullopt;
    if (primitive["extensions"]["KHR_draco_mesh_compression"]) {
      warn("meshes", mesh, "it is compressed");
      return std::nullopt;
    }
    return out;
  }

  std::optional<std::vector<float>> read(int accessor, int width, std::uint64_t count) {
    const SlimAccessor& facts = slim_.accessors[static_cast<std::size_t>(accessor)];
    if (facts.width != width || facts.count != count) return std::nullopt;
    Diagnostics reading;
    return read_floats(patch_.file(), slim_, accessor, count, reading);
  }

  const SlimAccessor& facts(int accessor) const {
    return slim_.accessors[static_cast<std::size_t>(accessor)];
  }

  /// New accessors for a primitive; none where nothing is shared.
  std::vector<Rebound::Attribute> split(const Bound& bound, int mesh,
                                        const std::vector<Sharing>& sharings) {
    if (std::find(bound.shares.begin(), bound.shares.end(), true) == bound.shares.end()) return {};
    const std::uint64_t count = facts(bound.positions).count;
    const auto positions = read(bound.positions, 3, count);
    auto vertices = read_weights(bound, count);
    if (!positions || !vertices) {
      warn("meshes", mesh, "its vertices cannot be read");
      return {};
    }
    std::vector<Sharing> own;
    std::vector<Bone*> bones;
    for (std::size_t i = 0; i < sharings.size(); ++i) {
      if (!bound.shares[i]) continue;
      own.push_back(sharings[i]);
      bones.push_back(of_skin_[i]);
    }
    const std::vector<bool> shared = share(*vertices, *positions, own);
    for (std::size_t i = 0; i < shared.size(); ++i)
      bones[i]->shared = bones[i]->shared || shared[i];
    if (std::find(shared.begin(), shared.end(), true) == shared.end()) return {};
    return write_weights(bound, *vertices);
  }

  std::optional<VertexWeights> read_weights(const Bound& bound, std::uint64_t count) {
    VertexWeights out;
    out.slots = 4 * bound.joints.size();
    out.joints.resize(count * out.slots);
    out.weights.resize(count * out.slots);
    const int component = facts(bound.weights[0]).component;
    if (component != kByte && component != kShort && component != kReal) return std::nullopt;
    out.whole = component != kReal;
    const float unit = component == kByte ? 255.0f : component == kShort ? 65535.0f : 1.0f;
    for (std::size_t set = 0; set < bound.joints.size(); ++set) {
      const int of_joints = facts(bound.joints[set]).component;
      if (facts(bound.weights[set]).component != component ||
          (of_joints != kByte && of_joints != kShort))
        return std::nullopt;
      const auto joints = read(bound.joints[set], 4, count);
      const auto weights = read(bound.weights[set], 4, count);
      if (!joints || !weights) return std::nullopt;
      for (std::size_t i = 0; i < joints->size(); ++i) {
        const std::size_t slot = i / 4 * out.slots + 4 * set + i % 4;
        out.joints[slot] = static_cast<std::uint16_t>((*joints)[i]);
        const float weight = (*weights)[i] * unit;
        out.weights[slot] =
            out.whole ? static_cast<float>(static_cast<int>(weight + 0.5f)) : weight;
      }
    }
    return out;
  }

  std::vector<Rebound::Attribute> write_weights(const Bound& bound, const VertexWeights& vertices) {
    std::vector<Rebound::Attribute> out;
    const std::size_t sets = bound.joints.size();
    for (std::size_t set = 0; set < vertices.slots / 4; ++set) {
      const std::size_t model = std::min(set, sets - 1);  // whose component type it has
      const auto add = [&](const char* name, const std::vector<int>& before, NewAccessor accessor) {
        out.push_back({name + std::to_string(set), set < sets ? before[set] : -1,
                       patch_.append(std::move(accessor))});
      };
      const bool wide = joint_count_ > 256 || facts(bound.joints[model]).component == kShort;
      NewAccessor joints = wide ? slice<std::uint16_t>(vertices.joints, vertices.slots, set)
                                : slice<std::uint8_t>(vertices.joints, vertices.slots, set);
      joints.component = wide ? ComponentType::unsigned_short : ComponentType::unsigned_byte;
      add("JOINTS_", bound.joints, std::move(joints));
      const int component = facts(bound.weights[model]).component;
      NewAccessor weights =
          component == kByte    ? slice<std::uint8_t>(vertices.weights, vertices.slots, set)
          : component == kShort ? slice<std::uint16_t>(vertices.weights, vertices.slots, set)
                                : slice<float>(vertices.weights, vertices.slots, set);
      weights.component = static_cast<ComponentType>(component);
      weights.normalised = vertices.whole;
      add("WEIGHTS_", bound.weights, std::move(weights));
    }
    return out;
  }

  Patch& patch_;
  const Slim& slim_;
  Rig& rig_;
  std::vector<Bone>& bones_;
  Diagnostics& diagnostics_;
  std::set<std::pair<std::string, int>> warned_;
  // Of the skin that is being split.
  std::map<int, std::size_t> joints_;  ///< places in its list by node
  std::vector<Bone*> of_skin_;
  std::map<NodeId, std::size_t> added_;  ///< places of the new ones
  std::size_t joint_count_ = 0;
  std::map<Bound, std::vector<Rebound::Attribute>> known_;
};

}  // namespace

std::set<NodeId> split_weights(Patch& patch, Rig& rig, Diagnostics& diagnostics) {
  rig.rebound = {};
  if (!rig.settings.split_weights) return {};
  std::vector<Bone> bones;
  for (const NodeId id : rig.scene.nodes())
    if (rig.scene[id].kind == scene::Kind::skin_split)
      if (auto bone = bone_of(rig.scene, id)) bones.push_back(*std::move(bone));
  if (bones.empty()) return {};
  for (Bone& bone : bones)
    if (!bone.surface.empty()) bone.meshes = meshes_of(patch.file(), rig, bone.surface);
  const trace::Span span("split weights");
  Diagnostics reading;
  const auto slim = read_slim(patch.file(), reading, false);
  if (slim) Splitter(patch, *slim, rig, bones, diagnostics).run();
  std::set<NodeId> shared;
  for (const Bone& bone : bones)
    if (bone.shared) shared.insert(bone.joints.begin(), bone.joints.end());
  return shared;
}

}  // namespace rigc::gltf
