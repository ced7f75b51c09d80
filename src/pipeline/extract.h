// SPDX-License-Identifier: MIT
// Extract: from a built rig to a template that builds it again. Test:
// tests/pipeline/extract_test.cpp
#pragma once

#include <optional>
#include <string>

#include "gltf/rig.h"
#include "pipeline/environment.h"

namespace rigc::pipeline {

struct ExtractRequest {
  std::string file;
  std::string rig;      ///< its global group; empty: the only one
  std::string name;     ///< of the template; empty: that of the one that built the rig
  std::string version;  ///< an integer from 1; empty: that of the template that built the rig
  Paths paths;
};

struct Extracted {
  std::string yaml;
  std::string name;
  int version = 1;
  std::size_t joints = 0;    ///< of the rig
  std::size_t commands = 0;  ///< tags, whether on or off
  bool fitted = false;       ///< the rig stands on a model, which gives the joints their places
};

std::optional<Extracted> extract(const ExtractRequest& request, Diagnostics& diagnostics);

/// The rig with this global group, or the only one where `global` is empty; a null pointer was
/// reported.
const gltf::Rig* choose_rig(const std::vector<gltf::Rig>& rigs, const std::string& global,
                            const std::string& file, Diagnostics& diagnostics);

}  // namespace rigc::pipeline
