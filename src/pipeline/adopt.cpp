// SPDX-License-Identifier: MIT
// Adopt: the driver, and which nodes are which. Test: tests/pipeline/adopt_test.cpp
#include "pipeline/adopt.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "pipeline/adopt_steps.h"
#include "pipeline/build.h"
#include "pipeline/codes.h"
#include "pipeline/rebuild.h"

namespace rigc::pipeline {
namespace {

// Programs keep 32-bit floats, turn axes, and go through matrices.
constexpr double kSameLength = 1e-5;  // of the character's height, or of the value
constexpr double kSameNumber = 2e-5;

std::optional<Side> read_side(const std::string& path, Diagnostics& diagnostics) {
  auto file = gltf::open(path, diagnostics);
  if (!file) return std::nullopt;
  auto slim = gltf::read_slim(*file, diagnostics, false);
  auto clips = gltf::read_clips(*file, diagnostics);
  if (!slim || !clips) return std::nullopt;
  return Side{std::move(*file), std::move(*slim), std::move(*clips)};
}

std::string shown(const Side& side, int node) {
  return fmt::format("{} (\"{}\")", node, printable(side.slim.node(node).name, 60));
}

/// What a node of the edited file says that it is.
std::optional<Identity> identity_of(const json::Value& node) {
  const auto text = node["extras"]["rigc"].string();
  return text ? parse_identity(*text) : std::nullopt;
}

}  // namespace

bool same_value(const Twin& twin, anim::Path path, const double* a, const double* b) {
  if (path == anim::Path::rotation) {
    double same = 0, opposite = 0;
    for (int i = 0; i < 4; ++i) {
      same = std::max(same, std::abs(a[i] - b[i]));
      opposite = std::max(opposite, std::abs(a[i] + b[i]));
    }
    return std::min(same, opposite) <= kSameNumber;
  }
  const bool length = path == anim::Path::translation;
  const int width = path == anim::Path::attribute ? 1 : 3;
  const double unit = length ? twin.rig->skeleton.character.height : 1;
  for (int i = 0; i < width; ++i) {
    const double size = std::max({unit, std::abs(a[i]), std::abs(b[i])});
    if (std::abs(a[i] - b[i]) > kSameLength * size) return false;
  }
  return true;
}

std::optional<std::vector<Twin>> find_twins(const Side& edited, const Side& original,
                                            const std::vector<gltf::Rig>& rigs, Adopted& report,
                                            Diagnostics& diagnostics) {
  std::map<Identity, Twin> known;
  for (const gltf::Rig& rig : rigs) {
    for (const scene::NodeId id : rig.scene.nodes()) {
      if (rig.nodes[id.index] < 0) continue;
      Identity identity = rig.scene[id].identity;
      identity.rig = rig.id;
      known.emplace(identity, Twin{-1, rig.nodes[id.index], &rig, id});
    }
  }
  std::vector<Twin> twins;
  std::map<Identity, int> seen;
  bool unique = true;
  const auto nodes = edited.file.root()["nodes"].items();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto identity = identity_of(nodes[i]);
    if (!identity) continue;
    const int node = static_cast<int>(i);
    const auto [first, fresh] = seen.emplace(*identity, node);
    if (!fresh) {
      unique = false;
      diagnostics.report(
          codes::kCopiedNode, Place(edited.file.path, fmt::format("/nodes/{}", node)),
          fmt::format("nodes {} and {} both say that they are {}", shown(edited, first->second),
                      shown(edited, node), to_text(*identity)),
          "remove the custom property `rigc` from the one that is a copy");
      continue;
    }
    const auto found = known.find(*identity);
    if (found == known.end()) {
      ++report.unknown;
      continue;
    }
    twins.push_back(found->second);
    twins.back().edited = node;
  }
  if (!unique) return std::nullopt;
  if (twins.empty()) {
    diagnostics.report(
        codes::kNothingToAdopt, Place(edited.file.path),
        report.unknown == 0 ? std::string("no node says what it is")
                            : fmt::format("no node is one of {}", printable(original.file.path)),
        report.unknown == 0 ? "export with custom properties (Blender: export_extras=True)"
                            : "is --rig the file that went into the other program?");
    return std::nullopt;
  }
  if (report.unknown > 0)
    diagnostics.report(codes::kStrangers, Place(edited.file.path),
                       fmt::format("{} nodes say that they are something that {} does not have",
                                   report.unknown, printable(original.file.path)));
  return twins;
}

std::optional<Adopted> adopt(const AdoptRequest& request, const std::string& out,
                             Diagnostics& diagnostics) {
  catalog::Catalogue catalogue;
  if (!check_output_name(out, diagnostics)) return std::nullopt;
  if (request.skeleton && !add_modules(request.paths, catalogue, diagnostics)) return std::nullopt;
  const auto edited = read_side(request.edited, diagnostics);
  const auto original = read_side(request.original, diagnostics);
  if (!edited || !original) return std::nullopt;
  const auto rigs = gltf::read_rigs(original->file, diagnostics);
  if (!rigs) return std::nullopt;
  if (rigs->empty()) {
    diagnostics.report(codes::kNoRig, Place(request.original), "the file has no rig");
    return std::nullopt;
  }
  Adopted report;
  const auto twins = find_twins(*edited, *original, *rigs, report, diagnostics);
  if (!twins) return std::nullopt;
  std::set<Target> keyed;
  const auto changes = adopt_clips(request, *edited, *original, *twins, keyed, report, diagnostics);
  if (!changes) return std::nullopt;

  gltf::Patch patch(original->file);
  adopt_values(*edited, *original, *twins, keyed, patch, report);
  if (request.skeleton) adopt_joints(*edited, *original, *twins, patch, report);
  gltf::write_clips(patch, original->file, *changes);
  if (!write_output(patch, original->file, out, report.bytes, diagnostics)) return std::nullopt;
  if (report.joints == 0) return report;
  const auto rebuilt = rebuild({}, catalogue, {out, out, {}}, diagnostics);
  if (!rebuilt) return std::nullopt;
  report.bytes = rebuilt->bytes;
  return report;
}

}  // namespace rigc::pipeline
