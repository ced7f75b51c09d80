// SPDX-License-Identifier: MIT
// Tests of src/catalog/shape.cpp: shapes of templates and of shapes/.
#include "catalog/shape.h"

#include <doctest/doctest.h>

#include "base/codes.h"
#include "catalog/codes.h"

using namespace rigc;
using namespace rigc::catalog;

namespace {

std::optional<std::vector<Shape>> read(const std::string& text, Diagnostics& diagnostics) {
  const auto node = yaml::read(diagnostics.sources().add("shapes.yaml", text), diagnostics);
  REQUIRE(node);
  return read_shapes(*node, diagnostics);
}

Shape good(const std::string& text) {
  Diagnostics diagnostics;
  const auto shapes = read("it: " + text, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(shapes);
  REQUIRE(shapes->size() == 1);
  return shapes->front();
}

void bad(const std::string& text, const Code& code) {
  Diagnostics diagnostics;
  CAPTURE(text);
  CHECK(!read(text, diagnostics));
  REQUIRE(diagnostics.all().size() == 1);
  CHECK(diagnostics.all()[0].code->number == code.number);
  CHECK(diagnostics.all()[0].place.span.known());
}

}  // namespace

TEST_CASE("catalog shape: lines in the plane and in space") {
  const Shape shape = good("{help: H., lines: [[[1, 2], [3, 4, 5]]]}");
  CHECK(shape.name == "it");
  CHECK(shape.help == "H.");
  CHECK(shape.lines == std::vector<std::vector<Point>>{{{1, 0, 2}, {3, 4, 5}}});
}

TEST_CASE("catalog shape: lines are repeated, then mirrored; circles stay single") {
  const Shape shape = good(
      "{lines: [[[0, 0], [0, 1]]], repeat: 3, mirror: x, circles: [{radius: 2, segments: 4}]}");
  REQUIRE(shape.lines.size() == 7);
  CHECK(shape.lines[6].size() == 5);
  CHECK(shape.lines[0] == shape.lines[3]);
  CHECK(shape.lines[1][1][0] == -shape.lines[4][1][0]);
}

TEST_CASE("catalog shape: curves are smooth") {
  CHECK(good("{curves: [[[0, 0], [1, 1], [2, 0]]]}").lines[0].size() == 13);
}

TEST_CASE("catalog shape: what is wrong") {
  bad("3", rigc::codes::kNotAMap);
  bad("it: 3", rigc::codes::kNotAMap);
  bad("3d: {lines: [[[0, 0], [1, 1]]]}", rigc::codes::kNotAName);
  bad("it: {lines: [[[0, 0], [1, 1]]], line: 2}", rigc::codes::kUnknownKey);
  bad("it: {lines: 3}", rigc::codes::kNotASequence);
  bad("it: {help: H.}", catalog::codes::kEmptyShape);
  bad("it: {lines: [[[0, 0]]]}", catalog::codes::kEmptyShape);
  bad("it: {lines: [3]}", catalog::codes::kEmptyShape);
  bad("it: {lines: [[[0, 0], [1]]]}", catalog::codes::kBadPoint);
  bad("it: {lines: [[[0, 0], 3]]}", catalog::codes::kBadPoint);
  bad("it: {lines: [[[0, 0], [1, 2000]]]}", catalog::codes::kBadPoint);
  bad("it: {lines: [[[0, 0], [1, a]]]}", rigc::codes::kNotANumber);
  bad("it: {circles: [{radius: 0}]}", catalog::codes::kBadCircle);
  bad("it: {circles: [{segments: 2}]}", catalog::codes::kBadCircle);
  bad("it: {circles: [{from: 0, to: 400}]}", catalog::codes::kBadCircle);
  bad("it: {circles: [{from: 5, to: 5}]}", catalog::codes::kBadCircle);
  bad("it: {circles: [{normal: w}]}", catalog::codes::kUnknownWord);
  bad("it: {circles: [{radios: 1}]}", rigc::codes::kUnknownKey);
  bad("it: {lines: [[[0, 0], [1, 1]]], repeat: 65}", catalog::codes::kBadRepeat);
  bad("it: {lines: [[[0, 0], [1, 1]]], mirror: w}", catalog::codes::kUnknownWord);
}

TEST_CASE("catalog shape: too many points are refused") {
  std::string curve = "[0, 0]";
  for (int i = 1; i < 100; ++i) curve += ", [" + std::to_string(i) + ", 1]";
  bad("it: {curves: [[" + curve + "]], repeat: 8}", catalog::codes::kLargeShape);
}
