// SPDX-License-Identifier: MIT
// Merging: every index of every known extension leads to what it led to; bytes, rigs and scenes of
// several files in one; what cannot be merged is refused by its name.
#include "gltf/merge.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/text.h"
#include "file_helpers.h"
#include "gltf/merge_table.h"
#include "rig_helpers.h"

using namespace rigc;
using namespace rigc::gltf;
using namespace rigc::gltf::test;

namespace {

/// A JSON document from pointers and the texts that stand there.
struct Tree {
  std::map<std::string, Tree> children;
  std::string leaf;

  void set(const std::string& pointer, const std::string& text) {
    Tree* at = this;
    for (const std::string_view step : split(std::string_view(pointer).substr(1), '/'))
      at = &at->children[std::string(step)];
    at->leaf = text;
  }
  std::string text() const {
    if (children.empty()) return leaf;
    const bool list = parse_integer(children.begin()->first).has_value();
    std::string out;
    for (const auto& [key, child] : children)
      out += (out.empty() ? "" : ",") + (list ? "" : json::quote(key) + ":") + child.text();
    return list ? "[" + out + "]" : "{" + out + "}";
  }
};

struct Entry {
  const char* pointer;
  const char* text;
};

/// Two elements and more in every array, with what rigc checks of them.
constexpr Entry kPlain[] = {
    {"/asset/version", "\"2.0\""},
    {"/buffers/0/byteLength", "4"},
    {"/buffers/1/byteLength", "4"},
    {"/buffers/1/uri", "\"data:application/octet-stream;base64,AAAAAA==\""},
    {"/bufferViews/0/byteLength", "4"},
    {"/bufferViews/1/byteLength", "4"},
    {"/accessors/0/componentType", "5126"},
    {"/accessors/0/count", "1"},
    {"/accessors/0/type", "\"SCALAR\""},
    {"/accessors/1/componentType", "5126"},
    {"/accessors/1/count", "1"},
    {"/accessors/1/type", "\"SCALAR\""},
    {"/accessors/1/sparse/count", "1"},
    {"/accessors/1/sparse/indices/componentType", "5121"},
    {"/accessors/2/componentType", "5126"},
    {"/accessors/2/count", "1"},
    {"/accessors/2/type", "\"MAT4\""},
    {"/animations/0/channels/0/sampler", "0"},
    {"/animations/0/channels/0/target/path", "\"weights\""},
    {"/animations/0/channels/1/sampler", "0"},
    {"/animations/0/channels/1/target/path", "\"pointer\""},
    {"/animations/0/channels/2/sampler", "0"},
    {"/animations/0/channels/2/target/path", "\"pointer\""},
    {"/cameras/0/type", "\"perspective\""},
    {"/cameras/1/type", "\"perspective\""},
    {"/images/0/mimeType", "\"image/png\""},
    {"/images/1/mimeType", "\"image/png\""},
    {"/materials/0/name", "\"first\""},
    {"/meshes/1/name", "\"second\""},
    {"/meshes/1/primitives/0/attributes/POSITION", "0"},
    {"/nodes/0/name", "\"first\""},
    {"/nodes/0/extras/index", "1"},
    {"/nodes/1/name", "\"second\""},
    {"/samplers/0/magFilter", "9728"},
    {"/samplers/1/magFilter", "9728"},
    {"/scene", "1"},
    {"/scenes/0/name", "\"first\""},
    {"/skins/1/joints/0", "0"},
    {"/textures/1/name", "\"second\""},
    {"/extensions/EXT_lights_ies/lights/1/uri", "\"a.ies\""},
    {"/extensions/EXT_lights_image_based/lights/1/intensity", "1"},
    {"/extensions/KHR_audio_emitter/audio/1/uri", "\"a.mp3\""},
    {"/extensions/KHR_audio_emitter/emitters/1/gain", "1"},
    {"/extensions/KHR_audio_emitter/sources/1/gain", "1"},
    {"/extensions/KHR_lights/lights/0/type", "\"ambient\""},
    {"/extensions/KHR_lights/lights/1/type", "\"ambient\""},
    {"/extensions/KHR_lights_punctual/lights/0/type", "\"point\""},
    {"/extensions/KHR_lights_punctual/lights/1/type", "\"spot\""},
    {"/extensions/KHR_materials_variants/variants/0/name", "\"day\""},
    {"/extensions/KHR_materials_variants/variants/1/name", "\"night\""},
    {"/extensions/KHR_xmp/packets/0/a", "0"},
    {"/extensions/KHR_xmp/packets/1/a", "1"},
    {"/extensions/KHR_xmp_json_ld/packets/0/a", "0"},
    {"/extensions/KHR_xmp_json_ld/packets/1/a", "1"},
    {"/extensions/VRMC_springBone/specVersion", "\"1.0\""},
    {"/extensions/VRMC_springBone/colliders/1/shape", "{}"},
    {"/extensions/VRMC_springBone/colliderGroups/1/name", "\"second\""},
};

/// A place that holds an index, the index, and the array that it counts: after a merge the index
/// has grown by what that array had before.
struct Spot {
  std::string pointer;
  int index;
  std::string array;
};

std::vector<Spot> places() {
  const std::string mesh = "/meshes/0/primitives/0/", matter = "/materials/1/extensions/",
                    node = "/nodes/1/extensions/", part = mesh + "extensions/";
  std::vector<Spot> out = {
      {"/bufferViews/0/buffer", 1, "buffers"},
      {"/bufferViews/1/buffer", 1, "buffers"},
      {"/accessors/0/bufferView", 1, "bufferViews"},
      {"/accessors/1/sparse/indices/bufferView", 1, "bufferViews"},
      {"/accessors/1/sparse/values/bufferView", 1, "bufferViews"},
      {"/animations/0/channels/0/target/node", 1, "nodes"},
      {"/animations/0/samplers/0/input", 1, "accessors"},
      {"/animations/0/samplers/0/output", 0, "accessors"},
      {"/images/1/bufferView", 1, "bufferViews"},
      {"/materials/1/emissiveTexture/index", 1, "textures"},
      {"/materials/1/normalTexture/index", 1, "textures"},
      {"/materials/1/occlusionTexture/index", 0, "textures"},
      {"/materials/1/pbrMetallicRoughness/baseColorTexture/index", 1, "textures"},
      {"/materials/1/pbrMetallicRoughness/metallicRoughnessTexture/index", 1, "textures"},
      {mesh + "attributes/POSITION", 1, "accessors"},
      {mesh + "indices", 1, "accessors"},
      {mesh + "material", 1, "materials"},
      {mesh + "targets/0/POSITION", 1, "accessors"},
      {"/nodes/0/camera", 1, "cameras"},
      {"/nodes/0/children/0", 1, "nodes"},
      {"/nodes/0/mesh", 1, "meshes"},
      {"/nodes/0/skin", 1, "skins"},
      {"/scenes/1/nodes/0", 0, "nodes"},
      {"/skins/0/inverseBindMatrices", 2, "accessors"},
      {"/skins/0/joints/0", 1, "nodes"},
      {"/skins/0/skeleton", 1, "nodes"},
      {"/textures/0/sampler", 1, "samplers"},
      {"/textures/0/source", 1, "images"},
      {part + "CESIUM_primitive_outline/indices", 1, "accessors"},
      {part + "EXT_mesh_features/featureIds/0/texture/index", 1, "textures"},
      {node + "EXT_mesh_gpu_instancing/attributes/TRANSLATION", 1, "accessors"},
      {"/meshes/0/extensions/EXT_mesh_manifold/manifoldPrimitive/indices", 1, "accessors"},
      {"/meshes/0/extensions/EXT_mesh_manifold/mergeIndices", 1, "accessors"},
      {"/meshes/0/extensions/EXT_mesh_manifold/mergeValues", 0, "accessors"},
      {"/textures/0/extensions/EXT_texture_avif/source", 1, "images"},
      {"/textures/0/extensions/EXT_texture_webp/source", 0, "images"},
      {"/textures/0/extensions/KHR_texture_basisu/source", 1, "images"},
      {"/textures/0/extensions/MSFT_texture_dds/source", 1, "images"},
      {part + "KHR_draco_mesh_compression/bufferView", 1, "bufferViews"},
      {part + "KHR_materials_variants/mappings/0/material", 1, "materials"},
      {part + "KHR_materials_variants/mappings/0/variants/0", 1, "KHR_materials_variants.variants"},
      {matter + "MSFT_lod/ids/0", 0, "materials"},
      {node + "MSFT_lod/ids/0", 1, "nodes"},
      {node + "EXT_lights_ies/light", 1, "EXT_lights_ies.lights"},
      {"/extensions/EXT_lights_ies/lights/0/bufferView", 1, "bufferViews"},
      {"/scenes/1/extensions/EXT_lights_image_based/light", 1, "EXT_lights_image_based.lights"},
      {"/extensions/EXT_lights_image_based/lights/0/specularImages/0/0", 1, "images"},
      {"/extensions/KHR_audio_emitter/audio/0/bufferView", 1, "bufferViews"},
      {"/extensions/KHR_audio_emitter/emitters/0/sources/0", 1, "KHR_audio_emitter.sources"},
      {"/extensions/KHR_audio_emitter/sources/0/audio", 1, "KHR_audio_emitter.audio"},
      {node + "KHR_audio_emitter/emitter", 1, "KHR_audio_emitter.emitters"},
      {"/scenes/1/extensions/KHR_audio_emitter/emitters/0", 1, "KHR_audio_emitter.emitters"},
      {"/scenes/1/extensions/KHR_lights/light", 1, "KHR_lights.lights"},
      {node + "KHR_lights_punctual/light", 1, "KHR_lights_punctual.lights"},
      {"/materials/0/extensions/KHR_xmp/packet", 1, "KHR_xmp.packets"},
      {node + "KHR_xmp_json_ld/packet", 1, "KHR_xmp_json_ld.packets"},
      {node + "VRMC_node_constraint/constraint/roll/source", 0, "nodes"},
      {"/extensions/VRMC_springBone/colliderGroups/0/colliders/0", 1, "VRMC_springBone.colliders"},
      {"/extensions/VRMC_springBone/colliders/0/node", 1, "nodes"},
      {"/extensions/VRMC_springBone/springs/0/center", 1, "nodes"},
      {"/extensions/VRMC_springBone/springs/0/colliderGroups/0", 1,
       "VRMC_springBone.colliderGroups"},
      {"/extensions/VRMC_springBone/springs/0/joints/0/node", 1, "nodes"},
  };
  const std::pair<const char*, const char*> textures[] = {
      {"KHR_materials_anisotropy", "anisotropyTexture"},
      {"KHR_materials_clearcoat", "clearcoatNormalTexture"},
      {"KHR_materials_clearcoat", "clearcoatRoughnessTexture"},
      {"KHR_materials_clearcoat", "clearcoatTexture"},
      {"KHR_materials_diffuse_transmission", "diffuseTransmissionColorTexture"},
      {"KHR_materials_diffuse_transmission", "diffuseTransmissionTexture"},
      {"KHR_materials_iridescence", "iridescenceTexture"},
      {"KHR_materials_iridescence", "iridescenceThicknessTexture"},
      {"KHR_materials_pbrSpecularGlossiness", "diffuseTexture"},
      {"KHR_materials_pbrSpecularGlossiness", "specularGlossinessTexture"},
      {"KHR_materials_sheen", "sheenColorTexture"},
      {"KHR_materials_sheen", "sheenRoughnessTexture"},
      {"KHR_materials_specular", "specularColorTexture"},
      {"KHR_materials_specular", "specularTexture"},
      {"KHR_materials_transmission", "transmissionTexture"},
      {"KHR_materials_volume", "thicknessTexture"},
      {"MSFT_packing_normalRoughnessMetallic", "normalRoughnessMetallicTexture"},
      {"MSFT_packing_occlusionRoughnessMetallic", "normalTexture"},
      {"MSFT_packing_occlusionRoughnessMetallic", "occlusionRoughnessMetallicTexture"},
      {"MSFT_packing_occlusionRoughnessMetallic", "roughnessMetallicOcclusionTexture"},
      {"VRMC_materials_mtoon", "matcapTexture"},
      {"VRMC_materials_mtoon", "outlineWidthMultiplyTexture"},
      {"VRMC_materials_mtoon", "rimMultiplyTexture"},
      {"VRMC_materials_mtoon", "shadeMultiplyTexture"},
      {"VRMC_materials_mtoon", "shadingShiftTexture"},
      {"VRMC_materials_mtoon", "uvAnimationMaskTexture"}};
  for (const auto& [extension, member] : textures)
    out.push_back({matter + extension + "/" + member + "/index", 1, "textures"});
  return out;
}

/// Of extensions that only one file can have.
std::vector<Spot> single_places() {
  const std::string data = "/extensions/EXT_structural_metadata/", vrm = "/extensions/VRMC_vrm/",
                    motion = "/extensions/VRMC_vrm_animation/";
  return {{data + "propertyTables/0/properties/a/arrayOffsets", 1, "bufferViews"},
          {data + "propertyTables/0/properties/a/stringOffsets", 1, "bufferViews"},
          {data + "propertyTables/0/properties/a/values", 0, "bufferViews"},
          {data + "propertyTextures/0/properties/a/index", 1, "textures"},
          {vrm + "expressions/preset/happy/materialColorBinds/0/material", 1, "materials"},
          {vrm + "expressions/preset/happy/morphTargetBinds/0/node", 1, "nodes"},
          {vrm + "expressions/custom/x/textureTransformBinds/0/material", 0, "materials"},
          {vrm + "firstPerson/meshAnnotations/0/node", 1, "nodes"},
          {vrm + "humanoid/humanBones/hips/node", 1, "nodes"},
          {vrm + "meta/thumbnailImage", 1, "images"},
          {motion + "expressions/preset/happy/node", 1, "nodes"},
          {motion + "humanoid/humanBones/hips/node", 1, "nodes"},
          {motion + "lookAt/node", 0, "nodes"}};
}

std::string document(const std::vector<Spot>& list) {
  Tree tree;
  for (const Entry& entry : kPlain) tree.set(entry.pointer, entry.text);
  const std::string pointer = "/animations/0/channels/1/target/extensions/KHR_animation_pointer/";
  tree.set(pointer + "pointer", "\"/nodes/1/extras/index\"");
  tree.set(replaced(pointer, "/1/", "/2/") + "pointer",
           "\"/extensions/KHR_lights_punctual/lights/1/intensity\"");
  for (const Spot& place : list) tree.set(place.pointer, std::to_string(place.index));
  return tree.text();
}

json::Value at(const json::Value& root, const std::string& pointer) {
  json::Value value = root;
  for (const std::string_view step : split(std::string_view(pointer).substr(1), '/')) {
    const auto index = parse_integer(step);
    if (value.is_object()) {
      value = value[step];
    } else {
      const auto items = value.items();
      REQUIRE_MESSAGE((index && static_cast<std::size_t>(*index) < items.size()), pointer);
      value = items[static_cast<std::size_t>(*index)];
    }
  }
  return value;
}

int size_of(const File& file, const std::string& array) {
  const std::size_t point = array.find('.');
  if (point == std::string::npos) return static_cast<int>(file.root()[array].size());
  return static_cast<int>(
      file.root()["extensions"][array.substr(0, point)][array.substr(point + 1)].size());
}

/// Where a pointer into `file` leads when the file has come to `base`.
std::string moved(const std::string& pointer, const File& base) {
  std::vector<std::string> steps;
  for (const std::string_view step : split(std::string_view(pointer).substr(1), '/'))
    steps.emplace_back(step);
  const bool extension = steps[0] == "extensions";
  const std::size_t place = extension ? 3 : 1;
  const std::string array = extension ? steps[1] + "." + steps[2] : steps[0];
  if (steps.size() > place)
    if (const auto index = parse_integer(steps[place]))
      steps[place] = std::to_string(*index + size_of(base, array));
  return "/" + join(steps, "/");
}

File opened(const std::string& text, const std::string& bin, const std::string& name) {
  Diagnostics diagnostics;
  auto file = gltf::open(name, Bytes(glb(text, bin)), diagnostics);
  REQUIRE_MESSAGE(file, render(diagnostics, false));
  return *std::move(file);
}

/// The merged file, opened; empty where something was refused.
std::optional<File> merged(const std::deque<File>& files, Diagnostics& diagnostics,
                           MergeOptions options = {}) {
  Patch patch(files.front());
  if (!merge(patch, files, options, diagnostics)) return std::nullopt;
  const auto output = patch.finish(options.binary, diagnostics);
  REQUIRE(output);
  const std::string folder = make_folder("broken/merged");
  for (const ExtraFile& extra : output->extra_files)
    write_bytes(folder + "/" + extra.name, text(extra.bytes));
  auto file = gltf::open(folder + (options.binary ? "/m.glb" : "/m.gltf"), Bytes(whole(*output)),
                         diagnostics);
  REQUIRE_MESSAGE(file, render(diagnostics, false));
  return file;
}

bool matches(const std::string& pointer, const IndexRule& rule) {
  const std::string owner = "/" + std::string(rule.owner) + "/";
  const std::size_t begin = pointer.find(owner);
  if (begin == std::string::npos) return false;
  auto steps = split(std::string_view(pointer).substr(begin + owner.size()), '/');
  if (!is_known_extension(rule.owner)) steps.erase(steps.begin());
  const auto wanted = split(rule.path, '/');
  return steps.size() == wanted.size() &&
         std::equal(steps.begin(), steps.end(), wanted.begin(),
                    [](std::string_view step, std::string_view want) {
                      return want == "*" || step == want;
                    });
}

}  // namespace

TEST_CASE("merge: every index of every known extension leads where it led") {
  std::vector<Spot> all = places();
  for (const Spot& place : single_places()) all.push_back(place);
  std::deque<File> files;
  files.push_back(opened(document(places()), "base", "base.glb"));
  files.push_back(opened(document(all), "more", "more.glb"));
  const File base = opened(document(places()), "base", "base.glb");
  Diagnostics diagnostics;
  const auto file = merged(files, diagnostics);
  REQUIRE_MESSAGE(file, render(diagnostics, false));
  CHECK(numbers(diagnostics).empty());
  for (const Spot& place : all) {
    CAPTURE(place.pointer);
    // All of its buffers have become a part of the first file's buffer 0.
    const int shift = place.array == "buffers" ? -1 : size_of(base, place.array);
    CHECK(at(file->root(), moved(place.pointer, base)).integer() == place.index + shift);
  }
  for (const Spot& place : places()) {
    CAPTURE(place.pointer);
    CHECK(at(file->root(), place.pointer).integer() == place.index);
  }
  const json::Value channels = at(file->root(), "/animations/1/channels");
  const auto pointer = [&](std::size_t i) {
    return channels.items()[i]["target"]["extensions"]["KHR_animation_pointer"]["pointer"].string();
  };
  CHECK(pointer(1) == "/nodes/3/extras/index");
  CHECK(pointer(2) == "/extensions/KHR_lights_punctual/lights/3/intensity");
  // Extras are somebody's own.
  CHECK(at(file->root(), "/nodes/2/extras/index").integer() == 1);

  // Every row of the table is among the places.
  std::set<std::string_view> owners(std::begin(kTopLevel), std::end(kTopLevel));
  for (const Spot& place : all) {
    const std::size_t begin = place.pointer.find("extensions/");
    if (begin == std::string::npos) continue;
    const std::string_view rest = std::string_view(place.pointer).substr(begin + 11);
    owners.insert(rest.substr(0, rest.find('/')));
  }
  for (const std::string_view owner : owners)
    for (const IndexRule* rule : rules_of(owner)) {
      CAPTURE(rule->owner);
      CAPTURE(rule->path);
      CHECK(std::any_of(all.begin(), all.end(),
                        [&](const Spot& place) { return matches(place.pointer, *rule); }));
    }
}

namespace {

/// A file in memory, as if it lay where the tests' files lie.
File text_file(const std::string& text) {
  Diagnostics diagnostics;
  auto file = gltf::open("model.gltf", Bytes(std::string(text)), diagnostics);
  REQUIRE_MESSAGE(file, render(diagnostics, false));
  return *std::move(file);
}

std::deque<File> files_of(const std::vector<std::string>& texts) {
  std::deque<File> files;
  for (const std::string& text : texts) files.push_back(text_file(text));
  return files;
}

/// Numbers of what merging these texts reports.
std::vector<int> reported(const std::vector<std::string>& texts) {
  Diagnostics diagnostics;
  merged(files_of(texts), diagnostics);
  return numbers(diagnostics);
}

/// An asset and what else is given.
std::string with(const std::string& members) {
  return R"({"asset":{"version":"2.0"},)" + members + "}";
}

std::string view_bytes(const File& file, std::size_t view) {
  const json::Value value = file.root()["bufferViews"].items()[view];
  const auto buffer = static_cast<std::size_t>(*value["buffer"].integer());
  return text(file.buffers[buffer].bytes.part(
      static_cast<std::uint64_t>(value["byteOffset"].integer().value_or(0)),
      static_cast<std::uint64_t>(*value["byteLength"].integer())));
}

std::string rigged(const std::string& text, const std::string& global, std::uint32_t id) {
  Diagnostics diagnostics;
  const File file = text_file(text);
  Rig rig = sample_rig(diagnostics, 0, 1);
  rig.id = id;
  tags::TaggedSkeleton& skeleton = rig.skeleton;
  for (tags::TaggedJoint& joint : skeleton.joints) joint.ids.global = global;
  skeleton.global = global;
  Patch patch(file);
  REQUIRE(write_rig(patch, rig, -1, diagnostics));
  const auto output = patch.finish(true, diagnostics);
  REQUIRE(output);
  return whole(*output);
}

std::deque<File> rigged_files() {
  std::deque<File> files;
  Diagnostics diagnostics;
  for (const char* global : {"left", "right", "third"}) {
    auto file = gltf::open("model.glb", Bytes(rigged(small_model(), global, 7)), diagnostics);
    REQUIRE(file);
    files.push_back(*std::move(file));
  }
  return files;
}

}  // namespace

TEST_CASE("merge: the first file keeps its bytes, the others' come behind them") {
  const std::deque<File> files = files_of({small_model(), small_model(), small_model()});
  Diagnostics diagnostics;
  for (const bool binary : {true, false}) {
    const auto file = merged(files, diagnostics, {binary, false});
    REQUIRE(file);
    CHECK(file->root()["buffers"].size() == (binary ? 1 : 3));
    for (std::size_t i = 0; i < 12; ++i)
      CHECK(view_bytes(*file, i) == view_bytes(files.front(), i % 4));
    for (const char* array : {"nodes", "meshes", "skins", "animations", "accessors"}) {
      const auto before = files.front().root()[array].items();
      const auto after = file->root()[array].items();
      REQUIRE(after.size() == 3 * before.size());
      for (std::size_t i = 0; i < before.size(); ++i) CHECK(after[i].text() == before[i].text());
    }
    CHECK(file->root()["scenes"].size() == 1);
    CHECK(at(file->root(), "/scenes/0/nodes").text() == "[0, 2, 3, 5, 6, 8]");
    CHECK(at(file->root(), "/nodes/3").text() ==
          R"({"name": "root", "children": [4], "translation": [0, 0, 0]})");
  }
  CHECK(numbers(diagnostics).empty());
}

TEST_CASE("merge: bytes begin on a multiple of 8, whatever lies before them") {
  const std::string view = R"("bufferViews":[{"buffer":0,"byteLength":3}],"buffers":[)";
  std::deque<File> files;
  files.push_back(opened(with(view + R"({"byteLength":5}])"), "abcde", "a.glb"));
  files.push_back(opened(with(view + R"({"byteLength":3}])"), "xyz", "b.glb"));
  Diagnostics diagnostics;
  const auto file = merged(files, diagnostics);
  REQUIRE(file);
  CHECK(at(file->root(), "/bufferViews/1/byteOffset").integer() == 8);
  CHECK(view_bytes(*file, 0) == "abc");
  CHECK(view_bytes(*file, 1) == "xyz");
}

TEST_CASE("merge: compressed views name their bytes and the buffer that a decoder fills") {
  const std::string text = with(
      R"("extensionsUsed":["EXT_meshopt_compression"],"extensionsRequired":["EXT_meshopt_compression"],)"
      R"("buffers":[{"byteLength":4},{"byteLength":8}],"bufferViews":[{"buffer":1,"byteLength":8,)"
      R"("extensions":{"EXT_meshopt_compression":{"buffer":0,"byteOffset":1,"byteLength":3}}}])");
  std::deque<File> files;
  for (const char* bin : {"abcd", "efgh"}) files.push_back(opened(text, bin, "a.glb"));
  Diagnostics diagnostics;
  const auto file = merged(files, diagnostics);
  REQUIRE(file);
  CHECK(at(file->root(), "/bufferViews/0").text() == at(files[0].root(), "/bufferViews/0").text());
  CHECK(at(file->root(), "/bufferViews/1/buffer").integer() == 2);
  CHECK(!at(file->root(), "/bufferViews/1")["byteOffset"]);
  const std::string compressed = "/bufferViews/1/extensions/EXT_meshopt_compression/";
  CHECK(at(file->root(), compressed + "buffer").integer() == 0);
  CHECK(at(file->root(), compressed + "byteOffset").integer() == 9);
  CHECK(file->root()["extensionsRequired"].size() == 1);
}

TEST_CASE("merge: a file without buffers or scenes takes those that come") {
  const std::string other = with(R"("buffers":[{"byteLength":1,"uri":"data:,a"}])");
  std::deque<File> files = files_of({with(R"("nodes":[{}])"), other});
  files.push_back(opened(with(R"("buffers":[{"byteLength":4}],"bufferViews":[{"buffer":0,)"
                              R"("byteLength":4}],"nodes":[{}],"scene":1,"scenes":[{},)"
                              R"({"nodes":[0]}])"),
                         "abcd", "b.glb"));
  files.push_back(text_file(with(R"("nodes":[{}],"scenes":[{"nodes":[0]}])")));
  Diagnostics diagnostics;
  const auto file = merged(files, diagnostics, {false, false});
  REQUIRE(file);
  CHECK(file->root()["scene"].integer() == 1);
  CHECK(file->root()["scenes"].text() == R"([{},{"nodes":[1,2]}])");
  CHECK(file->root()["buffers"].size() == 2);
  const auto glb = merged(files, diagnostics);
  REQUIRE(glb);
  CHECK(view_bytes(*glb, 0) == "abcd");
  CHECK(glb->root()["buffers"].text() == R"([{"byteLength":12}])");
}

TEST_CASE("merge: clips of one name become one clip where that is asked for") {
  const std::string walk = replaced(small_model(), "\"turn\"", "\"walk\"");
  const std::deque<File> files = files_of({small_model(), walk, small_model()});
  Diagnostics diagnostics;
  const auto apart = merged(files, diagnostics);
  REQUIRE(apart);
  CHECK(apart->root()["animations"].size() == 3);
  const auto joined = merged(files, diagnostics, {true, true});
  REQUIRE(joined);
  REQUIRE(joined->root()["animations"].size() == 2);
  const json::Value clip = joined->root()["animations"].items()[0];
  REQUIRE(clip["channels"].size() == 2);
  REQUIRE(clip["samplers"].size() == 2);
  const json::Value channel = clip["channels"].items()[1];
  CHECK(channel["sampler"].integer() == 1);
  CHECK(channel["target"]["node"].integer() == 7);
  CHECK(clip["samplers"].items()[1]["input"].integer() == 9);
  CHECK(joined->root()["animations"].items()[1]["name"].string() == "walk");
}

TEST_CASE("merge: what cannot be merged is refused by its name") {
  const std::string plain = with(R"("nodes":[{}])");
  const std::string unknown = with(R"("nodes":[{"extensions":{"ACME_wheels":{"node":0}}}])");
  CHECK(reported({plain, unknown}) == std::vector<int>{681});
  CHECK(reported({unknown, plain}).empty());
  CHECK(reported({plain, with(R"("extensionsUsed":["ACME_wheels"])")}) == std::vector<int>{681});
  const std::string hidden =
      R"("nodes":[{"extensions":{"KHR_lights_punctual":{"light":0,"extensions":{"ACME_x":{}}}}}],)"
      R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"}]}})";
  CHECK(reported({plain, with(hidden)}) == std::vector<int>{681});
  CHECK(reported({plain, with(R"("nodes":[{"extras":{"extensions":{"ACME_x":{}}}}])")}).empty());

  const std::string light = R"("nodes":[{"extensions":{"KHR_lights_punctual":{"light":1}}}])";
  CHECK(reported({plain, with(light)}) == std::vector<int>{682});
  const std::string odd = R"("nodes":[{"extensions":{"MSFT_lod":{"ids":["0"]}}}])";
  CHECK(reported({plain, with(odd)}) == std::vector<int>{682});

  const auto vrm = [](const char* name) {
    return with(R"("extensions":{")" + std::string(name) + R"(":{"humanoid":{}}})");
  };
  CHECK(reported({plain, vrm("VRMC_vrm")}).empty());
  CHECK(reported({vrm("VRMC_vrm"), vrm("VRMC_vrm_animation")}).empty());
  CHECK(reported({vrm("VRM"), plain}).empty());
  CHECK(reported({plain, vrm("VRM")}) == std::vector<int>{683});
  const std::string hips = R"("nodes":[{}],"extensions":{"VRMC_vrm":{"humanoid":{"humanBones":)"
                           R"({"hips":{"node":0}}}}})";
  CHECK(reported({with(hips), with(hips)}) == std::vector<int>{683});
  const auto spring = [](const char* version) {
    return with(R"("extensions":{"VRMC_springBone":{"specVersion":")" + std::string(version) +
                "\"}}");
  };
  CHECK(reported({spring("1.0"), spring("1.0")}).empty());
  CHECK(reported({spring("1.0"), spring("1.0-beta")}) == std::vector<int>{683});
}

TEST_CASE("merge: animation pointers that cannot be followed are refused") {
  const auto clip = [](const std::string& pointer) {
    return replaced(small_model(), R"("target": {"node": 1, "path": "rotation"})",
                    R"("target": {"path": "pointer", "extensions": {"KHR_animation_pointer": )"
                    R"({"pointer": ")" +
                        pointer + "\"}}}");
  };
  const std::string plain = with(R"("nodes":[{}])");
  CHECK(reported({plain, clip("/nodes/1/rotation")}).empty());
  CHECK(reported({plain, clip("/nodes/9/rotation")}) == std::vector<int>{682});
  CHECK(reported({plain, clip("/materials/0/alphaCutoff")}) == std::vector<int>{682});
  CHECK(reported({plain, clip("/extensions/ACME_x/0/y")}) == std::vector<int>{682});
}

TEST_CASE("merge: members of the root that one file can have are said to be left out") {
  const std::string plain = with(R"("nodes":[{}])"), extras = with(R"("extras":{"a":1})");
  Diagnostics diagnostics;
  const auto file = merged(files_of({plain, extras}), diagnostics);
  REQUIRE(file);
  CHECK(file->root()["extras"].text() == R"({"a":1})");
  CHECK(diagnostics.all().empty());
  CHECK(reported({with(R"("extras":1)"), extras}) == std::vector<int>{688});
  CHECK(reported({plain, R"({"asset":{"version":"2.0","copyright":"me"}})"}) ==
        std::vector<int>{688});
  CHECK(reported({plain, with(R"("odd":[1])")}) == std::vector<int>{688});
}

TEST_CASE("merge: rigs get ids of their own and stand for the same nodes") {
  const std::deque<File> files = rigged_files();
  Diagnostics diagnostics;
  const auto file = merged(files, diagnostics);
  REQUIRE_MESSAGE(file, render(diagnostics, false));
  const auto rigs = read_rigs(*file, diagnostics);
  REQUIRE_MESSAGE(rigs, render(diagnostics, false));
  CHECK(numbers(diagnostics).empty());
  REQUIRE(rigs->size() == 3);
  const auto nodes = file->root()["nodes"].items();
  std::set<int> taken;
  std::map<std::uint32_t, std::string> globals;
  for (const Rig& rig : *rigs) {
    globals[rig.id] = rig.skeleton.global;
    const auto before = read_rigs(files[0], diagnostics);
    REQUIRE(before);
    REQUIRE(rig.scene.size() == before->front().scene.size());
    for (const scene::NodeId id : rig.scene.nodes()) {
      CHECK(rig.scene[id].identity.rig == rig.id);
      const int node = rig.nodes[id.index], old = before->front().nodes[id.index];
      CHECK((node < 0) == (old < 0));
      if (node < 0) continue;
      CHECK(taken.insert(node).second);
      const json::Value mark = nodes[static_cast<std::size_t>(node)]["extras"]["rigc"];
      CHECK(mark.string() == to_text(rig.scene[id].identity));
      CHECK(nodes[static_cast<std::size_t>(node)]["name"].string() ==
            files[0].root()["nodes"].items()[static_cast<std::size_t>(old)]["name"].string());
    }
    for (std::size_t i = 0; i < rig.skeleton.joints.size(); ++i)
      CHECK((rig.skeleton.joints[i].foreign_node < 0) ==
            (before->front().skeleton.joints[i].foreign_node < 0));
    CHECK(rig.owned.goes.nodes.runs.size() == before->front().owned.goes.nodes.runs.size());
  }
  CHECK(globals == std::map<std::uint32_t, std::string>{{0, "right"}, {1, "third"}, {7, "left"}});
}

TEST_CASE("merge: taking all rigs out of a merged file leaves the models") {
  const std::deque<File> files = rigged_files();
  Diagnostics diagnostics;
  const auto file = merged(files, diagnostics);
  REQUIRE(file);
  const auto rigs = read_rigs(*file, diagnostics);
  REQUIRE(rigs);
  Patch patch(*file);
  strip_rigs(patch, *file, *rigs, Strip::nothing);
  const auto output = patch.finish(true, diagnostics);
  REQUIRE(output);
  const auto stripped = gltf::open("m.glb", Bytes(whole(*output)), diagnostics);
  REQUIRE(stripped);
  const File& left = *stripped;
  const File model = text_file(small_model());
  CHECK(!left.root()["extensions"]);
  CHECK(!left.root()["extensionsUsed"]);
  CHECK(at(left.root(), "/scenes/0/nodes").size() == 6);
  std::size_t meshes = 0;
  for (const json::Value& mesh : left.root()["meshes"].items())
    meshes += mesh["extras"]["rigc"] ? 0 : 1;
  CHECK(meshes == 3);
  for (const json::Value& node : left.root()["nodes"].items()) {
    const json::Value mark = node["extras"]["rigc"];
    CHECK((!mark || mark["free"]));
  }
  // Those of the first file are what they were, byte for byte.
  for (const char* array : {"nodes", "skins", "animations", "meshes"}) {
    const auto before = model.root()[array].items(), after = left.root()[array].items();
    for (std::size_t i = 0; i < before.size(); ++i) CHECK(after[i].text() == before[i].text());
  }
  CHECK(view_bytes(left, 0) == view_bytes(model, 0));
}

TEST_CASE("merge: two rigs of one global group are refused") {
  std::deque<File> files = rigged_files();
  Diagnostics diagnostics;
  auto again = gltf::open("again.glb", Bytes(rigged(small_model(), "left", 2)), diagnostics);
  REQUIRE(again);
  files.push_back(*std::move(again));
  CHECK(!merged(files, diagnostics));
  CHECK(numbers(diagnostics) == std::vector<int>{684});
}

TEST_CASE("merge: holders of orphans follow their rig") {
  std::deque<File> files = rigged_files();
  std::string text(files[1].json.text());
  text = replaced(text, R"("owned":)",
                  R"("orphans":[{"node":1,"identity":"7:00000000000000aa:00000000000000bb:c:r:0",)"
                  R"("name":"lost","kind":"control","other":7}],"owned":)");
  text = replaced(text, R"({"name": "body", "mesh": 0, "skin": 0})",
                  R"({"name": "body", "mesh": 0, "skin": 0, "extras": )"
                  R"({"rigc": "orphan:7:00000000000000aa:00000000000000bb:c:r:0"}})");
  Diagnostics diagnostics;
  auto changed =
      gltf::open("b.glb", Bytes(glb(text, gltf::test::text(*files[1].bin))), diagnostics);
  REQUIRE_MESSAGE(changed, render(diagnostics, false));
  const auto first = static_cast<int>(files[0].root()["nodes"].size());
  files[1] = *std::move(changed);
  const auto file = merged(files, diagnostics);
  REQUIRE_MESSAGE(file, render(diagnostics, false));
  CHECK(at(file->root(), "/extensions/RIGC_rig/rigs/1/orphans").text() ==
        R"([{"node":)" + std::to_string(first + 2) +
            R"(,"identity":"0:00000000000000aa:00000000000000bb:c:r:0",)" +
            R"("name":"lost","kind":"control","other":7}])");
  const auto rigs = read_rigs(*file, diagnostics);
  REQUIRE_MESSAGE(rigs, render(diagnostics, false));
  REQUIRE(rigs->front().orphans.size() == 1);
  CHECK(rigs->front().orphans[0].node == first + 2);
  CHECK(at(file->root(), "/nodes/" + std::to_string(first + 2) + "/extras/rigc").string() ==
        "orphan:0:00000000000000aa:00000000000000bb:c:r:0");
}
