// SPDX-License-Identifier: MIT
// Counts who uses accessors and buffer views. Test: tests/lossless/bake_test.cpp
#include "gltf/uses.h"

#include "base/text.h"

namespace rigc::gltf {
namespace {

int index_of(const json::Value& value) { return static_cast<int>(value.integer().value_or(-1)); }

void add(std::vector<int>& uses, std::int64_t index) {
  if (index >= 0 && index < static_cast<std::int64_t>(uses.size()))
    ++uses[static_cast<std::size_t>(index)];
}

/// Extensions of Khronos and VRM are known: of these only one names buffer views, none accessors.
bool may_name_accessors(const std::string& extension) {
  const bool known =
      starts_with(extension, "KHR_") || starts_with(extension, "VRM") || extension == "RIGC_rig";
  return !known || extension == "KHR_draco_mesh_compression";
}

}  // namespace

std::vector<int> accessors_of(const json::Value& mesh) {
  std::vector<int> out;
  for (const json::Value& primitive : mesh["primitives"].items()) {
    for (const auto& [name, accessor] : primitive["attributes"].members())
      out.push_back(index_of(accessor));
    for (const json::Value& target : primitive["targets"].items())
      for (const auto& [name, accessor] : target.members()) out.push_back(index_of(accessor));
    if (primitive["indices"]) out.push_back(index_of(primitive["indices"]));
  }
  return out;
}

Uses::Uses(const File& file) : file_(file), accessors_(file.root()["accessors"].items()) {
  const json::Value root = file.root();
  accessor_uses_.assign(accessors_.size(), 0);
  view_uses_.assign(root["bufferViews"].size(), 0);
  for (const json::Value& mesh : root["meshes"].items())
    for (const int accessor : accessors_of(mesh)) add(accessor_uses_, accessor);
  for (const json::Value& skin : root["skins"].items())
    add(accessor_uses_, index_of(skin["inverseBindMatrices"]));
  for (const json::Value& animation : root["animations"].items())
    for (const json::Value& sampler : animation["samplers"].items())
      for (const char* end : {"input", "output"}) add(accessor_uses_, index_of(sampler[end]));
  for (const json::Value& accessor : accessors_) {
    add(view_uses_, index_of(accessor["bufferView"]));
    for (const char* half : {"indices", "values"})
      add(view_uses_, index_of(accessor["sparse"][half]["bufferView"]));
  }
  for (const json::Value& image : root["images"].items())
    add(view_uses_, index_of(image["bufferView"]));
}

void Uses::find_mentions(const json::Value& value, bool inside) {
  if (inside && value.is_number()) mentions_.insert(value.integer().value_or(-1));
  for (const auto& [name, member] : value.members()) {
    const bool names_extensions = name == "extensions";
    if (!names_extensions) {
      find_mentions(member, inside);
      continue;
    }
    for (const auto& [extension, content] : member.members()) {
      if (extension == "RIGC_rig" && !inside) continue;  // mostly, the larger part of a file
      find_mentions(content, inside || may_name_accessors(extension));
    }
  }
  for (const json::Value& item : value.items())
    if (inside || !item.is_number()) find_mentions(item, inside);
}

bool Uses::may_go(std::size_t index, bool ours) {
  if (ours) return true;
  if (!has_mentions_) find_mentions(file_.root(), false);
  has_mentions_ = true;
  return mentions_.count(static_cast<std::int64_t>(index)) == 0;
}

void Uses::drop_accessor(Patch& patch, int accessor, bool ours) {
  if (accessor < 0 || accessor >= static_cast<int>(accessor_uses_.size())) return;
  const auto index = static_cast<std::size_t>(accessor);
  if (--accessor_uses_[index] != 0 || !may_go(index, ours)) return;
  patch.release("accessors", accessor);
  drop_view(patch, accessors_[index]["bufferView"], ours);
  for (const char* half : {"indices", "values"})
    drop_view(patch, accessors_[index]["sparse"][half]["bufferView"], ours);
}

void Uses::drop_view(Patch& patch, const json::Value& value, bool ours) {
  const int view = index_of(value);
  if (view < 0 || view >= static_cast<int>(view_uses_.size())) return;
  const auto index = static_cast<std::size_t>(view);
  if (--view_uses_[index] == 0 && may_go(index, ours)) patch.release("bufferViews", view);
}

}  // namespace rigc::gltf
