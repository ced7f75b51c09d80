// SPDX-License-Identifier: MIT
// Features of the quadruped that the biped has too, on the bare template and on the creatures of
// the corpus: hips and knees that go along with legs, gimbals, heads that follow, tails that curl.
#include <doctest/doctest.h>

#include "eval/evaluate.h"
#include "pipeline/build.h"
#include "pipeline/character_helpers.h"

namespace rigc {
namespace {

using math::Affine;
using math::Vec3;
using scene::NodeId;

struct Animal {
  std::string name, model, map;
};

/// The bare template, and what the corpus has.
std::vector<Animal> animals() {
  std::vector<Animal> found{{"bare", "", ""}};
  for (const auto& [file, map] :
       {std::pair{"khronos_Fox/Fox.glb", "fox"}, std::pair{"godot_enemy/enemy.glb", "enemy"}}) {
    const std::string model = test::corpus_file(file);
    if (!model.empty())
      found.push_back({map, model, std::string(RIGC_SOURCE_DIR) + "/tests/maps/" + map + ".yaml"});
  }
  return found;
}

gltf::Rig build(const Animal& animal,
                const std::vector<std::string>& features = {"auto_hip=on", "gimbal=on"}) {
  pipeline::BuildRequest request;
  request.template_file = test::templates_folder() + "/quadruped.yaml";
  request.paths.templates = {test::templates_folder()};
  request.model = animal.model;
  request.map = animal.map;
  request.features = features;
  Diagnostics diagnostics;
  const std::string out = test::test_out("quadruped_" + animal.name + ".glb");
  const auto built = pipeline::build(request, out, diagnostics);
  REQUIRE_MESSAGE(built, render(diagnostics, false));
  if (!animal.model.empty()) test::made_from(out, animal.model);
  return built->rig;
}

template <class Is>
std::vector<NodeId> nodes(const gltf::Rig& rig, Is is) {
  std::vector<NodeId> found;
  for (const NodeId id : rig.scene.nodes())
    if (is(rig.scene[id])) found.push_back(id);
  return found;
}

NodeId joint_of(const gltf::Rig& rig, const scene::Node& made) {
  return nodes(rig,
               [&](const scene::Node& node) {
                 return node.is_skeleton() && node.identity.owner == made.identity.owner;
               })
      .at(0);
}

/// What makes a joint of a pose from the joint at rest.
Affine motion(const gltf::Rig& rig, NodeId joint, const std::vector<eval::Setting>& settings) {
  return eval::worlds(rig.scene, {joint}, settings)[0] * math::inverse(rig.scene.rest_world(joint));
}

/// The first control of a group that a command made in a role.
NodeId control_of(const gltf::Rig& rig, const std::string& group, const std::string& command,
                  const std::string& role = "control") {
  return nodes(rig,
               [&](const scene::Node& node) {
                 return node.kind == scene::Kind::control && node.ids.local == group &&
                        node.identity.command == command && node.identity.role == role;
               })
      .at(0);
}

/// Where a hind leg stands.
NodeId paw_of(const gltf::Rig& rig, const std::string& leg) { return control_of(rig, leg, "paw"); }

scene::Plug plug(const gltf::Rig& rig, NodeId node, const std::string& attribute) {
  const auto found = rig.scene.find_plug(node, attribute);
  REQUIRE(found);
  return *found;
}

/// A paw high before the animal.
eval::Setting lifted(const gltf::Rig& rig, const std::string& leg) {
  const NodeId paw = paw_of(rig, leg);
  const tags::Character& character = rig.skeleton.character;
  const Vec3 way = (character.forward + character.up * 0.6) * (0.5 * character.height);
  const Affine inward = math::inverse(rig.scene.rest_world(rig.scene[paw].parent));
  return {{paw, scene::transform::kTranslate}, inward.linear * way};
}

}  // namespace

TEST_CASE("pipeline quadruped: hips go along with the hind leg that is lifted") {
  for (const Animal& animal : animals()) {
    CAPTURE(animal.name);
    const gltf::Rig rig = build(animal);
    const tags::Character& character = rig.skeleton.character;
    const auto made = nodes(rig, [](const scene::Node& node) {
      return node.module == "auto_hip" && node.identity.role == "tweak";
    });
    REQUIRE(made.size() == 1);
    const NodeId hips = joint_of(rig, rig.scene[made[0]]);
    const auto tilted = [&](const std::vector<eval::Setting>& settings) {
      const Vec3 left = motion(rig, hips, settings).linear * character.left;
      return Vec3{math::dot(left, character.left), math::dot(left, character.up),
                  math::dot(left, character.forward)};
    };
    CHECK(math::length(tilted({}) - Vec3{1, 0, 0}) < 1e-9);
    const Vec3 left = tilted({lifted(rig, "hind_l")}), right = tilted({lifted(rig, "hind_r")});
    CHECK(left.y > 0.02);
    CHECK(left.z > 0.02);
    CHECK(right.y < -0.02);
    CHECK(right.z < -0.02);
    const auto controls = nodes(rig, [](const scene::Node& node) {
      return !node.user.empty() && node.user[0].name == "auto_hip";
    });
    REQUIRE(controls.size() == 1);
    const scene::Plug amount = *rig.scene.find_plug(controls[0], "auto_hip");
    CHECK(math::length(tilted({lifted(rig, "hind_l"), {amount, 0.0}}) - Vec3{1, 0, 0}) < 1e-9);
  }
}

TEST_CASE("pipeline quadruped: gimbals turn the head and the first bones of the legs in FK") {
  for (const Animal& animal : animals()) {
    CAPTURE(animal.name);
    const gltf::Rig rig = build(animal);
    std::vector<eval::Setting> fk;
    for (const NodeId id : rig.scene.nodes())
      if (const auto plug = rig.scene.find_plug(id, "ik_fk")) fk.push_back({*plug, 0.0});
    const auto gimbals = nodes(rig, [](const scene::Node& node) {
      return node.module == "gimbal" && node.kind == scene::Kind::control;
    });
    CHECK(gimbals.size() == 5);
    for (const NodeId gimbal : gimbals) {
      CAPTURE(rig.scene[gimbal].name);
      const NodeId joint = joint_of(rig, rig.scene[gimbal]);
      const auto turn = math::axis_angle({0, 1, 0}, math::radians(30));
      std::vector<eval::Setting> settings = fk;
      settings.push_back({{gimbal, scene::transform::kRotation}, turn});
      const Vec3 axis = math::normalised(rig.scene.rest_world(gimbal).linear * Vec3{0, 1, 0});
      const math::Mat3 expected = math::matrix(math::axis_angle(axis, math::radians(30)));
      const math::Mat3 turned = motion(rig, joint, settings).linear;
      CHECK(math::length(turned.x - expected.x) < 1e-6);
      CHECK(math::length(turned.y - expected.y) < 1e-6);
      CHECK(math::length(turned.z - expected.z) < 1e-6);
    }
  }
}

TEST_CASE("pipeline quadruped: knees go along with their legs, about the hip") {
  for (const Animal& animal : animals()) {
    CAPTURE(animal.name);
    const gltf::Rig rig = build(animal);
    for (const std::string leg : {"hind_l", "hind_r"}) {
      const NodeId ik = control_of(rig, leg, "limb", "ik");
      const NodeId pole = control_of(rig, leg, "limb", "pole");
      const NodeId hip = joint_of(rig, rig.scene[control_of(rig, leg, "limb", "fk")]);
      const auto away = [&](const std::vector<eval::Setting>& settings) {
        const auto worlds = eval::worlds(rig.scene, {pole, hip}, settings);
        return math::length(worlds[0].origin - worlds[1].origin) / rig.skeleton.character.height;
      };
      const eval::Setting lift = lifted(rig, leg);
      const scene::Plug amount = plug(rig, ik, "auto_pole");
      CHECK(std::abs(away({lift, {amount, 1.0}}) - away({})) < 1e-6);
      CHECK(std::abs(away({lift, {amount, 0.0}}) - away({})) > 0.01);
    }
  }
}

TEST_CASE("pipeline quadruped: the head follows neck, body or world") {
  for (const Animal& animal : animals()) {
    CAPTURE(animal.name);
    const gltf::Rig rig = build(animal);
    const auto heads = nodes(rig, [](const scene::Node& node) {
      return !node.user.empty() && node.user[0].name == "follow";
    });
    if (heads.empty()) continue;
    const NodeId body = control_of(rig, "torso", "body");
    const auto turn = math::axis_angle(math::normalised(Vec3{0.3, 1, 0.2}), math::radians(40));
    const auto turned = [&](double follow) {
      const math::Mat3 m = motion(rig, heads[0],
                                  {{{body, scene::transform::kRotation}, turn},
                                   {plug(rig, heads[0], "follow"), follow}})
                               .linear;
      return math::degrees(std::acos((m.x.x + m.y.y + m.z.z - 1) / 2));
    };
    CHECK(turned(0) == doctest::Approx(40));
    CHECK(turned(1) == doctest::Approx(40));
    CHECK(turned(2) < 1e-4);
  }
}

TEST_CASE("pipeline quadruped: a tail curls, and lies on a curve") {
  for (const Animal& animal : animals()) {
    CAPTURE(animal.name);
    const gltf::Rig rig = build(animal, {"chain=on", "strand_fk=off"});
    const auto joints = nodes(rig, [](const scene::Node& node) {
      return node.is_skeleton() && node.ids.local == "tail";
    });
    if (joints.size() < 2) continue;
    const NodeId settings = control_of(rig, "tail", "chain", "settings");
    const NodeId first = control_of(rig, "tail", "chain", "fk");
    const auto turn = math::axis_angle({0, 0, 1}, math::radians(20));
    const auto bend = [&](double falloff) {
      const std::vector<eval::Setting> keys{{{first, scene::transform::kRotation}, turn},
                                            {plug(rig, settings, "falloff"), falloff}};
      const math::Mat3 m = motion(rig, joints.back(), keys).linear;
      return math::degrees(std::acos(std::min(1.0, (m.x.x + m.y.y + m.z.z - 1) / 2)));
    };
    CHECK(bend(0) == doctest::Approx(20));
    CHECK(bend(1) == doctest::Approx(20.0 * static_cast<double>(joints.size())));
    const NodeId end = nodes(rig, [](const scene::Node& node) {
                         return node.kind == scene::Kind::control && node.ids.local == "tail" &&
                                node.identity.role == "tweak";
                       }).back();
    const Vec3 by = Vec3{0, 0.1, 0} * rig.skeleton.character.height;
    const auto place = eval::worlds(rig.scene, {joints.back()},
                                    {{{end, scene::transform::kTranslate}, by},
                                     {plug(rig, settings, "spline"), 1.0}})[0]
                           .origin;
    CHECK(math::length(place - rig.scene.rest_world(joints.back()).origin - by) <
          0.2 * math::length(by));
  }
}

}  // namespace rigc
