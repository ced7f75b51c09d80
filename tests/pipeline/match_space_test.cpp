// SPDX-License-Identifier: MIT
// Controls that follow another space from a time on: nothing moves, before, then or after.
#include <doctest/doctest.h>

#include <algorithm>

#include "pipeline/build.h"
#include "pipeline/character_helpers.h"
#include "pipeline/match.h"
#include "pipeline/shot_helpers.h"

namespace rigc {
namespace {

using test::Shot;

/// Largest distance between joints of two shots at a time, rig units; of their axes in parts of 1.
double apart(const Shot& a, const Shot& b, int clip, double time) {
  const auto p = test::pose_at(a, a.rigs.front(), clip, time);
  const auto q = test::pose_at(b, b.rigs.front(), clip, time);
  double largest = 0;
  for (const auto& [key, world] : p) {
    const math::Affine& other = q.at(key);
    for (const math::Vec3& d : {world.origin - other.origin, world.linear.x - other.linear.x,
                                world.linear.y - other.linear.y, world.linear.z - other.linear.z})
      largest = std::max(largest, math::length(d));
  }
  return largest;
}

double value_at(const Shot& shot, int clip, const std::string& control, const std::string& name,
                double time) {
  const gltf::Rig& rig = shot.rigs.front();
  for (const scene::NodeId id : rig.scene.nodes()) {
    if (rig.scene[id].name != control) continue;
    for (const anim::Channel& channel : shot.clips[static_cast<std::size_t>(clip)].channels) {
      if (channel.node != rig.nodes[id.index] || channel.attribute != name) continue;
      double number = 0;
      anim::sample(channel.curve, false, time, &number);
      return number;
    }
    return rig.scene.number(*rig.scene.find_plug(id, name));
  }
  return -1;
}

std::string animated_biped(const std::string& name, const std::vector<std::string>& features = {},
                           const test::Animation& how = {2, 0.5, 0.3, 5, 0}) {
  const std::string shot = test::fresh_folder(name) + "/shot.glb";
  pipeline::BuildRequest request;
  request.template_file = test::templates_folder() + "/biped.yaml";
  request.paths.templates = {test::templates_folder()};
  request.features = features;
  Diagnostics diagnostics;
  REQUIRE(pipeline::build(request, shot, diagnostics));
  test::animate(shot, 12, how);
  return shot;
}

}  // namespace

TEST_CASE("pipeline match: a control that follows another space stays where it is") {
  const std::string shot = animated_biped("match_space"), out = test::test_out("match_space.glb");
  const Shot before = test::read_shot(shot);
  struct Change {
    std::string control, space;
    double number;
  };
  for (const Change& change :
       {Change{"arm_l_wrist_ik", "chest", 2}, Change{"arm_l_wrist_ik", "head", 3},
        Change{"arm_r_elbow_pole", "hand", 3}, Change{"arm_r_shoulder_fk", "root", 2},
        Change{"leg_l_ankle_ik", "body", 1}}) {
    CAPTURE(change.control);
    CAPTURE(change.space);
    pipeline::MatchRequest request;
    request.file = shot;
    request.controls = {change.control};
    request.space = change.space;
    request.range = "1:2";
    Diagnostics diagnostics;
    const auto done = pipeline::match_file(request, out, diagnostics);
    REQUIRE_MESSAGE(done, render(diagnostics, false));
    CHECK(diagnostics.all().empty());
    CHECK(done->clips.size() == before.clips.size());
    const Shot after = test::read_shot(out);
    for (int clip = 0; clip < static_cast<int>(before.clips.size()); ++clip) {
      CHECK(value_at(after, clip, change.control, "space", 1.5) == change.number);
      CHECK(done->clips[static_cast<std::size_t>(clip)].limbs.front().between.mm < 1.001);
      for (const double time : anim::key_times(before.clips[static_cast<std::size_t>(clip)])) {
        CAPTURE(time);
        const bool inside = time >= 1 && time <= 2;
        const double off = apart(before, after, clip, time);
        if (inside) CHECK(off < 5e-6);   // of an arm of half a metre 1e-5
        if (!inside) CHECK(off < 1e-6);  // curves are cut at floats
      }
    }
  }
}

TEST_CASE("pipeline match: limbs with gimbals, clavicles, hips and toes that go along, stay") {
  const std::string shot =
                        animated_biped("match_held", {"gimbal=on", "vector_foot=on", "auto_hip=on"},
                                       {2, 0.9, 0.3, 5, 0}),
                    out = test::test_out("match_held.glb");
  const Shot before = test::read_shot(shot);
  for (const std::string limb : {"arm_l", "arm_r", "leg_l", "leg_r"}) {
    for (const std::string to : {"ik", "fk"}) {
      CAPTURE(limb);
      CAPTURE(to);
      pipeline::MatchRequest request;
      request.file = shot;
      request.limbs = {limb};
      request.to = to;
      Diagnostics diagnostics;
      const auto done = pipeline::match_file(request, out, diagnostics);
      REQUIRE_MESSAGE(done, render(diagnostics, false));
      CHECK(render(diagnostics, false) == "");
      const Shot after = test::read_shot(out);
      for (int clip = 0; clip < static_cast<int>(before.clips.size()); ++clip) {
        for (const double time : anim::key_times(before.clips[static_cast<std::size_t>(clip)])) {
          CAPTURE(time);
          CHECK(apart(before, after, clip, time) < 5e-6);
        }
      }
    }
  }
}

TEST_CASE("pipeline match: a control is named by a selector too; what is wrong is told") {
  const std::string shot = animated_biped("match_space_bad"),
                    out = test::test_out("match_space_bad.glb");
  const auto run = [&](const std::string& control, const std::string& space) {
    pipeline::MatchRequest request;
    request.file = shot;
    if (!control.empty()) request.controls = {control};
    request.space = space;
    Diagnostics diagnostics;
    if (pipeline::match_file(request, out, diagnostics)) return std::string("done");
    REQUIRE(diagnostics.all().size() == 1);
    return std::to_string(diagnostics.all()[0].code->number) + " " + diagnostics.all()[0].hint;
  };
  CHECK(run("leg_l.ankle/ik_fk_limb#limb.ik", "body") == "done");
  CHECK(run("leg_l_ankle_ik", "chest") == "843 it can follow root, body");
  CHECK(run("leg_l_ankle_fk", "body") == "843 ");  // it has no spaces
  CHECK(run("leg_l::control", "body") == "843 ");  // many
  CHECK(run("nobody", "body") == "843 ");
  CHECK(run("leg_l_ankle_ik", "") == "841 ");
  CHECK(run("", "body") == "841 ");
}

}  // namespace rigc
