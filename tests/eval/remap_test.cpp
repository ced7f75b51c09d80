// SPDX-License-Identifier: MIT
// Remap: curves of points through scenes, against worked numbers and properties.
#include <doctest/doctest.h>

#include "eval/codes.h"
#include "eval/evaluate.h"
#include "scene/edit.h"
#include "tests/math/random.h"

namespace rigc {
namespace {

using scene::NodeId;
namespace at = scene::remap;

struct Remap {
  scene::Scene scene;
  scene::Journal journal;
  NodeId node;

  explicit Remap(const std::vector<double>& points, bool clamp = true) {
    scene::Edit edit(scene, journal, nullptr);
    scene::Node made;
    made.kind = scene::Kind::remap;
    node = edit.make(std::move(made));
    edit.set({node, at::kPoints}, points);
    edit.set({node, at::kClamp}, clamp ? 1.0 : 0.0);
  }
  void range(double in_min, double in_max, double out_min, double out_max) {
    scene::Edit edit(scene, journal, nullptr);
    edit.set({node, at::kInputMin}, in_min);
    edit.set({node, at::kInputMax}, in_max);
    edit.set({node, at::kOutputMin}, out_min);
    edit.set({node, at::kOutputMax}, out_max);
  }
  std::optional<double> at_input(double x, Diagnostics& diagnostics) const {
    const auto got =
        eval::evaluate(scene, {{node, at::kOutput}}, {{{node, at::kInput}, x}}, diagnostics);
    if (!got) return std::nullopt;
    return std::get<double>(got->front());
  }
  double operator()(double x) const {
    Diagnostics diagnostics;
    const auto got = at_input(x, diagnostics);
    REQUIRE(got);
    return *got;
  }
};

TEST_CASE("eval remap: without points it is a line") {
  Remap line({});
  line.range(-1, 1, 10, 20);
  CHECK(line(0) == 15);
  CHECK(line(-1) == 10);
  CHECK(line(5) == 20);
  Remap open({}, false);
  open.range(-1, 1, 10, 20);
  CHECK(open(3) == 30);
}

TEST_CASE("eval remap: each interpolation in the middle of a segment") {
  CHECK(Remap({0, 0, 0, 1, 1, 0})(0.25) == 0);
  CHECK(Remap({0, 0, 0, 1, 1, 0})(1) == 1);
  CHECK(Remap({0, 0, 1, 1, 1, 1})(0.25) == 0.25);
  CHECK(Remap({0, 0, 2, 1, 1, 1})(0.25) == doctest::Approx(0.15625));
  CHECK(Remap({0, 0, 3, 1, 1, 1})(0.25) == doctest::Approx(0.25));
  // Fritsch and Butland: slopes 0.5 and 2 meet in their harmonic mean 0.8, ends at -0.25 (kept from
  // turning: 0) and 2.75.
  const Remap spline({0, 0, 3, 0.5, 0.25, 3, 1, 1.25, 3});
  CHECK(spline(0.5) == 0.25);
  const double u = 0.5, h = 0.5;
  CHECK(spline(0.25) == doctest::Approx(0.25 * (0.5) + h * u * u * (u * 0 - u * 0.8)));
}

TEST_CASE("eval remap: every curve passes its points") {
  test::Random random(1);
  for (int i = 0; i < 100; ++i) {
    std::vector<double> points;
    double x = 0;
    for (int n = 0; n < 5; ++n) {
      points.insert(points.end(), {x, random.between(-1, 1), static_cast<double>(random.below(4))});
      x += random.between(0.05, 0.24);
    }
    const Remap curve(points);
    for (std::size_t n = 0; n < points.size(); n += 3)
      CHECK(curve(points[n]) == doctest::Approx(points[n + 1]));
  }
}

TEST_CASE("eval remap: splines through rising points rise and never overshoot") {
  test::Random random(2);
  for (int i = 0; i < 30; ++i) {
    std::vector<double> points;
    double x = 0, y = 0;
    for (int n = 0; n < 6; ++n) {
      points.insert(points.end(), {x, y, 3});
      x += random.between(0.02, 0.19);
      y += random.chance(30) ? 0 : random.between(0, 1);
    }
    const Remap curve(points);
    double before = -1e-12;
    for (int k = 0; k <= 100; ++k) {
      const double now = curve(k / 100.0);
      CHECK(now >= before - 1e-12);
      CHECK(now <= points[points.size() - 2] + 1e-12);
      before = now;
    }
  }
}

TEST_CASE("eval remap: outside the points") {
  const std::vector<double> points = {0.25, 1, 1, 0.75, 3, 1};
  CHECK(Remap(points)(0) == 1);
  CHECK(Remap(points)(7) == 3);
  CHECK(Remap(points, false)(0) == 0);
  CHECK(Remap(points, false)(1.25) == 5);
  CHECK(Remap({0.5, 2, 1}, false)(9) == 2);
}

TEST_CASE("eval remap: an empty or turned input range") {
  Remap curve({});
  curve.range(2, 2, 5, 6);
  CHECK(curve(2) == 5);
  CHECK(curve(9) == 5);
  curve.range(1, 0, 0, 1);
  CHECK(curve(0.25) == 0.75);
}

TEST_CASE("eval remap: points that make no curve are errors") {
  for (const std::vector<double>& points : {std::vector<double>{0, 1},
                                            {0, 0, 1, 0, 1, 1},
                                            {0.5, 0, 1, 0.25, 1, 1},
                                            {0, 0, 4},
                                            {0, 0, 0.5}}) {
    Diagnostics diagnostics;
    CHECK(!Remap(points).at_input(0, diagnostics));
    REQUIRE(diagnostics.errors() == 1);
    CHECK(diagnostics.all()[0].code == &eval::codes::kBadNode);
  }
}

}  // namespace
}  // namespace rigc
