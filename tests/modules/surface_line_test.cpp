// SPDX-License-Identifier: MIT
// The line along a surface: where it lies, which way it runs, and what surfaces have none.
#include "modules/limbs/surface_line.h"

#include <doctest/doctest.h>

#include "support/pose.h"
#include "support/surfaces.h"

using namespace rigc;
using math::Vec3;
using modules::line_on;

namespace {

/// Two along x and one along z, face up.
tags::Surface flat() {
  return test::sheet([](double u, double v) { return Vec3{2 * u, 0, -v}; }, 8, 3);
}

}  // namespace

TEST_CASE("surface_line: along the longer side, through the middle, with the surface's normal") {
  const auto line = line_on(flat(), "auto", 0.5);
  REQUIRE(line);
  CHECK(!line->closed());
  CHECK(line->length() == doctest::Approx(2));
  for (const double part : {0.0, 0.1, 0.5, 1.0}) {
    const auto at = line->at(part);
    CHECK(test::distance(at.point, {2 * part, 0, -0.5}) < 1e-12);
    CHECK(test::distance(at.along, {1, 0, 0}) < 1e-12);
    CHECK(test::distance(at.normal, {0, 1, 0}) < 1e-12);
    CHECK(line->nearest(at.point + Vec3{0, 0.2, 0.3}) == doctest::Approx(part));
  }
}

TEST_CASE("surface_line: across, along an edge, and outside of its ends") {
  const auto across = line_on(flat(), "v", 0.25);
  REQUIRE(across);
  CHECK(test::distance(across->at(0.5).point, {0.5, 0, -0.5}) < 1e-12);
  CHECK(test::distance(across->at(0).along, {0, 0, -1}) < 1e-12);
  for (const double row : {0.0, 1.0}) {
    const auto edge = line_on(flat(), "u", row);
    REQUIRE(edge);
    CHECK(test::distance(edge->at(0.5).point, {1, 0, -row}) < 2e-4);
    CHECK(test::distance(edge->at(-1).point, {0, 0, -row}) < 2e-4);
    CHECK(test::distance(edge->at(3).point, {2, 0, -row}) < 2e-4);
  }
}

TEST_CASE("surface_line: texture coordinates that lie anywhere, turned round or not to scale") {
  tags::Surface surface = flat();
  for (auto& place : surface.texture) place = {0.9 - 0.2 * place[1], 0.4 - 0.1 * place[0]};
  const auto line = line_on(surface, "auto", 0.5);
  REQUIRE(line);
  CHECK(line->length() == doctest::Approx(2));
  CHECK(test::distance(line->at(0).point, {2, 0, -0.5}) < 1e-9);
}

TEST_CASE("surface_line: a ring is closed at its seam, and without one") {
  const auto ring = [](double u, double v) {
    return Vec3{math::cos(2 * math::kPi * u), v, math::sin(2 * math::kPi * u)};
  };
  tags::Surface seam = test::sheet(ring, 16, 2);
  const auto line = line_on(seam, "u", 0.5);
  REQUIRE(line);
  CHECK(line->closed());
  CHECK(test::distance(line->at(0).point, line->at(1).point) < 1e-12);
  CHECK(test::distance(line->at(0).along, line->at(1).along) < 1e-12);
  CHECK(test::distance(line->at(0.25).point, {0, 0.5, 1}) < 1e-9);
  CHECK(test::distance(line->at(1.25).point, line->at(0.25).point) < 1e-9);
  CHECK(test::distance(line->at(-0.75).point, line->at(0.25).point) < 1e-9);
  // The last column's vertices are those of the first.
  for (auto& triangle : seam.triangles)
    for (auto& vertex : triangle)
      if (vertex % 17 == 16) vertex -= 16;
  const auto whole = line_on(seam, "u", 0.5);
  REQUIRE(whole);
  CHECK(whole->closed());
  CHECK(whole->length() == doctest::Approx(line->length()));
  CHECK(test::distance(whole->at(0).point, {1, 0.5, 0}) < 1e-9);
}

TEST_CASE("surface_line: of several pieces the longest; shading may break, triangles be nothing") {
  tags::Surface surface = flat();
  const tags::Surface small = test::sheet([](double u, double v) { return Vec3{u, 5, -v}; });
  const auto first = static_cast<std::uint32_t>(surface.places.size());
  surface.places.insert(surface.places.end(), small.places.begin(), small.places.end());
  surface.texture.insert(surface.texture.end(), small.texture.begin(), small.texture.end());
  for (const auto& [a, b, c] : small.triangles)
    surface.triangles.push_back({a + first, b + first, c + first});
  surface.triangles.push_back({0, 0, 0});
  surface.triangles.push_back({0, 9, 9});
  // Each triangle gets vertices of its own.
  tags::Surface apart;
  for (const auto& triangle : surface.triangles) {
    const auto at = static_cast<std::uint32_t>(apart.places.size());
    for (const std::uint32_t v : triangle) {
      apart.places.push_back(surface.places[v]);
      apart.texture.push_back(surface.texture[v]);
    }
    apart.triangles.push_back({at, at + 1, at + 2});
  }
  const auto line = line_on(apart, "u", 0.5);
  REQUIRE(line);
  CHECK(line->length() == doctest::Approx(2));
  CHECK(test::distance(line->at(0.3).point, {0.6, 0, -0.5}) < 1e-12);
  CHECK(test::distance(line->at(0.3).normal, {0, 1, 0}) < 1e-12);
}

TEST_CASE("surface_line: through the middle of its island, wherever others lie") {
  tags::Surface surface = flat();
  for (auto& place : surface.texture) place = {place[0] / 2, place[1] / 8};
  const tags::Surface back = test::sheet([](double u, double v) { return Vec3{u, -1, v}; });
  const auto first = static_cast<std::uint32_t>(surface.places.size());
  for (const auto& [a, b, c] : back.triangles)
    surface.triangles.push_back({a + first, b + first, c + first});
  surface.places.insert(surface.places.end(), back.places.begin(), back.places.end());
  for (const auto& [u, v] : back.texture) surface.texture.push_back({u / 2, 0.5 + v / 2});
  const auto line = line_on(surface, "auto", 0.5);
  REQUIRE(line);
  CHECK(line->length() == doctest::Approx(2));
  CHECK(test::distance(line->at(0.3).point, {0.6, 0, -0.5}) < 1e-12);
}

TEST_CASE("surface_line: no line without an extent in the texture or in space") {
  tags::Surface surface = flat();
  for (auto& place : surface.texture) place = {0.5, 0.5};
  CHECK(!line_on(surface, "auto", 0.5));
  surface = flat();
  for (Vec3& place : surface.places) place = {1, 2, 3};
  CHECK(!line_on(surface, "auto", 0.5));
  CHECK(!line_on(tags::Surface(), "auto", 0.5));
}
