// SPDX-License-Identifier: MIT
// Programs of compute nodes: what they give, that each output needs only what it names, and what is
// wrong with a node.
#include <doctest/doctest.h>

#include "eval/codes.h"
#include "scene/codes.h"
#include "tests/eval/scene_builder.h"

namespace rigc {
namespace {

using math::Quat;
using math::Vec3;
using scene::Plug;
using scene::Type;
namespace compute = scene::compute;

struct Program {
  test::SceneBuilder builder;
  scene::NodeId node = builder.make(scene::Kind::compute, "program");

  explicit Program(const std::string& code) { builder.edit.set({node, compute::kCode}, code); }
  Program& give(const scene::Value& value, std::int32_t element = 0) {
    builder.edit.set({node, compute::input_of(scene::type_of(value)), element}, value);
    return *this;
  }
  Plug out(Type type, std::int32_t element = 0) const {
    return {node, compute::output_of(type), element};
  }
  double number(std::int32_t element = 0) const {
    return builder.number(out(Type::number, element));
  }
  Vec3 vector(std::int32_t element = 0) const {
    return std::get<Vec3>(builder.value(out(Type::vec3, element)));
  }
};

double apart(Vec3 a, Vec3 b) { return math::length(a - b); }

TEST_CASE("eval compute: vectors") {
  Program p(
      "in a: vector, b: vector; out sum = a + b; out half = (a - b) / 2; out normal = cross(a, b);"
      "out far = distance(a, b); out along = dot(a, b); out unit = normalise(a);"
      "out part = lerp(a, b, 0.25); out each = multiply(a, b); out y = b.y;"
      "out other = vector(a.z, 7, -b.x);");
  p.give(Vec3{1, 2, 2}).give(Vec3{0, 3, 0}, 1);
  CHECK(apart(p.vector(0), {1, 5, 2}) < 1e-15);
  CHECK(apart(p.vector(1), {0.5, -0.5, 1}) < 1e-15);
  CHECK(apart(p.vector(2), {-6, 0, 3}) < 1e-15);
  CHECK(p.number(0) == doctest::Approx(std::sqrt(6.0)));
  CHECK(p.number(1) == 6);
  CHECK(apart(p.vector(3), {1.0 / 3, 2.0 / 3, 2.0 / 3}) < 1e-15);
  CHECK(apart(p.vector(4), {0.75, 2.25, 1.5}) < 1e-15);
  CHECK(apart(p.vector(5), {0, 6, 0}) < 1e-15);
  CHECK(p.number(2) == 3);
  CHECK(apart(p.vector(6), {2, 7, 0}) < 1e-15);
}

TEST_CASE("eval compute: rotations and matrices") {
  Program p(
      "in q: rotation, m: matrix, n: number;"
      "out turned = q * vector(1, 0, 0); out angle = twist(q, vector(0, 0, 2));"
      "out back = inverse(q) * (q * vector(1, 2, 3)); out point = m * vector(1, 1, 1);"
      "out way = direction(m, vector(1, 1, 1)); out home = inverse(m) * (m * vector(4, 5, 6));"
      "out size = scale(m); out at = m.origin;"
      "out aimed = aim(vector(0, 0, 1), vector(0, 1, 0)) * vector(1, 0, 0);"
      "out shortest = between(vector(0, 2, 0), vector(3, 0, 0)) * vector(0, 1, 0);"
      "out some = slerp(q, axis_angle(vector(0, 0, 1), 0), n) * vector(1, 0, 0);"
      "out euler = angles(euler(vector(10, 20, 30)));"
      "out framed = frame(m.origin, q) * vector(1, 0, 0);"
      "out chosen = n > 1 ? m.x : m.y; out swung = swing(q, vector(0, 0, 1)) * vector(1, 0, 0);");
  p.give(math::from_euler_degrees({0, 0, 90}));
  p.give(math::Affine{{{2, 0, 0}, {0, 3, 0}, {0, 0, 4}}, {1, 2, 3}}).give(0.5);
  CHECK(apart(p.vector(0), {0, 1, 0}) < 1e-15);
  CHECK(p.number() == doctest::Approx(90));
  CHECK(apart(p.vector(1), {1, 2, 3}) < 1e-15);
  CHECK(apart(p.vector(2), {3, 5, 7}) < 1e-15);
  CHECK(apart(p.vector(3), {2, 3, 4}) < 1e-15);
  CHECK(apart(p.vector(4), {4, 5, 6}) < 1e-14);
  CHECK(apart(p.vector(5), {2, 3, 4}) < 1e-15);
  CHECK(apart(p.vector(6), {1, 2, 3}) < 1e-15);
  CHECK(apart(p.vector(7), {0, 0, 1}) < 1e-15);
  CHECK(apart(p.vector(8), {1, 0, 0}) < 1e-15);
  CHECK(apart(p.vector(9), {std::sqrt(0.5), std::sqrt(0.5), 0}) < 1e-15);
  CHECK(apart(p.vector(10), {10, 20, 30}) < 1e-13);
  CHECK(apart(p.vector(11), {1, 3, 3}) < 1e-15);
  CHECK(apart(p.vector(12), {0, 3, 0}) < 1e-15);
  CHECK(apart(p.vector(13), {1, 0, 0}) < 1e-15);
}

TEST_CASE("eval compute: each output needs only what it names") {
  // The second number depends on what the first drives: no cycle.
  test::SceneBuilder builder;
  const scene::NodeId driven = builder.transform("driven");
  const scene::NodeId node = builder.make(scene::Kind::compute, "program");
  builder.edit.set({node, compute::kCode},
                   std::string("in a: number, m: matrix; out up = a * 2; out seen = m.origin.y;"));
  builder.edit.set({node, compute::kNumbers, 0}, 3.0);
  builder.edit.connect({driven, scene::transform::kWorld}, {node, compute::kMatrices, 0});
  builder.edit.connect({node, compute::kNumberOut, 0},
                       {driven, scene::transform::kTranslate, -1, 1});
  CHECK(builder.number({node, compute::kNumberOut, 1}) == 6);
}

TEST_CASE("eval compute: a node that is wrong says so") {
  const auto code_of = [](const Program& p, const Plug& plug) {
    Diagnostics diagnostics;
    CHECK(!eval::evaluate(p.builder.scene, {plug}, {}, diagnostics));
    return diagnostics.all().front().code;
  };
  Program good("in a: number; out b = a;");
  good.give(1.0);
  CHECK(good.number() == 1);
  CHECK(code_of(good, good.out(Type::number, 1)) == &eval::codes::kBadNode);
  CHECK(code_of(good, good.out(Type::vec3)) == &eval::codes::kBadNode);
  const Program poor("in a: number; out b = a;");
  CHECK(code_of(poor, poor.out(Type::number)) == &eval::codes::kBadNode);
  const Program wrong("out b = ;");
  CHECK(code_of(wrong, wrong.out(Type::number)) == &scene::codes::kFormulaSyntax);
}

}  // namespace
}  // namespace rigc
