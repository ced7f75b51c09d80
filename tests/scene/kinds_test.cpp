// SPDX-License-Identifier: MIT
// The table of kinds: names, defaults, and that no two attributes of a kind share a name.
#include <doctest/doctest.h>

#include <set>
#include <string>

#include "scene/kinds.h"

namespace rigc {
namespace {

using scene::Kind;

TEST_CASE("scene kinds: names read back") {
  for (int i = 0; i < static_cast<int>(Kind::count); ++i) {
    const Kind kind = static_cast<Kind>(i);
    CHECK(scene::parse_kind(scene::spec(kind).name) == kind);
  }
  CHECK(!scene::parse_kind("joints"));
  CHECK(!scene::parse_kind(""));
}

TEST_CASE("scene kinds: attributes have names of their own and a help text") {
  for (int i = 0; i < static_cast<int>(Kind::count); ++i) {
    std::set<std::string_view> names;
    for (const scene::AttributeSpec& attribute : scene::spec(static_cast<Kind>(i)).attributes) {
      CHECK(names.insert(attribute.name).second);
      CHECK(!attribute.help.empty());
      // Outputs are evaluated, so they are never text.
      if (attribute.role == scene::Role::output) CHECK(scene::width(attribute.type) > 0);
    }
  }
}

TEST_CASE("scene kinds: transforms are the kinds with a world") {
  for (int i = 0; i < static_cast<int>(Kind::count); ++i) {
    const scene::KindSpec& spec = scene::spec(static_cast<Kind>(i));
    const bool has_world = spec.attributes.size() > scene::transform::kWorld &&
                           spec.attributes[scene::transform::kWorld].name == "world";
    CHECK(spec.is_transform == has_world);
  }
}

TEST_CASE("scene kinds: types have names and widths") {
  using scene::Type;
  CHECK(scene::name_of(Type::vec3) == "vec3");
  CHECK(scene::name_of(Type::numbers) == "numbers");
  CHECK(scene::width(Type::number) == 1);
  CHECK(scene::width(Type::quat) == 4);
  CHECK(scene::width(Type::matrix) == 12);
  CHECK(scene::width(Type::text) == 0);
}

}  // namespace
}  // namespace rigc
