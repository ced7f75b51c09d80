// SPDX-License-Identifier: MIT
// For tests of adopt.
#include "pipeline/adopt_helpers.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "gltf/clips.h"
#include "pipeline/build.h"

namespace rigc::test {

using anim::Path;
using nlohmann::ordered_json;

namespace {

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

}  // namespace

std::string WalkShot::identity(int node) const {
  return load_glb(path).json["nodes"][static_cast<std::size_t>(node)]["extras"]["rigc"];
}

WalkShot make_shot(const std::string& name) {
  WalkShot shot;
  Diagnostics diagnostics;
  pipeline::BuildRequest request;
  request.template_file = "biped";
  request.paths.templates = {templates_folder()};
  shot.path = test_out("adopt_" + name + ".glb");
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
std::vector<float> OtherProgram::floats(const ordered_json& accessor) const {
  static const std::map<std::string, std::size_t> kWidths = {
      {"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}};
  const auto& view = character_.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  std::vector<float> out(accessor["count"].get<std::size_t>() * kWidths.at(accessor["type"]));
  const std::size_t from =
      view.value("byteOffset", std::size_t{0}) + accessor.value("byteOffset", std::size_t{0});
  std::copy_n(character_.bin.data() + from, out.size() * 4, reinterpret_cast<char*>(out.data()));
  return out;
}

int OtherProgram::add_accessor(const std::string& type, const std::vector<float>& values,
                               std::size_t count) {
  ordered_json& json = character_.json;
  character_.bin.resize((character_.bin.size() + 3) / 4 * 4, '\0');
  json["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", character_.bin.size()}, {"byteLength", values.size() * 4}});
  character_.bin.append(reinterpret_cast<const char*>(values.data()), values.size() * 4);
  ordered_json accessor = {{"bufferView", json["bufferViews"].size() - 1},
                           {"componentType", 5126},
                           {"type", type},
                           {"count", count}};
  if (type == "SCALAR") {
    accessor["min"] = {values.front()};
    accessor["max"] = {values.back()};
  }
  json["accessors"].push_back(accessor);
  json["buffers"][0]["byteLength"] = character_.bin.size();
  return static_cast<int>(json["accessors"].size()) - 1;
}

OtherProgram::OtherProgram(const std::string& path) : character_(load_glb(path)) {
  ordered_json& json = character_.json;
  json.erase("extensions");
  json.erase("extensionsUsed");
  resample();
  const auto count = json["nodes"].size();
  const auto moved = [&](const ordered_json& node) { return count - 1 - node.get<std::size_t>(); };
  std::reverse(json["nodes"].begin(), json["nodes"].end());
  for (ordered_json& node : json["nodes"]) {
    for (auto& child : node["children"]) child = moved(child);
    if (node["children"].empty()) node.erase("children");
    if (!node.contains("skin")) node.erase("mesh");
    node["name"] = (node.value("name", "") + "_of_the_other_program_that_likes_long_names_so_much")
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

ordered_json& OtherProgram::node(const WalkShot& shot, int index) {
  const auto original = load_glb(shot.path).json;
  const std::string identity = original["nodes"][static_cast<std::size_t>(index)]["extras"]["rigc"];
  for (ordered_json& node : json()["nodes"])
    if (node.contains("extras") && node["extras"].value("rigc", "") == identity) return node;
  FAIL("lost " << identity);
  return json();
}

int OtherProgram::index(const ordered_json& node) {
  return static_cast<int>(&node - &json()["nodes"][0]);
}

void OtherProgram::resample() {
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

ordered_json OtherProgram::sampled(const ordered_json& clip, int node, const std::string& path) {
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
    if (channel["target"].value("node", -1) != node || channel["target"]["path"] != path) continue;
    const ordered_json& sampler = clip["samplers"][channel["sampler"].get<std::size_t>()];
    const auto accessor = [&](const char* end) {
      return floats(json()["accessors"][sampler[end].get<std::size_t>()]);
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
  const int input = add_accessor("SCALAR", times, times.size());
  const int output = add_accessor(rotation ? "VEC4" : "VEC3", values, times.size());
  return {{"input", input}, {"output", output}};
}

void OtherProgram::move_bind(const math::Affine& motion) {
  const math::Affine back = inverse(motion);
  std::set<std::size_t> done;
  for (const ordered_json& skin : json()["skins"]) {
    const auto index = skin["inverseBindMatrices"].get<std::size_t>();
    if (!done.insert(index).second) continue;
    const ordered_json& accessor = json()["accessors"][index];
    const ordered_json& view = json()["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    char* bytes = character_.bin.data() + view.value("byteOffset", std::size_t{0}) +
                  accessor.value("byteOffset", std::size_t{0});
    auto* m = reinterpret_cast<float*>(bytes);
    for (std::size_t i = 0; i < accessor["count"].get<std::size_t>(); ++i, m += 16) {
      const auto column = [&](std::size_t c) {
        return math::Vec3{m[4 * c], m[4 * c + 1], m[4 * c + 2]};
      };
      const math::Affine moved = math::Affine{{column(0), column(1), column(2)}, column(3)} * back;
      const math::Vec3 columns[] = {moved.linear.x, moved.linear.y, moved.linear.z, moved.origin};
      for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t k = 0; k < 3; ++k) m[4 * c + k] = static_cast<float>(columns[c][k]);
    }
  }
}

std::optional<pipeline::Adopted> adopt(const std::string& edited, const std::string& original,
                                       const std::string& out, Diagnostics& diagnostics,
                                       bool skeleton, const std::vector<std::string>& clips) {
  pipeline::AdoptRequest request;
  request.edited = edited;
  request.original = original;
  request.skeleton = skeleton;
  request.clips = clips;
  return pipeline::adopt(request, out, diagnostics);
}

pipeline::Adopted adopted(const std::string& edited, const std::string& original,
                          const std::string& out, bool skeleton) {
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

bool near(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::abs(a[i] - b[i]) > tolerance) return false;
  return true;
}

}  // namespace rigc::test
