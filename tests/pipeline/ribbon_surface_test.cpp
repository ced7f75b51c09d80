// SPDX-License-Identifier: MIT
// Ribbons on meshes of a model, from file to file: a belt and a tail go with their controls, other
// meshes of the same skin do not, and the model comes back.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "eval/evaluate.h"
#include "gltf/vertices.h"
#include "pipeline/build.h"
#include "pipeline/character_helpers.h"
#include "pipeline/door_helpers.h"
#include "pipeline/plan.h"
#include "pipeline/shot_helpers.h"
#include "support/corpus.h"
#include "support/surfaces.h"

namespace rigc {
namespace {

using math::Affine;
using math::Vec3;
using nlohmann::ordered_json;

constexpr int kNoSurface = 895, kNoLine = 896, kMovesNothing = 910;
constexpr int kAround = 32, kAlong = 20;  // columns of belt and tail

Vec3 belt(double u, double v) {
  const double angle = 2 * math::kPi * u;
  return {0.3 * math::sin(angle), 0.95 + 0.1 * v, 0.3 * math::cos(angle)};
}
Vec3 tail(double u, double v) { return {0.1 * (v - 0.5), 1 + 0.2 * u * u, -0.3 - u}; }

template <class T>
void put(std::string& bin, const std::vector<T>& values) {
  bin.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  bin.resize((bin.size() + 3) / 4 * 4);
}

/// A model that is being made.
struct Maker {
  test::Character character;

  Maker() {
    character.json["asset"]["version"] = "2.0";
    // All at once: a member that is added moves the others.
    for (const char* array : {"accessors", "bufferViews", "meshes"})
      character.json[array] = ordered_json::array();
    character.json["scene"] = 0;
    character.json["scenes"] = {{{"nodes", {0}}}};
    character.json["nodes"] = {{{"name", "Root"}, {"children", {1}}},
                               {{"name", "Hips"}, {"translation", {0, 1, 0}}}};
    character.json["materials"] = {{{"name", "Cloth"}, {"doubleSided", true}}};
    const auto matrices = accessor<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,
                                           1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1},
                                          5126, "MAT4", 16);
    character.json["skins"] = {{{"inverseBindMatrices", matrices}, {"joints", {0, 1}}}};
  }

  template <class T>
  std::size_t accessor(const std::vector<T>& values, int component, const char* type,
                       std::size_t width, int target = 0) {
    auto& json = character.json;
    ordered_json view = {{"buffer", 0},
                         {"byteOffset", character.bin.size()},
                         {"byteLength", values.size() * sizeof(T)}};
    if (target != 0) view["target"] = target;
    json["accessors"].push_back({{"bufferView", json["bufferViews"].size()},
                                 {"componentType", component},
                                 {"count", values.size() / width},
                                 {"type", type}});
    json["bufferViews"].push_back(view);
    put(character.bin, values);
    return json["accessors"].size() - 1;
  }

  /// A mesh that is bound to the hips.
  void add(const std::string& name, const tags::Surface& surface) {
    std::vector<float> places, texture, weights;
    std::vector<std::uint8_t> joints;
    Vec3 least = surface.places[0], most = least;
    for (const Vec3& p : surface.places) {
      for (const double x : {p.x, p.y, p.z}) places.push_back(static_cast<float>(x));
      least = {std::min(least.x, p.x), std::min(least.y, p.y), std::min(least.z, p.z)};
      most = {std::max(most.x, p.x), std::max(most.y, p.y), std::max(most.z, p.z)};
      weights.insert(weights.end(), {1, 0, 0, 0});
      joints.insert(joints.end(), {1, 0, 0, 0});
    }
    for (const auto& t : surface.texture)
      for (const double x : t) texture.push_back(static_cast<float>(x));
    std::vector<std::uint16_t> indices;
    for (const auto& triangle : surface.triangles)
      for (const std::uint32_t v : triangle) indices.push_back(static_cast<std::uint16_t>(v));
    auto& json = character.json;
    const std::size_t at = accessor(places, 5126, "VEC3", 3, 34962);
    const auto bound = [](Vec3 p) {
      return ordered_json{static_cast<float>(p.x), static_cast<float>(p.y),
                          static_cast<float>(p.z)};
    };
    json["accessors"][at]["min"] = bound(least);
    json["accessors"][at]["max"] = bound(most);
    ordered_json attributes = {{"POSITION", at}};
    attributes["TEXCOORD_0"] = accessor(texture, 5126, "VEC2", 2, 34962);
    attributes["JOINTS_0"] = accessor(joints, 5121, "VEC4", 4, 34962);
    attributes["WEIGHTS_0"] = accessor(weights, 5126, "VEC4", 4, 34962);
    ordered_json primitive = {{"attributes", attributes}};
    primitive["material"] = 0;
    primitive["indices"] = accessor(indices, 5123, "SCALAR", 1, 34963);
    json["scenes"][0]["nodes"].push_back(json["nodes"].size());
    json["nodes"].push_back({{"name", name}, {"mesh", json["meshes"].size()}, {"skin", 0}});
    json["meshes"].push_back({{"name", name}, {"primitives", {primitive}}});
  }

  std::string save(const std::string& name) {
    const std::string path = test::test_out(name + ".glb");
    character.json["buffers"] = {{{"byteLength", character.bin.size()}}};
    test::save_glb(character, path);
    return path;
  }
};

/// Hips with a belt, a tail and a body, all of one skin.
std::string model(const std::string& name) {
  Maker maker;
  maker.add("Belt", test::sheet(belt, kAround, 2));
  maker.add("Tail", test::sheet(tail, kAlong, 2));
  maker.add("Body", test::sheet([](double u, double v) { return Vec3{u - 0.5, v, 0}; }, 4, 4));
  return maker.save(name);
}

constexpr const char* kRibbons = R"(
      - {command: ribbon, id: belt, with: {surface: Belt, controls: 4, count: 8}}
      - {command: ribbon, id: tail, with: {surface: Tail, count: 9, volume: 1}})";

struct Built {
  std::string model, path;
  gltf::Rig rig;
  std::vector<int> said;
};

Built build(const std::string& name, const std::string& file, bool split = true,
            const std::string& ribbons = kRibbons) {
  const std::string folder = test::test_out("ribbon_surface_" + name);
  Built out;
  out.model = file;
  pipeline::BuildRequest request;
  request.template_file = folder + ".yaml";
  request.map = folder + "_map.yaml";
  request.model = file;
  request.split_weights = split;
  std::ofstream(request.template_file, std::ios::binary) << R"(rigc: 1
name: sash
version: 1
joints:
  - {name: root, at: [0, 0, 0], local: root, label: root, tags: [{command: root, with: {}}]}
  - name: hips
    parent: root
    at: [0, 1, 0]
    local: hips
    label: hips
    tags:
      - {command: control, with: {}})" << ribbons << "\n";
  std::ofstream(request.map, std::ios::binary)
      << "map: sash\ntitle: Sash\njoints:\n  root.root: Root\n  hips.hips: Hips\n";
  out.path = folder + ".glb";
  Diagnostics diagnostics;
  auto built = pipeline::build(request, out.path, diagnostics);
  REQUIRE_MESSAGE(built, render(diagnostics, false));
  test::made_from(out.path, out.model);
  out.rig = std::move(built->rig);
  for (const Diagnostic& each : diagnostics.all()) out.said.push_back(each.code->number);
  return out;
}

scene::NodeId tweak(const gltf::Rig& rig, const std::string& command, std::uint32_t counter) {
  for (const scene::NodeId id : rig.scene.nodes()) {
    const Identity& known = rig.scene[id].identity;
    if (known.command == command && known.role == "tweak" && known.counter == counter) return id;
  }
  FAIL("no control");
  return {};
}

struct Mesh {
  std::vector<Vec3> places;
  std::vector<double> weights;  ///< sums
  std::size_t joints = 0;       ///< how many move it
};

/// The meshes of a built file, in its order, as the rig stands with `settings`.
std::vector<Mesh> posed(const Built& built, const std::vector<eval::Setting>& settings) {
  Diagnostics diagnostics;
  const auto file = gltf::open(built.path, diagnostics);
  REQUIRE(file);
  std::set<int> own;
  for (const scene::NodeId id : built.rig.scene.nodes())
    if (!built.rig.scene[id].is_skeleton()) own.insert(built.rig.nodes[id.index]);
  std::vector<Mesh> out;
  for (const gltf::SkinnedVertices& skinned : gltf::read_vertices(*file, own)) {
    std::vector<scene::NodeId> joints;
    for (const int node : skinned.joints) {
      const auto at = std::find(built.rig.nodes.begin(), built.rig.nodes.end(), node);
      REQUIRE(at != built.rig.nodes.end());
      joints.push_back({static_cast<std::uint32_t>(at - built.rig.nodes.begin())});
    }
    const auto worlds = eval::worlds(built.rig.scene, joints, settings);
    Mesh mesh;
    std::set<std::size_t> used;
    for (std::size_t v = 0; v < skinned.places.size(); ++v) {
      Vec3 sum;
      double weights = 0;
      for (std::size_t i = v * skinned.slots; i < (v + 1) * skinned.slots; ++i) {
        const auto weight = static_cast<double>(skinned.weights[i]);
        if (weight == 0) continue;
        const auto joint = static_cast<std::size_t>(skinned.used[i]);
        sum = sum + worlds[joint] * (skinned.inverse[joint] * skinned.places[v]) * weight;
        weights += weight;
        used.insert(joint);
      }
      mesh.places.push_back(sum);
      mesh.weights.push_back(weights);
    }
    mesh.joints = used.size();
    out.push_back(std::move(mesh));
  }
  REQUIRE(out.size() == 3);
  return out;
}

eval::Setting moved(const gltf::Rig& rig, scene::NodeId control, Vec3 by) {
  const Affine axes{rig.scene.rest_world(control).linear, {}};
  return {{control, scene::transform::kTranslate}, math::inverse(axes) * by};
}

/// The greatest and the least of the lengths of a sheet's edges, relative to what they were.
std::pair<double, double> strain(const Mesh& mesh, const Mesh& rest, int columns) {
  double most = 0, least = 1e9;
  const auto edge = [&](std::size_t a, std::size_t b) {
    const double part = math::length(mesh.places[b] - mesh.places[a]) /
                        math::length(rest.places[b] - rest.places[a]);
    most = std::max(most, part);
    least = std::min(least, part);
  };
  const auto row = static_cast<std::size_t>(columns) + 1;
  for (std::size_t v = 0; v < mesh.places.size(); ++v) {
    if (v % row + 1 < row) edge(v, v + 1);
    if (v + row < mesh.places.size()) edge(v, v + row);
  }
  return {most, least};
}

/// How far a point is from the nearest triangle that it lies above.
double off_surface(const tags::Surface& surface, Vec3 point) {
  double least = 1e300;
  for (const auto& [a, b, c] : surface.triangles) {
    const Vec3 from = surface.places[a];
    const Vec3 x = surface.places[b] - from, y = surface.places[c] - from, p = point - from;
    const Vec3 normal = math::cross(x, y);
    const double area = math::dot(normal, normal);
    if (!(area > 0)) continue;
    const double s = math::dot(math::cross(p, y), normal) / area;
    const double t = math::dot(math::cross(x, p), normal) / area;
    if (s < -1e-6 || t < -1e-6 || s + t > 1 + 1e-6) continue;
    least = std::min(least, std::abs(math::dot(p, normal)) / std::sqrt(area));
  }
  return least;
}

}  // namespace

TEST_CASE("pipeline ribbon on a surface: meshes rest, and go smoothly with their controls") {
  const Built built = build("pose", model("ribbon_surface_pose_model"));
  CHECK(built.said.empty());
  const auto rest = posed(built, {});
  CHECK(rest[0].joints == 8);
  CHECK(rest[1].joints == 9);
  CHECK(rest[2].joints == 1);
  for (const Mesh& mesh : rest)
    for (const double sum : mesh.weights) CHECK(sum == doctest::Approx(1).epsilon(1e-6));
  const auto row = static_cast<std::size_t>(kAlong) + 1;
  for (std::size_t v = 0; v < rest[1].places.size(); ++v) {
    const double u = static_cast<double>(v % row) / kAlong, w = static_cast<double>(v / row) / 2;
    CHECK(math::length(rest[1].places[v] - tail(u, w)) < 1e-6);
  }
  // The tail's middle: its ends stay, between them nothing is torn.
  const auto up = posed(built, {moved(built.rig, tweak(built.rig, "tail", 1), {0.1, 0.3, 0})});
  CHECK(math::length(up[1].places[row] - rest[1].places[row]) < 1e-6);
  CHECK(math::length(up[1].places[row + kAlong] - rest[1].places[row + kAlong]) < 1e-6);
  const Vec3 middle = up[1].places[row + kAlong / 2] - rest[1].places[row + kAlong / 2];
  CHECK(math::length(middle - Vec3{0.1, 0.3, 0}) < 0.01);
  const auto [most, least] = strain(up[1], rest[1], kAlong);
  CHECK(most < 1.8);
  CHECK(least > 0.6);
  for (std::size_t v = 0; v < rest[0].places.size(); ++v)
    CHECK(math::length(up[0].places[v] - rest[0].places[v]) < 1e-9);
  for (std::size_t v = 0; v < rest[2].places.size(); ++v)
    CHECK(math::length(up[2].places[v] - rest[2].places[v]) < 1e-9);
  // The belt at its seam, in front: both sides of the cut stay together.
  const auto out = posed(built, {moved(built.rig, tweak(built.rig, "belt", 0), {0, 0.05, 0.1})});
  const auto around = static_cast<std::size_t>(kAround) + 1;
  for (const std::size_t v : {std::size_t{0}, around, 2 * around})
    CHECK(math::length(out[0].places[v] - out[0].places[v + kAround]) < 1e-6);
  CHECK(out[0].places[around].z == doctest::Approx(0.4).epsilon(0.02));
  CHECK(strain(out[0], rest[0], kAround).first < 1.5);
  CHECK(strain(out[0], rest[0], kAround).second > 0.6);
}

TEST_CASE("pipeline ribbon on a surface: built again nothing changes, and the model comes back") {
  const Built built = build("again", model("ribbon_surface_again_model"));
  const std::string before = test::bytes_of(built.path);
  test::rebuild(built.path);
  CHECK(test::bytes_of(built.path) == before);
  pipeline::RebuildRequest apart;
  apart.unbuild = true;
  test::rebuild(built.path, apart);
  test::rebuild(built.path);
  CHECK(test::bytes_of(built.path) == before);
  Diagnostics diagnostics;
  REQUIRE(pipeline::strip({}, {built.path, built.path, ""}, diagnostics));
  CHECK(test::bytes_of(built.path) == test::bytes_of(built.model));
}

TEST_CASE("pipeline ribbon on a surface: keys on its controls survive a rebuild") {
  const Built built = build("keys", model("ribbon_surface_keys_model"));
  const int node = built.rig.nodes[tweak(built.rig, "tail", 1).index];
  const std::string path = test::with_clip(
      built.path, {test::keys(node, anim::Path::translation, 3, {0, 0, 0, 0.1f, 0.2f, 0}),
                   test::attribute_keys(node, "twist_end", {0, 90})});
  test::made_from(path, built.model);
  const auto clips = test::load_glb(path).json["animations"];
  REQUIRE(clips[0]["channels"].size() == 2);
  test::rebuild(path);
  CHECK(test::load_glb(path).json["animations"] == clips);
  const std::string before = test::bytes_of(path);
  test::rebuild(path);
  CHECK(test::bytes_of(path) == before);
}

TEST_CASE("pipeline ribbon on a surface: said where nothing moves, is missing or cannot be used") {
  const std::string file = model("ribbon_surface_said_model");
  CHECK(build("unsplit", file, false).said == std::vector<int>{kMovesNothing});
  // The list of commands is made of what the model holds, too.
  pipeline::BuildRequest planned;
  planned.template_file = test::test_out("ribbon_surface_unsplit.yaml");
  planned.map = test::test_out("ribbon_surface_unsplit_map.yaml");
  planned.model = file;
  Diagnostics said;
  CHECK(pipeline::plan(planned, pipeline::PlanForm::text, said));
  CHECK(said.all().empty());
  const std::string cape = R"(
      - {command: ribbon, with: {surface: Cape}})";
  CHECK(build("missing", file, true, cape).said == std::vector<int>{kNoSurface});
  // A mesh that is bound to another joint: the ribbon is there, but nothing goes with it.
  Maker maker;
  maker.add("Belt", test::sheet(belt, kAround, 2));
  maker.add("Tail", test::sheet(tail, kAlong, 2));
  maker.add("Body", test::sheet(tail, 2, 2));
  maker.character.json["skins"][0]["joints"] = {1, 0};
  CHECK(build("other", maker.save("ribbon_surface_other_model")).said ==
        std::vector<int>{kMovesNothing});
  // Two of one name.
  maker.character.json["nodes"][2]["name"] = "Tail";
  pipeline::BuildRequest request;
  request.template_file = test::test_out("ribbon_surface_pose.yaml");
  build("pose", file);
  request.map = test::test_out("ribbon_surface_pose_map.yaml");
  request.model = maker.save("ribbon_surface_two_model");
  Diagnostics diagnostics;
  CHECK(!pipeline::build(request, test::test_out("ribbon_surface_two.glb"), diagnostics));
  CHECK(std::any_of(diagnostics.all().begin(), diagnostics.all().end(),
                    [](const Diagnostic& each) { return each.code->number == kNoLine; }));
}

TEST_CASE("pipeline ribbon on a surface: a strand of hair of the corpus") {
  const std::string file = test::corpus_file("momentum_sort_joints/sort_joints.glb");
  if (file.empty()) return;
  const std::string folder = test::test_out("ribbon_surface_hair"), out = folder + ".glb";
  std::ofstream(folder + ".yaml", std::ios::binary) << R"(rigc: 1
name: hair
version: 1
joints:
  - name: top
    at: [0, 0, 0]
    local: hair
    label: top
    tags:
      - {command: root, with: {}}
      - {command: control, with: {}}
      - {command: ribbon, with: {surface: hair_curve_00144_mesh, count: 25}}
  - {name: next, parent: top, at: [0, -0.1, 0], local: hair, label: next}
)";
  std::ofstream(folder + "_map.yaml", std::ios::binary)
      << "map: hair\ntitle: Hair\njoints:\n  hair.top: hair_curve_00144_bone\n"
         "  hair.next: hair_curve_00144_bone.001\n";
  pipeline::BuildRequest request;
  request.template_file = folder + ".yaml";
  request.map = folder + "_map.yaml";
  request.model = file;
  request.split_weights = true;
  Diagnostics diagnostics;
  const auto built = pipeline::build(request, out, diagnostics);
  REQUIRE_MESSAGE(built, render(diagnostics, false));
  test::made_from(out, file);
  CHECK(diagnostics.all().empty());
  const auto model = gltf::open(file, diagnostics);
  REQUIRE(model);
  const auto surfaces = gltf::geometry_of(*model).surfaces("hair_curve_00144_mesh");
  REQUIRE(surfaces.size() == 1);
  const gltf::Rig& rig = built->rig;
  std::vector<Vec3> pins;
  std::optional<Affine> into_mesh;
  for (const scene::NodeId id : rig.scene.nodes()) {
    const scene::Node& node = rig.scene[id];
    for (const auto& [joint, way] : surfaces[0].bound)
      if (node.is_skeleton() && node.ids.label == "top" && joint == rig.nodes[id.index])
        into_mesh = math::inverse(rig.scene.rest_world(id) * way);
    if (node.kind == scene::Kind::joint && node.module == "ribbon")
      pins.push_back(eval::worlds(rig.scene, {id})[0].origin);
  }
  REQUIRE(into_mesh);
  REQUIRE(pins.size() == 25);
  double length = 0;
  for (std::size_t k = 1; k < pins.size(); ++k) length += math::length(pins[k] - pins[k - 1]);
  for (std::size_t k = 0; k < pins.size(); ++k) {
    CHECK(off_surface(surfaces[0], *into_mesh * pins[k]) < 1e-6 * length);
    if (k == 0) continue;
    // Chords of a line that is bent here more, there less.
    CHECK(math::length(pins[k] - pins[k - 1]) == doctest::Approx(length / 24).epsilon(0.1));
  }
  const std::string before = test::bytes_of(out);
  test::rebuild(out);
  CHECK(test::bytes_of(out) == before);
}

}  // namespace rigc
