// SPDX-License-Identifier: MIT
// Which files a folder has for check, and what a YAML file is. Test: tests/pipeline/check_test.cpp
#include <filesystem>

#include "base/files.h"
#include "base/text.h"
#include "base/yaml.h"
#include "pipeline/check_kinds.h"

namespace rigc::pipeline {
namespace {

constexpr int kMostDeep = 64;
constexpr std::pair<std::string_view, std::string_view> kFirstKeys[] = {
    {"rigc", "template"}, {"map", "map"}, {"module", "module"}};

/// Where the text is no YAML: the key at the beginning of a line.
std::string kind_of_broken(std::string_view text) {
  for (std::string_view line : split(text, '\n'))
    for (const auto& [key, kind] : kFirstKeys)
      if (starts_with(line, key) && starts_with(line.substr(key.size()), ":"))
        return std::string(kind);
  return {};
}

void add_files(const std::string& folder, int depth, std::vector<std::string>& found) {
  for (const std::string& name : list_folder(folder)) {
    const std::string path = join_path(folder, name);
    if (starts_with(name, ".")) continue;
    if (folder_exists(path)) {
      std::error_code ignored;
      const bool link = std::filesystem::is_symlink(path, ignored);
      if (depth < kMostDeep && !link) add_files(path, depth + 1, found);
    } else if (is_gltf(path)) {
      found.push_back(path);
    } else if (ends_with(name, ".yaml") || ends_with(name, ".yml")) {
      Diagnostics unused;
      if (!yaml_kind(path, unused).empty()) found.push_back(path);
    }
  }
}

}  // namespace

bool is_gltf(const std::string& path) {
  for (const char* ending : {".glb", ".gltf", ".vrm", ".vrma"})
    if (ends_with(path, ending)) return true;
  return false;
}

std::string yaml_kind(const std::string& path, Diagnostics& diagnostics) {
  auto text = read_file(path, 4u << 20, diagnostics);
  if (!text) return {};
  const std::uint32_t file = diagnostics.sources().add(path, std::move(*text));
  const auto root = yaml::read(file, diagnostics);
  if (!root) return kind_of_broken(diagnostics.sources().text(file));
  for (const auto& [key, kind] : kFirstKeys)
    if (root->is_map() && root->find(key)) return std::string(kind);
  return {};
}

std::vector<std::string> files_to_check(const std::string& folder) {
  std::vector<std::string> found;
  add_files(folder, 0, found);
  return found;
}

}  // namespace rigc::pipeline
