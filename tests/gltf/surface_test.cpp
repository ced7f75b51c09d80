// SPDX-License-Identifier: MIT
// A mesh of a file as a surface: found by name, read with its texture coordinates, or refused.
#include "gltf/surface.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "file_helpers.h"
#include "gltf/vertices.h"

using namespace rigc;
using namespace rigc::gltf;
using namespace rigc::gltf::test;

namespace {

/// A square of four vertices on node 2 "cape", whose mesh is called "cloth", bound to node 1 one
/// unit above node 0. `primitive`: what the primitive says besides its attributes.
std::string cape(const std::string& primitive = R"("indices":2)",
                 const std::string& attributes = R"("POSITION":0,"TEXCOORD_0":1)",
                 const std::string& node = R"("mesh":0,"skin":0)", char last_index = 3) {
  const std::string bytes = floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}) +
                            floats({0, 0, 1, 0, 0, 1, 1, 1}) +
                            std::string{0, 1, 2, 2, 1, last_index, 0, 0} +
                            floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1});
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[
    {"name":"hips","children":[1]},{"name":"chest","translation":[0,1,0],"children":[2]},
    {"name":"cape","translation":[0,0,2],)" +
         node + R"(}],
    "meshes":[{"name":"cloth","primitives":[{"attributes":{)" +
         attributes + "}" + (primitive.empty() ? "" : "," + primitive) + R"(}]}],
    "skins":[{"inverseBindMatrices":3,"joints":[1]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
      {"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},
      {"bufferView":2,"componentType":5121,"count":6,"type":"SCALAR"},
      {"bufferView":3,"componentType":5126,"count":1,"type":"MAT4"},
      {"componentType":5126,"count":4,"type":"VEC2"}],
    "bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":32},
      {"buffer":0,"byteOffset":80,"byteLength":6},{"buffer":0,"byteOffset":88,"byteLength":64}],
    "buffers":[{"byteLength":152,"uri":")" +
         data_uri(bytes) + "\"}]}";
}

std::optional<tags::Surface> surface(const std::string& text, const std::string& name = "cape",
                                     const std::set<int>& without = {}) {
  Diagnostics diagnostics;
  const auto file = open_text(text, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(file);
  const auto found = geometry_of(*file, without).surfaces(name);
  CHECK(found.size() < 2);
  return found.empty() ? std::nullopt : std::make_optional(found.front());
}

std::string trouble(const std::string& text) {
  const auto found = surface(text);
  REQUIRE(found);
  return found->trouble;
}

}  // namespace

TEST_CASE("gltf surface: triangles with places in space and texture, and what moves them") {
  for (const std::string name : {"cape", "cloth"}) {
    const auto found = surface(cape(), name);
    REQUIRE(found);
    CHECK(found->trouble.empty());
    REQUIRE(found->places.size() == 4);
    CHECK(math::length(found->places[3] - math::Vec3{1, 1, 0}) == 0);
    CHECK(found->texture[2] == std::array<double, 2>{0, 1});
    REQUIRE(found->triangles.size() == 2);
    CHECK(found->triangles[1] == std::array<std::uint32_t, 3>{2, 1, 3});
    REQUIRE(found->bound.size() == 1);
    CHECK(found->bound[0].first == 1);
    CHECK(found->bound[0].second.origin.y == -1);
  }
}

TEST_CASE("gltf surface: without a skin its node and all above move it") {
  const auto found =
      surface(cape(R"("indices":2)", R"("POSITION":0,"TEXCOORD_0":1)", R"("mesh":0)"));
  REQUIRE(found);
  REQUIRE(found->bound.size() == 3);
  CHECK(found->bound[1].first == 1);
  CHECK(math::length(found->bound[1].second.origin - math::Vec3{0, 0, 2}) == 0);
  CHECK(math::length(found->bound[2].second.origin - math::Vec3{0, 1, 2}) == 0);
}

TEST_CASE("gltf surface: strips, fans, and vertices without indices") {
  using Triangles = std::vector<std::array<std::uint32_t, 3>>;
  CHECK(surface(cape(R"("mode":5)"))->triangles == Triangles{{0, 1, 2}, {1, 3, 2}});
  CHECK(surface(cape(R"("mode":6)"))->triangles == Triangles{{1, 2, 0}, {2, 3, 0}});
  CHECK(surface(cape(""))->triangles == Triangles{{0, 1, 2}});
}

TEST_CASE("gltf surface: no such name, a node that does not count, and two of one name") {
  CHECK(!surface(cape(), "belt"));
  CHECK(!surface(cape(), "hips"));
  CHECK(!surface(cape(), "cape", {2}));
  const std::string two = replaced(cape(), R"({"name":"hips","children":[1]})",
                                   R"({"name":"cape","mesh":0,"children":[1]})");
  Diagnostics diagnostics;
  const auto file = open_text(two, diagnostics);
  REQUIRE(file);
  const auto both = geometry_of(*file).surfaces("cape");
  REQUIRE(both.size() == 2);
  CHECK(both[0].bound[0].first == 0);
  CHECK(both[1].bound[0].first == 1);
  // A mesh's name is not asked for where a node has it.
  const std::string shadowed = replaced(cape(), R"({"name":"hips","children":[1]})",
                                        R"({"name":"cloth","mesh":0,"children":[1]})");
  CHECK(surface(shadowed, "cloth")->bound[0].first == 0);
}

TEST_CASE("gltf surface: what cannot be read is refused") {
  const auto has = [](const std::string& text, const std::string& word) {
    INFO(text);
    return text.find(word) != std::string::npos;
  };
  CHECK(has(trouble(cape(R"("indices":2)", R"("POSITION":0)")), "texture coordinates"));
  CHECK(has(trouble(cape(R"("indices":2)", R"("POSITION":0,"TEXCOORD_0":4)")), "read"));
  CHECK(has(trouble(cape(R"("mode":1)")), "no triangles"));
  CHECK(has(trouble(cape(R"("indices":2,"extensions":{"KHR_draco_mesh_compression":{
      "bufferView":0,"attributes":{}}})")),
            "compressed"));
  // An index of a vertex that is not there.
  CHECK(has(
      trouble(cape(R"("indices":2)", R"("POSITION":0,"TEXCOORD_0":1)", R"("mesh":0,"skin":0)", 9)),
      "read"));
}
