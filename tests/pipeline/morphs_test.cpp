// SPDX-License-Identifier: MIT
// Morph targets that a rig drives, in files: a made model and one of the corpus.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "gltf/clips.h"
#include "gltf/morphs.h"
#include "gltf/slim.h"
#include "pipeline/bake_file.h"
#include "pipeline/build.h"
#include "pipeline/character_helpers.h"
#include "pipeline/codes.h"
#include "pipeline/rebuild.h"

namespace rigc {
namespace {

using math::Vec3;
using nlohmann::ordered_json;

void write_text(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// A head with a control that has `angry`; bowed forward by 90 degrees it is sad, too.
std::string face(const std::string& first) {
  return R"(rigc: 1
name: face
version: 1
joints:
  - {name: root, at: [0, 0, 0], local: root, label: root, tags: [{command: root, with: {}}]}
  - name: head
    parent: root
    at: [0, 1.6, 0]
    local: head
    label: head
    tags:
      - {command: control, with: {orient: world}}
      - {command: attribute, with: {attribute: angry}}
      - {command: pose_reader, with: {reads: rotation, poses: [[90, 0, 0]], names: [bowed], angle: 90}}
      - {command: morph_targets, with: {weights: [./control@angry, ./pose_reader@bowed],
         targets: [)" +
         first + R"(, Sad]}}
)";
}

/// Builds the face onto a model whose bones are called so; REQUIREs that it works.
pipeline::Built build_face(const std::string& model, const std::string& root,
                           const std::string& head, const std::string& out,
                           Diagnostics& diagnostics, const std::string& first = "Angry") {
  pipeline::BuildRequest request;
  request.template_file = test::test_out("morph_face.yaml");
  request.map = test::test_out("morph_face_map.yaml");
  request.model = model;
  write_text(request.template_file, face(first));
  write_text(request.map, "map: face\ntitle: Face\njoints:\n  root.root: " + root +
                              "\n  head.head: " + head + "\n");
  auto built = pipeline::build(request, out, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(built);
  test::made_from(out, model);
  return *std::move(built);
}

int control_of(const gltf::Rig& rig) {
  for (const scene::NodeId id : rig.scene.nodes())
    if (rig.scene[id].kind == scene::Kind::control && rig.scene[id].identity.role == "control")
      return rig.nodes[id.index];
  return -1;
}

/// Keys the face from 0 to 1 second: angry rises to 0.8, the head bows by 90 degrees; in an
/// animation of the file or in a new one.
void key_face(const std::string& path, const gltf::Rig& rig, int animation, const std::string& name,
              const std::string& out) {
  Diagnostics diagnostics;
  const auto file = gltf::open(path, diagnostics);
  REQUIRE(file);
  const auto times = std::make_shared<const std::vector<float>>(std::vector<float>{0, 1});
  anim::Clip clip{name, animation, {}};
  anim::Channel angry;
  angry.node = control_of(rig);
  angry.path = anim::Path::attribute;
  angry.attribute = "angry";
  angry.curve = {anim::Interpolation::linear, 1, times, {0, 0.8f}};
  anim::Channel bow;
  bow.node = angry.node;
  bow.path = anim::Path::rotation;
  const auto half = static_cast<float>(std::sqrt(0.5));
  bow.curve = {anim::Interpolation::linear, 4, times, {0, 0, 0, 1, half, 0, 0, half}};
  clip.channels = {angry, bow};
  gltf::Patch patch(*file);
  gltf::write_clip(patch, *file, clip, {});
  std::uint64_t bytes = 0;
  REQUIRE(pipeline::write_output(patch, *file, out, bytes, diagnostics));
}

void bake_face(const std::string& path, const std::string& out, bool keep_rig = false) {
  Diagnostics diagnostics;
  pipeline::BakeRequest request;
  request.file = path;
  request.keep_rig = keep_rig;
  const auto baked = pipeline::bake_file(request, out, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(baked);
}

/// Weights of a node at a time of an animation; empty where that has no channel on them.
std::vector<double> weights_at(const std::string& path, const std::string& clip, int node,
                               std::size_t count, double seconds) {
  Diagnostics diagnostics;
  const auto file = gltf::open(path, diagnostics);
  REQUIRE(file);
  const auto slim = gltf::read_slim(*file, diagnostics);
  REQUIRE(slim);
  for (std::size_t i = 0; i < slim->animations.size(); ++i) {
    if (slim->animations[i].name != clip) continue;
    const auto curve =
        gltf::read_weights_curve(*file, *slim, static_cast<int>(i), node, count, diagnostics);
    REQUIRE(curve);
    if (!curve->times) return {};
    std::vector<double> out(count);
    anim::sample(*curve, false, seconds, out.data());
    return out;
  }
  FAIL("no clip " << clip);
  return {};
}

/// A bone, a head above it and two meshes of one triangle: the face rides on the head and has
/// targets, whose names are not in the order of the template's; the other lies beside.
std::string made_model() {
  test::Character c;
  const float points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  c.bin.assign(reinterpret_cast<const char*>(points), sizeof points);
  const ordered_json primitive = ordered_json::parse(
      R"({"attributes":{"POSITION":0},"targets":[{"POSITION":0},{"POSITION":0},{"POSITION":0}]})");
  c.json = ordered_json::parse(R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,3,5]}],
    "nodes":[{"name":"low","children":[1]},
      {"name":"high","translation":[0,1.6,0],"children":[2]},
      {"name":"face","mesh":0,"translation":[0,0.1,0],"weights":[0.25,0,0]},
      {"name":"beside","mesh":0},{"name":"unused"},{"name":"skin","mesh":1,"skin":0}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
      {"bufferView":1,"componentType":5121,"count":3,"type":"VEC4"},
      {"bufferView":2,"componentType":5126,"count":3,"type":"VEC4"}],
    "bufferViews":[{"buffer":0,"byteLength":36}],"skins":[{"joints":[0,1]}]})");
  const auto view = [&](const std::string& bytes) {
    c.json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", c.bin.size()}, {"byteLength", bytes.size()}});
    c.bin += bytes;
  };
  view(std::string(12, '\0'));
  const float weights[] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
  view(std::string(reinterpret_cast<const char*>(weights), sizeof weights));
  c.json["buffers"] = {{{"byteLength", c.bin.size()}}};
  c.json["meshes"] = {
      {{"primitives", {primitive}}, {"extras", {{"targetNames", {"Smile", "Sad", "Angry"}}}}},
      {{"primitives",
        {ordered_json::parse(R"({"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}})")}}}};
  const std::string path = test::test_out("morph_model.glb");
  test::save_glb(c, path);
  return path;
}

void check_near(const std::vector<double>& found, const std::vector<double>& wanted) {
  REQUIRE(found.size() == wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i)
    CHECK(found[i] == doctest::Approx(wanted[i]).epsilon(1e-5));
}

}  // namespace

TEST_CASE("pipeline morphs: a bake writes what the rig says of targets, others stay") {
  Diagnostics diagnostics;
  const std::string model = made_model(), rig = test::test_out("morph_rig.glb");
  const pipeline::Built built = build_face(model, "low", "high", rig, diagnostics);
  const std::string keyed = test::test_out("morph_keyed.glb");
  key_face(rig, built.rig, -1, "bow", keyed);
  for (const bool keep : {false, true}) {
    CAPTURE(keep);
    const std::string out = test::test_out(keep ? "morph_kept.glb" : "morph_baked.glb");
    bake_face(keyed, out, keep);
    check_near(weights_at(out, "bow", 2, 3, 0), {0.25, 0, 0});
    check_near(weights_at(out, "bow", 2, 3, 1), {0.25, 1, 0.8});
    const auto half = weights_at(out, "bow", 2, 3, 0.5);
    CHECK(half[1] > 0.1);
    CHECK(half[1] < 0.9);
    CHECK(half[2] == doctest::Approx(0.4));
    CHECK(weights_at(out, "bow", 3, 3, 0).empty());  // hangs on no joint of the rig
  }
  // Baked again, it is the same.
  const std::string again = test::test_out("morph_again.glb");
  bake_face(test::test_out("morph_kept.glb"), again, true);
  check_near(weights_at(again, "bow", 2, 3, 1), {0.25, 1, 0.8});
  CHECK(test::bytes_of(again) == test::bytes_of(test::test_out("morph_kept.glb")));
}

TEST_CASE("pipeline morphs: what several commands say of one target adds up") {
  Diagnostics diagnostics;
  const std::string two =
      "Angry, Sad]}}\n      - {command: morph_targets, id: more, with: {weights: [./control@angry, "
      "./control@angry], targets: [Smile";
  const std::string rig = test::test_out("morph_sum_rig.glb"),
                    keyed = test::test_out("morph_sum_keyed.glb"),
                    out = test::test_out("morph_sum.glb");
  const auto built = build_face(made_model(), "low", "high", rig, diagnostics, two);
  key_face(rig, built.rig, -1, "bow", keyed);
  bake_face(keyed, out);
  check_near(weights_at(out, "bow", 2, 3, 0), {0, 0, 0});
  check_near(weights_at(out, "bow", 2, 3, 1), {0.8, 1.8, 0.8});
}

TEST_CASE("pipeline morphs: damaged keys on weights are an error") {
  Diagnostics diagnostics;
  const std::string rig = test::test_out("morph_damaged_rig.glb");
  const pipeline::Built built = build_face(made_model(), "low", "high", rig, diagnostics);
  const std::string keyed = test::test_out("morph_damaged_keyed.glb");
  key_face(rig, built.rig, -1, "bow", keyed);
  const std::string kept = test::test_out("morph_damaged_kept.glb");
  bake_face(keyed, kept, true);
  const auto codes_of = [&](auto damage) {
    test::Character character = test::load_character(kept);
    auto& animation = character.json["animations"][0];
    std::size_t channel = 0;
    while (animation["channels"][channel]["target"]["path"] != "weights") ++channel;
    damage(character,
           animation["samplers"][animation["channels"][channel]["sampler"].get<std::size_t>()]);
    std::filesystem::create_directories(test::test_out("broken"));
    const std::string path = test::test_out("broken/morph_damaged.glb");
    test::save_glb(character, path);
    Diagnostics found;
    pipeline::BakeRequest request;
    request.file = path;
    request.keep_rig = true;
    CHECK_FALSE(pipeline::bake_file(request, test::test_out("morph_damaged_out.glb"), found));
    REQUIRE(found.all().size() == 1);
    return std::to_string(found.all()[0].code->number) + " " +
           found.all()[0].place.pointer.substr(0, 11);
  };
  CHECK(codes_of([](test::Character&, ordered_json& sampler) {
          sampler["output"] = sampler["input"];
        }) == "678 /animations");
  CHECK(codes_of([](test::Character& character, ordered_json& sampler) {
          const auto& accessor = character.json["accessors"][sampler["output"].get<std::size_t>()];
          const auto& view =
              character.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
          const std::size_t at = view.value("byteOffset", std::size_t{0}) +
                                 accessor.value("byteOffset", std::size_t{0});
          const float wrong = std::numeric_limits<float>::quiet_NaN();
          std::memcpy(character.bin.data() + at, &wrong, sizeof wrong);
        }) == "673 /accessors/");
}

TEST_CASE("pipeline morphs: a name that no mesh has is reported, by build and by bake") {
  Diagnostics diagnostics;
  const std::string rig = test::test_out("morph_unknown.glb");
  const pipeline::Built built = build_face(made_model(), "low", "high", rig, diagnostics, "Cross");
  CHECK(render(diagnostics, false).find("RIG0859") != std::string::npos);
  CHECK(render(diagnostics, false)
            .find("no mesh that rig \"face\" moves has a morph target "
                  "\"Cross\"") != std::string::npos);
  const std::string keyed = test::test_out("morph_unknown_keyed.glb");
  key_face(rig, built.rig, -1, "bow", keyed);
  // Where the rig is built again, too.
  const std::string again = test::test_out("morph_unknown_again.glb");
  Diagnostics rebuilding;
  REQUIRE(pipeline::rebuild({}, catalog::Catalogue(), {keyed, again, ""}, rebuilding));
  CHECK(rebuilding.all().size() == 1);
  CHECK(render(rebuilding, false).find("\"Cross\"") != std::string::npos);
  const std::string out = test::test_out("morph_unknown_baked.glb");
  bake_face(keyed, out);
  check_near(weights_at(out, "bow", 2, 3, 1), {0.25, 1, 0});
}

TEST_CASE("pipeline morphs: a clip of the corpus keeps the targets that the rig does not drive") {
  const std::string model =
      test::corpus_file("gltftransform_RobotExpressive_quant/RobotExpressive.glb");
  if (model.empty()) return;
  Diagnostics diagnostics;
  const std::string rig = test::test_out("morph_robot.glb");
  const pipeline::Built built = build_face(model, "Bone", "Head", rig, diagnostics);
  const auto file = gltf::open(model, diagnostics);
  const auto animations = file->root()["animations"].items();
  std::size_t risen = 0;
  constexpr int kFace = 12;
  constexpr std::size_t kAngry = 0, kSurprised = 1, kSad = 2;
  for (std::size_t i = 0; i < animations.size(); ++i) {
    const std::string name = *animations[i]["name"].string();
    CAPTURE(name);
    const std::string keyed = test::test_out("morph_robot_keyed.glb");
    key_face(rig, built.rig, static_cast<int>(i), name, keyed);
    const std::string out = test::test_out("morph_robot_baked.glb");
    bake_face(keyed, out);
    test::made_from(keyed, model);
    test::made_from(out, model);
    for (const double time : {0.0, 0.2, 1.0}) {
      const auto was = weights_at(model, name, kFace, 3, time);
      const auto is = weights_at(out, name, kFace, 3, time);
      REQUIRE(is.size() == 3);
      CHECK(is[kSurprised] == doctest::Approx(was.empty() ? 0 : was[kSurprised]).epsilon(1e-4));
      CHECK(is[kAngry] == doctest::Approx(0.8 * time).epsilon(1e-4));
      CHECK(is[kSad] >= 0);
    }
    const double sad = weights_at(out, name, kFace, 3, 0)[kSad];
    if (weights_at(out, name, kFace, 3, 1)[kSad] > sad) ++risen;
  }
  CHECK(risen + 1 >= animations.size());  // one of them turns the neck the other way
}

}  // namespace rigc
