// SPDX-License-Identifier: MIT
// The table of built-in modules, sorted by name. Test: tests/modules/registry_test.cpp
#include "modules/registry.h"

#include <algorithm>

#include "modules/builder.h"

namespace rigc::modules {
namespace {

constexpr Module kModules[] = {
    {"aim_constraint", aim_constraint},
    {"aim_matrix", aim_matrix},
    {"attribute", attribute},
    {"auto_clavicle", auto_clavicle},
    {"auto_hip", auto_hip},
    {"auto_pole", auto_pole},
    {"blend", blend},
    {"blend_matrix", blend_matrix},
    {"chain", chain},
    {"clamp", clamp},
    {"clavicle", clavicle},
    {"compose", compose},
    {"condition", condition},
    {"connect", connect},
    {"control", control},
    {"control_set", control_set},
    {"decompose", decompose},
    {"display_layer", display_layer},
    {"distance", distance},
    {"driven_key", driven_key},
    {"edit_shape", edit_shape},
    {"expression", expression},
    {"fingertip_ik", fingertip_ik},
    {"fk_chain", fk_chain},
    {"foot_roll", foot_roll},
    {"gimbal", gimbal},
    {"hand", hand},
    {"hold_matrix", hold_matrix},
    {"ik_fk_limb", ik_fk_limb},
    {"ik_handle", ik_handle},
    {"joint", joint},
    {"leg_3", leg_3},
    {"limb_stretch", limb_stretch},
    {"limb_wrist", limb_wrist},
    {"limits", limits},
    {"lock", lock},
    {"look_at", look_at},
    {"morph_targets", morph_targets},
    {"multiply_matrix", multiply_matrix},
    {"neck_head", neck_head},
    {"orient_constraint", orient_constraint},
    {"parent", parent},
    {"parent_constraint", parent_constraint},
    {"pick_matrix", pick_matrix},
    {"pivot", pivot},
    {"point_constraint", point_constraint},
    {"pole_vector", pole_vector},
    {"pose_reader", pose_reader},
    {"proxy_mesh", proxy_mesh},
    {"remap", remap},
    {"ribbon", ribbon},
    {"root", root},
    {"scale_constraint", scale_constraint},
    {"set", set},
    {"space_switch", space_switch},
    {"spine_fk", spine_fk},
    {"spine_ik", spine_ik},
    {"squash_stretch", squash_stretch},
    {"state_machine", state_machine},
    {"transform", transform},
    {"twist_joints", twist_joints},
    {"vector", vector_operation},
    {"vector_foot", vector_foot},
    {"wheel", wheel},
};

}  // namespace

std::span<const Module> registry() { return kModules; }

const Module* find(std::string_view name) {
  const auto* found =
      std::lower_bound(std::begin(kModules), std::end(kModules), name,
                       [](const Module& m, std::string_view n) { return m.name < n; });
  return found != std::end(kModules) && found->name == name ? found : nullptr;
}

}  // namespace rigc::modules
