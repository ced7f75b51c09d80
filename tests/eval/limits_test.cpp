// SPDX-License-Identifier: MIT
// Limits and locks in a scene: everybody reads what is left after them; nodes that lie are errors.
#include <doctest/doctest.h>

#include "eval/codes.h"
#include "eval/limits.h"
#include "eval/program.h"
#include "tests/eval/scene_builder.h"

namespace rigc {
namespace {

using math::Vec3;
using scene::NodeId;
using scene::Plug;
using Values = std::vector<double>;
namespace transform = scene::transform;
namespace at = scene::limits;

struct Limited : test::SceneBuilder {
  NodeId control = make(scene::Kind::control, "control");
  NodeId below = transform("below", control);

  NodeId limits(const Values& bounds, const std::string& order = "xyz") {
    const NodeId node = make(scene::Kind::limits, "limits");
    edit.connect({control, transform::kWorld}, {node, at::kNode});
    edit.set({node, at::kBounds}, bounds);
    edit.set({node, at::kOrder}, order);
    return node;
  }
  void lock(double bits) { edit.set({control, scene::control::kLocked}, bits); }

  eval::Setting moved(Vec3 v) const { return {{control, transform::kTranslate}, v}; }
  eval::Setting turned(Vec3 degrees) const {
    return {{control, transform::kRotation}, math::from_euler_degrees(degrees)};
  }
  Vec3 place(const std::vector<eval::Setting>& settings) const {
    return std::get<math::Affine>(value({below, transform::kWorld}, settings)).origin;
  }
  Vec3 vector(std::uint16_t attribute, const std::vector<eval::Setting>& settings) const {
    return std::get<Vec3>(value({control, attribute}, settings));
  }
};

bool near(Vec3 a, Vec3 b) { return math::length(a - b) < 1e-9; }

TEST_CASE("eval limits: what hangs below and what reads a value get the clamped one") {
  Limited s;
  s.limits({1, 0, -0.5, 1, 1, 0.5});
  CHECK(s.place({s.moved({3, 2, 1})}) == Vec3{3, 0.5, 1});
  CHECK(s.vector(transform::kTranslate, {s.moved({3, -2, 1})}) == Vec3{3, -0.5, 1});
  const Plug twice = s.formula("$0 * 2", {{s.control, transform::kTranslate, -1, 1}});
  CHECK(s.number(twice, {s.moved({3, 2, 1})}) == 1);
  CHECK(s.number(twice, {s.moved({3, 0.25, 1})}) == 0.5);
}

TEST_CASE("eval limits: rotation, its angles and their components are clamped") {
  Limited s;
  s.limits({4, 0, -30, 4, 1, 60});
  CHECK(near(s.vector(transform::kRotate, {s.turned({0, 80, 0})}), {0, 60, 0}));
  CHECK(std::fabs(s.number({s.control, transform::kRotate, -1, 1}, {s.turned({0, -80, 0})}) + 30) <
        1e-9);
  CHECK(near(s.vector(transform::kRotate, {s.turned({10, 20, 30})}), {10, 20, 30}));
  // Angles that come by connections are clamped too.
  s.edit.connect(s.formula("$0 * 100", {{s.control, transform::kScale, -1, 0}}),
                 {s.control, transform::kRotate, -1, 1});
  CHECK(near(s.vector(transform::kRotate, {}), {0, 60, 0}));
}

TEST_CASE("eval limits: several limits of one node hold together") {
  Limited s;
  s.limits({0, 1, 2});
  s.limits({0, 1, 1, 6, 1, 3});
  s.limits({0, 0, -1});
  CHECK(s.place({s.moved({5, 0, 0})}) == Vec3{1, 0, 0});
  CHECK(s.place({s.moved({-5, 0, 0})}) == Vec3{-1, 0, 0});
  CHECK(s.vector(transform::kScale, {{{s.control, transform::kScale}, Vec3{9, 9, 9}}}) ==
        Vec3{3, 9, 9});
}

TEST_CASE("eval limits: locked components keep the scene's value, free ones follow their keys") {
  Limited s;
  s.edit.set({s.control, transform::kTranslate}, Vec3{0.25, 0, 0});
  s.lock(1 + 16);  // translate.x, rotate.y
  CHECK(s.place({s.moved({3, 2, 1})}) == Vec3{0.25, 2, 1});
  CHECK(near(s.vector(transform::kRotate, {s.turned({20, 30, 0})}), {20, 0, 0}));
  s.lock(7);
  CHECK(s.place({s.moved({3, 2, 1})}) == Vec3{0.25, 0, 0});
}

TEST_CASE("eval limits: what a connection decides about is not held by a lock") {
  Limited s;
  s.lock(7 * 64);
  s.edit.connect(s.formula("$0 + 1", {{s.control, transform::kTranslate, -1, 0}}),
                 {s.control, transform::kScale, -1, 1});
  CHECK(s.vector(transform::kScale, {s.moved({3, 0, 0})}) == Vec3{1, 4, 1});
}

TEST_CASE("eval limits: rest is bit for bit what it is without them") {
  Limited s;
  s.edit.set({s.control, transform::kRotation}, math::from_euler_degrees({11, 22, 33}));
  s.edit.set({s.control, transform::kTranslate}, Vec3{0.1, 0.2, 0.3});
  const auto before = s.value({s.below, transform::kWorld});
  s.limits({0, 0, -9, 3, 0, -90, 3, 1, 90, 5, 1, 40});
  s.lock(2 + 16);
  CHECK(s.value({s.below, transform::kWorld}) == before);
}

TEST_CASE("eval limits: an attribute without limits costs nothing") {
  Limited s;
  eval::Request request;
  request.inputs = {{s.control, transform::kTranslate}, {s.control, transform::kRotation}};
  request.outputs = {{s.below, transform::kWorld}, {s.control, transform::kRotate}};
  Diagnostics diagnostics;
  const auto plain = eval::compile(s.scene, request, diagnostics);
  s.limits({0, 1, 2});
  const auto limited = eval::compile(s.scene, request, diagnostics);
  REQUIRE(plain);
  REQUIRE(limited);
  CHECK(limited->instructions.size() == plain->instructions.size() + 1);
  CHECK(limited->dump(s.scene).find("limit_vector") != std::string::npos);
}

TEST_CASE("eval limits: a ring through a limited value names each plug once") {
  Limited s;
  s.limits({0, 1, 2});
  const Plug x{s.control, transform::kTranslate, -1, 0};
  s.edit.connect(s.formula("$0 + 1", {x}), x);
  Diagnostics diagnostics;
  CHECK_FALSE(eval::evaluate(s.scene, {{s.below, transform::kWorld}}, {}, diagnostics));
  REQUIRE(diagnostics.all().size() == 1);
  CHECK(diagnostics.all()[0].code->number == eval::codes::kCycle.number);
}

TEST_CASE("eval limits: nodes that make no sense are errors") {
  const auto error = [](const Values& bounds, const std::string& order, bool named = true) {
    Limited s;
    const NodeId node = s.limits(bounds, order);
    if (!named) s.edit.disconnect({node, at::kNode});
    Diagnostics diagnostics;
    CHECK_FALSE(eval::evaluate(s.scene, {{s.below, transform::kWorld}}, {}, diagnostics));
    REQUIRE(diagnostics.all().size() == 1);
    CHECK(diagnostics.all()[0].code->number == eval::codes::kBadNode.number);
    return diagnostics.all()[0].message;
  };
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  CHECK(has(error({0, 0}, "xyz"), "three numbers"));
  CHECK(has(error({9, 0, 1}, "xyz"), "channel 9"));
  CHECK(has(error({0.5, 0, 1}, "xyz"), "channel 0.5"));
  CHECK(has(error({-1, 0, 1}, "xyz"), "channel -1"));
  CHECK(has(error({0, 2, 1}, "xyz"), "side 2"));
  CHECK(has(error({4, 0, 1, 4, 1, 0}, "xyz"), "rotate.y"));
  CHECK(has(error({0, 0, 1}, "xxz"), "order"));
  CHECK(has(error({0, 0, 1}, "xy"), "order"));
  CHECK(has(error({0, 0, 1}, ""), "order"));
  CHECK(has(error({0, 0, 1}, "xyz", false), "names no transform"));
}

TEST_CASE("eval limits: masks of locks that make no sense lock nothing") {
  for (const double bits : {-1.0, 512.0, 1e300}) {
    Limited s;
    s.lock(bits);
    CHECK(s.place({s.moved({3, 2, 1})}) == Vec3{3, 2, 1});
  }
}

}  // namespace
}  // namespace rigc
