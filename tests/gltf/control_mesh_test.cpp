// SPDX-License-Identifier: MIT
// Control shapes as line meshes: shared where equal, safe where their points make no sense.
#include "gltf/control_mesh.h"

#include <doctest/doctest.h>

#include <limits>

#include "gltf/file.h"

using namespace rigc;
using namespace rigc::gltf;

namespace {

const std::vector<double> kLine = {2, 0, 0, 0, 1, 0, 0};
const std::vector<double> kCorner = {2, 0, 0, 0, 1, 0, 0, 3, 0, 0, 0, 0, 1, 0, 0, 1, 1};

}  // namespace

TEST_CASE("gltf control_mesh: equal shapes of one colour are one mesh, colours one material") {
  const File file = empty_file();
  Patch patch(file);
  ControlMeshes meshes(patch);
  CHECK(meshes.mesh(kLine, {1, 0, 0}, "line") == 0);
  CHECK(meshes.mesh(kCorner, {1, 0, 0}, "corner") == 1);
  CHECK(meshes.mesh(kLine, {1, 0, 0}, "other name") == 0);
  CHECK(meshes.mesh(kLine, {0, 1, 0}, "line") == 2);
  CHECK(patch.count("materials") == 2);
  CHECK(patch.count("accessors") == 6);
  const std::string material = patch.element("materials", 0);
  CHECK(material.find(R"("emissiveFactor":[1,0,0])") != std::string::npos);
  CHECK(material.find(R"("baseColorFactor":[1,0,0,1])") != std::string::npos);
  const std::string primitive =
      R"({"attributes":{"POSITION":2},"indices":3,"material":0,"mode":1})";
  CHECK(patch.element("meshes", 1) == R"({"name":"corner","primitives":[)" + primitive + "]}");
}

TEST_CASE("gltf control_mesh: several polylines are not joined") {
  const File file = empty_file();
  Patch patch(file);
  ControlMeshes meshes(patch);
  REQUIRE(meshes.mesh(kCorner, {}, "") == 0);
  CHECK(patch.element("accessors", 0).find("\"count\":5") != std::string::npos);
  CHECK(patch.element("accessors", 1).find("\"count\":6") != std::string::npos);  // three segments
}

TEST_CASE("gltf control_mesh: what makes no line makes no mesh") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::vector<double>> bad = {{},
                                                {0},
                                                {1, 0, 0, 0},
                                                {-1, 0, 0, 0},
                                                {2, 0, 0, 0},
                                                {1e300, 0, 0, 0},
                                                {nan, 0, 0, 0},
                                                {3},
                                                {0.5, 1, 2, 3}};
  const File file = empty_file();
  Patch patch(file);
  ControlMeshes meshes(patch);
  for (const auto& points : bad) CHECK(meshes.mesh(points, {}, "") == -1);
  CHECK(patch.count("accessors") == 0);
  CHECK(patch.count("materials") == 0);
}
