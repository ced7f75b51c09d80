// SPDX-License-Identifier: MIT
// Characters as plain JSON and bytes, changed copies, and a small player.
#include "pipeline/character_helpers.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <random>
#include <sstream>

#include "base/files.h"
#include "gltf/clips.h"

namespace rigc::test {
namespace {

using nlohmann::ordered_json;

std::uint32_t word(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

void put_word(std::string& bytes, std::uint32_t value) {
  bytes.append(reinterpret_cast<const char*>(&value), 4);
}

std::size_t inverse_bind_offset(const ordered_json& json, std::size_t joint) {
  const auto& accessor =
      json["accessors"][json["skins"][0]["inverseBindMatrices"].get<std::size_t>()];
  const auto& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  return view.value("byteOffset", std::size_t{0}) + accessor.value("byteOffset", std::size_t{0}) +
         joint * 64;
}

math::Affine read_inverse_bind(const Character& c, std::size_t joint) {
  float m[16];
  std::memcpy(m, c.bin.data() + inverse_bind_offset(c.json, joint), 64);
  return {{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}}, {m[12], m[13], m[14]}};
}

void write_inverse_bind(Character& c, std::size_t joint, const math::Affine& a) {
  const math::Vec3 columns[4] = {a.linear.x, a.linear.y, a.linear.z, a.origin};
  float m[16];
  for (int i = 0; i < 4; ++i) {
    m[4 * i] = static_cast<float>(columns[i].x);
    m[4 * i + 1] = static_cast<float>(columns[i].y);
    m[4 * i + 2] = static_cast<float>(columns[i].z);
    m[4 * i + 3] = i == 3 ? 1.0f : 0.0f;
  }
  std::memcpy(c.bin.data() + inverse_bind_offset(c.json, joint), m, 64);
}

/// The node above all joints: the skeleton's root hangs under it.
int ancestor_of(const ordered_json& json) {
  const std::vector<int> parents = parents_of(json);
  std::vector<bool> joint(parents.size(), false);
  for (int j : json["skins"][0]["joints"]) joint[static_cast<std::size_t>(j)] = true;
  int at = json["skins"][0]["joints"][0];
  while (at >= 0 && joint[static_cast<std::size_t>(at)]) at = parents[static_cast<std::size_t>(at)];
  return at;
}

}  // namespace

std::string test_out(const std::string& name) { return std::string(RIGC_TEST_OUT) + "/" + name; }
std::string templates_folder() { return std::string(RIGC_SOURCE_DIR) + "/templates"; }

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

Character load_glb(const std::string& path) {
  const std::string bytes = bytes_of(path);
  REQUIRE(bytes.size() > 20);
  const std::size_t length = word(bytes, 12);
  Character c;
  c.json = ordered_json::parse(bytes.substr(20, length));
  if (bytes.size() > 28 + length) c.bin = bytes.substr(28 + length, word(bytes, 20 + length));
  return c;
}

void save_glb(const Character& c, const std::string& path) {
  std::string json = c.json.dump();
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string out = "glTF";
  put_word(out, 2);
  put_word(out, static_cast<std::uint32_t>(28 + json.size() + c.bin.size()));
  put_word(out, static_cast<std::uint32_t>(json.size()));
  out += "JSON" + json;
  put_word(out, static_cast<std::uint32_t>(c.bin.size()));
  out += std::string("BIN\0", 4) + c.bin;
  std::ofstream(path, std::ios::binary) << out;
}

std::string corpus_file(const std::string& name) {
  const char* folder = std::getenv("RIGC_CORPUS");
  const std::string path =
      join_path(folder ? folder : std::string(RIGC_SOURCE_DIR) + "/../shared/corpus", name);
  if (file_exists(path)) return path;
  MESSAGE("corpus file not here, part of the test does not run: " << name);
  return {};
}

void made_from(const std::string& path, const std::string& model) {
  const bool beside = folder_of(path) == folder_of(model);
  std::ofstream(path + ".model") << (beside ? model.substr(model.rfind('/') + 1) : model) << "\n";
}

math::Affine local_of(const ordered_json& node) {
  if (node.contains("matrix")) {
    const auto m = node["matrix"].get<std::vector<double>>();
    return {{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}}, {m[12], m[13], m[14]}};
  }
  math::Trs trs;
  if (node.contains("translation")) {
    const auto t = node["translation"].get<std::vector<double>>();
    trs.translation = {t[0], t[1], t[2]};
  }
  if (node.contains("rotation")) {
    const auto r = node["rotation"].get<std::vector<double>>();
    trs.rotation = math::normalised(math::Quat{r[0], r[1], r[2], r[3]});
  }
  if (node.contains("scale")) {
    const auto s = node["scale"].get<std::vector<double>>();
    trs.scale = {s[0], s[1], s[2]};
  }
  return math::compose(trs);
}

void set_local(ordered_json& node, const math::Affine& local) {
  const math::Trs trs = math::decompose(local);
  node.erase("matrix");
  node["translation"] = {trs.translation.x, trs.translation.y, trs.translation.z};
  node["rotation"] = {trs.rotation.x, trs.rotation.y, trs.rotation.z, trs.rotation.w};
  node["scale"] = {trs.scale.x, trs.scale.y, trs.scale.z};
}

std::vector<int> parents_of(const ordered_json& json) {
  std::vector<int> parents(json["nodes"].size(), -1);
  for (std::size_t i = 0; i < parents.size(); ++i) {
    for (int child : json["nodes"][i].value("children", std::vector<int>{})) {
      parents[static_cast<std::size_t>(child)] = static_cast<int>(i);
    }
  }
  return parents;
}

Character with_random_axes(Character c, unsigned seed) {
  std::mt19937_64 random(seed);
  const auto number = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
  const std::vector<int> joints = c.json["skins"][0]["joints"];
  const std::vector<int> parents = parents_of(c.json);
  std::map<int, math::Affine> turns;
  for (int joint : joints) {
    const math::Quat q{number(), number(), number(), number()};
    turns[joint] = math::rotation(math::normalised(q));
  }
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const int joint = joints[i];
    auto& node = c.json["nodes"][static_cast<std::size_t>(joint)];
    math::Affine local = local_of(node) * turns[joint];
    const auto above = turns.find(parents[static_cast<std::size_t>(joint)]);
    if (above != turns.end()) local = math::inverse(above->second) * local;
    set_local(node, local);
    write_inverse_bind(c, i, math::inverse(turns[joint]) * read_inverse_bind(c, i));
  }
  c.json.erase("animations");
  return c;
}

Character under_scaled_ancestor(Character c, math::Vec3 scale) {
  const math::Affine s{{{scale.x, 0, 0}, {0, scale.y, 0}, {0, 0, scale.z}}, {}};
  const math::Affine inverse = math::inverse(s);
  auto& ancestor = c.json["nodes"][static_cast<std::size_t>(ancestor_of(c.json))];
  const math::Affine above = local_of(ancestor);
  ancestor["scale"] = {scale.x, scale.y, scale.z};
  REQUIRE(above == math::Affine{});
  const std::vector<int> joints = c.json["skins"][0]["joints"];
  for (std::size_t i = 0; i < joints.size(); ++i) {
    auto& node = c.json["nodes"][static_cast<std::size_t>(joints[i])];
    set_local(node, inverse * local_of(node) * s);
    write_inverse_bind(c, i, inverse * read_inverse_bind(c, i));
  }
  c.json.erase("animations");
  return c;
}

Character turned(Character c, double degrees) {
  auto& ancestor = c.json["nodes"][static_cast<std::size_t>(ancestor_of(c.json))];
  const math::Affine turn = math::rotation(math::from_euler_degrees({0, degrees, 0}));
  set_local(ancestor, turn * local_of(ancestor));
  const std::vector<int> joints = c.json["skins"][0]["joints"];
  for (std::size_t i = 0; i < joints.size(); ++i) {
    write_inverse_bind(c, i, read_inverse_bind(c, i) * math::inverse(turn));
  }
  c.json.erase("animations");
  return c;
}

std::map<std::string, int> joints_by_name(const ordered_json& json) {
  std::map<std::string, int> out;
  for (int joint : json["skins"][0]["joints"]) {
    out[json["nodes"][static_cast<std::size_t>(joint)].value("name", "")] = joint;
  }
  return out;
}

std::vector<math::Affine> play(const std::string& path, const std::string& clip, double seconds) {
  Diagnostics diagnostics;
  const Character c = load_glb(path);
  std::vector<math::Trs> locals;
  for (const auto& node : c.json["nodes"]) locals.push_back(math::decompose(local_of(node)));
  const auto file = gltf::open(path, diagnostics);
  REQUIRE(file);
  const auto clips = gltf::read_clips(*file, diagnostics);
  REQUIRE(clips);
  bool found = clip.empty();
  for (const anim::Clip& candidate : clips->clips) {
    if (candidate.name != clip || clip.empty()) continue;
    found = true;
    for (const anim::Channel& channel : candidate.channels) {
      double v[4] = {};
      math::Trs& local = locals[static_cast<std::size_t>(channel.node)];
      anim::sample(channel.curve, channel.path == anim::Path::rotation, seconds, v);
      if (channel.path == anim::Path::translation) local.translation = {v[0], v[1], v[2]};
      if (channel.path == anim::Path::rotation)
        local.rotation = math::normalised(math::Quat{v[0], v[1], v[2], v[3]});
      if (channel.path == anim::Path::scale) local.scale = {v[0], v[1], v[2]};
    }
  }
  REQUIRE(found);
  const std::vector<int> parents = parents_of(c.json);
  std::vector<math::Affine> worlds(locals.size());
  const std::function<math::Affine(std::size_t)> world = [&](std::size_t i) {
    const math::Affine local = math::compose(locals[i]);
    return parents[i] < 0 ? local : world(static_cast<std::size_t>(parents[i])) * local;
  };
  for (std::size_t i = 0; i < locals.size(); ++i) worlds[i] = world(i);
  return worlds;
}

}  // namespace rigc::test
