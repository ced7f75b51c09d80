// SPDX-License-Identifier: MIT
// Diagnostics that only whole files provoke: two skeletons, clips on driven joints, shear.
#include <doctest/doctest.h>

#include <cstdio>
#include <functional>

#include "base/files.h"
#include "gltf/clips.h"
#include "gltf/rig.h"
#include "pipeline/bake_file.h"
#include "pipeline/build.h"
#include "pipeline/character_helpers.h"

namespace rigc {
namespace {

/// The numbers of what was reported, in order.
std::vector<int> numbers(const Diagnostics& diagnostics) {
  std::vector<int> out;
  for (const Diagnostic& diagnostic : diagnostics.all()) out.push_back(diagnostic.code->number);
  return out;
}

pipeline::BuildRequest request_of(const std::string& name) {
  pipeline::BuildRequest request;
  request.template_file = test::templates_folder() + "/" + name;
  request.paths.templates = {test::templates_folder()};
  return request;
}

anim::Channel constant(int node, anim::Path path, std::vector<float> value) {
  anim::Channel channel;
  channel.node = node;
  channel.path = path;
  channel.curve.width = static_cast<int>(value.size());
  channel.curve.times = std::make_shared<const std::vector<float>>(1, 0.0f);
  channel.curve.values = std::move(value);
  return channel;
}

/// Bakes a clip of the channels that `keys` makes of a rig, after somebody changed its file; the
/// diagnostics of the bake.
using Keys = std::function<std::vector<anim::Channel>(const gltf::Rig&)>;
using Change = std::function<void(nlohmann::ordered_json&, const gltf::Rig&)>;
Diagnostics bake_with(const std::string& template_name, const std::string& name, const Keys& keys,
                      const Change& change = {}) {
  Diagnostics diagnostics;
  const std::string built = test::test_out(name + ".glb"),
                    keyed = test::test_out(name + "_keyed.glb");
  REQUIRE(pipeline::build(request_of(template_name), built, diagnostics));
  const auto file = gltf::open(built, diagnostics);
  REQUIRE(file);
  const auto rigs = gltf::read_rigs(*file, diagnostics);
  REQUIRE(rigs);
  gltf::Patch patch(*file);
  gltf::write_clip(patch, *file, {"test", -1, keys(rigs->front())}, {});
  std::uint64_t bytes = 0;
  REQUIRE(pipeline::write_output(patch, *file, keyed, bytes, diagnostics));
  REQUIRE(diagnostics.all().empty());
  if (change) {
    test::Character changed = test::load_glb(keyed);
    change(changed.json, rigs->front());
    test::save_glb(changed, keyed);
  }
  pipeline::BakeRequest request;
  request.file = keyed;
  CHECK(pipeline::bake_file(request, test::test_out(name + "_baked.glb"), diagnostics));
  return diagnostics;
}

/// glTF node of the n-th control in a role, or of the n-th joint of the skeleton where the role is
/// empty.
int node_in_role(const gltf::Rig& rig, const std::string& role, int n = 0) {
  for (scene::NodeId id : rig.scene.nodes()) {
    const scene::Node& node = rig.scene[id];
    const bool fits = role.empty() ? node.is_skeleton() : node.identity.role == role;
    if (fits && n-- == 0) return rig.nodes[id.index];
  }
  FAIL("no node in role " << role);
  return -1;
}

}  // namespace

TEST_CASE("pipeline codes: a model with two skeletons asks which one") {
  const std::string model = test::corpus_file("mixamo_Xbot_blender/Xbot.glb");
  if (model.empty()) return;
  test::Character twice = test::load_glb(model);
  const std::size_t count = twice.json["nodes"].size();
  const auto shift = [&](nlohmann::ordered_json& index) {
    index = index.get<std::size_t>() + count;
  };
  for (std::size_t i = 0; i < count; ++i) {
    auto copy = twice.json["nodes"][i];
    if (copy.contains("children"))
      for (auto& child : copy["children"]) shift(child);
    if (copy.contains("skin")) copy["skin"] = 1;
    twice.json["nodes"].push_back(copy);
  }
  auto skin = twice.json["skins"][0];
  for (auto& joint : skin["joints"]) shift(joint);
  twice.json["skins"].push_back(skin);
  auto root = twice.json["scenes"][0]["nodes"][0];
  shift(root);
  twice.json["scenes"][0]["nodes"].push_back(root);
  const std::string path = test::test_out("two_skeletons.glb"),
                    out = test::test_out("two_skeletons_rig.glb");
  test::save_glb(twice, path);
  std::remove(out.c_str());
  test::made_from(path, path);  // an input: it may have what it has
  test::made_from(out, path);

  pipeline::BuildRequest request = request_of("biped.yaml");
  request.model = path;
  Diagnostics diagnostics;
  CHECK_FALSE(pipeline::build(request, out, diagnostics));
  CHECK(numbers(diagnostics) == std::vector<int>{751});
  CHECK_FALSE(file_exists(out));

  // Named, it is rigged, and the other one after it, side by side.
  for (const char* skeleton : {"mixamorig:Hips", "136"}) {
    Diagnostics named;
    request.skeleton = skeleton;
    REQUIRE_MESSAGE(pipeline::build(request, out, named), render(named, false));
    request.model = out;
    request.global = "second";
  }
  const auto file = gltf::open(out, diagnostics);
  REQUIRE(file);
  const auto rigs = gltf::read_rigs(*file, diagnostics);
  REQUIRE(rigs);
  REQUIRE(rigs->size() == 2);
  CHECK((*rigs)[1].id == 1);
  CHECK((*rigs)[1].skeleton.global == "second");
}

TEST_CASE("pipeline codes: a clip that moves controls and what they drive") {
  const Diagnostics diagnostics = bake_with("prop.yaml", "codes_foreign", [](const gltf::Rig& rig) {
    std::vector<anim::Channel> channels;
    channels.push_back(constant(node_in_role(rig, "world"), anim::Path::translation, {1, 0, 0}));
    for (int joint = 0; joint < 3; ++joint) {
      channels.push_back(
          constant(node_in_role(rig, "", joint), anim::Path::translation, {0, 1, 0}));
    }
    return channels;
  });
  CHECK(numbers(diagnostics) == std::vector<int>{756});
}

TEST_CASE(
    "pipeline codes: what a bake put on the joints of a kept rig is rigc's own to the next bake") {
  const auto move = [](const gltf::Rig& rig) {
    return std::vector<anim::Channel>{
        constant(node_in_role(rig, "world"), anim::Path::translation, {1, 0, 0})};
  };
  const Diagnostics first = bake_with("prop.yaml", "codes_own", move);
  CHECK(numbers(first).empty());
  pipeline::BakeRequest request;
  request.file = test::test_out("codes_own_keyed.glb");
  request.keep_rig = true;
  const std::string kept = test::test_out("codes_own_kept.glb"),
                    again = test::test_out("codes_own_again.glb");
  Diagnostics diagnostics;
  REQUIRE(pipeline::bake_file(request, kept, diagnostics));
  request.file = kept;
  REQUIRE(pipeline::bake_file(request, again, diagnostics));
  CHECK(numbers(diagnostics).empty());
  const auto worlds = test::play(kept, "test", 0), same = test::play(again, "test", 0);
  REQUIRE(worlds.size() == same.size());
  for (std::size_t i = 0; i < worlds.size(); ++i) CHECK(worlds[i] == same[i]);
}

TEST_CASE("pipeline codes: a joint under an unevenly scaled node that somebody put in is sheared") {
  const auto turn = [](const gltf::Rig& rig) {
    return std::vector<anim::Channel>{constant(node_in_role(rig, "fk", 1), anim::Path::rotation,
                                               {0, 0, 0.38268343f, 0.9238795f})};
  };
  const auto put_between = [](nlohmann::ordered_json& json, const gltf::Rig& rig) {
    const int parent = node_in_role(rig, "", 0), child = node_in_role(rig, "", 1);
    auto& children = json["nodes"][static_cast<std::size_t>(parent)]["children"];
    for (auto& node : children) {
      if (node == child) node = json["nodes"].size();
    }
    json["nodes"].push_back({{"name", "squash"}, {"scale", {1, 3, 1}}, {"children", {child}}});
  };
  const Diagnostics diagnostics =
      bake_with("tutorial/04_chains.yaml", "codes_shear", turn, put_between);
  CHECK(numbers(diagnostics) == std::vector<int>{758});
}

}  // namespace rigc
