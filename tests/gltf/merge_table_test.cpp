// SPDX-License-Identifier: MIT
// Merging: every index of every known extension leads to what it led to.
#include "gltf/merge_table.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/text.h"
#include "file_helpers.h"
#include "merge_helpers.h"

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
    const auto now = at(file->root(), moved(place.pointer, base)).integer();
    CHECK(now == place.index + shift);
    CHECK(now < size_of(*file, place.array));
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
