// SPDX-License-Identifier: MIT
// Compiles a built scene once, so that a cycle is an error of the build and not of the first bake.
// Test: tests/pipeline/build_test.cpp
#include "base/trace.h"
#include "eval/program.h"
#include "pipeline/build.h"

namespace rigc::pipeline {

bool check_evaluates(const scene::Scene& scene, Diagnostics& diagnostics) {
  const trace::Span span("check evaluation");
  eval::Request request;
  for (scene::NodeId id : scene.nodes()) {
    if (scene::spec(scene[id].kind).is_transform)
      request.outputs.push_back({id, scene::transform::kWorld});
    if (scene[id].kind != scene::Kind::control) continue;
    // What animators key is an input: nothing that hangs on it may be folded away, or a cycle could
    // hide.
    request.inputs.push_back({id, scene::transform::kTranslate});
    request.inputs.push_back({id, scene::transform::kRotation});
  }
  return eval::compile(scene, request, diagnostics).has_value();
}

bool check_evaluates(const gltf::File& file, const gltf::Rig& rig, Diagnostics& diagnostics) {
  Diagnostics ignored;
  if (check_evaluates(rig.scene, ignored)) return true;
  // The template's lines are right: somebody changed the rig since. Read it again with its places.
  Diagnostics in_file;
  const auto rigs = gltf::read_rigs(file, in_file, gltf::Origins::file);
  const std::size_t known = in_file.all().size();
  for (const gltf::Rig& again : rigs.value_or(std::vector<gltf::Rig>()))
    if (again.id == rig.id) check_evaluates(again.scene, in_file);
  for (std::size_t i = known; i < in_file.all().size(); ++i) {
    const Diagnostic& wrong = in_file.all()[i];
    diagnostics.report(*wrong.code, Place(describe(wrong.place, in_file.sources())), wrong.message,
                       wrong.hint);
  }
  return false;
}

}  // namespace rigc::pipeline
