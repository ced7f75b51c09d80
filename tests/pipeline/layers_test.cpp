// SPDX-License-Identifier: MIT
// What of the templates' controls is shown when: layers that attributes of the root switch, FK or
// IK by the limb's switch; and that every control has a name of its own.
#include <doctest/doctest.h>

#include <map>
#include <set>

#include "eval/evaluate.h"
#include "modules/steps_groups.h"
#include "pipeline/build.h"
#include "pipeline/character_helpers.h"

namespace rigc {
namespace {

using scene::NodeId;
using scene::Plug;

gltf::Rig build(const std::string& name, const std::vector<std::string>& features) {
  pipeline::BuildRequest request;
  request.template_file = test::templates_folder() + "/" + name + ".yaml";
  request.paths.templates = {test::templates_folder()};
  request.features = features;
  Diagnostics diagnostics;
  auto built = pipeline::build(request, test::test_out("layers.glb"), diagnostics);
  REQUIRE_MESSAGE(built, render(diagnostics, false));
  return std::move(built->rig);
}

std::vector<NodeId> of_kind(const gltf::Rig& rig, scene::Kind kind) {
  std::vector<NodeId> out;
  for (const NodeId id : rig.scene.nodes())
    if (rig.scene[id].kind == kind) out.push_back(id);
  return out;
}

/// By node the names of the layers that it is in.
std::map<NodeId, std::set<std::string>> layers_of(const gltf::Rig& rig) {
  namespace layer = scene::display_layer;
  std::map<NodeId, std::set<std::string>> out;
  for (const NodeId id : of_kind(rig, scene::Kind::display_layer)) {
    const auto name = std::get<std::string>(rig.scene.value({id, layer::kLayer}));
    for (const NodeId member : modules::members_of(rig.scene, id, layer::kMembers))
      out[member].insert(name);
  }
  return out;
}

NodeId named(const gltf::Rig& rig, const std::string& name) {
  for (const NodeId id : of_kind(rig, scene::Kind::control))
    if (rig.scene[id].name == name) return id;
  FAIL("there is no control " << name);
  return {};
}

/// Names of the controls that are shown.
std::set<std::string> shown(const gltf::Rig& rig, const std::vector<eval::Setting>& settings) {
  const std::vector<NodeId> controls = of_kind(rig, scene::Kind::control);
  std::vector<Plug> plugs;
  for (const NodeId id : controls) plugs.push_back({id, scene::transform::kVisible});
  Diagnostics diagnostics;
  const auto values = eval::evaluate(rig.scene, plugs, settings, diagnostics);
  REQUIRE(values);
  std::set<std::string> out;
  for (std::size_t i = 0; i < controls.size(); ++i)
    if (std::get<double>((*values)[i]) != 0) out.insert(rig.scene[controls[i]].name);
  return out;
}

eval::Setting setting(const gltf::Rig& rig, const std::string& control, const std::string& name,
                      double value) {
  const auto plug = rig.scene.find_plug(named(rig, control), name);
  REQUIRE_MESSAGE(plug, control << " has no " << name);
  return {*plug, value};
}

const std::vector<std::string> kAllOn{"stretch=on",  "ribbons=on", "vector_foot=on",
                                      "auto_hip=on", "gimbal=on",  "fingertips=on"};

}  // namespace

TEST_CASE("pipeline layers: every control is in one, and has a name of its own") {
  for (const std::string name : {"biped", "biped_tail", "quadruped", "winged"}) {
    CAPTURE(name);
    const gltf::Rig rig = build(name, name == "biped" ? kAllOn : std::vector<std::string>{});
    auto layers = layers_of(rig);
    std::set<std::string> names;
    for (const NodeId id : of_kind(rig, scene::Kind::control)) {
      const scene::Node& control = rig.scene[id];
      CAPTURE(control.name);
      CHECK(names.insert(control.name).second);
      const bool root = control.identity.role == "world";
      CHECK(layers[id].size() == (root ? 0 : 1));
    }
  }
}

TEST_CASE("pipeline layers: attributes of the root show and hide them") {
  const gltf::Rig rig = build("biped", kAllOn);
  const auto all = shown(rig, {});
  const std::map<std::string, std::string> one_of{
      {"primary", "body"}, {"secondary", "arm_l_hand_index_middle_fk"}, {"tweak", "hips_auto"}};
  for (const auto& pair : one_of) {
    const std::string layer = pair.first, control = pair.second;
    CAPTURE(layer);
    CHECK(all.count(control) == 1);
    const auto left = shown(rig, {setting(rig, "root_world", layer + "_visible", 0)});
    CHECK(left.count(control) == 0);
    CHECK(left.count("root_world") == 1);
    for (const auto& [other, still] : one_of)
      if (other != layer) CHECK(left.count(still) == 1);
  }
  // A gimbal is shown by its control's attribute, where its layer is shown too.
  const auto gimbal = setting(rig, "head_head_control", "gimbal_visible", 1);
  CHECK(all.count("head_head_gimbal") == 0);
  CHECK(shown(rig, {gimbal}).count("head_head_gimbal") == 1);
  const auto hidden = setting(rig, "root_world", "tweak_visible", 0);
  CHECK(shown(rig, {gimbal, hidden}).count("head_head_gimbal") == 0);
}

TEST_CASE("pipeline layers: arms begin in FK and legs in IK, and show what poses them") {
  const gltf::Rig rig = build("biped", {});
  const auto rest = shown(rig, {});
  CHECK(rest.count("arm_l_elbow_fk") == 1);
  CHECK(rest.count("arm_l_wrist_ik") == 0);
  CHECK(rest.count("leg_r_knee_fk") == 0);
  CHECK(rest.count("leg_r_knee_pole") == 1);
  const auto ik = shown(rig, {setting(rig, "arm_l_wrist_settings", "ik_fk", 1)});
  CHECK(ik.count("arm_l_elbow_fk") == 0);
  CHECK(ik.count("arm_l_wrist_ik") == 1);
  CHECK(ik.count("arm_r_wrist_ik") == 0);
  const auto both = shown(rig, {setting(rig, "leg_r_ankle_settings", "ik_fk", 0.5)});
  CHECK(both.count("leg_r_knee_fk") == 1);
  CHECK(both.count("leg_r_knee_pole") == 1);
  const auto off = shown(rig, {setting(rig, "root_world", "primary_visible", 0)});
  CHECK(off.count("leg_r_knee_pole") == 0);
}

}  // namespace rigc
