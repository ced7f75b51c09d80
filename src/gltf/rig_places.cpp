// SPDX-License-Identifier: MIT
// Places in template files as RIGC_rig keeps them. Test: tests/gltf/rig_json_test.cpp
#include "gltf/rig_places.h"

#include <fmt/format.h>

#include "base/text.h"
#include "gltf/rig_codes.h"

namespace rigc::gltf {
namespace {

constexpr std::size_t kMostFiles = 4096;
constexpr std::int64_t kMostLines = 100'000'000;

std::string_view without_folders(std::string_view file) {
  const std::size_t slash = file.rfind('/');
  return slash == std::string_view::npos ? file : file.substr(slash + 1);
}

/// Parts are named without their extension.
std::string_view without_extension(std::string_view file) {
  return ends_with(file, ".yaml") ? file.substr(0, file.size() - 5) : file;
}

}  // namespace

std::vector<std::string> reference_names(const std::vector<tags::TemplateReference>& templates) {
  std::vector<std::string> names;
  for (const tags::TemplateReference& reference : templates) {
    const std::string& file = reference.file;
    const bool leaves = starts_with(file, "/") || file.find("..") != std::string::npos;
    names.emplace_back(leaves || names.empty() ? without_folders(file) : file);
  }
  return names;
}

std::string portable_name(std::string_view file, const std::vector<std::string>& references) {
  const std::string_view stem = without_extension(file);
  std::string_view best;
  for (const std::string& reference : references) {
    const std::string_view wanted = without_extension(reference);
    const bool fits = stem == wanted || ends_with(stem, '/' + std::string(wanted));
    if (fits && wanted.size() > best.size()) best = wanted;
  }
  if (best.empty()) return std::string(without_folders(file));
  return std::string(best) + std::string(file.substr(stem.size()));
}

int PlaceWriter::number(std::string_view file) {
  std::string name = portable_name(file, references_);
  const auto [at, is_new] = numbers_.emplace(name, static_cast<int>(files_.size()));
  if (is_new) files_.push_back(std::move(name));
  return at->second;
}

void PlaceWriter::write(json::Writer& writer, const Span& span) {
  if (!span.known()) return;
  const double place[] = {static_cast<double>(number(sources_.name(span.file))),
                          static_cast<double>(span.line), static_cast<double>(span.column)};
  writer.key("at").numbers(place, 3);
}

void PlaceWriter::write(json::Writer& writer, const std::string& file, int line) {
  if (file.empty()) return;
  const double place[] = {static_cast<double>(number(file)), static_cast<double>(line)};
  writer.key("at").numbers(place, 2);
}

PlaceReader::PlaceReader(const json::Value& rig, JsonReader& reader, const std::string& rig_file)
    : reader_(reader) {
  if (!rig_file.empty()) rig_place_ = rig_file + '#' + rig.pointer();
  reader.get(rig, "files", files_);
  if (files_.size() > kMostFiles) {
    reader.fail(codes::kRigTooLarge, rig["files"],
                fmt::format("{} files; at most {} are allowed", files_.size(), kMostFiles));
    files_.clear();
  }
  for (const std::string& file : files_)
    sources_.push_back(reader.diagnostics().sources().add(file, {}));
}

bool PlaceReader::numbers(const json::Value& object, std::size_t count, std::int64_t* out) {
  const json::Value at = object["at"];
  if (!at) return false;
  if (!at.is_array() || at.size() != count) {
    reader_.fail(codes::kRigType, at, fmt::format("{} numbers are needed here", count));
    return false;
  }
  const auto values = at.items();
  const auto last_file = static_cast<std::int64_t>(files_.size()) - 1;
  for (std::size_t i = 0; i < count; ++i) {
    if (!reader_.whole(values[i], 0, i == 0 ? last_file : kMostLines, out[i])) return false;
  }
  return true;
}

Span PlaceReader::read(const json::Value& object) {
  std::int64_t n[3];
  if (!numbers(object, 3, n)) return {};
  return {sources_[static_cast<std::size_t>(n[0])], static_cast<std::uint32_t>(n[1]),
          static_cast<std::uint32_t>(n[2]), 0};
}

Span PlaceReader::read_node(const json::Value& object, std::size_t index) {
  const Span span = read(object);
  if (rig_place_.empty()) return span;
  return {reader_.diagnostics().sources().add(fmt::format("{}/nodes/{}", rig_place_, index), {}), 0,
          0, 0};
}

void PlaceReader::read(const json::Value& object, std::string& file, int& line) {
  std::int64_t n[2];
  if (!numbers(object, 2, n)) return;
  file = files_[static_cast<std::size_t>(n[0])];
  line = static_cast<int>(n[1]);
}

}  // namespace rigc::gltf
