// SPDX-License-Identifier: MIT
// The table of built-in modules, sorted by name. Test: tests/modules/registry_test.cpp
#include "modules/registry.h"

#include <algorithm>

#include "modules/builder.h"

namespace rigc::modules {
namespace {

constexpr Module kModules[] = {
    {"aim_constraint", aim_constraint},
    {"attribute", attribute},
    {"connect", connect},
    {"control", control},
    {"control_set", control_set},
    {"display_layer", display_layer},
    {"expression", expression},
    {"fk_chain", fk_chain},
    {"ik_fk_limb", ik_fk_limb},
    {"ik_handle", ik_handle},
    {"joint", joint},
    {"limits", limits},
    {"lock", lock},
    {"look_at", look_at},
    {"orient_constraint", orient_constraint},
    {"parent", parent},
    {"parent_constraint", parent_constraint},
    {"point_constraint", point_constraint},
    {"pole_vector", pole_vector},
    {"proxy_mesh", proxy_mesh},
    {"remap", remap},
    {"root", root},
    {"scale_constraint", scale_constraint},
    {"set", set},
    {"spine_fk", spine_fk},
    {"transform", transform},
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
