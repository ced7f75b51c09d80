// SPDX-License-Identifier: MIT
// Reads the summaries of many files at a time and assesses their rigs.
// Test: tests/cli/status_test.cpp
#include "pipeline/status.h"

#include <algorithm>
#include <atomic>
#include <new>
#include <system_error>
#include <thread>

#include "pipeline/batch_codes.h"
#include "pipeline/batch_inputs.h"
#include "templates/library.h"

namespace rigc::pipeline {
namespace {

constexpr std::size_t kMostJobs = 64;

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

std::size_t job_count(std::size_t wanted, std::size_t files) {
  const std::size_t processors = std::max(1u, std::thread::hardware_concurrency());
  return std::min({wanted == 0 ? processors : wanted, kMostJobs, files});
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
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < files.size(); i = next++)
      read_file_status(installed, files[i], reported[i]);
  };
  std::vector<std::thread> others;
  try {
    while (others.size() + 1 < job_count(request.jobs, files.size())) others.emplace_back(work);
  } catch (const std::system_error&) {
    // No more threads to be had: those that are there do it all.
  }
  work();
  for (std::thread& other : others) other.join();
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
