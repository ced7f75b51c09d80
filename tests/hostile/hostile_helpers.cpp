// SPDX-License-Identifier: MIT
// Loads victims, damages them, runs rigc on them.
#include "hostile/hostile_helpers.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <set>

#include "base/files.h"
#include "cli/process_helpers.h"
#include "gltf/uri.h"
#include "support/sanitizers.h"

namespace rigc::test {
namespace fs = std::filesystem;
using nlohmann::ordered_json;
namespace {

constexpr bool kSanitized = RIGC_HAS_ADDRESS_SANITIZER;

constexpr std::size_t kLongestWord = 40;

/// What stands for a value until the text is written.
constexpr const char* kMark = "@CHANGED@";

void append_uint32(std::string& out, std::size_t value) {
  for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(value >> shift & 255);
}

std::size_t uint32_at(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

Victim load(const fs::path& path) {
  Victim victim;
  victim.name = path.stem().string();
  const std::string bytes = file_text(path);
  if (bytes.starts_with("glTF")) {
    const std::size_t length = uint32_at(bytes, 12);
    victim.json = ordered_json::parse(bytes.substr(20, length));
    victim.bin = bytes.substr(28 + length);
    return victim;
  }
  victim.json = ordered_json::parse(bytes);
  ordered_json& buffer = victim.json["buffers"][0];
  const std::string uri = buffer["uri"];
  buffer.erase("uri");
  victim.bin = uri.starts_with("data:") ? gltf::data_uri_bytes(uri).value_or("")
                                        : file_text(path.parent_path() / uri);
  return victim;
}

/// A joint of the first skin that another joint carries, and that one.
void find_joint(Victim& victim) {
  const ordered_json& joints = victim.json["skins"][0]["joints"];
  for (const ordered_json& parent : joints) {
    const ordered_json& node = victim.json["nodes"][parent.get<std::size_t>()];
    if (!node.contains("children")) continue;
    for (const ordered_json& child : node["children"]) {
      if (std::find(joints.begin(), joints.end(), child) == joints.end()) continue;
      victim.words["joint"] = child.dump();
      victim.words["parent"] = parent.dump();
      return;
    }
  }
  FAIL("no two joints in " << victim.name);
}

/// The first channel of the first animation that turns a node by more than one key.
void find_channel(Victim& victim) {
  const ordered_json& animation = victim.json["animations"][0];
  for (std::size_t i = 0; i < animation["channels"].size(); ++i) {
    const ordered_json& channel = animation["channels"][i];
    const ordered_json& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
    const ordered_json& times = victim.json["accessors"][sampler["input"].get<std::size_t>()];
    if (channel["target"]["path"] != "rotation" || times["count"] < 2) continue;
    victim.words["channel"] = std::to_string(i);
    victim.words["sampler"] = channel["sampler"].dump();
    victim.words["times"] = sampler["input"].dump();
    victim.words["values"] = sampler["output"].dump();
    return;
  }
  FAIL("no rotation in " << victim.name);
}

void find_words(Victim& victim) {
  find_joint(victim);
  find_channel(victim);
  const ordered_json& json = victim.json;
  auto& words = victim.words;
  words["root"] = json["skins"][0]["joints"][0].dump();
  words["ibm"] = json["skins"][0]["inverseBindMatrices"].dump();
  words["position"] = json["meshes"][0]["primitives"][0]["attributes"]["POSITION"].dump();
  for (const char* array : {"nodes", "accessors", "bufferViews", "skins", "meshes", "animations"})
    words[array] = std::to_string(json[array].size());
  words["samplers"] = std::to_string(json["animations"][0]["samplers"].size());
  for (const char* accessor : {"ibm", "times", "values", "position"}) {
    const ordered_json& value = json["accessors"][std::stoul(words[accessor])];
    words[accessor + std::string("_view")] = value["bufferView"].dump();
    words[accessor + std::string("_count")] = value["count"].dump();
  }
}

/// Appends a clip that moves a node along X.
void add_clip(Victim& victim, int node) {
  ordered_json& json = victim.json;
  const std::string keys = floats({0, 1, 0, 0, 0, 1, 0, 0});
  victim.bin.resize(json["buffers"][0]["byteLength"]);
  victim.bin.resize((victim.bin.size() + 3) / 4 * 4);
  const std::size_t at = victim.bin.size(), view = json["bufferViews"].size(),
                    accessor = json["accessors"].size();
  victim.bin += keys;
  json["buffers"][0]["byteLength"] = victim.bin.size();
  json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", at}, {"byteLength", 8}});
  json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", at + 8}, {"byteLength", 24}});
  json["accessors"].push_back(
      {{"bufferView", view}, {"componentType", 5126}, {"count", 2}, {"type", "SCALAR"}});
  json["accessors"].push_back(
      {{"bufferView", view + 1}, {"componentType", 5126}, {"count", 2}, {"type", "VEC3"}});
  json["animations"] = ordered_json::parse(
      R"([{"channels": [{"sampler": 0, "target": {"path": "translation"}}], "samplers": [{}]}])");
  json["animations"][0]["channels"][0]["target"]["node"] = node;
  json["animations"][0]["samplers"][0] = {{"input", accessor}, {"output", accessor + 1}};
}

/// First node of each kind: `{control}`, and `{control_node}` in the file's nodes.
void find_kinds(Victim& victim) {
  const ordered_json& nodes = victim.json["extensions"]["RIGC_rig"]["rigs"][0]["nodes"];
  victim.words["rig"] = "extensions/RIGC_rig/rigs/0";
  victim.words["scene_nodes"] = std::to_string(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::string kind = nodes[i]["kind"];
    if (!victim.words.emplace(kind, std::to_string(i)).second) continue;
    if (nodes[i].contains("node")) victim.words[kind + "_node"] = nodes[i]["node"].dump();
  }
}

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename());
  return names;
}

std::vector<std::string> arguments_for(Ask ask, const std::string& file) {
  const std::string out = "out.glb";
  switch (ask) {
    case Ask::inspect:
      return {"inspect", file};
    case Ask::check:
      return {"check", file};
    case Ask::bake:
      return {"bake", file, "-o", out};
    case Ask::query:
      return {"query", file, "machine.dial/control"};
    case Ask::build:
      break;
  }
  return {"build", (source_folder() / "templates/prop.yaml").string(), "--model", file, "-o", out};
}

}  // namespace

std::string Victim::expand(std::string text) const {
  for (std::size_t at = text.find('{'); at != std::string::npos; at = text.find('{', at + 1)) {
    const std::string start = text.substr(at + 1, kLongestWord);
    const auto word = words.find(start.substr(0, start.find('}')));
    if (word != words.end()) text.replace(at, word->first.size() + 2, word->second);
  }
  return text;
}

std::size_t Victim::offset_of(const std::string& accessor_word, std::size_t element) const {
  const ordered_json& accessor = json["accessors"][std::stoul(words.at(accessor_word))];
  const ordered_json& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  const std::string type = accessor["type"];
  const std::size_t size = 4 * (type == "SCALAR" ? 1u : type == "VEC4" ? 4u : 16u);
  return view.value("byteOffset", std::size_t{0}) + accessor.value("byteOffset", std::size_t{0}) +
         element * view.value("byteStride", size);
}

Victim small_victim() {
  Victim victim;
  victim.name = "small";
  victim.bin = floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,
                       1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1});
  victim.bin +=
      floats({0, 1}) + floats({0, 0, 0, 1, 0, 0, 1, 0}) + floats({0, 0, 0, 1, 0, 0, 0, 1, 0});
  victim.json = ordered_json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 2]}],
    "nodes": [{"name": "root", "children": [1]}, {"name": "tip", "translation": [0, 1, 0]},
              {"name": "body", "mesh": 0, "skin": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 3}}]}],
    "skins": [{"joints": [0, 1], "inverseBindMatrices": 0}],
    "animations": [{"channels": [{"sampler": 0, "target": {"node": 1, "path": "rotation"}}],
                    "samplers": [{"input": 1, "output": 2, "interpolation": "LINEAR"}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 2, "type": "MAT4"},
                  {"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR"},
                  {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC4"},
                  {"bufferView": 3, "componentType": 5126, "count": 3, "type": "VEC3"}],
    "bufferViews": [{"buffer": 0, "byteLength": 128}, {"buffer": 0, "byteOffset": 128, "byteLength": 8},
                    {"buffer": 0, "byteOffset": 136, "byteLength": 32},
                    {"buffer": 0, "byteOffset": 168, "byteLength": 36}],
    "buffers": [{"byteLength": 204}]})");
  return victim;
}

const std::vector<Victim>& skinned_victims() {
  static const std::vector<Victim> victims = [] {
    std::vector<Victim> list;
    const fs::path corpus = corpus_folder();
    if (corpus.empty()) {
      MESSAGE("the corpus is not here: a small model is damaged instead");
      list.push_back(small_victim());
    } else {
      for (const char* file :
           {"khronos_Fox/Fox.glb", "momentum_model_with_motion/model_with_motion.glb",
            "khronos_RiggedSimple_emb/rigged_simple.gltf",
            "blender_skinned_cylinder/03_skinned_cylinder.gltf"})
        list.push_back(load(corpus / file));
    }
    for (Victim& victim : list) find_words(victim);
    return list;
  }();
  return victims;
}

const std::vector<Victim>& binary_victims() {
  static const std::vector<Victim> victims = [] {
    constexpr std::size_t kSmall = 400'000;
    const fs::path corpus = corpus_folder();
    std::vector<fs::path> files;
    if (!corpus.empty())
      for (const auto& entry : fs::recursive_directory_iterator(corpus))
        if (entry.is_regular_file() && entry.file_size() < kSmall &&
            file_text(entry.path()).starts_with("glTF"))
          files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<Victim> list;
    for (const fs::path& file : files) list.push_back(load(file));
    if (list.empty()) list.push_back(small_victim());
    return list;
  }();
  return victims;
}

const Victim& rig_victim() {
  static const Victim rig = [] {
    const fs::path folder = fs::path(RIGC_TEST_OUT) / "hostile";
    fs::create_directories(folder);
    const std::string yaml = (source_folder() / "tests/hostile/every_kind.yaml").string();
    const fs::path out = folder / "every_kind.glb";
    const Outcome outcome = run_rigc({"build", yaml, "-o", out.string()});
    REQUIRE_MESSAGE(outcome.status == 0, outcome.err);
    Victim victim = load(out);
    find_kinds(victim);
    add_clip(victim, std::stoi(victim.words.at("control_node")));
    return victim;
  }();
  return rig;
}

Damaged damaged(const Victim& victim, const std::vector<Change>& changes) {
  ordered_json json = victim.json;
  std::vector<std::string> values;
  for (const Change& change : changes) {
    const ordered_json::json_pointer at(victim.expand(change.at));
    if (change.value == nullptr) {
      ordered_json& holder = json.at(at.parent_pointer());
      if (holder.is_array())
        holder.erase(std::stoul(at.back()));
      else
        holder.erase(at.back());
      continue;
    }
    json[at] = kMark + std::to_string(values.size());
    values.push_back(victim.expand(change.value));
  }
  Damaged result{json.dump(), 0};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string mark = "\"" + (kMark + std::to_string(i)) + "\"";
    result.value_at = result.json.find(mark);
    REQUIRE(result.value_at != std::string::npos);
    result.json.replace(result.value_at, mark.size(), values[i]);
  }
  return result;
}

std::string glb(std::string json, std::string bin) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  bin.resize((bin.size() + 3) / 4 * 4, '\0');
  std::string out = "glTF";
  append_uint32(out, 2);
  append_uint32(out, 28 + json.size() + bin.size());
  append_uint32(out, json.size());
  out += "JSON" + json;
  append_uint32(out, bin.size());
  out.append("BIN\0", 4);
  return out + bin;
}

std::string gltf(const Victim& victim) {
  ordered_json json = victim.json;
  json["buffers"][0]["uri"] = "data:application/octet-stream;base64," + gltf::base64(victim.bin);
  return json.dump();
}

void write_file(const fs::path& path, const std::string& bytes) {
  std::ofstream stream(path, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  REQUIRE(stream.good());
}

std::string repeated(const std::string& text, std::size_t count) {
  std::string out;
  out.reserve(text.size() * count);
  for (std::size_t i = 0; i < count; ++i) out += text;
  return out;
}

std::string floats(const std::vector<float>& values) {
  std::string bytes(values.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

fs::path broken_folder(const std::string& name) {
  const fs::path folder = fs::path(RIGC_TEST_OUT) / "hostile/broken" / name;
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

void expect(Ask ask, const fs::path& file, const Answer& answer) {
  const fs::path folder = file.parent_path();
  const std::string name = file.filename();
  const auto before = names_in(folder);
  std::error_code no_file;
  const bool regular = fs::is_regular_file(file, no_file);
  const std::size_t size = regular ? fs::file_size(file) : 0;
  const std::size_t memory = 100'000'000 + 4 * size;
  Surroundings surroundings;
  surroundings.folder = folder;
  surroundings.cpu_seconds = kSanitized ? 60 : 5;
  // A sanitizer reserves terabytes, and needs a few times more than the program itself.
  if (!kSanitized) surroundings.address_space = memory;
  const Outcome outcome = run_rigc(arguments_for(ask, name), surroundings);
  CAPTURE(file.string());
  CAPTURE(outcome.err.substr(0, 2000));
  CHECK(outcome.status == (answer.accepted ? 0 : answer.status));
  CHECK(outcome.err.find("Sanitizer") == std::string::npos);
  if (kSanitized) CHECK(outcome.peak_bytes < 1'000'000'000 + 4 * memory);
  if (answer.accepted) {
    fs::remove(folder / "out.glb");
  } else {
    const std::string number = std::to_string(answer.code);
    const std::string code = "RIG" + std::string(4 - number.size(), '0') + number;
    CHECK(outcome.err.substr(0, outcome.err.find("]: ") + 1) ==
          name + answer.place + ": error[" + code + "]");
  }
  CHECK(names_in(folder) == before);
}

void expect(const Row& row, const Victim& victim, const fs::path& folder) {
  const Damaged damage = damaged(victim, {row.change});
  const fs::path file = folder / (std::string(row.name) + "_" + victim.name + ".glb");
  write_file(file, glb(damage.json, victim.bin));
  std::string place = victim.expand(*row.place ? row.place : row.change.at);
  if (place.starts_with('@')) {
    char hex[32];
    std::snprintf(hex, sizeof hex, "@0x%zx", 20 + damage.value_at + std::stoul(place.substr(1)));
    place = hex;
  } else {
    place = "#" + place;
  }
  expect(row.ask, file, {row.code, place, 1, row.code == 0});
}

void expect(const std::vector<Row>& rows, const std::string& folder) {
  const fs::path path = broken_folder(folder);
  const auto& victims = skinned_victims();
  for (std::size_t i = 0; i < rows.size(); ++i) expect(rows[i], victims[i % victims.size()], path);
}

}  // namespace rigc::test
