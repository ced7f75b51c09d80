// SPDX-License-Identifier: MIT
// Cycles: what is one and what is none, and that the message names every plug, command and line.
#include "eval/cycle.h"

#include <doctest/doctest.h>

#include "eval/codes.h"
#include "tests/eval/scene_builder.h"

namespace rigc {
namespace {

using scene::Kind;
using scene::NodeId;
using scene::Plug;
using test::SceneBuilder;
namespace transform = scene::transform;

Diagnostics compile(const SceneBuilder& b, const std::vector<Plug>& outputs,
                    Diagnostics diagnostics = {}) {
  eval::Request request;
  request.outputs = outputs;
  const bool compiled = eval::compile(b.scene, request, diagnostics).has_value();
  CHECK(compiled == diagnostics.ok());
  return diagnostics;
}

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

NodeId made_by(SceneBuilder& b, std::uint32_t file, std::uint32_t line, const char* command,
               const char* joint) {
  scene::Node node;
  node.name = std::string(command) + "_node";
  node.origin = {{file, line, 5, 3}, joint, command};
  return b.edit.make(std::move(node));
}

TEST_CASE("eval cycle: every plug, command and template line is named") {
  Diagnostics diagnostics;
  const std::uint32_t file = diagnostics.sources().add("biped.yaml", "rigc: 1\n");
  SceneBuilder b;
  const NodeId first = made_by(b, file, 12, "control", "hand"),
               second = made_by(b, file, 34, "connect", "elbow");
  b.edit.connect({first, transform::kTranslate, -1, 0}, {second, transform::kScale, -1, 1});
  b.edit.connect({second, transform::kScale, -1, 1}, {first, transform::kTranslate, -1, 0});
  diagnostics = compile(b, {{first, transform::kWorld}}, diagnostics);
  REQUIRE(diagnostics.errors() == 1);
  const Diagnostic& d = diagnostics.all()[0];
  CHECK(d.code == &eval::codes::kCycle);
  CHECK(d.place.span.line == 12);
  for (const char* part : {"translate.x", "control", "hand", "biped.yaml:12:5", "scale.y",
                           "connect", "elbow", "biped.yaml:34:5"}) {
    CAPTURE(part);
    CHECK(has(d.hint, part));
  }
}

TEST_CASE("eval cycle: the message is the same wherever the walk begins") {
  SceneBuilder b;
  std::vector<NodeId> ring;
  for (int i = 0; i < 5; ++i) ring.push_back(b.transform("n"));
  for (std::size_t i = 0; i < 5; ++i)
    b.edit.connect({ring[(i + 1) % 5], transform::kScale}, {ring[i], transform::kScale});
  const std::string want = compile(b, {{ring[0], transform::kScale}}).all()[0].hint;
  for (const NodeId node : ring) {
    CHECK(compile(b, {{node, transform::kScale}}).all()[0].hint == want);
    CHECK(compile(b, {{node, transform::kWorld}}).errors() == 1);
  }
}

TEST_CASE("eval cycle: a plug connected to itself") {
  SceneBuilder b;
  const NodeId node = b.transform("node");
  b.edit.connect({node, transform::kScale}, {node, transform::kScale});
  CHECK(compile(b, {{node, transform::kWorld}}).errors() == 1);
}

TEST_CASE("eval cycle: through a hierarchy and a constraint") {
  SceneBuilder b;
  const NodeId root = b.transform("root"), child = b.transform("child", root);
  const NodeId node = b.make(Kind::parent_constraint, "constraint");
  namespace c = scene::constraint;
  b.edit.connect({child, transform::kWorld}, {node, c::kTargets, 0});
  b.edit.set({node, c::kWeights, 0}, 1.0);
  b.edit.set({node, c::kOffsets, 0}, math::Affine{});
  b.edit.connect({node, c::kTranslate}, {root, transform::kTranslate});
  const Diagnostics d = compile(b, {{child, transform::kWorld}});
  REQUIRE(d.errors() == 1);
  for (const char* part : {"root", "child", "constraint", "targets[0]", "translate", "world"})
    CHECK(has(d.all()[0].hint, part));
}

TEST_CASE("eval cycle: rings that are none") {
  SceneBuilder b;
  const NodeId node = b.transform("node");
  // x from y, y from z: an order exists.
  b.edit.connect({node, transform::kTranslate, -1, 1}, {node, transform::kTranslate, -1, 0});
  b.edit.connect({node, transform::kTranslate, -1, 2}, {node, transform::kTranslate, -1, 1});
  CHECK(compile(b, {{node, transform::kWorld}}).ok());
  // A child's own translate does not depend on where its parent is.
  const NodeId child = b.transform("child", node);
  b.edit.connect({child, transform::kTranslate}, {node, transform::kScale});
  CHECK(compile(b, {{child, transform::kWorld}}).ok());
  // An angle from another angle of the same node.
  const NodeId turned = b.transform("turned");
  b.edit.connect({turned, transform::kRotate, -1, 1}, {turned, transform::kRotate, -1, 0});
  CHECK(compile(b, {{turned, transform::kWorld}}).ok());
}

TEST_CASE("eval cycle: the Euler view and the rotation that it overrides") {
  SceneBuilder b;
  const NodeId node = b.transform("node");
  // rotation.y is what the view makes of it; feeding it back into the view is a ring.
  b.edit.connect({node, transform::kRotation, -1, 1}, {node, transform::kRotate, -1, 0});
  CHECK(compile(b, {{node, transform::kWorld}}).errors() == 1);
}

TEST_CASE("eval cycle: each ring is reported once, others too") {
  SceneBuilder b;
  std::vector<Plug> outputs;
  for (int i = 0; i < 4; ++i) {
    const NodeId node = b.transform("node");
    b.edit.connect({node, transform::kScale}, {node, transform::kTranslate});
    b.edit.connect({node, transform::kTranslate}, {node, transform::kScale});
    outputs.push_back({node, transform::kWorld});
    outputs.push_back({node, transform::kScale});
  }
  CHECK(compile(b, outputs).errors() == 4);
}

TEST_CASE("eval cycle: a ring of a hundred thousand") {
  SceneBuilder b;
  const int n = 100000;
  for (int i = 0; i < n; ++i) b.transform("n");
  for (std::uint32_t i = 0; i < n; ++i) {
    b.edit.connect({NodeId{(i + 1) % n}, transform::kScale}, {NodeId{i}, transform::kScale});
  }
  const Diagnostics d = compile(b, {{NodeId{7}, transform::kWorld}});
  REQUIRE(d.errors() == 1);
  CHECK(has(d.all()[0].message, "100000 attributes"));
  CHECK(d.all()[0].hint.size() < 20000);
}

}  // namespace
}  // namespace rigc
