// SPDX-License-Identifier: MIT
// Tests of src/catalog/words.cpp.
#include <doctest/doctest.h>

#include <set>

#include "catalog/reader.h"

using namespace rigc::catalog;

TEST_CASE("catalog words: types and stages have names that read back") {
  for (int i = 0; i <= static_cast<int>(ParameterType::value); ++i) {
    const auto type = static_cast<ParameterType>(i);
    CHECK(parse_type(name_of(type)) == type);
  }
  CHECK(name_of(ParameterType::number) == "float");
  CHECK(name_of(ParameterType::enumeration) == "enum");
  CHECK(!parse_type("number"));
  for (int i = 0; i <= static_cast<int>(Stage::optimize); ++i) {
    const auto stage = static_cast<Stage>(i);
    CHECK(parse_stage(name_of(stage)) == stage);
  }
  CHECK(!parse_stage("late"));
}

TEST_CASE("catalog words: colours have distinct values in 0..1") {
  std::set<std::array<double, 3>> seen;
  for (const std::string& name : color_names()) {
    const auto color = named_color(name);
    REQUIRE(color);
    CHECK(seen.insert(*color).second);
    for (double channel : *color) {
      CHECK(channel >= 0);
      CHECK(channel <= 1);
    }
  }
  CHECK(seen.size() == 12);
  CHECK(!named_color("mauve"));
}
