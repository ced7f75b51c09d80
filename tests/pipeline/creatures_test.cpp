// SPDX-License-Identifier: MIT
// The creatures of the corpus on the templates for creatures, each through a user map of
// tests/maps: what matches, that the mesh rests as it was modelled, that controls of both sides
// know each other, and what tails, paws, fingers and wings do when their controls are keyed.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>

#include "pipeline/motion_helpers.h"

namespace rigc {
namespace {

using math::Affine;
using math::Vec3;
using scene::NodeId;
using test::Pose;
using test::Rigged;

struct Creature {
  std::string file, map, template_name;
  std::size_t matched, made, untagged;  ///< joints: of the model, made by rigc, not in the template
};

const Creature kFox{"khronos_Fox/Fox.glb", "fox", "quadruped.yaml", 23, 2, 1};
const Creature kTRex{"fbx2gltf_TRex/TRex.glb", "trex", "biped_tail.yaml", 30, 0, 2};
const Creature kHand{"webxr_generic_hand_left/left.glb", "hand", "hand.yaml", 25, 0, 0};
const Creature kBat{"gdquest_bat/bat.glb", "bat", "winged.yaml", 9, 1, 4};
const Creature kEnemy{"godot_enemy/enemy.glb", "enemy", "quadruped.yaml", 11, 10, 0};

/// Empty where the corpus is absent.
Rigged rig(const Creature& creature) {
  const std::string model = test::corpus_file(creature.file);
  if (model.empty()) return {};
  return test::rig_model(model,
                         std::string(RIGC_SOURCE_DIR) + "/tests/maps/" + creature.map + ".yaml",
                         "creature_" + creature.map, creature.template_name);
}

Vec3 at_rest(const Rigged& rigged, NodeId node) { return rigged.world(node).origin; }

/// Where a joint is in a pose that was baked.
Vec3 place(const Rigged& rigged, const std::vector<Affine>& worlds, NodeId joint) {
  return worlds[static_cast<std::size_t>(rigged.gltf_node(joint))].origin;
}

/// Joints of a group, as the template orders them.
std::vector<NodeId> joints(const Rigged& rigged, const std::string& local) {
  std::vector<NodeId> found;
  for (const tags::TaggedJoint& joint : rigged.rig->skeleton.joints)
    if (joint.ids.local == local) found.push_back(rigged.joint(joint.key));
  REQUIRE_MESSAGE(!found.empty(), "no joints in group " << local);
  return found;
}

NodeId joint(const Rigged& rigged, const std::string& local, const std::string& label) {
  for (const tags::TaggedJoint& tagged : rigged.rig->skeleton.joints)
    if (tagged.ids.local == local && tagged.ids.label == label) return rigged.joint(tagged.key);
  FAIL("no joint " << local << "." << label);
  return {};
}

/// The control of a command, by its id.
NodeId control(const Rigged& rigged, const std::string& local, const std::string& id) {
  for (const NodeId node : rigged.controls(local, "control"))
    if (rigged.scene()[node].identity.command == id) return node;
  FAIL("no control " << id << " of group " << local);
  return {};
}

test::Key attribute_of(const Rigged& rigged, NodeId node, const std::string& name, float value) {
  return {rigged.gltf_node(node), anim::Path::attribute, name, {value}, {0}};
}

NodeId opposite_of(const Rigged& rigged, NodeId node) {
  const auto& value = rigged.scene().value({node, scene::control::kOpposite});
  const std::string& text = std::get<std::string>(value);
  for (const NodeId other : rigged.scene().nodes())
    if (!text.empty() && to_text(rigged.scene()[other].identity) == text) return other;
  return {};
}

Vec3 column(const Affine& world, int axis) {
  const math::Mat3& m = world.linear;
  return axis == 0 ? m.x : axis == 1 ? m.y : m.z;
}

Vec3 reflected(const Rigged& rigged, Vec3 v) {
  return v - rigged.axes.x * (2 * math::dot(rigged.axes.x, v));
}

/// A joint's world at rest times its inverse bind matrix is the mesh's placement, the same for all
/// joints: checked on the file alone. Gives the largest difference from the first joint's, in
/// lengths of the figure.
double worst_bind_error(const Rigged& rigged, const std::vector<Affine>& worlds) {
  const test::Character file = test::load_character(rigged.model);
  const auto& skin = file.json["skins"][0];
  const auto& accessor = file.json["accessors"][skin["inverseBindMatrices"].get<std::size_t>()];
  const auto& view = file.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  const std::size_t start =
      view.value("byteOffset", std::size_t{0}) + accessor.value("byteOffset", std::size_t{0});
  std::vector<bool> tagged(worlds.size(), false);
  for (const tags::TaggedJoint& joint : rigged.rig->skeleton.joints)
    if (joint.foreign_node >= 0 && !joint.ids.local.empty())
      tagged[static_cast<std::size_t>(joint.foreign_node)] = true;
  std::vector<std::pair<Affine, Vec3>> placements;  // and where the joint is in the mesh's space
  for (std::size_t i = 0; i < skin["joints"].size(); ++i) {
    const auto node = skin["joints"][i].get<std::size_t>();
    if (!tagged[node]) continue;
    float m[16];
    std::memcpy(m, file.bin.data() + start + i * 64, 64);
    const Affine inverse_bind{{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}},
                              {m[12], m[13], m[14]}};
    placements.emplace_back(worlds[node] * inverse_bind, math::inverse(inverse_bind).origin);
  }
  REQUIRE(placements.size() >= 9);
  double worst = 0;
  for (const auto& [placement, unused] : placements)
    for (const auto& [other, point] : placements)
      worst = std::max(worst, math::length(placement * point - placements[0].first * point));
  return worst / rigged.height;
}

}  // namespace

TEST_CASE("pipeline creatures: each matches what its map says and rests as it was modelled") {
  for (const Creature& creature : {kFox, kTRex, kHand, kBat, kEnemy}) {
    CAPTURE(creature.file);
    const Rigged rigged = rig(creature);
    if (!rigged.rig) continue;
    std::size_t matched = 0, made = 0, untagged = 0;
    for (const tags::TaggedJoint& joint : rigged.rig->skeleton.joints)
      ++(joint.foreign_node < 0 ? made : joint.ids.local.empty() ? untagged : matched);
    CHECK(matched == creature.matched);
    CHECK(made == creature.made);
    CHECK(untagged == creature.untagged);

    const NodeId root = rigged.control("root", "world");
    const auto worlds = test::bake_poses(
        rigged,
        {{rigged.move_to(root, at_rest(rigged, root))},
         {rigged.move_to(root, at_rest(rigged, root) + rigged.axes.y * rigged.height)}},
        "creature_rest")[0];
    double worst = 0;
    for (const tags::TaggedJoint& joint : rigged.rig->skeleton.joints) {
      if (joint.ids.local.empty()) continue;
      const NodeId node = rigged.joint(joint.key);
      worst = std::max(worst, math::length(place(rigged, worlds, node) - at_rest(rigged, node)));
    }
    CHECK(worst <= 1e-5 * rigged.height);
    CHECK(worst_bind_error(rigged, worlds) <= 1e-4);
  }
}

TEST_CASE("pipeline creatures: controls of the left know those of the right, and back") {
  for (const Creature& creature : {kFox, kTRex, kBat, kEnemy}) {
    CAPTURE(creature.file);
    const Rigged rigged = rig(creature);
    if (!rigged.rig) continue;
    std::size_t pairs = 0;
    for (const NodeId node : rigged.scene().nodes()) {
      const std::string& local = rigged.scene()[node].ids.local;
      if (rigged.scene()[node].kind != scene::Kind::control ||
          local.find("_l") == std::string::npos)
        continue;
      CAPTURE(rigged.scene()[node].name);
      const NodeId other = opposite_of(rigged, node);
      REQUIRE(other.valid());
      CHECK(opposite_of(rigged, other) == node);
      const Vec3 image = reflected(rigged, at_rest(rigged, node));
      CHECK(math::length(image - at_rest(rigged, other)) <= 0.06 * rigged.height);
      ++pairs;
    }
    CHECK(pairs >= 4);
  }
}

TEST_CASE("pipeline creatures: a tail bends behind the control that is turned") {
  for (const Creature& creature : {kFox, kTRex}) {
    CAPTURE(creature.file);
    const Rigged rigged = rig(creature);
    if (!rigged.rig) continue;
    const std::vector<NodeId> tail = joints(rigged, "tail");
    const std::vector<NodeId> fk = rigged.controls("tail", "fk");
    REQUIRE(tail.size() == fk.size());
    const math::Quat turn = rigged.turn_about({1, 0, 0}, 0.6);
    const auto worlds = test::bake_poses(rigged, {{rigged.turn_by(fk[1], turn)}},
                                         "creature_tail_" + creature.map)[0];
    const Vec3 pivot = at_rest(rigged, tail[1]);
    for (std::size_t i = 0; i < tail.size(); ++i) {
      const Vec3 rest = at_rest(rigged, tail[i]);
      const Vec3 expected = i < 2 ? rest : pivot + math::rotate(turn, rest - pivot);
      CHECK(math::length(place(rigged, worlds, tail[i]) - expected) <= 1e-5 * rigged.height);
      if (i >= 2) CHECK(math::length(expected - rest) > 0.01 * rigged.height);
    }
  }
}

TEST_CASE("pipeline creatures: paws stand where their controls are, lift their heels and have FK") {
  for (const Creature& creature : {kFox, kEnemy}) {
    CAPTURE(creature.file);
    const Rigged rigged = rig(creature);
    if (!rigged.rig) continue;
    const double near = 1e-5 * rigged.height;
    for (const std::string group : {"front_l", "front_r", "hind_l", "hind_r"}) {
      CAPTURE(group);
      const bool front = group.starts_with("front");
      const NodeId paw = joint(rigged, group, "paw");
      const NodeId heel = joint(rigged, group, front ? "wrist" : "hock");
      const NodeId top = joint(rigged, group, front ? "shoulder" : "hip");
      const Vec3 rest = at_rest(rigged, paw), heel_rest = at_rest(rigged, heel);
      const Vec3 step =
          rest + rigged.axes * Vec3{0.01, 0.04, 0.06} * (math::length(at_rest(rigged, top) - rest));
      const math::Quat raise = rigged.turn_about({1, 0, 0}, 0.3);
      const math::Quat swing = rigged.turn_about({1, 0, 0}, -0.4);
      const auto worlds = test::bake_poses(
          rigged,
          {{rigged.move_to(control(rigged, group, "paw"), step)},
           {rigged.turn_by(control(rigged, group, "lift"), raise)},
           {rigged.switch_to(group, 0), rigged.turn_by(rigged.controls(group, "fk")[0], swing)},
           {rigged.turn_by(control(rigged, group, "toes"), raise)}},
          "creature_paw_" + creature.map);
      CHECK(math::length(place(rigged, worlds[0], paw) - step) <= near);

      const Vec3 lifted = rest + math::rotate(raise, heel_rest - rest);
      CHECK(math::length(place(rigged, worlds[1], paw) - rest) <= near);
      CHECK(math::length(place(rigged, worlds[1], heel) - lifted) <= near);
      CHECK(math::length(lifted - heel_rest) > 0.01 * rigged.height);
      const auto paw_node = static_cast<std::size_t>(rigged.gltf_node(paw));
      for (int axis = 0; axis < 3; ++axis) {  // the sole stays on the ground
        const Vec3 now = math::normalised(column(worlds[1][paw_node], axis));
        const Vec3 before = math::normalised(column(rigged.world(paw), axis));
        CHECK(math::length(now - before) <= 1e-4);
      }

      const Vec3 pivot = at_rest(rigged, top);
      const Vec3 swung = pivot + math::rotate(swing, rest - pivot);
      CHECK(math::length(place(rigged, worlds[2], paw) - swung) <= near);

      CHECK(math::length(place(rigged, worlds[3], paw) - rest) <= near);
      const Vec3 bent = math::normalised(worlds[3][paw_node].linear.z);
      const Vec3 wanted = math::rotate(raise, math::normalised(rigged.world(paw).linear.z));
      CHECK(math::length(bent - wanted) <= 1e-4);
    }
  }
}

TEST_CASE("pipeline creatures: feet that do not hang under the legs stay while the body sinks") {
  const Rigged rigged = rig(kTRex);
  if (!rigged.rig) return;
  const NodeId body = control(rigged, "torso", "body");
  const Vec3 sink = rigged.axes * Vec3{0, -0.04, 0.02} * rigged.height;
  const NodeId ik = rigged.controls("leg_l", "ik")[0];
  const Vec3 step = at_rest(rigged, ik) + rigged.axes * Vec3{0, 0.05, 0.1} * rigged.height;
  const auto worlds = test::bake_poses(
      rigged, {{rigged.move_to(body, at_rest(rigged, body) + sink)}, {rigged.move_to(ik, step)}},
      "creature_feet");
  const double near = 1e-5 * rigged.height;
  for (const std::string group : {"leg_l", "leg_r"}) {
    const NodeId ankle = joint(rigged, group, "ankle"), hip = joint(rigged, group, "hip");
    CHECK(math::length(place(rigged, worlds[0], ankle) - at_rest(rigged, ankle)) <= near);
    CHECK(math::length(place(rigged, worlds[0], hip) - at_rest(rigged, hip) - sink) <= near);
  }
  CHECK(math::length(place(rigged, worlds[1], joint(rigged, "leg_l", "ankle")) - step) <= near);
  const NodeId head = joint(rigged, "head", "head");
  CHECK(math::length(place(rigged, worlds[0], head) - at_rest(rigged, head) - sink) <= near);
}

TEST_CASE("pipeline creatures: fingers of a flat hand curl, and all of it follows the root") {
  const Rigged rigged = rig(kHand);
  if (!rigged.rig) return;
  const double near = 1e-5 * rigged.height;
  const std::vector<NodeId> finger = joints(rigged, "hand_index");
  const std::vector<NodeId> fk = rigged.controls("hand_index", "fk");
  REQUIRE(finger.size() == 4);  // the metacarpal too
  REQUIRE(fk.size() == 4);
  const NodeId tip = joint(rigged, "hand_index_tip", "tip");
  const math::Quat curl = rigged.turn_about({1, 0, 0}, 0.7);
  const NodeId root = rigged.control("root", "offset");
  const Vec3 travel{0.1, 0.2, -0.3};
  const math::Quat roll = rigged.turn_about({0, 1, 0}, 1);
  const Vec3 wrist = at_rest(rigged, joint(rigged, "hand", "wrist"));
  const auto worlds = test::bake_poses(
      rigged,
      {{rigged.turn_by(fk[1], curl)},
       {rigged.move_to(root, at_rest(rigged, root) + travel), rigged.turn_by(root, roll)}},
      "creature_hand");
  const Vec3 pivot = at_rest(rigged, finger[1]);
  for (std::size_t i = 0; i < finger.size(); ++i) {
    const Vec3 rest = at_rest(rigged, finger[i]);
    const Vec3 expected = i < 2 ? rest : pivot + math::rotate(curl, rest - pivot);
    CHECK(math::length(place(rigged, worlds[0], finger[i]) - expected) <= near);
  }
  for (const tags::TaggedJoint& tagged : rigged.rig->skeleton.joints) {
    if (tagged.ids.label == "tip") continue;  // nothing drives the tips of a flat hand
    CAPTURE(tagged.name);
    const NodeId node = rigged.joint(tagged.key);
    const Vec3 expected = wrist + travel + math::rotate(roll, at_rest(rigged, node) - wrist);
    CHECK(math::length(place(rigged, worlds[1], node) - expected) <= near);
  }
  CHECK(tip.valid());
}

TEST_CASE("pipeline creatures: wings rise, fold and spread, both sides as mirror images") {
  const Rigged rigged = rig(kBat);
  if (!rigged.rig) return;
  const double near = 1e-5 * rigged.height;
  const NodeId left = control(rigged, "wing_l", "control");
  const NodeId right = opposite_of(rigged, left);
  REQUIRE(right.valid());
  test::Key raise = rigged.turn_by(left, rigged.turn_about({0, 0, 1}, 0.5));
  test::Key raise_right = raise;  // the same values
  raise_right.node = rigged.gltf_node(right);
  const auto worlds = test::bake_poses(
      rigged,
      {{raise, raise_right},
       {attribute_of(rigged, left, "fold", 1), attribute_of(rigged, right, "fold", 1)},
       {attribute_of(rigged, left, "spread", 1), attribute_of(rigged, right, "spread", 1)}},
      "creature_wings");
  const NodeId shoulder = joint(rigged, "wing_l", "upper"),
               lower = joint(rigged, "wing_l", "lower");
  const NodeId hand = joint(rigged, "wing_l", "hand"), hand_r = joint(rigged, "wing_r", "hand");
  const Vec3 pivot = at_rest(rigged, shoulder), rest = at_rest(rigged, hand);
  const Vec3 raised = pivot + math::rotate(rigged.turn_about({0, 0, 1}, 0.5), rest - pivot);
  CHECK(math::length(place(rigged, worlds[0], hand) - raised) <= near);
  CHECK(math::dot(raised - rest, rigged.axes.y) > 0.1 * rigged.height);
  for (const auto& pose : worlds) {
    const Vec3 image = reflected(rigged, place(rigged, pose, hand));
    CHECK(math::length(place(rigged, pose, hand_r) - image) <= 1e-3 * rigged.height);
  }
  const auto outward = [&](const std::vector<Affine>& pose, NodeId node) {
    return math::dot(place(rigged, pose, node) - pivot, rigged.axes.x);
  };
  const auto forward = [&](const std::vector<Affine>& pose, NodeId node) {
    return math::dot(place(rigged, pose, node) - pivot, rigged.axes.z);
  };
  const double span = math::dot(rest - pivot, rigged.axes.x);
  CHECK(outward(worlds[1], hand) < 0.75 * span);
  CHECK(forward(worlds[1], lower) < -0.1 * span);
  CHECK(forward(worlds[2], hand) > 0.05 * span);
}

}  // namespace rigc
