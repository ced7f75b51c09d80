// SPDX-License-Identifier: MIT
// Whatever hangs under what in a model, the same controls give the same motion: feet under the
// root, fingers that are siblings, twist joints in a limb, scaled joints.
#include "modules/hierarchy_helpers.h"

#include <doctest/doctest.h>

#include "modules/bodies_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

std::string character() {
  test::Commands commands{
      {"root", "{command: root, with: {drive: on}}"},
      {"hips",
       "{command: control, id: body, with: {drive: off}}\n"
       "{command: spine_fk, with: {joints: [torso.hips, \"spine[*]\", torso.chest], "
       "parent: \"torso.hips/control#body\"}}"},
      {"head",
       "{command: control, with: {}}\n"
       "{command: look_at, with: {eyes: \"eyes[*]\", parent: ./control}}"}};
  for (const std::string s : {"l", "r"}) {
    commands["clavicle_" + s] = "{command: control, with: {translate: off}}";
    for (const auto& [joint, group] :
         {std::pair{"upperarm_" + s, "arm_" + s}, {"thigh_" + s, "leg_" + s}}) {
      commands[joint] = "{command: ik_fk_limb, with: {start: ., middle: " + group +
                        ".lower, end: " + group +
                        ".end, bend: " + (joint[0] == 't' ? "forward" : "backward") + "}}";
    }
    commands["foot_" + s] = "{command: control, with: {label: toes, drive: off}}";
  }
  std::string text = test::body(commands);
  for (const std::string side : {"l", "r"}) {
    text += "  - {name: eye_" + side + ", parent: head, at: [" + (side == "l" ? "" : "-") +
            "0.03, 1.66, 0.1], local: eyes}\n";
    text += "  - name: finger_" + side + "\n    parent: hand_" + side + "\n    at: [" +
            (side == "l" ? "" : "-") + "0.8, 1.42, 0]\n    local: finger_" + side +
            "\n    chain: {count: 3, to: [" + (side == "l" ? "" : "-") +
            "0.88, 1.41, 0.01]}\n    tags:\n      - {command: fk_chain, with: {joints: \"finger_" +
            side + "[*]\", parent: arm_" + side + ".end}}\n";
  }
  return text;
}

/// Everything moves: both arms by FK and IK, legs by IK (the right one out of reach), spine, head,
/// eyes, fingers, root.
test::Pose posed(const test::Rig& rig, double master_scale) {
  test::Pose pose(rig);
  pose.set("root/root.world@master_scale", master_scale);
  pose.translate("root/root.offset", Vec3{0.2, 0.1, -0.3}).rotate("root/root.world", {0, 30, 0});
  pose.rotate("torso/control#body", {5, 10, 0}).translate("torso/control#body", {0, -0.2, 0.05});
  pose.rotate("torso.hips/spine_fk.hips", {10, 0, 5}).rotate("spine[0]/spine_fk", {0, 15, 0});
  pose.rotate("torso.chest/spine_fk.chest", {10, -20, 0}).rotate("head/control", {0, 30, 10});
  pose.translate("head/look_at.target", {0.1, 0.2, 0});
  pose.rotate("arm_l.clavicle/control", {0, 0, 15}).rotate("arm_r.clavicle/control", {0, 10, 0});
  pose.set("arm_l/ik_fk_limb.settings@ik_fk", 0.35).set("arm_r/ik_fk_limb.settings@ik_fk", 1.0);
  pose.rotate("arm_l.upper/ik_fk_limb.fk", {0, 20, 30})
      .rotate("arm_l.lower/ik_fk_limb.fk", {0, 40, 0});
  pose.translate("arm_l/ik_fk_limb.ik", {-0.1, 0.2, 0.3}).rotate("arm_l/ik_fk_limb.ik", {20, 0, 0});
  pose.translate("arm_r/ik_fk_limb.ik", {0.2, -0.2, 0.3})
      .translate("arm_r/ik_fk_limb.pole", {0, -0.3, 0});
  pose.set("leg_l/ik_fk_limb.settings@ik_fk", 1.0).set("leg_r/ik_fk_limb.settings@ik_fk", 1.0);
  pose.translate("leg_l/ik_fk_limb.ik", {0.1, 0.2, 0.15})
      .rotate("leg_l/ik_fk_limb.ik", {30, 10, 0});
  pose.translate("leg_r/ik_fk_limb.ik", {-0.6, 0.1, 0.6});
  pose.rotate("finger_l[0]/fk_chain", {0, 0, -30}).rotate("finger_l[1]/fk_chain", {0, 0, -20});
  return pose;
}

using Motions = std::map<std::string, math::Affine>;

Motions motions(const test::Rig& rig, double master_scale) {
  const auto all = test::motion(rig, posed(rig, master_scale));
  Motions out;
  for (std::size_t j = 0; j < all.size(); ++j) {
    const tags::TaggedJoint& joint = rig.skeleton.joints[j];
    out[joint.name + to_text(joint.key)] = all[j];
  }
  return out;
}

void check_same_motion(const test::Rig& rig, const test::Rig& plain) {
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(test::rest_error(rig) < 1e-9);
  for (const double master_scale : {1.0, 2.5}) {
    CAPTURE(master_scale);
    const Motions is = motions(rig, master_scale), wanted = motions(plain, master_scale);
    double most = 0;
    std::string where;
    for (const auto& [name, motion] : wanted) {
      const auto found = is.find(name);
      REQUIRE(found != is.end());
      const Vec3 at = plain.rest("root").origin;
      for (const Vec3 off : {Vec3{}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        const double now = test::distance(found->second * (at + off), motion * (at + off));
        if (now > most) where = name;
        most = std::max(most, now);
      }
    }
    CAPTURE(where);
    CHECK(most < 1e-7);
  }
}

struct Odd {
  const char* name;
  test::Rig::Change change;
};

}  // namespace

TEST_CASE("modules hierarchy: the same controls give the same motion, whatever hangs under what") {
  const test::Rig plain(character());
  REQUIRE(plain.clean());
  const Odd odds[] = {
      {"feet under the root",
       [](auto& s) {
         test::rehang(s, "foot_l", "root");
         test::rehang(s, "foot_r", "root");
       }},
      {"feet under nothing", [](auto& s) { test::rehang(s, "foot_l", ""); }},
      {"shins and feet under the hips",
       [](auto& s) {
         test::rehang(s, "shin_l", "hips");
         test::rehang(s, "foot_l", "hips");
         test::rehang(s, "shin_r", "hips");
       }},
      {"arms under the hips",
       [](auto& s) {
         test::rehang(s, "clavicle_l", "hips");
         test::rehang(s, "upperarm_r", "hips");
         test::rehang(s, "forearm_r", "root");
       }},
      {"spine and head under the root",
       [](auto& s) {
         test::rehang(s, "chest", "root");
         test::rehang(s, "head", "hips");
         test::rehang(s, "eye_r", "chest");
       }},
      {"all under the root", [](auto& s) { test::flatten(s, "root"); }},
      {"all under nothing", [](auto& s) { test::flatten(s, ""); }},
      {"twist joints",
       [](auto& s) {
         for (const char* joint : {"forearm_l", "hand_l", "shin_l", "foot_r", "chest", "hand_r"}) {
           test::put_between(s, joint, 1);
         }
       }},
      {"twist joints with scale",
       [](auto& s) {
         for (const char* joint : {"forearm_l", "hand_l", "shin_l", "foot_r", "clavicle_r"}) {
           test::put_between(s, joint, 2.5);
         }
       }},
      {"scaled joints",
       [](auto& s) {
         test::scale_below(s, "hips", 100);
         test::scale_below(s, "upperarm_l", 3);
         test::scale_below(s, "hand_l", 0.2);
         test::scale_below(s, "forearm_r", 0.4);
         test::scale_below(s, "chest", 3);
       }},
      {"all at once",
       [](auto& s) {
         test::turn_axes(s, 7);
         test::scale_below(s, "hips", 0.01);
         test::scale_below(s, "thigh_r", 3);
         test::put_between(s, "shin_r", 0.3);
         test::put_between(s, "foot_r", 2);
         test::rehang(s, "foot_l", "root");
         test::put_between(s, "hand_l", 4);
         test::rehang(s, "upperarm_l", "hips");
       }},
  };
  for (const Odd& odd : odds) {
    CAPTURE(odd.name);
    check_same_motion(test::Rig(character(), odd.change), plain);
  }
}
