// SPDX-License-Identifier: MIT
// Detection: which of the maps that come with rigc fits skeletons with the names of many programs.
#include <doctest/doctest.h>

#include <map>
#include <random>

#include "templates/templates_helpers.h"

using namespace rigc;
using namespace rigc::templates;
using namespace rigc::templates::testing;

namespace {

struct Biped {
  Diagnostics diagnostics;
  std::optional<Expanded> expanded = expand_file(biped_path(), diagnostics);
  std::optional<tags::TaggedSkeleton> placed = place(*expanded, diagnostics);
};

const Biped& biped() {
  static const Biped kBiped;
  return kBiped;
}

/// The names of one program for hips, spine and limbs; `@` stands for the side.
struct Style {
  const char* name;
  const char* left;
  const char* right;
  std::vector<const char*> spine;  ///< hips first, chest last
  const char *neck, *head, *clavicle, *shoulder, *elbow, *wrist, *hip, *knee, *ankle, *ball;
};

const std::vector<Style> kStyles = {
    {"biped",
     "L",
     "R",
     {"Bip01 Pelvis", "Bip01 Spine", "Bip01 Spine1"},
     "Bip01 Neck",
     "Bip01 Head",
     "Bip01 @ Clavicle",
     "Bip01 @ UpperArm",
     "Bip01 @ Forearm",
     "Bip01 @ Hand",
     "Bip01 @ Thigh",
     "Bip01 @ Calf",
     "Bip01 @ Foot",
     "Bip01 @ Toe0"},
    {"character creator",
     "L",
     "R",
     {"CC_Base_Hip", "CC_Base_Waist", "CC_Base_Spine01", "CC_Base_Spine02"},
     "CC_Base_NeckTwist01",
     "CC_Base_Head",
     "CC_Base_@_Clavicle",
     "CC_Base_@_Upperarm",
     "CC_Base_@_Forearm",
     "CC_Base_@_Hand",
     "CC_Base_@_Thigh",
     "CC_Base_@_Calf",
     "CC_Base_@_Foot",
     "CC_Base_@_ToeBase"},
    {"source",
     "L",
     "R",
     {"ValveBiped.Bip01_Pelvis", "ValveBiped.Bip01_Spine", "ValveBiped.Bip01_Spine1",
      "ValveBiped.Bip01_Spine4"},
     "ValveBiped.Bip01_Neck1",
     "ValveBiped.Bip01_Head1",
     "ValveBiped.Bip01_@_Clavicle",
     "ValveBiped.Bip01_@_UpperArm",
     "ValveBiped.Bip01_@_Forearm",
     "ValveBiped.Bip01_@_Hand",
     "ValveBiped.Bip01_@_Thigh",
     "ValveBiped.Bip01_@_Calf",
     "ValveBiped.Bip01_@_Foot",
     "ValveBiped.Bip01_@_Toe0"},
    {"daz",
     "l",
     "r",
     {"hip", "abdomenLower", "abdomenUpper", "chestLower", "chestUpper"},
     "neckLower",
     "head",
     "@Collar",
     "@ShldrBend",
     "@ForearmBend",
     "@Hand",
     "@ThighBend",
     "@Shin",
     "@Foot",
     "@Toe"},
    {"unity",
     "Left",
     "Right",
     {"Hips", "Spine", "Chest", "UpperChest"},
     "Neck",
     "Head",
     "@Shoulder",
     "@UpperArm",
     "@LowerArm",
     "@Hand",
     "@UpperLeg",
     "@LowerLeg",
     "@Foot",
     "@Toes"},
    {"blender",
     "L",
     "R",
     {"hips", "spine", "chest"},
     "neck",
     "head",
     "shoulder.@",
     "upper_arm.@",
     "forearm.@",
     "hand.@",
     "thigh.@",
     "shin.@",
     "foot.@",
     "toe.@"},
    {"maya",
     "l",
     "r",
     {"c_pelvis_jnt", "spine_01_jnt", "spine_02_jnt"},
     "neck_jnt",
     "head_jnt",
     "",
     "@_shoulder_jnt",
     "@_elbow_jnt",
     "@_wrist_jnt",
     "@_hip_jnt",
     "@_knee_jnt",
     "@_ankle_jnt",
     "@_ball_jnt"},
    {"vroid",
     "L",
     "R",
     {"J_Bip_C_Hips", "J_Bip_C_Spine", "J_Bip_C_Chest", "J_Bip_C_UpperChest"},
     "J_Bip_C_Neck",
     "J_Bip_C_Head",
     "J_Bip_@_Shoulder",
     "J_Bip_@_UpperArm",
     "J_Bip_@_LowerArm",
     "J_Bip_@_Hand",
     "J_Bip_@_UpperLeg",
     "J_Bip_@_LowerLeg",
     "J_Bip_@_Foot",
     "J_Bip_@_ToeBase"},
};

std::string with_side(std::string name, const char* side) {
  const std::size_t at = name.find('@');
  return at == std::string::npos ? name : name.replace(at, 1, side);
}

/// The biped's own skeleton under the names of a style, without fingers; a long spine keeps what
/// fits on the template's three bones.
tags::ForeignSkeleton styled(const Style& style) {
  const auto name = [&](const tags::TaggedJoint& joint) -> std::string {
    const std::string& local = joint.ids.local;
    const std::string& label = joint.ids.label;
    if (label == "hips") return style.spine.front();
    if (local == "spine" && label == "chest") return style.spine.back();
    if (local == "spine")
      return joint.key.ordinal + 2 < style.spine.size() ? style.spine[joint.key.ordinal + 1] : "";
    if (local == "head_neck") return style.neck;
    if (local == "head") return style.head;
    const std::map<std::string, const char*> limbs = {
        {"clavicle", style.clavicle}, {"shoulder", style.shoulder}, {"elbow", style.elbow},
        {"wrist", style.wrist},       {"hip", style.hip},           {"knee", style.knee},
        {"ankle", style.ankle},       {"ball", style.ball}};
    const auto limb = limbs.find(label);
    if (limb == limbs.end()) return "";
    return with_side(limb->second, local.back() == 'l' ? style.left : style.right);
  };
  return as_model(*biped().placed, {}, name);
}

std::string detected(const tags::ForeignSkeleton& skeleton) {
  Diagnostics diagnostics;
  const auto map = detect_map(*biped().expanded, skeleton, {template_folder()}, diagnostics);
  CHECK_MESSAGE(map, render(diagnostics, false));
  return map ? map->name : "";
}

}  // namespace

TEST_CASE(
    "templates map_detect: the names of many programs fit the generic map, every joint right") {
  Diagnostics diagnostics;
  const auto map = find_map("generic", {template_folder()}, diagnostics);
  REQUIRE(map);
  for (const Style& style : kStyles) {
    CAPTURE(style.name);
    const auto skeleton = styled(style);
    CHECK(detected(skeleton) == "generic");
    FitReport report;
    Diagnostics fitting;
    CHECK_MESSAGE(fit(*biped().expanded, skeleton, *map, report, fitting), render(fitting, false));
    CHECK(report.matched.size() == skeleton.joints.size());
    // Bones stand where the template's joints stand, so a bone at another joint's place is wrong.
    for (const FitReport::Match& match : report.matched)
      for (const tags::ForeignJoint& bone : skeleton.joints) {
        if (bone.node != match.node) continue;
        const tags::TaggedJoint& own =
            biped().placed->joints[static_cast<std::size_t>(bone.node - 100)];
        CHECK_MESSAGE(own.name.find(match.joint) == 0, bone.name);
      }
  }
}

TEST_CASE("templates map_detect: specific maps win over the generic one") {
  Diagnostics diagnostics;
  for (const char* name : {"mixamo", "ready_player_me", "unreal", "rigify", "makehuman"}) {
    CAPTURE(name);
    const auto map = find_map(name, {template_folder()}, diagnostics);
    REQUIRE(map);
    const std::string prefix = std::string(name) == "mixamo" ? "mixamorig:" : "";
    const auto skeleton = as_model(*biped().placed, {}, [&](const tags::TaggedJoint& joint) {
      const MapEntry* entry = map->find(joint.ids.local, joint.ids.label);
      if (!entry || joint.ids.local == "root") return std::string();
      const std::size_t at = entry->label.empty() ? joint.key.ordinal : 0;
      return at < entry->bones.size() ? prefix + entry->bones[at].front() : std::string();
    });
    CHECK(detected(skeleton) == name);
  }
}

TEST_CASE("templates map_detect: a VRM's table decides and the names of its nodes are never read") {
  Diagnostics diagnostics;
  const auto map = find_map("vrm", {template_folder()}, diagnostics);
  REQUIRE(map);
  const auto named = [&](const tags::TaggedJoint& joint) {
    const MapEntry* entry = map->find(joint.ids.local, joint.ids.label);
    if (!entry) return std::string();
    const std::size_t at = entry->label.empty() ? joint.key.ordinal : 0;
    return at < entry->bones.size() ? entry->bones[at].front() : std::string();
  };
  auto skeleton = as_model(*biped().placed, {}, named);
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i)
    skeleton.humanoid.emplace_back(skeleton.joints[i].name, static_cast<int>(i));
  FitReport expected;
  REQUIRE(fit(*biped().expanded, skeleton, *map, expected, diagnostics));
  std::mt19937_64 random(5);
  for (int round = 0; round < 4; ++round) {
    // Names of other joints, of another program, or none at all.
    std::vector<std::string> names;
    for (const tags::ForeignJoint& joint : skeleton.joints)
      names.push_back(round == 0 ? "" : "mixamorig:" + joint.name);
    for (std::size_t i = names.size(); i > 1; --i) std::swap(names[i - 1], names[random() % i]);
    for (std::size_t i = 0; i < names.size(); ++i) skeleton.joints[i].name = names[i];
    CHECK(detected(skeleton) == "vrm");
    FitReport report;
    REQUIRE(fit(*biped().expanded, skeleton, *map, report, diagnostics));
    REQUIRE(report.matched.size() == expected.matched.size());
    for (std::size_t i = 0; i < report.matched.size(); ++i) {
      CHECK(report.matched[i].joint == expected.matched[i].joint);
      CHECK(report.matched[i].node == expected.matched[i].node);
    }
  }
}

TEST_CASE("templates map_detect: thumbs of VRM 0.x and 1.0, and chests that are missing") {
  Diagnostics diagnostics;
  const auto map = find_map("vrm", {template_folder()}, diagnostics);
  REQUIRE(map);
  tags::ForeignSkeleton skeleton;
  const auto add = [&](const char* bone) {
    skeleton.joints.emplace_back();
    skeleton.joints.back().node = static_cast<int>(skeleton.joints.size());
    skeleton.humanoid.emplace_back(bone, static_cast<int>(skeleton.joints.size()) - 1);
  };
  const auto bone_of = [&](const char* joint) -> std::string {
    FitReport report;
    Diagnostics unheard;
    fit(*biped().expanded, skeleton, *map, report, unheard);
    for (const FitReport::Match& match : report.matched)
      if (match.joint == joint)
        return skeleton.humanoid[static_cast<std::size_t>(match.node) - 1].first;
    return "";
  };
  for (const char* bone :
       {"spine", "leftThumbProximal", "leftThumbIntermediate", "leftThumbDistal"})
    add(bone);
  CHECK(bone_of("spine_chest") == "spine");
  CHECK(bone_of("arm_l_hand_thumb_proximal") == "leftThumbProximal");
  CHECK(bone_of("arm_l_hand_thumb_middle") == "leftThumbIntermediate");
  add("chest");
  CHECK(bone_of("spine_chest") == "chest");
  CHECK(bone_of("spine_spine") == "spine");
  skeleton.humanoid[2].first = "leftThumbMetacarpal";
  CHECK(bone_of("arm_l_hand_thumb_proximal") == "leftThumbMetacarpal");
  CHECK(bone_of("arm_l_hand_thumb_middle") == "leftThumbProximal");
  CHECK(bone_of("arm_l_hand_thumb_distal") == "leftThumbDistal");
}

TEST_CASE(
    "templates map_detect: a map with missing joints is never chosen, and says what it lacks") {
  auto skeleton = styled(kStyles[0]);
  for (tags::ForeignJoint& joint : skeleton.joints)
    if (joint.name == "Bip01 L Forearm") joint.name = "Bip01 L Xyz";
  Diagnostics diagnostics;
  CHECK_FALSE(detect_map(*biped().expanded, skeleton, {template_folder()}, diagnostics));
  REQUIRE(numbers(diagnostics) == std::vector<int>{341});
  const std::string& hint = diagnostics.all()[0].hint;
  CHECK(hint.find("generic comes nearest") != std::string::npos);
  CHECK(hint.find("it finds no arm_l_elbow\n") != std::string::npos);
  CHECK(hint.find("rigc map") != std::string::npos);

  // The map that names most bones loses against one that leaves no required joint out.
  const Folder folder("map_detect");
  folder.write("maps/many.yaml", "map: many\njoints: {t.a: A, t.c: C, t.d: D}\n");
  folder.write("maps/right.yaml", "map: right\njoints: {t.a: A, t.b: B}\n");
  folder.write("maps/absent.yaml",
               "map: absent\nrequires: [Z]\njoints: {t.a: A, t.b: B, t.c: C}\n");
  Diagnostics second;
  const auto expanded =
      expand_text(with_head("joints:\n  - {name: a, local: t, label: a}\n  - {name: b, parent: a, "
                            "local: t, label: b}\n"
                            "  - {name: c, parent: a, local: t, label: c, optional: true}\n"
                            "  - {name: d, parent: a, local: t, label: d, optional: true}\n"),
                  second);
  REQUIRE_MESSAGE(expanded, render(second, false));
  tags::ForeignSkeleton letters;
  for (const char* name : {"A", "B", "C", "D"}) {
    letters.joints.emplace_back();
    letters.joints.back().name = name;
  }
  const auto map = detect_map(*expanded, letters, {folder.path()}, second);
  REQUIRE_MESSAGE(map, render(second, false));
  CHECK(map->name == "right");
}
