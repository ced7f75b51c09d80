// SPDX-License-Identifier: MIT
// Where indices stand in a glTF file: one row a place. An extension that gets a row here, or in the
// list of those without indices, can be merged. Test: tests/gltf/merge_table_test.cpp
#include "gltf/merge_table.h"

#include <algorithm>
#include <map>

namespace rigc::gltf {
namespace {

constexpr IndexRule kRules[] = {
    {"accessors", "bufferView", "bufferViews"},
    {"accessors", "sparse/indices/bufferView", "bufferViews"},
    {"accessors", "sparse/values/bufferView", "bufferViews"},
    {"animations", "channels/*/target/node", "nodes"},
    {"animations", "samplers/*/input", "accessors"},
    {"animations", "samplers/*/output", "accessors"},
    {"images", "bufferView", "bufferViews"},
    {"materials", "emissiveTexture/index", "textures"},
    {"materials", "normalTexture/index", "textures"},
    {"materials", "occlusionTexture/index", "textures"},
    {"materials", "pbrMetallicRoughness/baseColorTexture/index", "textures"},
    {"materials", "pbrMetallicRoughness/metallicRoughnessTexture/index", "textures"},
    {"meshes", "primitives/*/attributes/*", "accessors"},
    {"meshes", "primitives/*/indices", "accessors"},
    {"meshes", "primitives/*/material", "materials"},
    {"meshes", "primitives/*/targets/*/*", "accessors"},
    {"nodes", "camera", "cameras"},
    {"nodes", "children/*", "nodes"},
    {"nodes", "mesh", "meshes"},
    {"nodes", "skin", "skins"},
    {"scenes", "nodes/*", "nodes"},
    {"skins", "inverseBindMatrices", "accessors"},
    {"skins", "joints/*", "nodes"},
    {"skins", "skeleton", "nodes"},
    {"textures", "sampler", "samplers"},
    {"textures", "source", "images"},

    // Geometry and images. Buffers that views name (meshopt) are merge_bytes.cpp's.
    {"CESIUM_primitive_outline", "indices", "accessors"},
    {"EXT_mesh_features", "featureIds/*/texture/index", "textures"},
    {"EXT_mesh_gpu_instancing", "attributes/*", "accessors"},
    {"EXT_mesh_manifold", "manifoldPrimitive/indices", "accessors"},
    {"EXT_mesh_manifold", "mergeIndices", "accessors"},
    {"EXT_mesh_manifold", "mergeValues", "accessors"},
    {"EXT_structural_metadata", "propertyTables/*/properties/*/arrayOffsets", "bufferViews"},
    {"EXT_structural_metadata", "propertyTables/*/properties/*/stringOffsets", "bufferViews"},
    {"EXT_structural_metadata", "propertyTables/*/properties/*/values", "bufferViews"},
    {"EXT_structural_metadata", "propertyTextures/*/properties/*/index", "textures"},
    {"EXT_texture_avif", "source", "images"},
    {"EXT_texture_webp", "source", "images"},
    {"KHR_draco_mesh_compression", "bufferView", "bufferViews"},
    {"KHR_texture_basisu", "source", "images"},
    {"MSFT_texture_dds", "source", "images"},

    // Materials.
    {"KHR_materials_anisotropy", "anisotropyTexture/index", "textures"},
    {"KHR_materials_clearcoat", "clearcoatNormalTexture/index", "textures"},
    {"KHR_materials_clearcoat", "clearcoatRoughnessTexture/index", "textures"},
    {"KHR_materials_clearcoat", "clearcoatTexture/index", "textures"},
    {"KHR_materials_diffuse_transmission", "diffuseTransmissionColorTexture/index", "textures"},
    {"KHR_materials_diffuse_transmission", "diffuseTransmissionTexture/index", "textures"},
    {"KHR_materials_iridescence", "iridescenceTexture/index", "textures"},
    {"KHR_materials_iridescence", "iridescenceThicknessTexture/index", "textures"},
    {"KHR_materials_pbrSpecularGlossiness", "diffuseTexture/index", "textures"},
    {"KHR_materials_pbrSpecularGlossiness", "specularGlossinessTexture/index", "textures"},
    {"KHR_materials_sheen", "sheenColorTexture/index", "textures"},
    {"KHR_materials_sheen", "sheenRoughnessTexture/index", "textures"},
    {"KHR_materials_specular", "specularColorTexture/index", "textures"},
    {"KHR_materials_specular", "specularTexture/index", "textures"},
    {"KHR_materials_transmission", "transmissionTexture/index", "textures"},
    {"KHR_materials_variants", "mappings/*/material", "materials"},
    {"KHR_materials_variants", "mappings/*/variants/*", "KHR_materials_variants.variants"},
    {"KHR_materials_volume", "thicknessTexture/index", "textures"},
    {"MSFT_lod", "ids/*", "materials", "materials"},
    {"MSFT_lod", "ids/*", "nodes", "nodes"},
    {"MSFT_packing_normalRoughnessMetallic", "normalRoughnessMetallicTexture/index", "textures"},
    {"MSFT_packing_occlusionRoughnessMetallic", "normalTexture/index", "textures"},
    {"MSFT_packing_occlusionRoughnessMetallic", "occlusionRoughnessMetallicTexture/index",
     "textures"},
    {"MSFT_packing_occlusionRoughnessMetallic", "roughnessMetallicOcclusionTexture/index",
     "textures"},
    {"VRMC_materials_mtoon", "matcapTexture/index", "textures"},
    {"VRMC_materials_mtoon", "outlineWidthMultiplyTexture/index", "textures"},
    {"VRMC_materials_mtoon", "rimMultiplyTexture/index", "textures"},
    {"VRMC_materials_mtoon", "shadeMultiplyTexture/index", "textures"},
    {"VRMC_materials_mtoon", "shadingShiftTexture/index", "textures"},
    {"VRMC_materials_mtoon", "uvAnimationMaskTexture/index", "textures"},

    // Lights, sounds, descriptions.
    {"EXT_lights_ies", "light", "EXT_lights_ies.lights"},
    {"EXT_lights_ies", "lights/*/bufferView", "bufferViews"},
    {"EXT_lights_image_based", "light", "EXT_lights_image_based.lights"},
    {"EXT_lights_image_based", "lights/*/specularImages/*/*", "images"},
    {"KHR_audio_emitter", "audio/*/bufferView", "bufferViews"},
    {"KHR_audio_emitter", "emitter", "KHR_audio_emitter.emitters"},
    {"KHR_audio_emitter", "emitters/*", "KHR_audio_emitter.emitters", "scenes"},
    {"KHR_audio_emitter", "emitters/*/sources/*", "KHR_audio_emitter.sources"},
    {"KHR_audio_emitter", "sources/*/audio", "KHR_audio_emitter.audio"},
    {"KHR_lights", "light", "KHR_lights.lights"},
    {"KHR_lights_punctual", "light", "KHR_lights_punctual.lights"},
    {"KHR_xmp", "packet", "KHR_xmp.packets"},
    {"KHR_xmp_json_ld", "packet", "KHR_xmp_json_ld.packets"},

    // Animation and characters.
    {"KHR_animation_pointer", "pointer", "pointer"},
    {"VRMC_node_constraint", "constraint/*/source", "nodes"},
    {"VRMC_springBone", "colliderGroups/*/colliders/*", "VRMC_springBone.colliders"},
    {"VRMC_springBone", "colliders/*/node", "nodes"},
    {"VRMC_springBone", "springs/*/center", "nodes"},
    {"VRMC_springBone", "springs/*/colliderGroups/*", "VRMC_springBone.colliderGroups"},
    {"VRMC_springBone", "springs/*/joints/*/node", "nodes"},
    {"VRMC_vrm", "expressions/*/*/materialColorBinds/*/material", "materials"},
    {"VRMC_vrm", "expressions/*/*/morphTargetBinds/*/node", "nodes"},
    {"VRMC_vrm", "expressions/*/*/textureTransformBinds/*/material", "materials"},
    {"VRMC_vrm", "firstPerson/meshAnnotations/*/node", "nodes"},
    {"VRMC_vrm", "humanoid/humanBones/*/node", "nodes"},
    {"VRMC_vrm", "meta/thumbnailImage", "images"},
    {"VRMC_vrm_animation", "expressions/*/*/node", "nodes"},
    {"VRMC_vrm_animation", "humanoid/humanBones/*/node", "nodes"},
    {"VRMC_vrm_animation", "lookAt/node", "nodes"},
};

/// Extensions without indices into anything that a merge moves. Some count among themselves
/// (EXT_instance_features the tables of EXT_structural_metadata, which only one file can have).
constexpr std::string_view kWithoutIndices[] = {
    "ADOBE_materials_thin_transparency",
    "AGI_articulations",
    "CESIUM_RTC",
    "EXT_instance_features",
    "EXT_meshopt_compression",
    "FB_geometry_metadata",
    "FB_ngon_encoding",
    "GODOT_single_root",
    "KHR_gaussian_splatting",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_meshopt_compression",
    "KHR_node_hoverability",
    "KHR_node_selectability",
    "KHR_node_visibility",
    "KHR_texture_transform",
    "RIGC_rig",
    "VRMC_materials_hdr_emissiveMultiplier",
    "VRMC_node_collider",
    "VRMC_springBone_extended_collider",
    "VRMC_springBone_limit",
};

struct UnitedArray {
  std::string_view extension, array;
};
constexpr UnitedArray kUnited[] = {
    {"AGI_articulations", "articulations"},
    {"EXT_lights_ies", "lights"},
    {"EXT_lights_image_based", "lights"},
    {"KHR_audio_emitter", "audio"},
    {"KHR_audio_emitter", "emitters"},
    {"KHR_audio_emitter", "sources"},
    {"KHR_lights", "lights"},
    {"KHR_lights_punctual", "lights"},
    {"KHR_materials_variants", "variants"},
    {"KHR_xmp", "packets"},
    {"KHR_xmp_json_ld", "packets"},
    {"VRMC_springBone", "colliderGroups"},
    {"VRMC_springBone", "colliders"},
    {"VRMC_springBone", "springs"},
};

/// Lists of theirs go by the order of the file's materials.
constexpr std::string_view kFirstOnly[] = {"VRM"};

template <std::size_t N>
bool has(const std::string_view (&names)[N], std::string_view name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

using RulesByOwner = std::map<std::string_view, std::vector<const IndexRule*>>;

RulesByOwner by_owner() {
  RulesByOwner out;
  for (const IndexRule& rule : kRules) out[rule.owner].push_back(&rule);
  return out;
}

}  // namespace

const std::vector<const IndexRule*>& rules_of(std::string_view owner) {
  static const RulesByOwner kByOwner = by_owner();
  static const std::vector<const IndexRule*> kNone;
  const auto found = kByOwner.find(owner);
  return found == kByOwner.end() ? kNone : found->second;
}

bool is_known_extension(std::string_view name) {
  if (has(kWithoutIndices, name) || has(kFirstOnly, name)) return true;
  return !has(kTopLevel, name) && !rules_of(name).empty();
}

AtRoot at_root(std::string_view extension) {
  if (has(kFirstOnly, extension)) return AtRoot::first_only;
  return united_arrays(extension).empty() ? AtRoot::one : AtRoot::unite;
}

std::vector<std::string_view> united_arrays(std::string_view extension) {
  std::vector<std::string_view> out;
  for (const UnitedArray& row : kUnited)
    if (row.extension == extension) out.push_back(row.array);
  return out;
}

}  // namespace rigc::gltf
