// SPDX-License-Identifier: MIT
// What made the rigs of a file, read without their scenes, without buffers, and past most of the
// file's JSON: a thousand files a second. Test: tests/gltf/rig_summary_test.cpp
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "base/ids.h"
#include "tags/tags.h"

namespace rigc::gltf {

/// Keys and values that wait on a holder node for a control that the rig does not have now.
struct OrphanSummary {
  std::string identity;  ///< that was lost
  std::string name, local, label;
  std::vector<std::string> attributes;  ///< that it keeps
};

struct RigSummary {
  std::uint32_t id = 0;  ///< number of the rig, unique in its file
  std::string name;      ///< of the template
  std::string global;
  std::vector<tags::TemplateReference> templates;  ///< the main one first
  /// Name and version of each module that its tags name.
  std::vector<std::pair<std::string, int>> modules;
  tags::Settings settings;
  std::vector<OrphanSummary> orphans;
};

/// The rigs of a .glb or .gltf, ordered by id; empty for a file without any. Checked are only the
/// container and what is read: the rest of the file may still be bad.
std::optional<std::vector<RigSummary>> read_rig_summaries(const std::string& path,
                                                          Diagnostics& diagnostics);

/// The JSON text of a glTF file without all that a summary does not need: what is left stands under
/// the same keys. Nothing where the brackets do not match or keys are spelled with escapes.
std::optional<std::string> without_details(std::string_view json);

}  // namespace rigc::gltf
