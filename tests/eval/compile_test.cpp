// SPDX-License-Identifier: MIT
// The compiler: what overrides what, what is folded, what is never emitted, and bad nodes.
#include <doctest/doctest.h>

#include "eval/codes.h"
#include "eval/kernels/table.h"
#include "scene/codes.h"
#include "tests/eval/scene_builder.h"
#include "tests/math/random.h"

namespace rigc {
namespace {

using eval::Request;
using math::Vec3;
using scene::Kind;
using scene::NodeId;
using scene::Plug;
using test::SceneBuilder;
namespace transform = scene::transform;

eval::Program compile(const SceneBuilder& b, const Request& request) {
  Diagnostics diagnostics;
  auto program = eval::compile(b.scene, request, diagnostics);
  REQUIRE(program);
  return *program;
}

const Code* error_of(const SceneBuilder& b, const Request& request) {
  Diagnostics diagnostics;
  CHECK(!eval::compile(b.scene, request, diagnostics));
  REQUIRE(diagnostics.errors() >= 1);
  return diagnostics.all().front().code;
}

Plug component(Plug plug, int c) {
  plug.component = static_cast<std::int8_t>(c);
  return plug;
}

TEST_CASE("eval compile: worlds of a resting hierarchy are the rest worlds, bit for bit") {
  test::Random random(1);
  SceneBuilder b;
  std::vector<NodeId> nodes;
  for (int i = 0; i < 60; ++i) {
    const NodeId parent =
        i == 0 || random.chance(10) ? NodeId{} : nodes[random.below(nodes.size())];
    nodes.push_back(b.make(i % 3 ? Kind::joint : Kind::control, "n", parent));
    const math::Trs trs = random.trs(false);
    b.edit.set({nodes.back(), transform::kTranslate}, trs.translation);
    b.edit.set({nodes.back(), transform::kRotation}, trs.rotation);
    b.edit.set({nodes.back(), transform::kScale}, trs.scale);
  }
  const auto worlds = eval::worlds(b.scene, nodes);
  REQUIRE(worlds.size() == nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) CHECK(worlds[i] == b.scene.rest_world(nodes[i]));
}

TEST_CASE("eval compile: an input moves what hangs under it") {
  SceneBuilder b;
  const NodeId root = b.transform("root"), child = b.transform("child", root);
  b.edit.set({child, transform::kTranslate}, Vec3{0, 1, 0});
  const auto worlds =
      eval::worlds(b.scene, {child},
                   {{{root, transform::kRotation}, math::axis_angle({0, 0, 1}, math::kPi / 2)},
                    {{root, transform::kTranslate}, Vec3{5, 0, 0}}});
  CHECK(test::distance(worlds[0].origin, Vec3{4, 0, 0}) < 1e-15);
}

TEST_CASE("eval compile: a connection wins over input and value, component by component") {
  SceneBuilder b;
  const NodeId from = b.transform("from"), to = b.transform("to");
  b.edit.set({from, transform::kTranslate}, Vec3{1, 2, 3});
  b.edit.set({to, transform::kTranslate}, Vec3{10, 20, 30});
  const Plug target{to, transform::kTranslate};
  b.edit.connect({from, transform::kTranslate, -1, 2}, component(target, 0));
  CHECK(std::get<Vec3>(b.value(target)) == Vec3{3, 20, 30});
  CHECK(std::get<Vec3>(b.value(target, {{target, Vec3{7, 8, 9}}})) == Vec3{3, 8, 9});
  CHECK(b.number(component(target, 1), {{target, Vec3{7, 8, 9}}}) == 8);
  CHECK(b.number(component(target, 0), {{target, Vec3{7, 8, 9}}}) == 3);
  b.edit.connect({from, transform::kTranslate}, target);
  CHECK(std::get<Vec3>(b.value(target, {{target, Vec3{7, 8, 9}}})) == Vec3{3, 2, 3});
}

TEST_CASE("eval compile: a component is connected over a whole one") {
  SceneBuilder b;
  const NodeId a = b.transform("a"), c = b.transform("c"), to = b.transform("to");
  b.edit.set({a, transform::kTranslate}, Vec3{1, 2, 3});
  b.edit.set({c, transform::kTranslate}, Vec3{4, 5, 6});
  b.edit.connect({a, transform::kTranslate}, {to, transform::kTranslate});
  b.edit.connect({c, transform::kTranslate, -1, 1}, {to, transform::kTranslate, -1, 1});
  CHECK(b.number({to, transform::kTranslate, -1, 1}) == 5);
  CHECK(b.number({to, transform::kTranslate, -1, 0}) == 1);
  CHECK(std::get<Vec3>(b.value({to, transform::kTranslate})) == Vec3{1, 5, 3});
}

TEST_CASE("eval compile: the Euler view reads, overrides and mixes") {
  SceneBuilder b;
  const NodeId from = b.transform("from"), to = b.transform("to");
  const Plug rotate{to, transform::kRotate}, rotation{to, transform::kRotation};
  b.edit.set(rotate, Vec3{10, 20, 30});
  CHECK(test::distance(std::get<Vec3>(b.value(rotate)), Vec3{10, 20, 30}) < 1e-13);
  CHECK(b.number(component(rotate, 2)) == doctest::Approx(30));
  // One angle connected: the others stay those of the rotation, set or animated.
  b.edit.set({from, transform::kTranslate}, Vec3{45, 0, 0});
  b.edit.connect({from, transform::kTranslate, -1, 0}, component(rotate, 1));
  CHECK(test::distance(std::get<Vec3>(b.value(rotate)), Vec3{10, 45, 30}) < 1e-13);
  CHECK(test::distance(std::get<math::Quat>(b.value(rotation)),
                       math::from_euler_degrees({10, 45, 30})) < 1e-15);
  const eval::Setting turned{rotation, math::from_euler_degrees({-5, 0, 60})};
  CHECK(test::distance(std::get<Vec3>(b.value(rotate, {turned})), Vec3{-5, 45, 60}) < 1e-13);
  const auto world = eval::worlds(b.scene, {to}, {turned})[0];
  CHECK(test::distance(world, math::rotation(math::from_euler_degrees({-5, 45, 60}))) < 1e-15 * 8);
  // The whole view connected: nothing of the rotation is left.
  b.edit.connect({from, transform::kScale}, rotate);
  CHECK(test::distance(std::get<math::Quat>(b.value(rotation, {turned})),
                       math::from_euler_degrees({1, 45, 1})) < 1e-15);
}

TEST_CASE("eval compile: angles as input replace the rotation") {
  SceneBuilder b;
  const NodeId node = b.transform("node");
  const eval::Setting angles{{node, transform::kRotate}, Vec3{0, 200, 0}};
  CHECK(test::distance(std::get<math::Quat>(b.value({node, transform::kRotation}, {angles})),
                       math::from_euler_degrees({0, 200, 0})) < 1e-15);
  CHECK(b.number({node, transform::kRotate, -1, 1}, {angles}) == 200);
}

TEST_CASE("eval compile: a rotation is put together from components") {
  SceneBuilder b;
  const NodeId from = b.transform("from"), to = b.transform("to");
  b.edit.set({from, transform::kTranslate}, Vec3{1, 0, 0});
  b.edit.connect({from, transform::kTranslate, -1, 0}, {to, transform::kRotation, -1, 1});
  const auto world = eval::worlds(b.scene, {to})[0];
  CHECK(test::distance(world, math::rotation(math::axis_angle({0, 1, 0}, math::kPi / 2))) <
        1e-15 * 8);
  CHECK(b.number({to, transform::kRotate, -1, 1}) == doctest::Approx(90));
}

TEST_CASE("eval compile: parent is the parent's world") {
  SceneBuilder b;
  const NodeId root = b.transform("root"), child = b.transform("child", root);
  b.edit.set({root, transform::kTranslate}, Vec3{1, 2, 3});
  CHECK(std::get<math::Affine>(b.value({child, transform::kParent})).origin == Vec3{1, 2, 3});
  CHECK(std::get<math::Affine>(b.value({root, transform::kParent})) == math::Affine{});
  const NodeId between = b.make(Kind::remap, "no transform", root);
  const NodeId under = b.transform("under", between);
  CHECK(std::get<math::Affine>(b.value({under, transform::kParent})).origin == Vec3{1, 2, 3});
  CHECK(std::get<math::Affine>(b.value({under, transform::kWorld})) == b.scene.rest_world(under));
}

TEST_CASE("eval compile: formulas over plugs") {
  SceneBuilder b;
  const NodeId node = b.transform("node");
  const Plug size = b.edit.add_attribute(node, {.name = "size", .value = 3, .min = {}, .max = {}});
  CHECK(b.number(b.formula("$0 * 2 + $1", {size, {node, transform::kScale, -1, 1}})) == 7);
  CHECK(b.number(b.formula("$0 > 1 ? sin(30) : 9", {size})) == doctest::Approx(0.5));
  CHECK(b.number(b.formula("if($0 < 0, 1, max(4, $0, 2))", {size}), {{size, -1.0}}) == 1);
  CHECK(b.number(b.formula("1 / ($0 - 3)", {size})) == 0);
  CHECK(b.number(b.formula("42", {})) == 42);
  CHECK(b.number(b.formula("$0", {size})) == 3);
}

TEST_CASE("eval compile: what depends on no input becomes a constant") {
  SceneBuilder b;
  const NodeId root = b.transform("root"), zero = b.transform("zero", root),
               control = b.transform("control", zero);
  b.edit.set({root, transform::kTranslate}, Vec3{1, 0, 0});
  b.edit.set({zero, transform::kTranslate}, Vec3{0, 1, 0});
  const Plug sum = b.formula("1 + 2 * 3", {});
  eval::Program program = compile(b, {{}, {{control, transform::kWorld}, sum}});
  CHECK(program.instructions.empty());
  CHECK(program.rows <= 13);
  program = compile(b, {{{control, transform::kTranslate}}, {{control, transform::kWorld}}});
  // The zero's world is folded, and so are the control's axes; its origin is left.
  REQUIRE(program.instructions.size() == 1);
  CHECK(program.instructions[0].op == eval::Op::place);
}

TEST_CASE("eval compile: folding gives the bits that running gives") {
  test::Random random(2);
  for (int i = 0; i < 50; ++i) {
    SceneBuilder b;
    const NodeId root = b.transform("root"), child = b.transform("child", root);
    const math::Trs trs = random.trs(false);
    b.edit.set({root, transform::kTranslate}, trs.translation);
    b.edit.set({root, transform::kRotation}, trs.rotation);
    b.edit.set({child, transform::kRotation}, random.rotation());
    const Plug formula =
        b.formula("sin($0 * 40) ^ 2 + exp($0)", {{root, transform::kTranslate, -1, 0}});
    b.edit.connect(formula, {child, transform::kRotate, -1, 2});
    const auto folded = eval::worlds(b.scene, {child})[0];
    const auto run = eval::worlds(b.scene, {child},
                                  {{{root, transform::kTranslate}, trs.translation},
                                   {{root, transform::kRotation}, trs.rotation}})[0];
    CHECK(folded == run);
  }
}

TEST_CASE("eval compile: what nobody asks for is never emitted, what is asked for twice once") {
  SceneBuilder b;
  const NodeId a = b.transform("a"), child = b.transform("child", a),
               other = b.transform("other", a);
  b.edit.set({other, transform::kTranslate}, Vec3{0, 1, 0});
  b.edit.set({child, transform::kTranslate}, Vec3{0, 2, 0});
  const Plug input{a, transform::kTranslate};
  b.formula("$0 * 3", {{a, transform::kTranslate, -1, 0}});
  const auto one = compile(b, {{input}, {{child, transform::kWorld}}});
  CHECK(one.instructions.size() == 2);
  const auto two = compile(
      b, {{input},
          {{child, transform::kWorld}, {other, transform::kWorld}, {child, transform::kWorld}}});
  CHECK(two.instructions.size() == 3);
  CHECK(two.outputs[0].row == two.outputs[2].row);
  CHECK(compile(b, {{input}, {}}).instructions.empty());
}

TEST_CASE(
    "eval compile: a point constraint may drive one component from another of the same node") {
  SceneBuilder b;
  const NodeId node = b.transform("node");
  const Plug translate{node, transform::kTranslate};
  b.edit.set(translate, Vec3{2, 0, 0});
  b.edit.connect(b.formula("$0 * 10", {component(translate, 0)}), component(translate, 1));
  CHECK(std::get<Vec3>(b.value(translate)) == Vec3{2, 20, 0});
}

TEST_CASE("eval compile: outputs of constraints, in whole, in part and as angles") {
  SceneBuilder b;
  const NodeId target = b.transform("target");
  b.edit.set({target, transform::kTranslate}, Vec3{1, 2, 3});
  b.edit.set({target, transform::kRotate}, Vec3{0, 0, 40});
  const NodeId node = b.make(Kind::parent_constraint, "constraint");
  namespace c = scene::constraint;
  b.edit.connect({target, transform::kWorld}, {node, c::kTargets, 0});
  b.edit.set({node, c::kWeights, 0}, 1.0);
  b.edit.set({node, c::kOffsets, 0}, math::translation({0, 0, 1}));
  CHECK(test::distance(std::get<Vec3>(b.value({node, c::kTranslate})), Vec3{1, 2, 4}) < 1e-15);
  CHECK(b.number({node, c::kTranslate, -1, 2}) == 4);
  CHECK(b.number({node, c::kRotate, -1, 2}) == doctest::Approx(40));
  CHECK(test::distance(std::get<Vec3>(b.value({node, c::kScale})), Vec3{1, 1, 1}) < 1e-15);
}

TEST_CASE("eval compile: a chain of a hundred thousand nodes") {
  SceneBuilder b;
  NodeId at;
  for (int i = 0; i < 100000; ++i) {
    const NodeId next = b.transform("n", at);
    b.edit.set({next, transform::kTranslate}, Vec3{1, 0, 0});
    if (i > 0) b.edit.connect({at, transform::kTranslate}, {next, transform::kTranslate});
    at = next;
  }
  const auto worlds =
      eval::worlds(b.scene, {at}, {{{NodeId{0}, transform::kTranslate}, Vec3{2, 0, 0}}});
  REQUIRE(worlds.size() == 1);
  CHECK(worlds[0].origin == Vec3{200000, 0, 0});
}

TEST_CASE("eval compile: requests that make no sense") {
  SceneBuilder b;
  const NodeId node = b.make(Kind::control, "c"), chain = b.make(Kind::ik_chain, "chain");
  const Code* bad = &eval::codes::kBadRequest;
  CHECK(error_of(b, {{}, {{node, 999}}}) == bad);
  CHECK(error_of(b, {{}, {{NodeId{77}, 0}}}) == bad);
  CHECK(error_of(b, {{}, {{node, scene::control::kShape}}}) == bad);
  CHECK(error_of(b, {{}, {{node, scene::control::kPoints}}}) == bad);
  CHECK(error_of(b, {{{node, transform::kWorld}}, {}}) == bad);
  CHECK(error_of(b, {{{node, scene::control::kColor}}, {}}) == bad);
  CHECK(error_of(b, {{{node, transform::kTranslate, -1, 0}}, {}}) == bad);
  for (std::int32_t i = 0; i < 3; ++i) {
    b.edit.set({chain, scene::ik_chain::kTranslates, i}, Vec3{0, 1, 0});
    b.edit.set({chain, scene::ik_chain::kRests, i}, math::Quat{});
  }
  compile(b, {{}, {{chain, scene::ik_chain::kRotations, 1}}});
  CHECK(error_of(b, {{}, {{chain, scene::ik_chain::kRotations, 2}}}) == bad);
  CHECK(error_of(b, {{}, {{chain, scene::ik_chain::kRotations, INT32_MAX}}}) == bad);
}

TEST_CASE("eval compile: nodes whose data do not fit together") {
  SceneBuilder b;
  const Code* bad = &eval::codes::kBadNode;
  const NodeId point = b.make(Kind::point_constraint, "point"),
               aim = b.make(Kind::aim_constraint, "aim");
  const NodeId ik = b.make(Kind::ik_two_bone, "ik"), chain = b.make(Kind::ik_chain, "chain");
  const Request translate{{}, {{point, scene::constraint::kTranslate}}};
  CHECK(error_of(b, translate) == bad);
  b.edit.set({point, scene::constraint::kTargets, 0}, math::Affine{});
  CHECK(error_of(b, translate) == bad);
  b.edit.set({point, scene::constraint::kWeights, 0}, 1.0);
  CHECK(error_of(b, translate) == bad);
  b.edit.set({point, scene::constraint::kOffsets, 0}, math::Affine{});
  compile(b, translate);
  const Request aimed{{}, {{aim, scene::aim::kRotation}}};
  CHECK(error_of(b, aimed) == bad);
  b.edit.set({aim, scene::aim::kTargets, 0}, math::Affine{});
  CHECK(error_of(b, aimed) == bad);
  b.edit.set({aim, scene::aim::kWeights, 0}, 1.0);
  b.edit.set({aim, scene::aim::kUpMode}, 3.0);
  CHECK(error_of(b, aimed) == bad);
  CHECK(error_of(b, {{}, {{ik, scene::ik2::kStartWorld}}}) == bad);
  const Request chained{{}, {{chain, scene::ik_chain::kRotations, 0}}};
  CHECK(error_of(b, chained) == bad);
  for (std::int32_t i = 0; i < 3; ++i)
    b.edit.set({chain, scene::ik_chain::kTranslates, i}, Vec3{0, 1, 0});
  CHECK(error_of(b, chained) == bad);
  for (std::int32_t i = 0; i < 3; ++i)
    b.edit.set({chain, scene::ik_chain::kRests, i}, math::Quat{});
  b.edit.set({chain, scene::ik_chain::kIterations}, 1e9);
  CHECK(error_of(b, chained) == bad);
  CHECK(error_of(b, {{}, {b.formula("1 +", {})}}) == &scene::codes::kFormulaSyntax);
}

TEST_CASE("eval compile: all bad nodes are reported in one run") {
  SceneBuilder b;
  Request request;
  for (int i = 0; i < 5; ++i)
    request.outputs.push_back({b.make(Kind::aim_constraint, "aim"), scene::aim::kRotate});
  request.outputs.push_back(b.formula("1 +", {}));
  Diagnostics diagnostics;
  CHECK(!eval::compile(b.scene, request, diagnostics));
  CHECK(diagnostics.errors() == 6);
}

}  // namespace
}  // namespace rigc
