// SPDX-License-Identifier: MIT
// Which vertices joints move, where they are bound.
#include "gltf/vertices.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "file_helpers.h"

using namespace rigc;
using namespace rigc::gltf;
using namespace rigc::gltf::test;

namespace {

/// A leg (node 0), a foot 1 m below it (node 1), toes 1 m before that (node 2) and a mesh of four
/// vertices: of the leg, of leg and foot, of foot and toes, of the toes.
std::string leg(const std::string& joint_of_last = "2", const std::string& weights_view = "3",
                char padding = 0) {
  const std::string bytes =
      floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0,  0,
              0, 0, 1, 0, 0, 1, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, -1, 1}) +
      floats({0, -0.5f, 0, 0, -0.9f, 0, 0.1f, -1.1f, 0.5f, 0, -1.1f, 1.2f}) +
      std::string{
          0,       0, 0, 0, 0, 1, 0, 0, 1, 2, 0, 0, static_cast<char>(joint_of_last[0] - '0'),
          padding, 0, 0} +
      floats({1, 0, 0, 0, 0.7f, 0.3f, 0, 0, 0.5f, 0.5f, 0, 0, 1, 0, 0, 0});
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,3]}],"nodes":[
    {"name":"leg","children":[1]},{"name":"foot","translation":[0,-1,0],"children":[2]},
    {"name":"toes","translation":[0,0,1]},{"name":"body","mesh":0,"skin":0}],
    "meshes":[{"primitives":[{"mode":0,"attributes":{"POSITION":1,"JOINTS_0":2,"WEIGHTS_0":3}}]}],
    "skins":[{"inverseBindMatrices":0,"joints":[0,1,2]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"MAT4"},
      {"bufferView":1,"componentType":5126,"count":4,"type":"VEC3","min":[0,-1.1,0],"max":[0.1,-0.5,1.2]},
      {"bufferView":2,"componentType":5121,"count":4,"type":"VEC4"},
      {)" +
         (weights_view.empty() ? "" : "\"bufferView\":" + weights_view + ",") +
         R"("componentType":5126,"count":4,"type":"VEC4"}],
    "bufferViews":[{"buffer":0,"byteLength":192},{"buffer":0,"byteOffset":192,"byteLength":48},
      {"buffer":0,"byteOffset":240,"byteLength":16},{"buffer":0,"byteOffset":256,"byteLength":64}],
    "buffers":[{"byteLength":320,"uri":")" +
         data_uri(bytes) + "\"}]}";
}

std::vector<tags::BoundVertex> moved_by(const std::string& text, const std::vector<int>& nodes) {
  Diagnostics diagnostics;
  const auto file = open_text(text, diagnostics);
  REQUIRE(file);
  return geometry_of(*file).vertices(nodes);
}

}  // namespace

TEST_CASE("gltf vertices: what a joint and all below it move, seen from where it is bound") {
  const auto foot = moved_by(leg(), {1});
  REQUIRE(foot.size() == 3);
  CHECK(foot[0].weight == doctest::Approx(0.3));
  CHECK(foot[1].weight == doctest::Approx(1));
  CHECK(foot[2].weight == doctest::Approx(1));
  CHECK(math::length(foot[1].at - math::Vec3{0.1, -0.1, 0.5}) < 1e-6);
  const auto toes = moved_by(leg(), {2});
  REQUIRE(toes.size() == 2);
  CHECK(toes[0].weight == doctest::Approx(0.5));
  CHECK(math::length(toes[1].at - math::Vec3{0, -0.1, 0.2}) < 1e-6);
}

TEST_CASE("gltf vertices: weights of several joints count together, places are the first one's") {
  const auto found = moved_by(leg(), {2, 1});
  REQUIRE(found.size() == 3);
  CHECK(found[1].weight == doctest::Approx(1));
  CHECK(math::length(found[2].at - math::Vec3{0, -0.1, 0.2}) < 1e-6);
}

TEST_CASE("gltf vertices: primitives without usable weights are left out") {
  CHECK(moved_by(leg("2", ""), {1}).empty());  // compressed: no view
  CHECK(moved_by(leg("7"), {1}).empty());      // a joint that the skin does not have
  CHECK(moved_by(leg(), {3}).empty());         // a node that is no joint
}

TEST_CASE("gltf vertices: a joint that the skin does not have may fill up, with weight 0") {
  const auto foot = moved_by(leg("2", "3", 3), {1});
  REQUIRE(foot.size() == 3);
  CHECK(foot[2].weight == doctest::Approx(1));
}

TEST_CASE("gltf vertices: a mesh without a skin rides on the joints above it") {
  const std::string shoe =
      replaced(leg(), R"({"name":"toes",)", R"({"name":"toes","children":[4],)");
  const std::string text =
      replaced(replaced(shoe, R"("mesh":0,"skin":0})",
                        R"("mesh":0,"skin":0},{"mesh":1,"translation":[0,0.5,0]})"),
               R"("meshes":[)", R"("meshes":[{"primitives":[{"mode":0,"attributes":{"POSITION":1,
               "JOINTS_0":2,"WEIGHTS_0":3}}]},{"primitives":[{"attributes":{"POSITION":1}}]}],
               "unused":[)");
  const auto toes = moved_by(text, {2});
  REQUIRE(toes.size() == 6);
  CHECK(toes[2].weight == 1);
  CHECK(math::length(toes[5].at - math::Vec3{0, -0.6, 1.2}) < 1e-6);
  const auto foot = moved_by(text, {1});
  REQUIRE(foot.size() == 7);
  CHECK(math::length(foot[6].at - math::Vec3{0, -0.6, 2.2}) < 1e-6);
}
