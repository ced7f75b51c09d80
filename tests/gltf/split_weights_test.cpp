// SPDX-License-Identifier: MIT
// Skins of a model are bound to joints that a rig made along a bone, in accessors of their own, and
// are the model's again when the rig goes.
#include "gltf/split_weights.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstring>

#include "file_helpers.h"
#include "gltf/accessor.h"
#include "gltf/slim.h"
#include "merge_helpers.h"
#include "rig_helpers.h"

using namespace rigc;
using namespace rigc::gltf;
using namespace rigc::gltf::test;

namespace {

constexpr int kRings = 9, kSides = 4;

/// How a model stores what is bound.
struct Storage {
  int joints = 5121, weights = 5126;
};

template <class T>
void put(std::string& out, double value) {
  const auto number = static_cast<T>(value);
  out.append(reinterpret_cast<const char*>(&number), sizeof number);
}

void put_as(std::string& out, int component, double value, double unit) {
  if (component == 5121) return put<std::uint8_t>(out, value * (unit > 0 ? 255 : 1));
  if (component == 5123) return put<std::uint16_t>(out, value * (unit > 0 ? 65535 : 1));
  put<float>(out, value);
}

/// A sleeve around the bone from node 0 to node 1, which lies two units above it, bound to node 0.
/// Two primitives share all accessors.
std::string sleeve(const Storage& storage = {}) {
  std::string positions, joints, weights;
  for (int ring = 0; ring < kRings; ++ring)
    for (int side = 0; side < kSides; ++side) {
      for (const double x : {side % 2 ? 0.0 : 1.0 - side, ring * 0.25, side % 2 ? side - 2.0 : 0.0})
        put<float>(positions, x);
      for (int slot = 0; slot < 4; ++slot) {
        put_as(joints, storage.joints, 0, 0);
        put_as(weights, storage.weights, slot == 0, 1);
      }
    }
  std::string bytes = floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,
                              1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -2, 0, 1});
  std::string views;
  const auto view = [&](const std::string& data) {
    views += fmt::format(R"(,{{"buffer":0,"byteOffset":{},"byteLength":{}}})", bytes.size(),
                         data.size());
    bytes += data;
  };
  views = R"({"buffer":0,"byteLength":128})";
  view(positions);
  view(joints);
  view(weights);
  std::string indices;
  for (int i = 0; i < 6; ++i) put<std::uint16_t>(indices, i);
  view(indices);
  const int count = kRings * kSides;
  const auto accessor = [&](int at, int component, const char* type, const std::string& more) {
    return fmt::format(R"(,{{"bufferView":{},"componentType":{},"count":{},"type":"{}"{}}})", at,
                       component, at == 4 ? 6 : count, type, more);
  };
  const std::string primitive =
      R"({ "attributes": { "POSITION": 1, "JOINTS_0": 2, "WEIGHTS_0" : 3 }, "indices": 4 })";
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,2]}],"nodes":[
    {"name":"elbow","children":[1]},{"name":"wrist","translation":[0,2,0]},
    {"name":"sleeve","mesh":0,"skin":0}],
    "meshes":[{"primitives":[)" +
         primitive + ", " + primitive + R"(]}],
    "skins":[{"inverseBindMatrices": 0, "joints": [ 0, 1 ]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":2,"type":"MAT4"})" +
         accessor(1, 5126, "VEC3", R"(,"min":[-1,0,-1],"max":[1,2,1])") +
         accessor(2, storage.joints, "VEC4", "") +
         accessor(3, storage.weights, "VEC4",
                  storage.weights == 5126 ? "" : R"(,"normalized":true)") +
         accessor(4, 5123, "SCALAR", "") + "],\"bufferViews\":[" + views +
         fmt::format(R"(],"buffers":[{{"byteLength":{},"uri":"{}"}}]}})", bytes.size(),
                     data_uri(bytes));
}

/// A rig on the sleeve's joints, with two twist joints on the bone, in the middle and at its end.
Rig twisted(bool split_weights, int joints = 2) {
  RigMaker maker;
  const auto elbow = maker.joint("elbow", -1, {}, 0);
  maker.command("twist", "twist_joints");
  const auto wrist = maker.joint("wrist", 0, {{0, 2, 0}, {}, {1, 1, 1}}, 1);
  const auto split = maker.node(scene::Kind::skin_split, "split");
  using scene::transform::kWorld;
  maker.edit.connect({elbow, kWorld}, {split, scene::skin_split::kJoints, 0});
  maker.edit.connect({wrist, kWorld}, {split, scene::skin_split::kJoints, 1});
  std::vector<double> fractions{0};
  for (int i = 1; i <= joints; ++i) {
    const double fraction = static_cast<double>(i) / joints;
    const auto joint = maker.node(scene::Kind::joint, fmt::format("twist{}", i), elbow);
    maker.edit.set({joint, scene::transform::kTranslate}, math::Vec3{0, 2 * fraction, 0});
    maker.edit.set({joint, scene::transform::kRotation}, math::axis_angle({0, 0, 1}, 0.3 * i));
    maker.edit.connect({joint, kWorld}, {split, scene::skin_split::kJoints, i + 1});
    fractions.push_back(fraction);
  }
  maker.edit.set({split, scene::skin_split::kFractions}, fractions);
  Rig rig = maker.take();
  rig.settings.split_weights = split_weights;
  return rig;
}

File as_glb(const File& file, const std::string& name) {
  Diagnostics diagnostics;
  Patch patch(file);
  const auto output = patch.finish(true, diagnostics);
  REQUIRE(output);
  const std::string path = make_folder("broken/" + name) + "/model.glb";
  write_bytes(path, whole(*output));
  auto opened = gltf::open(path, diagnostics);
  REQUIRE(opened);
  return *std::move(opened);
}

/// A sleeve as a .glb, which a rig that goes leaves byte for byte.
File model(const Storage& storage, const std::string& name) {
  return as_glb(model_file(sleeve(storage), name), name + "_glb");
}

Rig read_one(const File& file) {
  Diagnostics diagnostics;
  auto rigs = read_rigs(file, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(rigs);
  REQUIRE(rigs->size() == 1);
  return std::move(rigs->front());
}

std::vector<float> read(const File& file, int accessor) {
  Diagnostics diagnostics;
  const auto slim = read_slim(file, diagnostics);
  REQUIRE(slim);
  const auto out =
      read_floats(file, *slim, accessor, slim->accessors[static_cast<std::size_t>(accessor)].count,
                  diagnostics);
  REQUIRE(out);
  return *out;
}

int attribute(const File& file, std::size_t primitive, const char* name) {
  const auto primitives = file.root()["meshes"].items()[0]["primitives"].items();
  return static_cast<int>(primitives[primitive]["attributes"][name].integer().value_or(-1));
}

std::string stripped(const File& file, const Rig& rig) {
  Diagnostics diagnostics;
  Patch patch(file);
  strip_rig(patch, file, rig, Strip::nothing);
  const auto output = patch.finish(true, diagnostics);
  REQUIRE(output);
  return whole(*output);
}

/// `rig` in the place of the one that a file has, each node where it was.
File rebuilt(const File& file, Rig fresh, const std::string& name) {
  const Rig old = read_one(file);
  Diagnostics diagnostics;
  diagnostics.sources().add("templates/lamp.yaml", "");
  diagnostics.sources().add("templates/parts/arm.yaml", "");
  std::vector<int> places(fresh.scene.size(), -1);
  const std::vector<int> own = own_nodes(old);
  for (const scene::NodeId a : fresh.scene.nodes())
    for (const scene::NodeId b : old.scene.nodes())
      if (fresh.scene[a].identity == old.scene[b].identity) places[a.index] = own[b.index];
  Patch patch(file);
  std::vector<Replacement> replacements = {{&old, &fresh, places, diagnostics.sources()}};
  REQUIRE(replace_rigs(patch, file, replacements, diagnostics));
  const auto output = patch.finish(true, diagnostics);
  REQUIRE(output);
  const std::string path = make_folder(name) + "/rig.glb";
  write_output(*output, path, folder_of(file.path));
  allow_messages_of(path, file.path);
  auto opened = gltf::open(path, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(opened);
  return *std::move(opened);
}

}  // namespace

TEST_CASE("gltf split_weights: each vertex is bound to the joints that it lies between") {
  for (const int joints : {5121, 5123})
    for (const int weights : {5126, 5121, 5123}) {
      CAPTURE(joints);
      CAPTURE(weights);
      const std::string name = fmt::format("split_{}_{}", joints, weights);
      const File plain = model({joints, weights}, name);
      Rig rig = twisted(true);
      const File file = written(plain, rig, name);
      const json::Value skin = file.root()["skins"].items()[0];
      REQUIRE(skin["joints"].size() == 4);
      CHECK(skin["joints"].items()[2].integer() == rig.nodes[with_role(rig, "twist1").index]);

      const int now = attribute(file, 0, "WEIGHTS_0");
      CHECK(now != 3);
      CHECK(attribute(file, 1, "WEIGHTS_0") == now);
      CHECK(attribute(file, 0, "POSITION") == 1);
      const auto bound = read(file, attribute(file, 0, "JOINTS_0"));
      const auto parts = read(file, now);
      const double rounding = weights == 5121 ? 0.5 / 255 : 1e-5;
      for (std::size_t v = 0; v < kRings * kSides; ++v) {
        const double fraction = static_cast<double>(v / kSides) / (kRings - 1);
        double of[4] = {};
        for (std::size_t i = 0; i < 4; ++i)
          of[static_cast<std::size_t>(bound[4 * v + i])] += static_cast<double>(parts[4 * v + i]);
        CHECK(of[0] == doctest::Approx(std::max(0.0, 1 - 2 * fraction)).epsilon(rounding));
        CHECK(of[2] == doctest::Approx(1 - std::abs(2 * fraction - 1)).epsilon(rounding));
        CHECK(of[3] == doctest::Approx(std::max(0.0, 2 * fraction - 1)).epsilon(rounding));
        CHECK(of[0] + of[1] + of[2] + of[3] == doctest::Approx(1).epsilon(1e-6));
      }
      // What the model had is there as it was.
      CHECK(read(file, 2) == read(plain, 2));
      CHECK(read(file, 3) == read(plain, 3));
    }
}

TEST_CASE("gltf split_weights: nothing moves until a new joint turns") {
  const File plain = model({}, "split_rest");
  Rig rig = twisted(true);
  const File file = written(plain, rig, "split_rest");
  Diagnostics diagnostics;
  const auto slim = read_slim(file, diagnostics);
  REQUIRE(slim);
  const auto joints = slim->skins[0].joints;
  const auto matrices = read(file, slim->skins[0].matrices);
  REQUIRE(matrices.size() == 16 * joints.size());
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const float* m = matrices.data() + 16 * i;
    const math::Affine inverse_bind{{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}},
                                    {m[12], m[13], m[14]}};
    const math::Affine moved = slim->world(joints[i]) * inverse_bind;
    CHECK(math::length(moved.origin) < 1e-6);
    CHECK(math::length(moved.linear.x - math::Vec3{1, 0, 0}) < 1e-6);
    CHECK(math::length(moved.linear.y - math::Vec3{0, 1, 0}) < 1e-6);
  }
}

TEST_CASE("gltf split_weights: taken out, the rig leaves the model's bytes") {
  for (const int weights : {5126, 5121}) {
    const std::string name = fmt::format("split_strip_{}", weights);
    const File plain = model({5121, weights}, name);
    Rig rig = twisted(true);
    const File file = written(plain, rig, name);
    CHECK(stripped(file, read_one(file)) == text(plain.whole));
  }
}

TEST_CASE("gltf split_weights: what is read back is what was written") {
  Rig rig = twisted(true);
  const File file = written(model({}, "split_read"), rig, "split_read");
  const Rig read = read_one(file);
  REQUIRE(rig.rebound.skins.size() == 1);
  REQUIRE(rig.rebound.primitives.size() == 2);
  CHECK(read.rebound == rig.rebound);
  CHECK(read.settings.split_weights);
}

TEST_CASE(
    "gltf split_weights: built again, the file is the same; with more joints they share too") {
  const File plain = model({}, "split_again");
  Rig rig = twisted(true);
  const File file = written(plain, rig, "split_again");
  const File again = rebuilt(file, twisted(true), "split_again_2");
  CHECK(again.json.text() == file.json.text());
  CHECK(text(again.whole) == text(file.whole));

  const File more = rebuilt(file, twisted(true, 5), "split_more");
  CHECK(more.root()["skins"].items()[0]["joints"].size() == 7);
  CHECK(stripped(more, read_one(more)) == text(plain.whole));
  const File none = rebuilt(more, twisted(false), "split_none");
  CHECK(none.root()["skins"].items()[0]["joints"].size() == 2);
  CHECK(attribute(none, 0, "JOINTS_0") == 2);
  CHECK(stripped(none, read_one(none)) == text(plain.whole));
}

TEST_CASE("gltf split_weights: a skin that another program bound anew stays as it is") {
  Rig rig = twisted(true);
  const File file = written(model({}, "split_foreign"), rig, "split_foreign");
  Patch patch(file);
  const int other = attribute(file, 0, "JOINTS_0");
  // Somebody binds the second primitive by itself.
  patch.set_member("meshes", 0, "primitives",
                   fmt::format(R"([{{"attributes":{{"POSITION":1,"JOINTS_0":{},"WEIGHTS_0":{}}}}},
                                   {{"attributes":{{"POSITION":1,"JOINTS_0":2,"WEIGHTS_0":3}}}}])",
                               other, attribute(file, 0, "WEIGHTS_0")));
  Diagnostics diagnostics;
  const auto output = patch.finish(true, diagnostics);
  REQUIRE(output);
  const std::string path = make_folder("split_foreign_bound") + "/rig.glb";
  write_bytes(path, whole(*output));
  const auto bound = gltf::open(path, diagnostics);
  REQUIRE(bound);
  const File again = rebuilt(*bound, twisted(true), "split_foreign_again");
  CHECK(again.root()["skins"].items()[0]["joints"].size() == 4);
  CHECK(attribute(again, 0, "JOINTS_0") == other);

  Patch strip(again);
  strip_rig(strip, again, read_one(again), Strip::nothing);
  const auto rest = strip.finish(true, diagnostics);
  REQUIRE(rest);
  const std::string left = make_folder("split_foreign_left") + "/model.glb";
  write_bytes(left, whole(*rest));
  const auto model = gltf::open(left, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(model);
  // The joints that bend it stay with it.
  CHECK(model->root()["nodes"].size() == 5);
}

TEST_CASE("gltf split_weights: in a merged file they are given back too") {
  Rig rig = twisted(true);
  const File split = written(model({}, "split_merge"), rig, "split_merge");
  Diagnostics diagnostics;
  std::deque<File> files;
  files.push_back(model_file(small_model(), "split_merge_first"));
  files.push_back(split);
  const auto both = merged(files, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(both);
  const Rig moved = read_one(*both);
  REQUIRE(moved.rebound.skins.size() == 1);
  CHECK(moved.rebound.skins[0].skin == 1);
  const std::string path = make_folder("split_merge_left") + "/model.glb";
  write_bytes(path, stripped(*both, moved));
  allow_messages_of(path, files[0].path);
  const auto left = gltf::open(path, diagnostics);
  REQUIRE(left);
  CHECK(left->root()["skins"].items()[1]["joints"].size() == 2);
  const auto primitive = left->root()["meshes"].items()[1]["primitives"].items()[0];
  const auto index = static_cast<int>(primitive["attributes"]["WEIGHTS_0"].integer().value_or(-1));
  CHECK(read(*left, index) == read(split, 3));
}

TEST_CASE("gltf split_weights: says where new joints bend nothing, and what cannot be shared") {
  const auto said = [](const std::string& text, bool split_weights) {
    Diagnostics none;
    const File file = model_file(text, "split_said");
    Diagnostics diagnostics;
    Patch patch(file);
    Rig rig = twisted(split_weights);
    REQUIRE(write_rig(patch, rig, -1, diagnostics));
    return numbers(diagnostics);
  };
  CHECK(said(sleeve(), true).empty());
  CHECK(said(sleeve(), false) == std::vector<int>{910});
  // Nothing is drawn; or it is not bound.
  CHECK(said(replaced(sleeve(), R"("mesh":0,"skin":0)", R"("extras":0)"), false).empty());
  CHECK(said(replaced(sleeve(), R"("mesh":0,"skin":0)", R"("mesh":0)"), false) ==
        std::vector<int>{910});
  CHECK(said(replaced(sleeve(), R"("inverseBindMatrices": 0, )", ""), true) ==
        std::vector<int>{911, 910});
  // The same mesh with two skins.
  std::string two = replaced(sleeve(), R"({"name":"sleeve","mesh":0,"skin":0})",
                             R"({"name":"a","mesh":0,"skin":0},{"name":"b","mesh":0,"skin":1})");
  two = replaced(two, R"("skins":[)", R"("skins":[{"inverseBindMatrices":0,"joints":[0,1]},)");
  CHECK(said(replaced(two, R"("nodes":[0,2])", R"("nodes":[0,2,3])"), true) ==
        std::vector<int>{911, 910});
  // Compressed, by an extension that leaves plain data beside.
  const std::string draco = R"(, "indices": 4, "extensions":{"KHR_draco_mesh_compression":{}} })";
  std::string packed = sleeve();
  for (std::size_t at; (at = packed.find(R"(, "indices": 4 })")) != std::string::npos;)
    packed.replace(at, 16, draco);
  CHECK(said(packed, true) == std::vector<int>{911, 910});
}
