// SPDX-License-Identifier: MIT
// Reads what made the rigs of a file. Test: tests/gltf/rig_summary_test.cpp
#include "gltf/rig_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/trace.h"
#include "gltf/container.h"
#include "gltf/rig_codes.h"
#include "gltf/rig_json.h"
#include "gltf/rig_json_reader.h"
#include "gltf/rig_json_skeleton.h"

namespace rigc::gltf {
namespace {

struct Text {
  std::string json;
  std::size_t offset = 0;  ///< in the file
};

std::optional<Text> read_text(const std::string& path, Diagnostics& diagnostics) {
  const auto whole = Bytes::open(path, kLargestFile, diagnostics);
  const auto container = whole ? read_container(*whole, path, diagnostics) : std::nullopt;
  if (!container) return std::nullopt;
  auto text = container->json.text(diagnostics);
  if (!text) return std::nullopt;
  return Text{std::move(*text), container->json_offset};
}

OrphanSummary read_orphan(const json::Value& object, JsonReader& reader) {
  OrphanSummary orphan;
  reader.get(object, "identity", orphan.identity);
  reader.get(object, "name", orphan.name);
  reader.get(object, "local", orphan.local);
  reader.get(object, "label", orphan.label);
  for (const json::Value& attribute : reader.objects(object, "attributes", kMostNodes))
    reader.get(attribute, "name", orphan.attributes.emplace_back(), Need::required);
  return orphan;
}

RigSummary read_rig(const json::Value& object, JsonReader& reader) {
  RigSummary rig;
  reader.get(object, "id", 0, UINT32_MAX, rig.id, Need::required);
  reader.get(object, "name", rig.name, Need::required);
  reader.get(object, "global", rig.global, Need::required);
  rig.templates = read_template_references(object, reader);
  rig.modules = read_versions(object, "modules", reader);
  read_settings(object, reader, rig.settings);
  for (const json::Value& orphan : reader.objects(object, "orphans", kMostNodes))
    rig.orphans.push_back(read_orphan(orphan, reader));
  return rig;
}

std::optional<std::vector<RigSummary>> read_rigs(const std::string& path, const json::Value& root,
                                                 Diagnostics& diagnostics) {
  const json::Value extension = root["extensions"]["RIGC_rig"];
  std::vector<RigSummary> rigs;
  if (!extension) return rigs;
  JsonReader reader(path, diagnostics);
  const auto version = extension["version"].integer();
  if (!version || *version < 1 || *version > kRigVersionNumber) {
    reader.fail(codes::kRigVersion, extension["version"] ? extension["version"] : extension,
                fmt::format("this rigc reads RIGC_rig version {}", kRigVersionNumber));
    return std::nullopt;
  }
  std::set<std::uint32_t> ids;
  for (const json::Value& item : reader.objects(extension, "rigs", kMostRigs, Need::required)) {
    rigs.push_back(read_rig(item, reader));
    if (!ids.insert(rigs.back().id).second)
      reader.fail(codes::kRigDuplicate, item["id"],
                  fmt::format("there are two rigs {}", rigs.back().id));
  }
  if (!reader.ok()) return std::nullopt;
  std::stable_sort(rigs.begin(), rigs.end(),
                   [](const RigSummary& a, const RigSummary& b) { return a.id < b.id; });
  return rigs;
}

std::optional<std::vector<RigSummary>> parse_rigs(const std::string& path, std::string json,
                                                  std::size_t offset, Diagnostics& diagnostics) {
  const auto document = json::parse(std::move(json), path, offset, diagnostics);
  if (!document) return std::nullopt;
  return read_rigs(path, document->root(), diagnostics);
}

}  // namespace

std::optional<std::vector<RigSummary>> read_rig_summaries(const std::string& path,
                                                          Diagnostics& diagnostics) {
  const trace::Span span("read rig versions");
  auto text = read_text(path, diagnostics);
  if (!text) return std::nullopt;
  if (auto rest = without_details(text->json)) {
    Diagnostics quiet;  // of an error, the whole text tells the right place
    if (auto rigs = parse_rigs(path, std::move(*rest), 0, quiet)) return rigs;
  }
  return parse_rigs(path, std::move(text->json), text->offset, diagnostics);
}

}  // namespace rigc::gltf
