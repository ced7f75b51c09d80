// SPDX-License-Identifier: MIT
// Hierarchies in few instructions: constants are multiplied when compiling, and the worlds stay
// what they are.
#include "eval/worlds.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "tests/eval/scene_builder.h"
#include "tests/math/random.h"

namespace rigc {
namespace {

using eval::Op;
using math::Vec3;
using scene::NodeId;
using test::Random;
using test::SceneBuilder;
namespace transform = scene::transform;

std::vector<Op> ops_of(const SceneBuilder& b, const std::vector<scene::Plug>& inputs, NodeId node) {
  Diagnostics diagnostics;
  const auto program = eval::compile(b.scene, {inputs, {{node, transform::kWorld}}}, diagnostics);
  REQUIRE(program);
  std::vector<Op> ops;
  for (const eval::Instruction& i : program->instructions) ops.push_back(i.op);
  return ops;
}

void pose(SceneBuilder& b, NodeId node, const math::Trs& trs) {
  b.edit.set({node, transform::kTranslate}, trs.translation);
  b.edit.set({node, transform::kRotation}, trs.rotation);
  b.edit.set({node, transform::kScale}, trs.scale);
}

TEST_CASE("eval worlds: a static chain under what moves costs one instruction") {
  Random random(1);
  SceneBuilder b;
  const NodeId root = b.transform("root");
  const std::vector<scene::Plug> moving{{root, transform::kTranslate},
                                        {root, transform::kRotation}};
  NodeId at = root;
  for (int i = 0; i < 20; ++i) {
    at = b.transform("n", at);
    pose(b, at, random.trs(false));
  }
  CHECK(ops_of(b, moving, at) == std::vector{Op::compose_rigid, Op::hang});
  // Only moved from each other.
  at = root;
  for (int i = 0; i < 5; ++i) {
    at = b.transform("n", at);
    b.edit.set({at, transform::kTranslate}, random.vector());
  }
  CHECK(ops_of(b, moving, at) == std::vector{Op::compose_rigid, Op::hang_straight});
  // Not moved at all, or there and back.
  const NodeId same = b.transform("same", root), away = b.transform("away", root),
               back = b.transform("back", away);
  b.edit.set({away, transform::kTranslate}, Vec3{1, 2, 3});
  b.edit.set({back, transform::kTranslate}, Vec3{-1, -2, -3});
  CHECK(ops_of(b, moving, same) == std::vector{Op::compose_rigid});
  CHECK(ops_of(b, moving, back) == std::vector{Op::compose_rigid});
}

TEST_CASE("eval worlds: a control under a zero under a control costs two instructions") {
  Random random(2);
  SceneBuilder b;
  const NodeId above = b.transform("above"), zero = b.transform("zero", above),
               control = b.transform("control", zero);
  const std::vector<scene::Plug> inputs{{above, transform::kRotation},
                                        {control, transform::kTranslate},
                                        {control, transform::kRotation}};
  math::Trs rigid = random.trs();
  rigid.scale = {1, 1, 1};
  pose(b, zero, rigid);
  CHECK(ops_of(b, inputs, control) ==
        std::vector{Op::compose_rigid, Op::compose_under, Op::multiply});
  pose(b, zero, random.trs(false));
  CHECK(ops_of(b, inputs, control) ==
        std::vector{Op::compose_rigid, Op::hang, Op::compose_rigid, Op::multiply});
}

TEST_CASE("eval worlds: any part of any hierarchy moves as it would by itself") {
  Random random(3);
  double most = 0;
  for (int i = 0; i < 100; ++i) {
    SceneBuilder b;
    std::vector<NodeId> nodes;
    std::vector<eval::Setting> settings;
    for (int n = 0; n < 25; ++n) {
      const NodeId above =
          n == 0 || random.chance(10) ? NodeId{} : nodes[random.below(nodes.size())];
      const NodeId id = b.transform("n", above);
      nodes.push_back(id);
      math::Trs trs = random.trs(random.chance(50));
      if (random.chance(60)) trs.scale = {1, 1, 1};
      if (random.chance(40)) trs.rotation = {};
      if (random.chance(20)) trs.translation = {};
      pose(b, id, trs);
      // The same values as inputs: nothing may be folded there, and all is as at rest.
      if (random.chance(40)) settings.push_back({{id, transform::kTranslate}, trs.translation});
      if (random.chance(40)) settings.push_back({{id, transform::kRotation}, trs.rotation});
      if (random.chance(20)) settings.push_back({{id, transform::kScale}, trs.scale});
    }
    const auto worlds = eval::worlds(b.scene, nodes, settings);
    REQUIRE(worlds.size() == nodes.size());
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const math::Affine rest = b.scene.rest_world(nodes[n]);
      const double size = 1 + math::length(rest.origin) + math::length(rest.linear.x) +
                          math::length(rest.linear.y) + math::length(rest.linear.z);
      most = std::max(most, test::distance(worlds[n], rest) / size);
    }
  }
  MESSAGE("largest difference: ", most);
  CHECK(most < 1e-13);
}

TEST_CASE("eval worlds: equal transforms are computed once") {
  SceneBuilder b;
  const NodeId root = b.transform("root"), left = b.transform("left", root),
               right = b.transform("right", root);
  for (const NodeId id : {left, right}) b.edit.set({id, transform::kTranslate}, Vec3{0, 1, 0});
  Diagnostics diagnostics;
  const auto program = eval::compile(
      b.scene,
      {{{root, transform::kRotation}}, {{left, transform::kWorld}, {right, transform::kWorld}}},
      diagnostics);
  REQUIRE(program);
  CHECK(program->instructions.size() == 2);
  CHECK(program->outputs[0].row == program->outputs[1].row);
}

}  // namespace
}  // namespace rigc
