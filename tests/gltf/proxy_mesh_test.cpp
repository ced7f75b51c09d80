// SPDX-License-Identifier: MIT
// Proxy meshes: closed surfaces that face outward, bound rigidly, at rest where the joints rest.
#include "gltf/proxy_mesh.h"

#include <doctest/doctest.h>

#include <cstring>
#include <map>

#include "file_helpers.h"
#include "rig_helpers.h"
#include "tests/math/random.h"

using namespace rigc;
using namespace rigc::gltf;
using namespace rigc::gltf::test;

namespace {

ProxyPart random_part(rigc::test::Random& random, ProxyStyle style) {
  ProxyPart part;
  part.style = style;
  part.head = random.vector();
  part.tail = part.head + random.direction() * random.between(0.1, 2);
  part.side = random.direction();
  part.width = random.between(0.05, 0.5);
  part.depth = random.between(0.05, 0.5);
  return part;
}

double volume(const Surface& surface) {
  double six = 0;
  for (std::size_t i = 0; i < surface.indices.size(); i += 3) {
    const auto at = [&](std::size_t k) { return surface.points[surface.indices[i + k]]; };
    six += math::dot(at(0), math::cross(at(1), at(2)));
  }
  return six / 6;
}

/// Each edge of a closed surface is passed once each way; by place, because corners of boxes are
/// several points.
bool closed(const Surface& surface) {
  const auto place = [&](std::uint32_t index) {
    const math::Vec3& p = surface.points[index];
    return std::array<long long, 3>{static_cast<long long>(p.x * 1e7 + (p.x < 0 ? -0.5 : 0.5)),
                                    static_cast<long long>(p.y * 1e7 + (p.y < 0 ? -0.5 : 0.5)),
                                    static_cast<long long>(p.z * 1e7 + (p.z < 0 ? -0.5 : 0.5))};
  };
  std::map<std::pair<std::array<long long, 3>, std::array<long long, 3>>, int> edges;
  for (std::size_t i = 0; i < surface.indices.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k)
      ++edges[{place(surface.indices[i + k]), place(surface.indices[i + (k + 1) % 3])}];
  for (const auto& [edge, count] : edges)
    if (count != 1 || edges.count({edge.second, edge.first}) == 0) return false;
  return true;
}

std::string bytes_of(const File& file, const json::Value& accessor) {
  const json::Value view =
      file.root()["bufferViews"]
          .items()[static_cast<std::size_t>(*accessor["bufferView"].integer())];
  return text(
      file.buffers[0].bytes.part(static_cast<std::size_t>(view["byteOffset"].integer().value_or(0)),
                                 static_cast<std::size_t>(*view["byteLength"].integer())));
}

std::vector<float> floats_of(const File& file, const json::Value& accessor) {
  const std::string bytes = bytes_of(file, accessor);
  std::vector<float> values(bytes.size() / 4);
  std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

}  // namespace

TEST_CASE("gltf proxy_mesh: surfaces are closed and face outward") {
  rigc::test::Random random(1);
  for (int round = 0; round < 50; ++round) {
    const ProxyPart part = random_part(random, static_cast<ProxyStyle>(round % 3));
    const Surface s = surface(part);
    CHECK(closed(s));
    const double length = math::length(part.tail - part.head);
    const double block = part.width * part.depth * length;
    if (part.style == ProxyStyle::box)
      CHECK(volume(s) == doctest::Approx(block).epsilon(1e-9));
    else if (part.style == ProxyStyle::cylinder)
      CHECK(volume(s) == doctest::Approx(block * math::kPi / 4).epsilon(0.01));
    else
      CHECK(volume(s) >
            block * 0.7);  // a cylinder has pi / 4 of it, its segments a little less, the caps more
    REQUIRE(s.normals.size() == s.points.size());
    for (std::size_t i = 0; i < s.indices.size(); i += 3) {
      const auto at = [&](std::size_t k) { return s.points[s.indices[i + k]]; };
      const math::Vec3 face = math::cross(at(1) - at(0), at(2) - at(0));
      for (std::size_t k = 0; k < 3; ++k) {
        const math::Vec3 normal = s.normals[s.indices[i + k]];
        CHECK(math::length(normal) == doctest::Approx(1));
        CHECK(math::dot(face, normal) > 0);
      }
    }
  }
}

TEST_CASE("gltf proxy_mesh: a piece without length is a sphere, not a crash") {
  ProxyPart part;
  part.width = part.depth = 2;
  const Surface s = surface(part);
  CHECK(volume(s) == doctest::Approx(4.0 / 3 * math::kPi).epsilon(0.1));
  part.width = 0;
  for (const ProxyStyle style : {ProxyStyle::capsule, ProxyStyle::box, ProxyStyle::cylinder}) {
    part.style = style;
    for (const math::Vec3& point : surface(part).points) CHECK(math::length(point) < 1.1);
  }
}

TEST_CASE("gltf proxy_mesh: skinning at rest gives the mesh as it lies") {
  Diagnostics diagnostics;
  Rig rig = proxy_rig(diagnostics);
  const File file = written(empty_file(), rig, "proxy");
  const json::Value mesh = file.root()["meshes"].items()[0];
  const json::Value skin = file.root()["skins"].items()[0];
  const auto accessors = file.root()["accessors"].items();
  const auto accessor = [&](const json::Value& index) {
    return accessors[static_cast<std::size_t>(*index.integer())];
  };
  REQUIRE(mesh["primitives"].size() == 1);
  const json::Value attributes = mesh["primitives"].items()[0]["attributes"];
  const auto points = floats_of(file, accessor(attributes["POSITION"]));
  const auto binds = floats_of(file, accessor(skin["inverseBindMatrices"]));
  const std::string joints = bytes_of(file, accessor(attributes["JOINTS_0"]));
  const auto weights = floats_of(file, accessor(attributes["WEIGHTS_0"]));
  REQUIRE(points.size() / 3 == joints.size() / 4);
  const scene::NodeId ids[] = {joint_named(rig, "base"), joint_named(rig, "tip")};
  CHECK(skin["joints"].text() == "[" + std::to_string(rig.nodes[ids[0].index]) + "," +
                                     std::to_string(rig.nodes[ids[1].index]) + "]");
  for (std::size_t i = 0; i < joints.size() / 4; ++i) {
    CHECK(weights[i * 4] == 1);
    const auto joint = static_cast<std::size_t>(joints[i * 4]);
    const float* m = &binds[joint * 16];
    const auto d = [](float value) { return static_cast<double>(value); };
    const math::Affine bind{
        {{d(m[0]), d(m[1]), d(m[2])}, {d(m[4]), d(m[5]), d(m[6])}, {d(m[8]), d(m[9]), d(m[10])}},
        {d(m[12]), d(m[13]), d(m[14])}};
    const math::Vec3 point{d(points[i * 3]), d(points[i * 3 + 1]), d(points[i * 3 + 2])};
    const math::Vec3 skinned = rig.scene.rest_world(ids[joint]) * (bind * point);
    CHECK(math::length(skinned - point) < 1e-6);
  }
  // The mesh is a root of the scene, and stands for the scene's mesh node.
  const int node = rig.nodes[with_role(rig, "mesh").index];
  bool is_root = false;
  for (const json::Value& root : file.root()["scenes"].items()[0]["nodes"].items())
    is_root = is_root || root.integer() == node;
  CHECK(is_root);
}

TEST_CASE("gltf proxy_mesh: joints of two trees get a skin each") {
  RigMaker maker;
  maker.joint("one", -1, {});
  maker.joint("two", -1, {{2, 0, 0}, {}, {1, 1, 1}});
  maker.command("body", "proxy_mesh");
  const scene::NodeId mesh = maker.node(scene::Kind::mesh, "mesh");
  std::vector<double> parts;
  std::int32_t element = 0;
  for (const char* name : {"one", "two", "one"}) {
    maker.edit.connect({joint_named(maker.rig(), name), scene::transform::kWorld},
                       {mesh, scene::mesh::kJoints, element++});
    const double red = element == 3 ? 1 : 0;
    parts.insert(parts.end(), {0, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0.2, 0.2, red, 0, 0});
  }
  maker.edit.set({mesh, scene::mesh::kParts}, parts);
  Rig rig = maker.take();
  const File file = written(empty_file(), rig, "proxy_two_trees");
  CHECK(file.root()["skins"].size() == 2);
  CHECK(file.root()["meshes"].items()[0]["primitives"].size() == 2);  // two colours
  CHECK(file.root()["meshes"].items()[1]["primitives"].size() == 1);
}
