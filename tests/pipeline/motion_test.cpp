// SPDX-License-Identifier: MIT
// Keys on the controls of every rigged humanoid of the corpus bake to joints that do what they
// should, and the same world motion comes out of copies whose bone axes were turned at random,
// whose ancestors are scaled or mirrored, and which face the other way.
#include <doctest/doctest.h>

#include <algorithm>
#include <functional>

#include "pipeline/motion_helpers.h"
#include "support/corpus.h"

namespace rigc {
namespace {

using math::Affine;
using math::Vec3;
using scene::NodeId;
using test::Key;
using test::Pose;
using test::Rigged;
using Worlds = std::vector<Affine>;

const std::string kLimbs[] = {"arm_l", "arm_r", "leg_l", "leg_r"};

/// In lengths of the limb, as [outward, up, forward] of the character.
const Vec3 kReachable[] = {{0.5, 0.2, 0.4}, {0.2, -0.7, 0.1}, {0.3, 0.6, -0.2}, {0.05, -0.5, 0.3}};
const Vec3 kFar[] = {{1.5, 0.6, 1.2}, {0.3, -2, 0.4}};

/// A limb's joints and its size at rest, in the world.
struct Limb {
  std::size_t nodes[3];  ///< glTF
  Vec3 at[3];
  double length = 0;
};

Limb limb_of(const Rigged& rigged, const std::string& group) {
  const auto fk = rigged.controls(group, "fk");
  REQUIRE(fk.size() == 3);
  Limb limb;
  for (std::size_t i = 0; i < 3; ++i) {
    const NodeId joint = rigged.joint_of(fk[i]);
    limb.nodes[i] = static_cast<std::size_t>(rigged.gltf_node(joint));
    limb.at[i] = rigged.world(joint).origin;
  }
  limb.length = math::length(limb.at[1] - limb.at[0]) + math::length(limb.at[2] - limb.at[1]);
  return limb;
}

/// Every joint is as far from the one that it hangs under in the template as it was at rest.
void check_lengths(const Rigged& rigged, const Worlds& worlds) {
  double worst = 0;
  std::string where;
  for (const tags::TaggedJoint& joint : rigged.rig->skeleton.joints) {
    const tags::TaggedSkeleton& skeleton = rigged.rig->skeleton;
    const int above =
        joint.template_parent.uid != 0 ? skeleton.find(joint.template_parent) : joint.parent;
    const NodeId a = rigged.joint(joint.key);
    if (above < 0 || !rigged.is_driven(a)) continue;
    const NodeId b = rigged.joint(skeleton.joints[static_cast<std::size_t>(above)].key);
    const double rest = math::length(rigged.world(a).origin - rigged.world(b).origin);
    const double now = math::length(worlds[static_cast<std::size_t>(rigged.gltf_node(a))].origin -
                                    worlds[static_cast<std::size_t>(rigged.gltf_node(b))].origin);
    if (std::abs(now - rest) > worst) where = joint.name;
    worst = std::max(worst, std::abs(now - rest));
  }
  CAPTURE(where);
  CHECK(worst <= 2e-6 * rigged.height);
}

/// A point in a direction from the limb's start.
Vec3 goal_of(const Rigged& rigged, const std::string& group, Vec3 direction) {
  if (group.back() == 'r') direction.x = -direction.x;
  const Limb limb = limb_of(rigged, group);
  return limb.at[0] + rigged.axes * direction * limb.length;
}

/// All limbs by IK toward a direction.
Pose reaching(const Rigged& rigged, Vec3 direction) {
  Pose pose;
  for (const std::string& group : kLimbs) {
    pose.push_back(rigged.switch_to(group, 1));
    pose.push_back(
        rigged.move_to(rigged.controls(group, "ik").front(), goal_of(rigged, group, direction)));
  }
  return pose;
}

/// The left arm swung by FK, and its IK control somewhere.
Pose swinging(const Rigged& rigged, float ik) {
  const NodeId fk = rigged.controls("arm_l", "fk").front();
  return {rigged.switch_to("arm_l", ik), rigged.turn_by(fk, rigged.turn_about({0, 0, 1}, -0.8)),
          rigged.move_to(rigged.controls("arm_l", "ik").front(),
                         goal_of(rigged, "arm_l", kReachable[0]))};
}

Vec3 travel_of(const Rigged& rigged) { return rigged.axes * Vec3{0.3, 0.1, 1.5} * rigged.height; }

/// Arms by FK and IK, a leg by IK, hips, spine, head and root.
Pose everything(const Rigged& rigged) {
  Pose pose;
  const auto add_ik = [&](const std::string& group, Vec3 direction) {
    pose.push_back(rigged.switch_to(group, 1));
    pose.push_back(
        rigged.move_to(rigged.controls(group, "ik").front(), goal_of(rigged, group, direction)));
  };
  const auto turn = [&](NodeId control, Vec3 axis, double radians) {
    pose.push_back(rigged.turn_by(control, rigged.turn_about(axis, radians)));
  };
  add_ik("arm_l", {0.45, -0.2, 0.5});
  add_ik("leg_r", {0.1, -0.75, 0.3});
  pose.push_back(rigged.switch_to("arm_r", 0));
  turn(rigged.controls("arm_r", "fk")[0], {0, 0, 1}, 0.7);
  turn(rigged.controls("arm_r", "fk")[1], {0, 1, 0}, 0.9);
  turn(rigged.control("spine_fk", "hips"), {1, 0, 0}, 0.2);
  turn(rigged.control("spine_fk", "chest"), {0, 1, 0}, 0.4);
  const NodeId world = rigged.control("root", "world");
  turn(world, {0, 1, 0}, 0.3);
  const Vec3 travel = rigged.axes * Vec3{0.2, 0.05, 0.4} * rigged.height;
  pose.push_back(rigged.move_to(world, rigged.world(world).origin + travel));
  return pose;
}

/// Poses of the whole test, one a second; the first is the rest. Limbs that a pose does not speak
/// of stand in FK: the middle joint of a limb that is straight at rest lies anywhere within the
/// square root of rounding in IK.
std::vector<Pose> timeline(const Rigged& rigged) {
  std::vector<Pose> poses{Pose{}};
  for (const Vec3 direction : kReachable) poses.push_back(reaching(rigged, direction));
  for (const Vec3 direction : kFar) poses.push_back(reaching(rigged, direction));
  poses.push_back(swinging(rigged, 0));
  poses.push_back(swinging(rigged, 1));
  const NodeId root = rigged.control("root", "world");
  poses.push_back({rigged.move_to(root, rigged.world(root).origin + travel_of(rigged))});
  poses.push_back(everything(rigged));
  for (std::size_t i = 1; i < poses.size(); ++i) {
    for (const std::string& group : kLimbs) {
      const Key fk = rigged.switch_to(group, 0);
      const auto same = [&](const Key& key) { return key.node == fk.node; };
      if (std::none_of(poses[i].begin(), poses[i].end(), same)) poses[i].push_back(fk);
    }
  }
  return poses;
}

void check_reach(const Rigged& rigged, const Worlds& worlds, Vec3 direction) {
  for (const std::string& group : kLimbs) {
    CAPTURE(group);
    const Limb limb = limb_of(rigged, group);
    CHECK(math::length(worlds[limb.nodes[2]].origin - goal_of(rigged, group, direction)) <=
          1e-5 * limb.length);
  }
  check_lengths(rigged, worlds);
}

void check_straight(const Rigged& rigged, const Worlds& worlds) {
  for (const std::string& group : kLimbs) {
    CAPTURE(group);
    const Limb limb = limb_of(rigged, group);
    const Vec3 start = worlds[limb.nodes[0]].origin;
    const Vec3 upper = worlds[limb.nodes[1]].origin - start;
    const Vec3 whole = worlds[limb.nodes[2]].origin - start;
    CHECK(math::length(whole) == doctest::Approx(limb.length).epsilon(1e-5));
    CHECK(math::length(math::cross(upper, whole)) <= 1e-5 * limb.length * limb.length);
  }
  check_lengths(rigged, worlds);
}

/// Every driven joint is where it rests, moved by `offset`.
void check_moved(const Rigged& rigged, const Worlds& worlds, Vec3 offset, double tolerance) {
  double worst = 0;
  std::string where;
  for (const tags::TaggedJoint& joint : rigged.rig->skeleton.joints) {
    const NodeId id = rigged.joint(joint.key);
    if (!rigged.is_driven(id)) continue;
    const Vec3 now = worlds[static_cast<std::size_t>(rigged.gltf_node(id))].origin;
    const double off = math::length(now - (rigged.world(id).origin + offset));
    if (off > worst) where = joint.name;
    worst = std::max(worst, off);
  }
  CAPTURE(where);
  CHECK(worst <= tolerance * rigged.height);
}

/// `worlds` by second of the timeline.
void check_timeline(const Rigged& rigged, const std::vector<Worlds>& worlds) {
  std::size_t at = 0;
  check_moved(rigged, worlds[at++], {}, 2e-4);
  for (const Vec3 direction : kReachable) check_reach(rigged, worlds[at++], direction);
  for (std::size_t i = 0; i < std::size(kFar); ++i) check_straight(rigged, worlds[at++]);

  const Limb arm = limb_of(rigged, "arm_l");
  const math::Quat turn = rigged.turn_about({0, 0, 1}, -0.8);
  const Vec3 swung = arm.at[0] + math::rotate(turn, arm.at[2] - arm.at[0]);
  CHECK(math::length(worlds[at][arm.nodes[2]].origin - swung) <= 1e-5 * arm.length);
  check_lengths(rigged, worlds[at++]);
  // The FK swing does nothing while the switch stands at IK.
  const Vec3 goal = goal_of(rigged, "arm_l", kReachable[0]);
  CHECK(math::length(worlds[at++][arm.nodes[2]].origin - goal) <= 1e-5 * arm.length);
  check_moved(rigged, worlds[at++], travel_of(rigged), 1e-5);
  check_lengths(rigged, worlds[at]);
}

std::vector<test::Change> changes(unsigned seeds) {
  std::vector<test::Change> all;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    all.push_back({.name = "axes" + std::to_string(seed), .axes_seed = seed});
  }
  all.push_back({.name = "small", .ancestor_scale = {0.01, 0.01, 0.01}});
  all.push_back({.name = "large", .ancestor_scale = {100, 100, 100}});
  all.push_back({.name = "mirror", .ancestor_scale = {-1, 1, 1}});
  all.push_back({.name = "mirror_axes", .axes_seed = 9, .ancestor_scale = {1, 1, -1}});
  all.push_back({.name = "back", .turn_degrees = 180});
  return all;
}

/// The joints of the model that a rig was built on: rest in the world by glTF node, without the
/// little shear that some files have, which no turned axes could have as translation, rotation and
/// scale.
std::map<int, Affine> binds_of(const Rigged& rigged) {
  std::map<int, Affine> binds;
  for (const tags::TaggedJoint& joint : rigged.rig->skeleton.joints) {
    if (joint.foreign_node < 0) continue;
    const Affine world = rigged.world(rigged.joint(joint.key));
    const double size = math::cbrt(math::determinant(world.linear));
    const math::Mat3 axes = math::orthonormal(world.linear);
    binds[joint.foreign_node] = {{axes.x * size, axes.y * size, axes.z * size}, world.origin};
  }
  return binds;
}

void check_copies(const Rigged& base, const std::vector<Worlds>& expected,
                  const test::Humanoid& humanoid, const std::string& model) {
  const test::Character original = test::load_character(model);
  const std::map<int, Affine> binds = binds_of(base);
  std::vector<int> driven;
  for (const auto& [node, bind] : binds) {
    if (base.is_driven(base.joint_at(node))) driven.push_back(node);
  }
  for (const test::Change& change : changes(humanoid.map.empty() ? 2 : 1)) {
    CAPTURE(change.name);
    const std::string path = test::test_out("motion_copy.glb");
    test::save_glb(test::changed(original, binds, change), path);
    test::made_from(path, path);  // an input: it may have what it has
    // Nodes hold doubles; the limbs of Xbot are so straight that the floats of inverse bind
    // matrices would say where they bend to.
    const Rigged rigged =
        test::rig_model(path, test::user_map(humanoid), "motion_copy", "biped.yaml", "nodes");
    const Affine turn = math::rotation(math::from_euler_degrees({0, change.turn_degrees, 0}));
    const math::Mat3 axes = turn.linear * base.axes;
    CHECK(math::length(rigged.axes.x - axes.x) + math::length(rigged.axes.z - axes.z) < 1e-5);
    const auto worlds = test::bake_poses(rigged, timeline(rigged), "motion_copy");
    REQUIRE(worlds.size() == expected.size());
    for (std::size_t second = 1; second < worlds.size(); ++second) {
      CAPTURE(second);
      double worst = 0;
      int where = -1;
      for (const int node : driven) {
        const auto at = static_cast<std::size_t>(node);
        const double off =
            math::length(worlds[second][at].origin - turn * expected[second][at].origin);
        if (off > worst) where = node;
        worst = std::max(worst, off);
      }
      CAPTURE(where);
      CHECK(worst <= 2e-5 * base.height);
    }
  }
}

}  // namespace

TEST_CASE("pipeline motion: IK reaches, FK swings, the root travels, on every kind of model") {
  for (const test::Humanoid& humanoid : test::humanoids()) {
    CAPTURE(humanoid.file);
    const std::string model = test::corpus_file(humanoid.file);
    if (model.empty()) continue;
    const Rigged rigged = test::rig_model(model, test::user_map(humanoid), "motion");
    const auto worlds = test::bake_poses(rigged, timeline(rigged), "motion");
    check_timeline(rigged, worlds);
    check_copies(rigged, worlds, humanoid, model);
  }
}

}  // namespace rigc
