// SPDX-License-Identifier: MIT
// Guides: writing the file that riggers edit, and building with it. Test:
// tests/pipeline/guides_test.cpp
#pragma once

#include <optional>
#include <string>

#include "pipeline/build.h"
#include "templates/guides.h"

namespace rigc::pipeline {

struct GuidesFile {
  std::string yaml;
  std::string template_name;
  std::size_t joints = 0;    ///< that have a guide
  std::size_t moved = 0;     ///< kept from the file before
  std::size_t edited = 0;    ///< controls, kept from the file before
  std::size_t of_model = 0;  ///< joints that are the model's own
};

struct GuidesRequest {
  BuildRequest build;
  std::string before;  ///< a guides file whose edits stay; empty: none
  /// A rig file of the same template: joints that stand elsewhere in it than fitted, and edits of
  /// controls that it was built with, are taken over. Empty: none.
  std::string from;
};

/// The guides of a build.
std::optional<GuidesFile> write_guides(const GuidesRequest& request, Diagnostics& diagnostics);

/// Puts guides over a skeleton: placed or fitted from a template, or as a rig file has it
/// (`expanded`: null). What they do not mention stays as it was. `put_back`: joints and controls
/// that they set back to what the template, or the fit, made of them.
bool apply_guides(const templates::Guides& guides, const templates::Expanded* expanded,
                  const catalog::Catalogue& catalogue, tags::TaggedSkeleton& skeleton,
                  std::vector<std::string>& put_back, Diagnostics& diagnostics);

/// Reports guides that are not of the template with one of these names.
bool check_guides_of(const templates::Guides& guides, const std::vector<std::string>& names,
                     Diagnostics& diagnostics);

}  // namespace rigc::pipeline
