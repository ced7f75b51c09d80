// SPDX-License-Identifier: MIT
// Adopt: edits made where extensions are dropped come back by identity. What such a program does to
// a file is done here in JSON, and by Blender itself where it is installed.
#include "pipeline/adopt.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "base/text.h"
#include "gltf/clips.h"
#include "gltf/float_text.h"
#include "pipeline/bake_file.h"
#include "pipeline/build.h"
#include "pipeline/character_helpers.h"
#include "support/rig.h"

namespace rigc {
namespace {

using anim::Path;
using nlohmann::ordered_json;
using test::bytes_of;

/// A biped's rig with a clip on its controls, and where its parts are.
struct Shot {
  std::string path;
  int body = -1, hand = -1, settings = -1, free = -1;  ///< glTF nodes
};

anim::Channel channel(int node, Path path, std::vector<float> times, std::vector<float> values,
                      anim::Interpolation interpolation = anim::Interpolation::linear,
                      const std::string& attribute = {}) {
  anim::Channel out;
  out.node = node;
  out.path = path;
  out.attribute = attribute;
  out.curve.interpolation = interpolation;
  out.curve.width = path == Path::attribute ? 1 : path == Path::rotation ? 4 : 3;
  out.curve.times = std::make_shared<const std::vector<float>>(std::move(times));
  out.curve.values = std::move(values);
  return out;
}

int control(const gltf::Rig& rig, const std::string& local, const std::string& label,
            const std::string& role) {
  for (const scene::NodeId id : rig.scene.nodes()) {
    const scene::Node& node = rig.scene[id];
    if (node.kind == scene::Kind::control && node.ids.local == local && node.ids.label == label &&
        node.identity.role == role)
      return rig.nodes[id.index];
  }
  FAIL("no control " << local << "." << label << " " << role);
  return -1;
}

void save(gltf::Patch& patch, const gltf::File& file, const std::string& path) {
  Diagnostics diagnostics;
  std::uint64_t bytes = 0;
  REQUIRE_MESSAGE(pipeline::write_output(patch, file, path, bytes, diagnostics),
                  render(diagnostics, false));
}

Shot make_shot(const std::string& name) {
  Shot shot;
  Diagnostics diagnostics;
  pipeline::BuildRequest request;
  request.template_file = "biped";
  request.paths.templates = {test::templates_folder()};
  shot.path = test::test_out("adopt_" + name + ".glb");
  const auto built = pipeline::build(request, shot.path, diagnostics);
  REQUIRE_MESSAGE(built, render(diagnostics, false));
  shot.body = control(built->rig, "torso", "hips", "control");
  shot.hand = control(built->rig, "arm_l", "wrist", "ik");
  shot.settings = control(built->rig, "arm_l", "wrist", "settings");
  shot.free = control(built->rig, "leg_r", "ankle", "ik");
  const auto file = gltf::open(shot.path, diagnostics);
  REQUIRE(file);
  gltf::Patch patch(*file);
  const float s = std::sin(0.3f), c = std::cos(0.3f);
  anim::Clip clip{"walk", -1, {}};
  clip.channels = {
      channel(shot.body, Path::translation, {0, 0.5, 1}, {0, 0, 0, 0.1f, 0.05f, 0, 0, 0, 0.2f}),
      channel(shot.body, Path::rotation, {0, 0.5, 1}, {0, 0, 0, 1, 0, s, 0, c, -s, 0, 0, -c}),
      channel(shot.hand, Path::translation, {0, 0.25, 1}, {0, 0, 0, 0, 0.3f, 0.1f, 0.1f, 0, 0},
              anim::Interpolation::step),
      channel(shot.settings, Path::attribute, {0, 1}, {1, 0.5f}, anim::Interpolation::linear,
              "ik_fk")};
  gltf::write_clip(patch, *file, clip, {});
  save(patch, *file, shot.path);
  return shot;
}

/// Numbers of an accessor of packed floats.
std::vector<float> floats(const test::Character& character, const ordered_json& accessor) {
  static const std::map<std::string, std::size_t> kWidths = {
      {"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}};
  const auto& view = character.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  std::vector<float> out(accessor["count"].get<std::size_t>() * kWidths.at(accessor["type"]));
  const std::size_t from =
      view.value("byteOffset", std::size_t{0}) + accessor.value("byteOffset", std::size_t{0});
  std::copy_n(character.bin.data() + from, out.size() * 4, reinterpret_cast<char*>(out.data()));
  return out;
}

int add_accessor(test::Character& character, const std::string& type,
                 const std::vector<float>& values, std::size_t count) {
  ordered_json& json = character.json;
  character.bin.resize((character.bin.size() + 3) / 4 * 4, '\0');
  json["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", character.bin.size()}, {"byteLength", values.size() * 4}});
  character.bin.append(reinterpret_cast<const char*>(values.data()), values.size() * 4);
  ordered_json accessor = {{"bufferView", json["bufferViews"].size() - 1},
                           {"componentType", 5126},
                           {"type", type},
                           {"count", count}};
  if (type == "SCALAR") {
    accessor["min"] = {values.front()};
    accessor["max"] = {values.back()};
  }
  json["accessors"].push_back(accessor);
  json["buffers"][0]["byteLength"] = character.bin.size();
  return static_cast<int>(json["accessors"].size()) - 1;
}

/// What Blender leaves of a file: no extensions, no pointers; nodes in another order, under other
/// names; line meshes gone; every clip sampled at 24 frames a second, all three channels of every
/// node that it moves, up to the last whole frame.
class Foreign {
 public:
  explicit Foreign(const std::string& path) : character_(test::load_glb(path)) {
    ordered_json& json = character_.json;
    json.erase("extensions");
    json.erase("extensionsUsed");
    resample();
    const auto count = json["nodes"].size();
    const auto moved = [&](const ordered_json& node) {
      return count - 1 - node.get<std::size_t>();
    };
    std::reverse(json["nodes"].begin(), json["nodes"].end());
    for (ordered_json& node : json["nodes"]) {
      for (auto& child : node["children"]) child = moved(child);
      if (node["children"].empty()) node.erase("children");
      if (!node.contains("skin")) node.erase("mesh");
      node["name"] =
          (node.value("name", "") + "_of_the_other_program_that_likes_long_names_so_much")
              .substr(0, 59) +
          ".001";
    }
    for (ordered_json& scene : json["scenes"])
      for (auto& root : scene["nodes"]) root = moved(root);
    for (ordered_json& skin : json["skins"]) {
      for (auto& joint : skin["joints"]) joint = moved(joint);
      if (skin.contains("skeleton")) skin["skeleton"] = moved(skin["skeleton"]);
    }
    for (ordered_json& clip : json["animations"])
      for (ordered_json& channel : clip["channels"])
        channel["target"]["node"] = moved(channel["target"]["node"]);
  }

  ordered_json& json() { return character_.json; }
  test::Character& character() { return character_; }
  /// The node that says the same as one of the shot's.
  ordered_json& node(const Shot& shot, int index) {
    const auto original = test::load_glb(shot.path).json;
    const std::string identity =
        original["nodes"][static_cast<std::size_t>(index)]["extras"]["rigc"];
    for (ordered_json& node : json()["nodes"])
      if (node.contains("extras") && node["extras"].value("rigc", "") == identity) return node;
    FAIL("lost " << identity);
    return json();
  }
  int index(const ordered_json& node) { return static_cast<int>(&node - &json()["nodes"][0]); }
  void save(const std::string& path) const { test::save_glb(character_, path); }

 private:
  void resample() {
    for (ordered_json& clip : json()["animations"]) {
      ordered_json channels = ordered_json::array(), samplers = ordered_json::array();
      std::set<int> nodes;
      for (const ordered_json& channel : clip["channels"])
        if (channel["target"].contains("node")) nodes.insert(channel["target"]["node"].get<int>());
      for (const int node : nodes) {
        for (const char* path : {"translation", "rotation", "scale"}) {
          samplers.push_back(sampled(clip, node, path));
          channels.push_back(
              {{"sampler", samplers.size() - 1}, {"target", {{"node", node}, {"path", path}}}});
        }
      }
      clip["channels"] = channels;
      clip["samplers"] = samplers;
    }
  }

  ordered_json sampled(const ordered_json& clip, int node, const std::string& path) {
    const bool rotation = path == "rotation";
    const ordered_json& own = json()["nodes"][static_cast<std::size_t>(node)];
    const ordered_json standard = rotation          ? ordered_json{0, 0, 0, 1}
                                  : path == "scale" ? ordered_json{1, 1, 1}
                                                    : ordered_json{0, 0, 0};
    anim::Curve curve;
    curve.width = rotation ? 4 : 3;
    curve.times = std::make_shared<const std::vector<float>>(1, 0.0f);
    curve.values = own.value(path, standard).get<std::vector<float>>();
    for (const ordered_json& channel : clip["channels"]) {
      if (channel["target"].value("node", -1) != node || channel["target"]["path"] != path)
        continue;
      const ordered_json& sampler = clip["samplers"][channel["sampler"].get<std::size_t>()];
      const auto accessor = [&](const char* end) {
        return floats(character_, json()["accessors"][sampler[end].get<std::size_t>()]);
      };
      curve.times = std::make_shared<const std::vector<float>>(accessor("input"));
      curve.values = accessor("output");
      if (sampler.value("interpolation", "LINEAR") == "STEP")
        curve.interpolation = anim::Interpolation::step;
    }
    std::vector<float> times, values;
    for (int frame = 0; frame <= 23; ++frame) {
      times.push_back(static_cast<float>(frame) / 24);
      double value[4];
      anim::sample(curve, rotation, times.back(), value);
      for (int i = 0; i < curve.width; ++i) values.push_back(static_cast<float>(value[i]));
    }
    const int input = add_accessor(character_, "SCALAR", times, times.size());
    const int output = add_accessor(character_, rotation ? "VEC4" : "VEC3", values, times.size());
    return {{"input", input}, {"output", output}};
  }

  test::Character character_;
};

std::optional<pipeline::Adopted> adopt(const std::string& edited, const std::string& original,
                                       const std::string& out, Diagnostics& diagnostics,
                                       bool skeleton = false,
                                       const std::vector<std::string>& clips = {}) {
  pipeline::AdoptRequest request;
  request.edited = edited;
  request.original = original;
  request.skeleton = skeleton;
  request.clips = clips;
  return pipeline::adopt(request, out, diagnostics);
}

pipeline::Adopted adopted(const std::string& edited, const std::string& original,
                          const std::string& out, bool skeleton = false) {
  Diagnostics diagnostics;
  const auto result = adopt(edited, original, out, diagnostics, skeleton);
  REQUIRE_MESSAGE(result, render(diagnostics, false));
  CHECK_MESSAGE(diagnostics.all().empty(), render(diagnostics, false));
  return *result;
}

anim::Clip clip_of(const std::string& path, const std::string& name) {
  Diagnostics diagnostics;
  const auto file = gltf::open(path, diagnostics);
  REQUIRE(file);
  const auto clips = gltf::read_clips(*file, diagnostics);
  REQUIRE(clips);
  for (const anim::Clip& clip : clips->clips)
    if (clip.name == name) return clip;
  FAIL("no clip " << name);
  return {};
}

const anim::Channel* find(const anim::Clip& clip, int node, Path path) {
  for (const anim::Channel& channel : clip.channels)
    if (channel.node == node && channel.path == path) return &channel;
  return nullptr;
}

std::vector<double> value_at(const anim::Clip& clip, int node, Path path, double seconds) {
  const anim::Channel* found = find(clip, node, path);
  REQUIRE(found);
  std::vector<double> value(static_cast<std::size_t>(found->curve.width));
  anim::sample(found->curve, path == Path::rotation, seconds, value.data());
  return value;
}

gltf::Rig rig_of(const std::string& path) {
  Diagnostics diagnostics;
  const auto file = gltf::open(path, diagnostics);
  REQUIRE(file);
  auto rigs = gltf::read_rigs(*file, diagnostics);
  REQUIRE_MESSAGE(rigs, render(diagnostics, false));
  REQUIRE(rigs->size() == 1);
  return std::move(rigs->front());
}

/// Farthest that a joint comes from where it was, over the clip of two files.
double largest_motion_difference(const std::string& a, const std::string& b,
                                 const std::string& clip) {
  const auto baked = [](const std::string& path) {
    Diagnostics diagnostics;
    pipeline::BakeRequest request;
    request.file = path;
    const std::string out = path.substr(0, path.size() - 4) + "_baked.glb";
    REQUIRE_MESSAGE(pipeline::bake_file(request, out, diagnostics), render(diagnostics, false));
    return out;
  };
  const std::string first = baked(a), second = baked(b);
  const std::vector<double> times = {0, 0.1, 0.25, 0.5, 0.7, 0.9};
  const auto left = test::play(first, clip, times), right = test::play(second, clip, times);
  const auto json = test::load_glb(first).json;
  double farthest = 0;
  for (const auto& skin : json["skins"])
    for (const auto& joint : skin["joints"])
      for (std::size_t i = 0; i < times.size(); ++i)
        farthest = std::max(farthest, math::length(left[i][joint.get<std::size_t>()].origin -
                                                   right[i][joint.get<std::size_t>()].origin));
  return farthest;
}

bool near(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::abs(a[i] - b[i]) > tolerance) return false;
  return true;
}

}  // namespace

TEST_CASE("adopt: a file in which nothing was edited changes no byte") {
  const Shot shot = make_shot("same");
  Foreign foreign(shot.path);
  const std::string edited = test::test_out("adopt_same_edited.glb");
  foreign.save(edited);
  const std::string out = test::test_out("adopt_same_out.glb");
  const auto report = adopted(edited, shot.path, out, true);
  REQUIRE(report.clips.size() == 1);
  CHECK(report.clips[0].name == "walk");
  CHECK_FALSE(report.clips[0].fresh);
  CHECK(report.clips[0].same == 3);
  CHECK(report.clips[0].at_rest == 3);
  CHECK(report.clips[0].kept == 1);
  CHECK(report.clips[0].changed + report.clips[0].added == 0);
  CHECK(report.transforms + report.attributes + report.joints == 0);
  CHECK(bytes_of(out) == bytes_of(shot.path));
}

TEST_CASE("adopt: keys, clips, transforms and attributes arrive, the rest stays") {
  const Shot shot = make_shot("edit");
  Foreign foreign(shot.path);
  ordered_json& json = foreign.json();
  // Unkeyed: a control moved, an attribute set; a control that is keyed stands where its clip is.
  foreign.node(shot, shot.free)["translation"] = {0.1, 0.2, 0.3};
  foreign.node(shot, shot.settings)["extras"]["ik_fk"] = 0.25;
  foreign.node(shot, shot.body)["translation"] = {9, 9, 9};
  // Keys: the body's path at frame 6. A new clip that only turns the hand, and has the rest.
  ordered_json& walk = json["animations"][0];
  walk["name"] = "walk.001";
  const int body = foreign.index(foreign.node(shot, shot.body));
  for (const ordered_json& channel : walk["channels"]) {
    if (channel["target"]["node"] != body || channel["target"]["path"] != "translation") continue;
    ordered_json& sampler = walk["samplers"][channel["sampler"].get<std::size_t>()];
    auto values =
        floats(foreign.character(), json["accessors"][sampler["output"].get<std::size_t>()]);
    values[6 * 3 + 1] += 0.5f;
    const int output = add_accessor(foreign.character(), "VEC3", values, values.size() / 3);
    sampler["output"] = output;
  }
  const int hand = foreign.index(foreign.node(shot, shot.hand));
  const int times = add_accessor(foreign.character(), "SCALAR", {0, 1}, 2);
  const int turn = add_accessor(foreign.character(), "VEC4", {0, 0, 0, 1, 0.6f, 0, 0, 0.8f}, 2);
  const int scale = add_accessor(foreign.character(), "VEC3", {1, 1, 1, 1, 1, 1}, 2);
  json["animations"].push_back(
      {{"name", "wave"},
       {"channels",
        {{{"sampler", 0}, {"target", {{"node", hand}, {"path", "rotation"}}}},
         {{"sampler", 1}, {"target", {{"node", hand}, {"path", "scale"}}}}}},
       {"samplers",
        {{{"input", times}, {"output", turn}}, {{"input", times}, {"output", scale}}}}});
  const std::string edited = test::test_out("adopt_edit_edited.glb");
  foreign.save(edited);
  const std::string out = test::test_out("adopt_edit_out.glb");
  const auto report = adopted(edited, shot.path, out);
  CHECK(report.transforms == 1);
  CHECK(report.attributes == 1);
  REQUIRE(report.clips.size() == 2);
  CHECK(report.clips[0].name == "walk");
  CHECK(report.clips[0].changed == 1);
  CHECK(report.clips[0].same == 2);
  CHECK(report.clips[1].fresh);
  CHECK(report.clips[1].added == 1);
  CHECK(report.clips[1].at_rest == 1);

  const anim::Clip before = clip_of(shot.path, "walk"), after = clip_of(out, "walk");
  CHECK(after.channels.size() == before.channels.size());
  CHECK(near(value_at(after, shot.body, Path::translation, 0.25), {0.05, 0.525, 0}, 1e-4));
  CHECK(find(after, shot.hand, Path::translation)->curve.interpolation ==
        anim::Interpolation::step);
  CHECK(find(after, shot.settings, Path::attribute)->curve.values ==
        find(before, shot.settings, Path::attribute)->curve.values);
  CHECK(find(after, shot.body, Path::rotation)->curve.values ==
        find(before, shot.body, Path::rotation)->curve.values);
  CHECK(near(value_at(clip_of(out, "wave"), shot.hand, Path::rotation, 1), {0.6, 0, 0, 0.8}, 1e-6));
  CHECK(clip_of(out, "wave").channels.size() == 1);

  const auto there = test::load_glb(shot.path).json, here = test::load_glb(out).json;
  CHECK(here["extensions"]["RIGC_rig"] == there["extensions"]["RIGC_rig"]);
  const auto node = [&](int index) { return here["nodes"][static_cast<std::size_t>(index)]; };
  CHECK(near(node(shot.free)["translation"], {0.1, 0.2, 0.3}, 1e-6));
  CHECK(node(shot.settings)["extras"]["ik_fk"] == 0.25);
  CHECK_FALSE(node(shot.body).contains("translation"));
  // What nobody touched is as it was: all nodes but two.
  std::size_t different = 0;
  for (std::size_t i = 0; i < here["nodes"].size(); ++i)
    different += here["nodes"][i] != there["nodes"][i] ? 1 : 0;
  CHECK(different == 2);
}

TEST_CASE("adopt: placements of joints go into the tags and the joints' nodes") {
  const Shot shot = make_shot("joints");
  const gltf::Rig before = rig_of(shot.path);
  const auto joint_of = [&](const gltf::Rig& rig, const std::string& local,
                            const std::string& label) {
    for (std::size_t i = 0; i < rig.skeleton.joints.size(); ++i) {
      const Identifiers& ids = rig.skeleton.joints[i].ids;
      if (ids.local == local && ids.label == label) return i;
    }
    FAIL("no joint");
    return std::size_t{0};
  };
  // A joint without a skin: of others the bind pose counts, which is not as easily edited here.
  Foreign foreign(shot.path);
  foreign.json().erase("skins");
  for (ordered_json& node : foreign.json()["nodes"]) {
    node.erase("skin");
    node.erase("mesh");
  }
  test::Character bare = test::load_glb(shot.path);
  bare.json.erase("skins");
  for (ordered_json& node : bare.json["nodes"]) node.erase("skin");
  const std::string original = test::test_out("adopt_joints_bare.glb");
  test::save_glb(bare, original);
  const std::size_t elbow = joint_of(before, "arm_l", "elbow");
  int node = -1;
  for (const scene::NodeId id : before.scene.nodes())
    if (before.scene[id].is_skeleton() &&
        before.scene[id].identity.owner == before.skeleton.joints[elbow].key)
      node = before.nodes[id.index];
  ordered_json& edited_node = foreign.node(shot, node);
  const math::Trs rest = before.skeleton.joints[elbow].rest;
  edited_node["translation"] = {rest.translation.x, rest.translation.y + 0.05, rest.translation.z};
  const std::string edited = test::test_out("adopt_joints_edited.glb");
  foreign.save(edited);
  const std::string out = test::test_out("adopt_joints_out.glb");
  CHECK(adopted(edited, original, out, false).joints == 0);
  CHECK(rig_of(out).skeleton.joints[elbow].rest == rest);
  const auto report = adopted(edited, original, out, true);
  CHECK(report.joints == 1);
  const gltf::Rig after = rig_of(out);
  for (std::size_t i = 0; i < after.skeleton.joints.size(); ++i) {
    if (i == elbow) continue;
    CHECK(after.skeleton.joints[i].rest == before.skeleton.joints[i].rest);
  }
  const math::Trs now = after.skeleton.joints[elbow].rest;
  CHECK(math::length(now.translation - rest.translation - math::Vec3{0, 0.05, 0}) < 1e-6);
  const auto json = test::load_glb(out).json;
  CHECK(std::abs(json["nodes"][static_cast<std::size_t>(node)]["translation"][1].get<double>() -
                 now.translation.y) < 1e-6);
}

TEST_CASE("adopt: copies, strangers, files that say nothing, and clips that are not there") {
  const Shot shot = make_shot("errors");
  const std::string out = test::test_out("adopt_errors_out.glb");
  const std::string edited = test::test_out("adopt_errors_edited.glb");
  std::remove(out.c_str());
  const auto codes_of = [&](const Foreign& foreign, const std::vector<std::string>& clips = {}) {
    foreign.save(edited);
    Diagnostics diagnostics;
    adopt(edited, shot.path, out, diagnostics, false, clips);
    return test::codes(diagnostics);
  };
  Foreign silent(shot.path);
  for (ordered_json& node : silent.json()["nodes"]) node.erase("extras");
  CHECK(codes_of(silent) == "RIG0852");
  Foreign strangers(shot.path);
  for (ordered_json& node : strangers.json()["nodes"])
    if (node.contains("extras") && node["extras"].contains("rigc"))
      node["extras"]["rigc"] = "7" + node["extras"]["rigc"].get<std::string>().substr(1);
  CHECK(codes_of(strangers) == "RIG0852");
  Foreign copies(shot.path);
  copies.node(shot, shot.body)["extras"] = copies.node(shot, shot.free)["extras"];
  CHECK(codes_of(copies) == "RIG0853");
  Foreign clip(shot.path);
  CHECK(codes_of(clip, {"run"}) == "RIG0755");
  CHECK_FALSE(file_exists(out));
  Foreign stranger(shot.path);
  stranger.node(shot, shot.body)["extras"]["rigc"] = "0:0123456789abcdef";
  CHECK(codes_of(stranger) == "RIG0854");
  CHECK(file_exists(out));

  test::Character plain = test::load_glb(shot.path);
  plain.json.erase("extensions");
  plain.json.erase("extensionsUsed");
  plain.json.erase("animations");
  const std::string rigless = test::test_out("adopt_errors_rigless.glb");
  test::save_glb(plain, rigless);
  Diagnostics diagnostics;
  CHECK_FALSE(adopt(edited, rigless, out, diagnostics));
  CHECK(test::codes(diagnostics) == "RIG0754");
}

namespace {

/// Imports, runs the lines of an edit, exports; false (with a message) where there is no Blender.
bool through_blender(const std::string& in, const std::string& out, int fps,
                     const std::string& edit) {
  if (std::system("command -v blender >/dev/null 2>&1") != 0) {
    MESSAGE("no blender: its round trip is not tested");
    return false;
  }
  const std::string script = out + ".py";
  std::ofstream(script) << fmt::format(
      "import numpy\nnumpy.bool = bool\nimport bpy\n"
      "bpy.ops.wm.read_factory_settings(use_empty=True)\n"
      "bpy.context.scene.render.fps = {}\n"
      "bpy.ops.import_scene.gltf(filepath='{}', bone_heuristic='BLENDER')\n"
      "def find(identity):\n"
      "    return [o for o in bpy.data.objects if o.get('rigc') == identity][0]\n"
      "{}"
      "bpy.ops.export_scene.gltf(filepath='{}', export_format='GLB', export_extras=True,\n"
      "                          export_frame_range=False)\n",
      fps, in, edit, out);
  const std::string command = "blender -b --factory-startup --python-exit-code 3 --python '" +
                              script + "' >'" + out + ".log' 2>&1";
  std::remove(out.c_str());
  REQUIRE(std::system(command.c_str()) == 0);
  REQUIRE(file_exists(out));
  return true;
}

std::string identity(const Shot& shot, int node) {
  return test::load_glb(shot.path).json["nodes"][static_cast<std::size_t>(node)]["extras"]["rigc"];
}

}  // namespace

TEST_CASE("adopt: through Blender and back without an edit") {
  for (const int fps : {24, 30}) {
    CAPTURE(fps);
    const Shot shot = make_shot("blender");
    const std::string edited = test::test_out("adopt_blender_edited.glb");
    if (!through_blender(shot.path, edited, fps, "")) return;
    const std::string out = test::test_out("adopt_blender_out.glb");
    const auto report = adopted(edited, shot.path, out, true);
    CHECK(report.transforms + report.attributes + report.joints == 0);
    REQUIRE(report.clips.size() == 1);
    CHECK(report.clips[0].changed + report.clips[0].added == 0);
    CHECK(bytes_of(out) == bytes_of(shot.path));
  }
}

TEST_CASE("adopt: a control moved, a key changed, a property set and a joint moved in Blender") {
  const Shot shot = make_shot("blender_edit");
  const std::string edited = test::test_out("adopt_blender_edit_edited.glb");
  const gltf::Rig before = rig_of(shot.path);
  const std::string edit = fmt::format(
      "free = find('{}')\n"
      "free.location = (0.1, -0.3, 0.2)\n"  // x, -z, y
      "find('{}')['ik_fk'] = 0.25\n"
      "action = find('{}').animation_data.nla_tracks[0].strips[0].action\n"
      "curve = [f for f in action.fcurves if f.data_path == 'location' and f.array_index == 2][0]\n"
      "key = curve.keyframe_points[1]\n"
      "key.co.y += 0.5\nkey.handle_left.y += 0.5\nkey.handle_right.y += 0.5\n"
      "curve.update()\n"
      "armature = [o for o in bpy.data.objects if o.type == 'ARMATURE'][0]\n"
      "bpy.context.view_layer.objects.active = armature\n"
      "bpy.ops.object.mode_set(mode='EDIT')\n"
      "bone = armature.data.edit_bones['head_head']\n"
      "bone.head.z += 0.03\nbone.tail.z += 0.03\n"
      "bpy.ops.object.mode_set(mode='OBJECT')\n",
      identity(shot, shot.free), identity(shot, shot.settings), identity(shot, shot.body));
  if (!through_blender(shot.path, edited, 24, edit)) return;
  const std::string out = test::test_out("adopt_blender_edit_out.glb");
  const auto report = adopted(edited, shot.path, out);
  CHECK(report.transforms == 1);
  CHECK(report.attributes == 1);
  REQUIRE(report.clips.size() == 1);
  CHECK(report.clips[0].changed == 1);
  CHECK(report.clips[0].added == 0);
  const anim::Clip after = clip_of(out, "walk");
  CHECK(near(value_at(after, shot.body, Path::translation, 0.5), {0.1, 0.55, 0}, 1e-4));
  CHECK(near(value_at(after, shot.body, Path::translation, 0), {0, 0, 0}, 1e-4));
  CHECK(find(after, shot.settings, Path::attribute));
  const auto there = test::load_glb(shot.path).json, here = test::load_glb(out).json;
  CHECK(here["extensions"]["RIGC_rig"] == there["extensions"]["RIGC_rig"]);
  const auto& free = here["nodes"][static_cast<std::size_t>(shot.free)];
  CHECK(near(free["translation"], {0.1, 0.2, 0.3}, 1e-4));
  CHECK(here["nodes"][static_cast<std::size_t>(shot.settings)]["extras"]["ik_fk"] == 0.25);

  const std::string placed = test::test_out("adopt_blender_edit_placed.glb");
  const auto with_joints = adopted(edited, shot.path, placed, true);
  const gltf::Rig rig = rig_of(placed);
  for (std::size_t i = 0; i < rig.skeleton.joints.size(); ++i) {
    const math::Vec3 moved = rig.skeleton.world(i).origin - before.skeleton.world(i).origin;
    // Eyes and the tip hang on the head, and are no bones in Blender.
    const std::string& local = rig.skeleton.joints[i].ids.local;
    const double height = local.starts_with("head") && local != "head_neck" ? 0.03 : 0;
    CHECK_MESSAGE(math::length(moved - math::Vec3{0, height, 0}) < 1e-4,
                  rig.skeleton.joints[i].name, moved.x, " ", moved.y, " ", moved.z);
  }
  CHECK(with_joints.joints == 1);
}

TEST_CASE("adopt: where nothing was edited the joints move as before") {
  const Shot shot = make_shot("motion");
  Foreign foreign(shot.path);
  foreign.node(shot, shot.settings)["extras"]["ik_fk"] = 0.25;  // keyed: no effect in the clip
  const std::string edited = test::test_out("adopt_motion_edited.glb");
  foreign.save(edited);
  const std::string out = test::test_out("adopt_motion_out.glb");
  CHECK(adopted(edited, shot.path, out).attributes == 1);
  const double height = rig_of(shot.path).skeleton.character.height;
  CHECK(largest_motion_difference(shot.path, out, "walk") <= 1e-3 * height);
}

}  // namespace rigc
