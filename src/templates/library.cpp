// SPDX-License-Identifier: MIT
// Finding and reading template files, each once. Test: tests/templates/library_test.cpp
#include "templates/library.h"

#include <fmt/format.h>

#include <cstdlib>

#include "base/files.h"
#include "base/text.h"
#include "base/trace.h"
#include "templates/codes.h"
#include "templates/read.h"

namespace rigc::templates {
namespace {

constexpr std::uint64_t kMostBytes = 4u << 20;

bool is_path(const std::string& text) {
  return text.find('/') != std::string::npos || ends_with(text, ".yaml") || ends_with(text, ".yml");
}

std::vector<std::string> names_in(const std::vector<std::string>& folders) {
  std::vector<std::string> names;
  for (const std::string& folder : folders)
    for (const std::string& file : list_folder(folder))
      if (ends_with(file, ".yaml")) names.push_back(stem_of(file));
  return names;
}

}  // namespace

std::vector<std::string> template_folders(const std::vector<std::string>& given) {
  std::vector<std::string> folders = given;
  if (const char* list = std::getenv("RIGC_TEMPLATES"))
    for (const std::string_view folder : split(list, ':'))
      if (!folder.empty()) folders.emplace_back(folder);
  const std::string data = data_folder();
  if (!data.empty()) folders.push_back(join_path(data, "templates"));
  return folders;
}

std::optional<std::string> part_file(const std::string& reference, const std::string& folder,
                                     const std::vector<std::string>& folders) {
  std::vector<std::string> places = {folder.empty() ? "." : folder};
  places.insert(places.end(), folders.begin(), folders.end());
  for (const std::string& place : places) {
    const auto path = confine(place, reference + ".yaml");
    if (path && file_exists(*path)) return path;
  }
  return std::nullopt;
}

const Template* Library::open(const std::string& path_or_name, Diagnostics& diagnostics) {
  if (is_path(path_or_name) || file_exists(path_or_name))
    return read_once(path_or_name, path_or_name, {}, diagnostics);
  if (const auto path = find(path_or_name)) return read_once(*path, *path, {}, diagnostics);
  diagnostics.report(codes::kUnknownTemplate, Place(path_or_name),
                     fmt::format("there is no template \"{}\"", printable(path_or_name, 100)),
                     suggest(path_or_name, names_in(folders_)));
  return nullptr;
}

std::optional<std::string> Library::find(const std::string& name) const {
  for (const std::string& folder : folders_) {
    const auto path = confine(folder, name + ".yaml");
    if (path && file_exists(*path)) return join_path(folder, name + ".yaml");
  }
  return std::nullopt;
}

const Template* Library::open_part(const Part& part, const Template& outer,
                                   Diagnostics& diagnostics) {
  const std::string file = part.reference + ".yaml";
  std::vector<std::string> places = {outer.folder.empty() ? "." : outer.folder};
  places.insert(places.end(), folders_.begin(), folders_.end());
  bool confined = false;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto path = confine(places[i], file);
    confined |= path.has_value();
    if (!path || !file_exists(*path)) continue;
    const bool beside = i == 0;
    const std::string shown = beside && outer.folder.empty() ? file : join_path(places[i], file);
    return read_once(*path, shown, part.reference, diagnostics);
  }
  if (confined)
    diagnostics.report(codes::kUnknownPart, part.span,
                       fmt::format("there is no part \"{}\"", printable(part.reference, 100)),
                       fmt::format("looked for {} in {}", printable(file, 100),
                                   printable(join(places, ", "), 300)));
  else
    diagnostics.report(codes::kPartOutside, part.span,
                       fmt::format("the part \"{}\" lies outside of the template's folder",
                                   printable(part.reference, 100)),
                       "name a file in that folder or below, or in a template folder");
  return nullptr;
}

const Template* Library::read_once(const std::string& path, const std::string& shown_path,
                                   const std::string& reference, Diagnostics& diagnostics) {
  const auto found = read_.find(path);
  if (found != read_.end()) return found->second.get();
  const trace::Span span("read template", trace::kStage, "template", shown_path);
  std::unique_ptr<Template>& slot = read_[path];
  auto text = read_file(path, kMostBytes, diagnostics);
  if (!text) return nullptr;
  const std::uint32_t file = diagnostics.sources().add(shown_path, std::move(*text));
  auto result = read(file, catalogue_, diagnostics);
  if (!result) return nullptr;
  if (!reference.empty()) result->reference = reference;
  slot = std::make_unique<Template>(std::move(*result));
  return slot.get();
}

}  // namespace rigc::templates
