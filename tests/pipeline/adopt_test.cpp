// SPDX-License-Identifier: MIT
// Adopt: edits made where extensions are dropped come back by identity. What such a program does to
// a file is done here in JSON; adopt_blender_test.cpp has Blender do it.
#include "pipeline/adopt.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "gltf/clips.h"
#include "pipeline/adopt_helpers.h"
#include "pipeline/bake_file.h"
#include "pipeline/build.h"
#include "support/rig.h"

namespace rigc {
namespace {

using anim::Path;
using nlohmann::ordered_json;
using test::adopt;
using test::adopted;
using test::bytes_of;
using test::clip_of;
using test::find;
using test::make_shot;
using test::near;
using test::OtherProgram;
using test::rig_of;
using test::value_at;
using test::WalkShot;

/// Farthest that a joint comes from where it was, over the clip of two files.
double largest_motion_difference(const std::string& a, const std::string& b,
                                 const std::string& clip) {
  const auto baked = [](const std::string& path) {
    Diagnostics diagnostics;
    pipeline::BakeRequest request;
    request.file = path;
    const std::string out = path.substr(0, path.size() - 4) + "_baked.glb";
    REQUIRE_MESSAGE(pipeline::bake_file(request, out, diagnostics), render(diagnostics, false));
    return out;
  };
  const std::string first = baked(a), second = baked(b);
  const std::vector<double> times = {0, 0.1, 0.25, 0.5, 0.7, 0.9};
  const auto left = test::play(first, clip, times), right = test::play(second, clip, times);
  const auto json = test::load_glb(first).json;
  double farthest = 0;
  for (const auto& skin : json["skins"])
    for (const auto& joint : skin["joints"])
      for (std::size_t i = 0; i < times.size(); ++i)
        farthest = std::max(farthest, math::length(left[i][joint.get<std::size_t>()].origin -
                                                   right[i][joint.get<std::size_t>()].origin));
  return farthest;
}

}  // namespace

TEST_CASE("adopt: a file in which nothing was edited changes no byte") {
  const WalkShot shot = make_shot("same");
  OtherProgram foreign(shot.path);
  const std::string edited = test::test_out("adopt_same_edited.glb");
  foreign.save(edited);
  const std::string out = test::test_out("adopt_same_out.glb");
  const auto report = adopted(edited, shot.path, out, true);
  REQUIRE(report.clips.size() == 1);
  CHECK(report.clips[0].name == "walk");
  CHECK_FALSE(report.clips[0].fresh);
  CHECK(report.clips[0].same == 3);
  CHECK(report.clips[0].at_rest == 3);
  CHECK(report.clips[0].kept == 1);
  CHECK(report.clips[0].changed + report.clips[0].added == 0);
  CHECK(report.transforms + report.attributes + report.joints == 0);
  CHECK(bytes_of(out) == bytes_of(shot.path));
}

TEST_CASE("adopt: keys, clips, transforms and attributes arrive, the rest stays") {
  const WalkShot shot = make_shot("edit");
  OtherProgram foreign(shot.path);
  ordered_json& json = foreign.json();
  // Unkeyed: a control moved, an attribute set; a control that is keyed stands where its clip is.
  foreign.node(shot, shot.free)["translation"] = {0.1, 0.2, 0.3};
  foreign.node(shot, shot.settings)["extras"]["ik_fk"] = 0.25;
  foreign.node(shot, shot.body)["translation"] = {9, 9, 9};
  // Keys: the body's path at frame 6. A new clip that only turns the hand, and has the rest.
  ordered_json& walk = json["animations"][0];
  walk["name"] = "walk.001";
  const int body = foreign.index(foreign.node(shot, shot.body));
  for (const ordered_json& channel : walk["channels"]) {
    if (channel["target"]["node"] != body || channel["target"]["path"] != "translation") continue;
    ordered_json& sampler = walk["samplers"][channel["sampler"].get<std::size_t>()];
    auto values = foreign.floats(json["accessors"][sampler["output"].get<std::size_t>()]);
    values[6 * 3 + 1] += 0.5f;
    const int output = foreign.add_accessor("VEC3", values, values.size() / 3);
    sampler["output"] = output;
  }
  const int hand = foreign.index(foreign.node(shot, shot.hand));
  const int times = foreign.add_accessor("SCALAR", {0, 1}, 2);
  const int turn = foreign.add_accessor("VEC4", {0, 0, 0, 1, 0.6f, 0, 0, 0.8f}, 2);
  const int scale = foreign.add_accessor("VEC3", {1, 1, 1, 1, 1, 1}, 2);
  json["animations"].push_back(
      {{"name", "wave"},
       {"channels",
        {{{"sampler", 0}, {"target", {{"node", hand}, {"path", "rotation"}}}},
         {{"sampler", 1}, {"target", {{"node", hand}, {"path", "scale"}}}}}},
       {"samplers",
        {{{"input", times}, {"output", turn}}, {{"input", times}, {"output", scale}}}}});
  const std::string edited = test::test_out("adopt_edit_edited.glb");
  foreign.save(edited);
  const std::string out = test::test_out("adopt_edit_out.glb");
  const auto report = adopted(edited, shot.path, out);
  CHECK(report.transforms == 1);
  CHECK(report.attributes == 1);
  REQUIRE(report.clips.size() == 2);
  CHECK(report.clips[0].name == "walk");
  CHECK(report.clips[0].changed == 1);
  CHECK(report.clips[0].same == 2);
  CHECK(report.clips[1].fresh);
  CHECK(report.clips[1].added == 1);
  CHECK(report.clips[1].at_rest == 1);

  const anim::Clip before = clip_of(shot.path, "walk"), after = clip_of(out, "walk");
  CHECK(after.channels.size() == before.channels.size());
  CHECK(near(value_at(after, shot.body, Path::translation, 0.25), {0.05, 0.525, 0}, 1e-4));
  CHECK(find(after, shot.hand, Path::translation)->curve.interpolation ==
        anim::Interpolation::step);
  CHECK(find(after, shot.settings, Path::attribute)->curve.values ==
        find(before, shot.settings, Path::attribute)->curve.values);
  CHECK(find(after, shot.body, Path::rotation)->curve.values ==
        find(before, shot.body, Path::rotation)->curve.values);
  CHECK(near(value_at(clip_of(out, "wave"), shot.hand, Path::rotation, 1), {0.6, 0, 0, 0.8}, 1e-6));
  CHECK(clip_of(out, "wave").channels.size() == 1);

  const auto there = test::load_glb(shot.path).json, here = test::load_glb(out).json;
  CHECK(here["extensions"]["RIGC_rig"] == there["extensions"]["RIGC_rig"]);
  const auto node = [&](int index) { return here["nodes"][static_cast<std::size_t>(index)]; };
  CHECK(near(node(shot.free)["translation"], {0.1, 0.2, 0.3}, 1e-6));
  CHECK(node(shot.settings)["extras"]["ik_fk"] == 0.25);
  CHECK_FALSE(node(shot.body).contains("translation"));
  // What nobody touched is as it was: all nodes but two.
  std::size_t different = 0;
  for (std::size_t i = 0; i < here["nodes"].size(); ++i)
    different += here["nodes"][i] != there["nodes"][i] ? 1 : 0;
  CHECK(different == 2);
}

TEST_CASE("adopt: placements of joints go into the tags and the joints' nodes") {
  const WalkShot shot = make_shot("joints");
  const gltf::Rig before = rig_of(shot.path);
  const auto joint_of = [&](const gltf::Rig& rig, const std::string& local,
                            const std::string& label) {
    for (std::size_t i = 0; i < rig.skeleton.joints.size(); ++i) {
      const Identifiers& ids = rig.skeleton.joints[i].ids;
      if (ids.local == local && ids.label == label) return i;
    }
    FAIL("no joint");
    return std::size_t{0};
  };
  // A joint without a skin: of others the bind pose counts, which is not as easily edited here.
  OtherProgram foreign(shot.path);
  foreign.json().erase("skins");
  for (ordered_json& node : foreign.json()["nodes"]) {
    node.erase("skin");
    node.erase("mesh");
  }
  test::Character bare = test::load_glb(shot.path);
  bare.json.erase("skins");
  for (ordered_json& node : bare.json["nodes"])
    if (node.erase("skin") != 0) node.erase("mesh");
  const std::string original = test::test_out("adopt_joints_bare.glb");
  test::save_glb(bare, original);
  const std::size_t elbow = joint_of(before, "arm_l", "elbow");
  int node = -1;
  for (const scene::NodeId id : before.scene.nodes())
    if (before.scene[id].is_skeleton() &&
        before.scene[id].identity.owner == before.skeleton.joints[elbow].key)
      node = before.nodes[id.index];
  ordered_json& edited_node = foreign.node(shot, node);
  const math::Trs rest = before.skeleton.joints[elbow].rest;
  edited_node["translation"] = {rest.translation.x, rest.translation.y + 0.05, rest.translation.z};
  const std::string edited = test::test_out("adopt_joints_edited.glb");
  foreign.save(edited);
  const std::string out = test::test_out("adopt_joints_out.glb");
  CHECK(adopted(edited, original, out, false).joints == 0);
  CHECK(rig_of(out).skeleton.joints[elbow].rest == rest);
  const auto report = adopted(edited, original, out, true);
  CHECK(report.joints == 1);
  const gltf::Rig after = rig_of(out);
  for (std::size_t i = 0; i < after.skeleton.joints.size(); ++i) {
    if (i == elbow) continue;
    CHECK(after.skeleton.joints[i].rest == before.skeleton.joints[i].rest);
  }
  const math::Trs now = after.skeleton.joints[elbow].rest;
  CHECK(math::length(now.translation - rest.translation - math::Vec3{0, 0.05, 0}) < 1e-6);
  const auto json = test::load_glb(out).json;
  CHECK(std::abs(json["nodes"][static_cast<std::size_t>(node)]["translation"][1].get<double>() -
                 now.translation.y) < 1e-6);
}

TEST_CASE("adopt: copies, strangers, files that say nothing, and clips that are not there") {
  const WalkShot shot = make_shot("errors");
  const std::string out = test::test_out("adopt_errors_out.glb");
  const std::string edited = test::test_out("adopt_errors_edited.glb");
  std::remove(out.c_str());
  const auto codes_of = [&](const OtherProgram& foreign,
                            const std::vector<std::string>& clips = {}) {
    foreign.save(edited);
    Diagnostics diagnostics;
    adopt(edited, shot.path, out, diagnostics, false, clips);
    return test::codes(diagnostics);
  };
  OtherProgram silent(shot.path);
  for (ordered_json& node : silent.json()["nodes"]) node.erase("extras");
  CHECK(codes_of(silent) == "RIG0852");
  OtherProgram strangers(shot.path);
  for (ordered_json& node : strangers.json()["nodes"])
    if (node.contains("extras") && node["extras"].contains("rigc"))
      node["extras"]["rigc"] = "7" + node["extras"]["rigc"].get<std::string>().substr(1);
  CHECK(codes_of(strangers) == "RIG0852");
  OtherProgram copies(shot.path);
  copies.node(shot, shot.body)["extras"] = copies.node(shot, shot.free)["extras"];
  CHECK(codes_of(copies) == "RIG0853");
  OtherProgram clip(shot.path);
  CHECK(codes_of(clip, {"run"}) == "RIG0755");
  CHECK_FALSE(file_exists(out));
  OtherProgram stranger(shot.path);
  stranger.node(shot, shot.body)["extras"]["rigc"] = "0:0123456789abcdef";
  CHECK(codes_of(stranger) == "RIG0854");
  CHECK(file_exists(out));

  test::Character plain = test::load_glb(shot.path);
  plain.json.erase("extensions");
  plain.json.erase("extensionsUsed");
  plain.json.erase("animations");
  const std::string rigless = test::test_out("adopt_errors_rigless.glb");
  test::save_glb(plain, rigless);
  Diagnostics diagnostics;
  CHECK_FALSE(adopt(edited, rigless, out, diagnostics));
  CHECK(test::codes(diagnostics) == "RIG0754");
}

TEST_CASE("adopt: where nothing was edited the joints move as before") {
  const WalkShot shot = make_shot("motion");
  OtherProgram foreign(shot.path);
  foreign.node(shot, shot.settings)["extras"]["ik_fk"] = 0.25;  // keyed: no effect in the clip
  const std::string edited = test::test_out("adopt_motion_edited.glb");
  foreign.save(edited);
  const std::string out = test::test_out("adopt_motion_out.glb");
  CHECK(adopted(edited, shot.path, out).attributes == 1);
  const double height = rig_of(shot.path).skeleton.character.height;
  CHECK(largest_motion_difference(shot.path, out, "walk") <= 1e-3 * height);
}

TEST_CASE("adopt: keys on attributes that the other program kept, and only the clips asked for") {
  const WalkShot shot = make_shot("pointer");
  Diagnostics diagnostics;
  const auto file = gltf::open(shot.path, diagnostics);
  REQUIRE(file);
  gltf::Patch patch(*file);
  anim::Clip walk = clip_of(shot.path, "walk"), run{"run", -1, {}};
  for (anim::Channel& channel : walk.channels)
    if (channel.path == Path::attribute) channel.curve.values = {0.75f, 0.25f};
  run.channels = {*find(walk, shot.body, Path::translation)};
  gltf::write_clips(patch, *file, {{walk, {}}, {run, {}}});
  const std::string edited = test::test_out("adopt_pointer_edited.glb");
  std::uint64_t bytes = 0;
  REQUIRE(pipeline::write_output(patch, *file, edited, bytes, diagnostics));

  const std::string out = test::test_out("adopt_pointer_out.glb");
  auto report = adopt(edited, shot.path, out, diagnostics, false, {"run"});
  REQUIRE(report);
  REQUIRE(report->clips.size() == 1);
  CHECK(report->clips[0].fresh);
  CHECK(clip_of(out, "run").channels.size() == 1);
  CHECK(value_at(clip_of(out, "walk"), shot.settings, Path::attribute, 1)[0] == 0.5);
  report = adopt(edited, shot.path, out, diagnostics);
  REQUIRE(report);
  REQUIRE(report->clips.size() == 2);
  CHECK(report->clips[0].changed == 1);
  CHECK(report->clips[0].same == 3);
  CHECK(value_at(clip_of(out, "walk"), shot.settings, Path::attribute, 1)[0] == 0.25);
}

TEST_CASE("adopt: a character that is bound elsewhere as a whole has no edited joints") {
  const WalkShot shot = make_shot("bind");
  OtherProgram foreign(shot.path);
  foreign.move_bind({math::matrix(math::from_euler_degrees({10, 20, 30})), {0.5, 1, 2}});
  const std::string edited = test::test_out("adopt_bind_edited.glb");
  foreign.save(edited);
  CHECK(adopted(edited, shot.path, test::test_out("adopt_bind_out.glb"), true).joints == 0);
}

}  // namespace rigc
