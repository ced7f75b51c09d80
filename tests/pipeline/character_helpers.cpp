// SPDX-License-Identifier: MIT
// Characters as plain JSON and bytes, changed copies, and a small player.
#include "pipeline/character_helpers.h"

#include <doctest/doctest.h>

#include <algorithm>
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

std::string decode_base64(const std::string& text) {
  const auto digit = [](char c) -> std::uint32_t {
    if (c >= 'A' && c <= 'Z') return static_cast<std::uint32_t>(c - 'A');
    if (c >= 'a' && c <= 'z') return static_cast<std::uint32_t>(c - 'a' + 26);
    if (c >= '0' && c <= '9') return static_cast<std::uint32_t>(c - '0' + 52);
    return c == '+' ? 62 : 63;
  };
  std::string out;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | digit(c);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    out += static_cast<char>(bits >> count & 255);
  }
  return out;
}

/// All buffers of a .gltf one after the other as buffer 0.
void join_buffers(Character& c, const std::string& folder) {
  std::vector<std::size_t> starts;
  for (const auto& buffer : c.json.value("buffers", ordered_json::array())) {
    const std::string uri = buffer.value("uri", "");
    const std::size_t comma = uri.find(";base64,");
    c.bin.resize((c.bin.size() + 3) / 4 * 4, '\0');
    starts.push_back(c.bin.size());
    std::string bytes = comma == std::string::npos ? bytes_of(join_path(folder, uri))
                                                   : decode_base64(uri.substr(comma + 8));
    bytes.resize(buffer["byteLength"].get<std::size_t>(), '\0');
    c.bin += bytes;
  }
  for (auto& view : c.json["bufferViews"]) {
    view["byteOffset"] =
        view.value("byteOffset", std::size_t{0}) + starts[view["buffer"].get<std::size_t>()];
    view["buffer"] = 0;
  }
  c.json["buffers"] = ordered_json::array({{{"byteLength", c.bin.size()}}});
}

/// The lowest node above all of these joints that is none of them; -1 without one.
int ancestor_of(const std::vector<int>& parents, const std::map<int, math::Affine>& binds) {
  std::map<int, std::size_t> passed;
  for (const auto& [node, bind] : binds) {
    for (int at = node; at >= 0; at = parents[static_cast<std::size_t>(at)]) ++passed[at];
  }
  for (int at = binds.begin()->first; at >= 0; at = parents[static_cast<std::size_t>(at)]) {
    if (passed[at] == binds.size() && !binds.contains(at)) return at;
  }
  return -1;
}

/// Puts a node above everything in the scene.
int wrap_scene(ordered_json& json) {
  const int wrapper = static_cast<int>(json["nodes"].size());
  auto& scene = json["scenes"][json.value("scene", std::size_t{0})];
  json["nodes"].push_back({{"name", "wrapper"}, {"children", scene["nodes"]}});
  scene["nodes"] = {wrapper};
  return wrapper;
}

/// Meshes and what only they need, and clips.
void drop_all_but_skeletons(Character& c) {
  for (const char* key : {"meshes", "materials", "textures", "images", "samplers", "animations",
                          "accessors", "bufferViews", "cameras"}) {
    c.json.erase(key);
  }
  for (auto& node : c.json["nodes"]) {
    for (const char* key : {"mesh", "skin", "weights", "camera", "extensions"}) node.erase(key);
  }
  c.bin.clear();
}

void add_inverse_binds(Character& c, ordered_json& skin, const std::vector<math::Affine>& binds) {
  const std::size_t start = c.bin.size();
  for (const math::Affine& bind : binds) {
    const math::Affine a = math::inverse(bind);
    const math::Vec3 columns[4] = {a.linear.x, a.linear.y, a.linear.z, a.origin};
    for (int i = 0; i < 4; ++i) {
      const float column[4] = {static_cast<float>(columns[i].x), static_cast<float>(columns[i].y),
                               static_cast<float>(columns[i].z), i == 3 ? 1.0f : 0.0f};
      c.bin.append(reinterpret_cast<const char*>(column), 16);
    }
  }
  skin["inverseBindMatrices"] = c.json["accessors"].size();
  c.json["accessors"].push_back({{"bufferView", c.json["bufferViews"].size()},
                                 {"componentType", 5126},
                                 {"count", binds.size()},
                                 {"type", "MAT4"}});
  c.json["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", start}, {"byteLength", c.bin.size() - start}});
  c.json["buffers"] = ordered_json::array({{{"byteLength", c.bin.size()}}});
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

Character load_character(const std::string& path) {
  const std::string bytes = bytes_of(path);
  REQUIRE(bytes.size() > 20);
  if (!bytes.starts_with("glTF")) {
    Character c;
    c.json = ordered_json::parse(bytes);
    join_buffers(c, folder_of(path));
    return c;
  }
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

Character changed(Character c, const std::map<int, math::Affine>& binds, const Change& change) {
  drop_all_but_skeletons(c);
  c.json["accessors"] = c.json["bufferViews"] = ordered_json::array();
  int ancestor = ancestor_of(parents_of(c.json), binds);
  if (ancestor < 0) ancestor = wrap_scene(c.json);
  const std::vector<int> parents = parents_of(c.json);
  const auto node = [&](int i) -> ordered_json& {
    return c.json["nodes"][static_cast<std::size_t>(i)];
  };
  std::map<int, math::Affine> worlds;  // of what is done, as it is in the changed copy
  const std::function<math::Affine(int)> world = [&](int i) -> math::Affine {
    if (i < 0) return {};
    if (!worlds.contains(i))
      worlds[i] = world(parents[static_cast<std::size_t>(i)]) * local_of(node(i));
    return worlds[i];
  };
  const auto put = [&](int i, const math::Affine& place) {
    set_local(node(i), math::inverse(world(parents[static_cast<std::size_t>(i)])) * place);
    worlds[i] = place;
  };
  const math::Affine turn = math::rotation(math::from_euler_degrees({0, change.turn_degrees, 0}));
  const math::Vec3 s = change.ancestor_scale;
  const math::Affine scale{{{s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}}, {}};
  put(ancestor, turn * world(ancestor) * scale);
  worlds.clear();

  std::mt19937_64 random(change.axes_seed);
  std::map<int, math::Affine> places;
  for (const auto& [joint, bind] : binds) {
    double q[4];
    for (double& x : q) x = static_cast<double>(random() >> 11) * 0x1p-52 - 1;
    const math::Affine axes =
        change.axes_seed == 0
            ? math::Affine{}
            : math::rotation(math::normalised(math::Quat{q[0], q[1], q[2], q[3]}));
    places[joint] = turn * bind * axes * scale;
  }
  const std::function<void(int)> put_joint = [&](int joint) {
    for (int at = parents[static_cast<std::size_t>(joint)]; at >= 0;
         at = parents[static_cast<std::size_t>(at)]) {
      if (places.contains(at) && !worlds.contains(at)) put_joint(at);
    }
    if (!worlds.contains(joint)) put(joint, places[joint]);
  };
  for (const auto& [joint, place] : places) put_joint(joint);
  for (auto& skin : c.json["skins"]) {
    std::vector<math::Affine> own;
    for (const int joint : skin["joints"]) own.push_back(places.at(joint));
    add_inverse_binds(c, skin, own);
  }
  return c;
}

std::vector<std::vector<math::Affine>> play(const std::string& path, const std::string& clip,
                                            const std::vector<double>& seconds) {
  Diagnostics diagnostics;
  const Character c = load_character(path);
  const std::vector<int> parents = parents_of(c.json);
  std::vector<math::Trs> rest;
  for (const auto& node : c.json["nodes"]) rest.push_back(math::decompose(local_of(node)));
  const auto file = gltf::open(path, diagnostics);
  REQUIRE(file);
  const auto clips = gltf::read_clips(*file, diagnostics);
  REQUIRE(clips);
  const auto played = std::find_if(clips->clips.begin(), clips->clips.end(),
                                   [&](const anim::Clip& one) { return one.name == clip; });
  REQUIRE(played != clips->clips.end());
  std::vector<std::vector<math::Affine>> all;
  for (const double second : seconds) {
    std::vector<math::Trs> locals = rest;
    for (const anim::Channel& channel : played->channels) {
      double v[4] = {};
      math::Trs& local = locals[static_cast<std::size_t>(channel.node)];
      anim::sample(channel.curve, channel.path == anim::Path::rotation, second, v);
      if (channel.path == anim::Path::translation) local.translation = {v[0], v[1], v[2]};
      if (channel.path == anim::Path::rotation)
        local.rotation = math::normalised(math::Quat{v[0], v[1], v[2], v[3]});
      if (channel.path == anim::Path::scale) local.scale = {v[0], v[1], v[2]};
    }
    std::vector<math::Affine>& worlds = all.emplace_back();
    for (std::size_t i = 0; i < locals.size(); ++i) {
      math::Affine world = math::compose(locals[i]);
      for (int at = parents[i]; at >= 0; at = parents[static_cast<std::size_t>(at)])
        world = math::compose(locals[static_cast<std::size_t>(at)]) * world;
      worlds.push_back(world);
    }
  }
  return all;
}

}  // namespace rigc::test
