// SPDX-License-Identifier: MIT
// Reads the summaries of many files at a time and assesses their rigs.
// Test: tests/cli/status_test.cpp
#include "pipeline/status.h"

#include <algorithm>
#include <new>

#include "base/threads.h"
#include "pipeline/batch_codes.h"
#include "pipeline/batch_inputs.h"
#include "templates/library.h"

namespace rigc::pipeline {
namespace {

void read_file_status(const Installed& installed, FileStatus& out, Diagnostics& diagnostics) try {
  auto rigs = gltf::read_rig_summaries(out.file, diagnostics);
  if (!rigs) return;
  for (gltf::RigSummary& rig : *rigs) {
    Assessment assessment = installed.assess(rig.templates, rig.modules);
    out.rigs.push_back({std::move(rig), std::move(assessment)});
  }
  out.read = true;
} catch (const std::bad_alloc&) {
  // One file that is too much must not end the others.
  out.rigs.clear();
  diagnostics.report(codes::kOutOfMemory, Place(out.file), "there is not enough memory");
}

}  // namespace

std::optional<std::vector<FileStatus>> status(const StatusRequest& request,
                                              Diagnostics& diagnostics) {
  catalog::Catalogue catalogue;
  auto inputs = find_inputs(request.inputs, {}, diagnostics);
  if (!add_modules(request.paths, catalogue, diagnostics) || !inputs) return std::nullopt;
  const Installed installed(templates::template_folders(request.paths.templates), catalogue);
  if (!installed.versions().check_readable(diagnostics)) return std::nullopt;
  installed.versions().report_twins(diagnostics);

  std::vector<FileStatus> files;
  for (BatchInput& input : *inputs) files.push_back({std::move(input.path), false, {}});
  std::vector<Diagnostics> reported(files.size());
  Threads threads(static_cast<unsigned>(request.jobs));
  threads.for_each(files.size(),
                   [&](std::size_t i) { read_file_status(installed, files[i], reported[i]); });
  for (const Diagnostics& one : reported) diagnostics.append(one);
  return files;
}

bool any_changes(const std::vector<FileStatus>& files) {
  return std::any_of(files.begin(), files.end(), [](const FileStatus& file) {
    return std::any_of(file.rigs.begin(), file.rigs.end(),
                       [](const RigStatus& rig) { return rig.assessment.needs_update(); });
  });
}

}  // namespace rigc::pipeline
