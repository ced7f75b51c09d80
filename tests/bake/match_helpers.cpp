// SPDX-License-Identifier: MIT
// Arms with FK and IK, and clips on them.
#include "bake/match_helpers.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>

#include "eval/clip_inputs.h"
#include "support/models.h"

namespace rigc::test {
namespace {

std::string side(const std::string& s, double x, double elbow) {
  const std::string limb = R"(
    tags:
      - {command: ik_fk_limb, with: {start: ., middle: arm_S.lower, end: arm_S.end}}
      - {command: limb_stretch, with: {limb: arm_S/ik_fk_limb.ik}}
      - {command: limb_wrist, with: {limb: arm_S/ik_fk_limb.ik}}
)";
  std::string text = fmt::format(R"(  - name: upper_S
    parent: chest
    at: [{}, 1.4, 0]
    local: arm_S
    label: upper)",
                                 x * 0.2) +
                     limb +
                     fmt::format(R"(  - {{name: lower_S, parent: upper_S, at: [{}, 1.38, {}],
     local: arm_S, label: lower}}
  - {{name: end_S, parent: lower_S, at: [{}, 1.36, 0.03], local: arm_S, label: end}}
)",
                                 x * 0.5, elbow, x * 0.74);
  for (std::size_t at = 0; (at = text.find("_S", at)) != std::string::npos;)
    text.replace(at, 2, "_" + s);
  return text;
}

}  // namespace

std::string arms(double elbow) {
  return template_of(R"(joints:
  - name: root
    at: [0, 0, 0]
    local: root
    label: root
    tags:
      - {command: root, with: {drive: on}}
  - name: chest
    parent: root
    at: [0, 1.2, 0]
    local: torso
    label: chest
    tags:
      - {command: control, with: {}}
)" + side("l", 1, elbow) +
                     side("r", -1, elbow));
}

std::vector<int> nodes_of(const scene::Scene& scene) {
  std::vector<int> nodes(scene.size(), -1);
  for (const scene::NodeId id : scene.nodes())
    if (scene::spec(scene[id].kind).is_transform) nodes[id.index] = static_cast<int>(id.index);
  return nodes;
}

std::vector<math::Affine> joints_at(const Rig& rig, const bake::MatchLimb& limb,
                                    const anim::Clip& clip, double seconds) {
  std::vector<eval::Setting> settings;
  for (const eval::ClipInput& input : eval::clip_inputs(rig.scene(), nodes_of(rig.scene()), clip)) {
    double n[4];
    const bool rotation = input.plug.attribute == scene::transform::kRotation;
    anim::sample(*input.curve, rotation, seconds, n);
    if (input.curve->width == 1) settings.push_back({input.plug, n[0]});
    if (input.curve->width == 3) settings.push_back({input.plug, math::Vec3{n[0], n[1], n[2]}});
    if (input.curve->width == 4)
      settings.push_back({input.plug, math::Quat{n[0], n[1], n[2], n[3]}});
  }
  return eval::worlds(rig.scene(), {limb.joints.begin(), limb.joints.end()}, settings);
}

const bake::MatchLimb& find(const std::vector<bake::MatchLimb>& limbs, const std::string& name) {
  const auto found =
      std::find_if(limbs.begin(), limbs.end(), [&](const auto& limb) { return limb.name == name; });
  REQUIRE(found != limbs.end());
  return *found;
}

}  // namespace rigc::test
