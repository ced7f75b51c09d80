// SPDX-License-Identifier: MIT
// Check. Test: tests/pipeline/check_test.cpp
#include "pipeline/check.h"

#include "base/text.h"
#include "gltf/clips.h"
#include "gltf/rig.h"
#include "pipeline/build.h"

namespace rigc::pipeline {
namespace {

bool check_gltf(const std::string& path, Diagnostics& diagnostics) {
  const auto file = gltf::open(path, diagnostics);
  if (!file) return false;
  const auto rigs = gltf::read_rigs(*file, diagnostics);
  const auto clips = gltf::read_clips(*file, diagnostics);
  if (!rigs || !clips) return false;
  bool good = true;
  for (const gltf::Rig& rig : *rigs) good = check_evaluates(rig.scene, diagnostics) && good;
  return good;
}

bool check_template(const std::string& path, const Paths& paths, Diagnostics& diagnostics) {
  BuildRequest request;
  request.template_file = path;
  request.paths = paths;
  const auto prepared = prepare(request, diagnostics);
  if (!prepared) return false;
  // A part can only run inside the template that has the groups it needs.
  if (prepared->needs_outside) return true;
  processor::Processor processor(prepared->skeleton, prepared->commands, prepared->catalogue);
  return processor.run(diagnostics) && check_evaluates(processor.scene(), diagnostics);
}

}  // namespace

bool check(const std::string& file, const Paths& paths, Diagnostics& diagnostics) {
  for (const char* ending : {".glb", ".gltf", ".vrm", ".vrma"}) {
    if (ends_with(file, ending)) return check_gltf(file, diagnostics);
  }
  return check_template(file, paths, diagnostics);
}

}  // namespace rigc::pipeline
