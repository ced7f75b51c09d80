// SPDX-License-Identifier: MIT
// Compiles a built scene once, so that a cycle is an error of the build and not of the first bake.
// Test: tests/pipeline/build_test.cpp
#include "eval/program.h"
#include "pipeline/build.h"

namespace rigc::pipeline {

bool check_evaluates(const scene::Scene& scene, Diagnostics& diagnostics) {
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

}  // namespace rigc::pipeline
