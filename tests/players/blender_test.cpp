// SPDX-License-Identifier: MIT
// Baked files in Blender, where it is installed: every joint and vertex at whole frames is where
// rigc's own evaluation has it.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/files.h"
#include "pipeline/wiggle_helpers.h"
#include "players/puppet_helpers.h"
#include "support/corpus.h"

namespace rigc {
namespace {

using nlohmann::json;
using test::Puppet;
using test::ShownPrimitive;
using test::Wiggle;

constexpr double kAllowed = 1e-5;  // of the character's height

/// Characters of the corpus. RobotExpressive's bones hang under a scale of 100, and Blender keeps
/// the rest pose that theirs is relative to in 32-bit floats: it plays the model's own clips, which
/// rigc never touched, off by 1.6e-5 of the height too, and its vertices, far from their bones, by
/// three times that.
struct Played {
  const char* folder;
  double allowed;  ///< of the height
};
constexpr Played kPlayed[] = {{"gdquest_mannequiny", kAllowed},
                              {"khronos_CesiumMan", kAllowed},
                              {"gltftransform_RobotExpressive_quant", 1e-4}};

constexpr int kFrames[] = {0, 7, 11, 19, 26, 30};
constexpr std::size_t kMostVertices = 500;

/// Imports a file whose nodes are called n0, n1, ..., plays one clip, writes what it shows in
/// glTF's axes (x, z, -y).
const char* const kScript = R"(
import json, sys
import numpy
numpy.bool = bool
import bpy
from mathutils import Matrix
path, clip, out, frames, most = sys.argv[sys.argv.index('--') + 1:]
frames = [int(f) for f in frames.split(',')]
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.fps = 30
bpy.ops.import_scene.gltf(filepath=path, bone_heuristic='BLENDER')
def play(holder):
    data = holder.animation_data if holder else None
    if not data:
        return
    data.action = None
    for track in data.nla_tracks:
        track.mute = True
        if track.name == clip:
            data.action = track.strips[0].action
for o in bpy.data.objects:
    play(o)
    if o.type == 'MESH':
        play(o.data.shape_keys)
axes = Matrix(((1, 0, 0, 0), (0, 0, 1, 0), (0, -1, 0, 0), (0, 0, 0, 1)))
def numbers(matrix):
    m = axes @ matrix
    return [m[row][column] for column in range(4) for row in range(4)]
def shown():
    graph = bpy.context.evaluated_depsgraph_get()
    joints, vertices = {}, {}
    for o in bpy.data.objects:
        e = o.evaluated_get(graph)
        if o.type == 'ARMATURE':
            for bone in e.pose.bones:
                joints[bone.name] = numbers(e.matrix_world @ bone.matrix)
        if o.type == 'MESH':
            m = axes @ e.matrix_world
            mesh = e.to_mesh()
            step = max(1, -(-len(mesh.vertices) // int(most)))
            at = [c for v in list(mesh.vertices)[::step] for c in m @ v.co]
            vertices[o.name] = {'count': len(mesh.vertices), 'at': at}
            e.to_mesh_clear()
    return {'joints': joints, 'vertices': vertices}
states = []
for frame in frames:
    scene.frame_set(frame)
    states.append(shown())
json.dump(states, open(out, 'w'))
)";

/// A copy whose nodes are named by their numbers, with one clip (what only others move stays where
/// they leave it), without what only renderers need.
void save_numbered(const std::string& from, const std::string& clip, const std::string& to) {
  test::Character c = test::load_character(from);
  auto animations = nlohmann::ordered_json::array();
  for (const auto& animation : c.json["animations"])
    if (animation.value("name", "") == clip) animations.push_back(animation);
  c.json["animations"] = animations;
  for (std::size_t i = 0; i < c.json["nodes"].size(); ++i)
    c.json["nodes"][i]["name"] = "n" + std::to_string(i);
  for (const char* key : {"materials", "textures", "images", "samplers", "extensionsRequired"})
    c.json.erase(key);
  for (auto& mesh : c.json["meshes"])
    for (auto& primitive : mesh["primitives"]) primitive.erase("material");
  test::save_glb(c, to);
}

json played_by_blender(const std::string& baked, const std::string& clip) {
  // What Blender is given is not ours to validate: that folder is left out.
  std::filesystem::create_directories(test::test_out("broken"));
  const std::string base = test::test_out("broken/blender_numbered");
  save_numbered(baked, clip, base + ".glb");
  std::ofstream(base + ".py") << kScript;
  std::string frames;
  for (const int frame : kFrames) frames += (frames.empty() ? "" : ",") + std::to_string(frame);
  const std::string command = fmt::format(
      "blender -b --factory-startup --python-exit-code 3 --python '{0}.py' -- '{0}.glb' '{1}' "
      "'{0}.json' {2} {3} >'{0}.log' 2>&1",
      base, clip, frames, kMostVertices);
  std::remove((base + ".json").c_str());
  REQUIRE(std::system(command.c_str()) == 0);
  std::ifstream stream(base + ".json");
  return json::parse(stream);
}

math::Affine affine_from(const json& m) {
  const auto column = [&](std::size_t i) {
    return math::Vec3{m[4 * i].get<double>(), m[4 * i + 1].get<double>(),
                      m[4 * i + 2].get<double>()};
  };
  return {{column(0), column(1), column(2)}, column(3)};
}

/// Blender turns bones in their own space by something that does not change: what it makes of the
/// first frame says what.
class JointComparison {
 public:
  double error(const std::string& name, const math::Affine& shown, const math::Affine& wanted,
               double limb) {
    const auto [turn, is_first] = turns_.emplace(name, math::Affine{});
    if (is_first) turn->second.linear = math::inverse(wanted.linear) * shown.linear;
    return test::apart(shown, wanted * turn->second, limb);
  }
  std::size_t count() const { return turns_.size(); }

 private:
  std::map<std::string, math::Affine> turns_;
};

/// All vertices of a node's primitives that are used, as Blender joins them.
std::vector<math::Vec3> vertices_of(const Puppet& puppet, int node,
                                    const std::vector<math::Affine>& worlds, double seconds) {
  std::vector<math::Vec3> out;
  for (const ShownPrimitive& primitive : puppet.primitives()) {
    if (primitive.node != node) continue;
    const auto all = puppet.vertices(primitive, worlds, seconds);
    for (std::size_t v = 0; v < all.size(); ++v)
      if (primitive.used[v]) out.push_back(all[v]);
  }
  return out;
}

double vertex_error(const Puppet& puppet, const json& shown,
                    const std::vector<math::Affine>& worlds, double seconds) {
  double largest = 0;
  for (const auto& [name, mesh] : shown.items()) {
    const std::vector<math::Vec3> wanted =
        vertices_of(puppet, std::stoi(name.substr(1)), worlds, seconds);
    if (wanted.empty()) continue;  // a shape that Blender made for its bones
    REQUIRE(wanted.size() == mesh["count"].get<std::size_t>());
    const std::size_t step =
        std::max<std::size_t>(1, (wanted.size() + kMostVertices - 1) / kMostVertices);
    const auto at = mesh["at"].get<std::vector<double>>();
    for (std::size_t i = 0; 3 * i < at.size(); ++i)
      largest = std::max(largest, math::length(math::Vec3{at[3 * i], at[3 * i + 1], at[3 * i + 2]} -
                                               wanted[i * step]));
  }
  return largest;
}

void compare(const std::string& model, const std::string& map, const std::string& name,
             double allowed) {
  CAPTURE(name);
  const Wiggle wiggle = test::wiggle(test::rig_model(model, map, name), name, 5);
  const std::string baked = test::test_out(name + "_baked.glb");
  test::bake_wiggle(wiggle, baked);
  const json states = played_by_blender(baked, wiggle.name);
  const Puppet puppet(baked, wiggle.name);
  std::vector<double> seconds;
  for (const int frame : kFrames)
    seconds.push_back(static_cast<double>(static_cast<float>(frame / 30.0)));
  const auto worlds = puppet.worlds(seconds);
  const double height = wiggle.rigged.height;
  double joints = 0, vertices = 0;
  JointComparison comparison;
  for (std::size_t t = 0; t < seconds.size(); ++t) {
    for (const auto& [bone, matrix] : states[t]["joints"].items())
      joints =
          std::max(joints, comparison.error(bone, affine_from(matrix),
                                            worlds[t][std::stoul(bone.substr(1))], 0.1 * height));
    vertices =
        std::max(vertices, vertex_error(puppet, states[t]["vertices"], worlds[t], seconds[t]));
  }
  MESSAGE(name, ": joints ", joints / height, ", vertices ", vertices / height, " of the height");
  CHECK(comparison.count() >= 10);
  CHECK(joints < allowed * height);
  CHECK(vertices < allowed * height);
}

bool has_blender() {
  if (std::system("command -v blender >/dev/null 2>&1") == 0) return true;
  MESSAGE("no blender: not compared");
  return false;
}

}  // namespace

TEST_CASE("players blender: the biped with its proxies") {
  if (has_blender()) compare("", "", "blender_biped", kAllowed);
}

TEST_CASE("players blender: characters of the corpus, skinned and morphed") {
  if (!has_blender()) return;
  for (const test::Humanoid& humanoid : test::humanoids()) {
    const std::string folder = humanoid.file.substr(0, humanoid.file.find('/'));
    const auto played = std::find_if(std::begin(kPlayed), std::end(kPlayed),
                                     [&](const Played& one) { return folder == one.folder; });
    if (played == std::end(kPlayed)) continue;
    const std::string model = test::corpus_file(humanoid.file);
    if (!model.empty())
      compare(model, test::user_map(humanoid), "blender_" + folder, played->allowed);
  }
}

}  // namespace rigc
