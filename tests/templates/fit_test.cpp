// SPDX-License-Identifier: MIT
// Fitting the biped to skeletons that look like models, and to a real one.
#include "templates/fit.h"

#include <doctest/doctest.h>

#include <map>
#include <random>
#include <set>

#include "templates/templates_helpers.h"

using namespace rigc;
using namespace rigc::templates;
using namespace rigc::templates::testing;

namespace {

/// Mixamo's names for the biped's joints, by the map itself.
struct Names {
  std::map<std::pair<std::string, std::string>, std::string> of;
  std::string operator()(const tags::TaggedJoint& joint) const {
    std::string label = joint.ids.label;
    if (joint.ids.local == "spine" && label.empty())
      return joint.key.ordinal == 0 ? "mixamorig:Spine" : "mixamorig:Spine1";
    if (joint.ids.local == "spine") return "mixamorig:Spine2";
    const auto found = of.find({joint.ids.local, label});
    return found == of.end() ? "" : "mixamorig:" + found->second;
  }
};

struct Case {
  Diagnostics diagnostics;
  std::optional<Expanded> expanded;
  std::optional<tags::TaggedSkeleton> placed;
  std::optional<Map> map;
  Names names;

  Case() {
    expanded = expand_file(biped_path(), diagnostics);
    REQUIRE(expanded);
    placed = place(*expanded, diagnostics);
    REQUIRE(placed);
    map = find_map("mixamo", {template_folder()}, diagnostics);
    REQUIRE(map);
    for (const MapEntry& entry : map->entries)
      names.of[{entry.local, entry.label}] = entry.bones.front().front();
  }
};

double distance(math::Vec3 a, math::Vec3 b) { return length(a - b); }

}  // namespace

TEST_CASE("templates fit: a model of the template's own shape gets its own placement back") {
  Case c;
  const auto model = as_model(*c.placed, {}, c.names);
  FitReport report;
  const auto fitted = fit(*c.expanded, model, *c.map, report, c.diagnostics);
  REQUIRE_MESSAGE(fitted, render(c.diagnostics, false));
  CHECK(c.diagnostics.all().empty());
  CHECK(report.helpers == std::vector<std::string>{"root"});
  CHECK(report.missing.empty());
  CHECK(report.extra.empty());
  CHECK(report.matched.size() == model.joints.size());
  CHECK(fitted->character.up == math::Vec3{0, 1, 0});
  CHECK(fitted->character.left == math::Vec3{1, 0, 0});
  CHECK(distance(fitted->character.forward, {0, 0, 1}) < 1e-12);
  CHECK(fitted->character.unit == doctest::Approx(1));
  for (std::size_t i = 0; i < fitted->joints.size(); ++i) {
    const tags::TaggedJoint& joint = fitted->joints[i];
    const int index = c.placed->find(joint.key);
    REQUIRE(index >= 0);
    const tags::TaggedJoint& own = c.placed->joints[static_cast<std::size_t>(index)];
    CHECK(joint.ids == own.ids);
    CHECK(joint.commands.size() == own.commands.size());
    CHECK(joint.mirror.opposite == own.mirror.opposite);
    CHECK(joint.parent < static_cast<int>(i));
    CHECK(distance(fitted->world(i).origin,
                   c.placed->world(static_cast<std::size_t>(index)).origin) < 1e-9);
  }
}

TEST_CASE(
    "templates fit: the character is measured in the world, whatever lies above the skeleton") {
  Case c;
  const math::Affine turned = math::rotation(math::axis_angle({0, 1, 0}, math::kPi));
  const std::vector<math::Affine> ancestors = {
      {{{0.01, 0, 0}, {0, 0.01, 0}, {0, 0, 0.01}}, {2, 0, 0}},
      {{{100, 0, 0}, {0, 100, 0}, {0, 0, 100}}, {}},
      {{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 1, 0}},
      turned * math::Affine{{{0, 0, -0.5}, {0.5, 0, 0}, {0, 0.5, 0}}, {1, 2, 3}},
  };
  for (const math::Affine& ancestor : ancestors) {
    const auto model = as_model(*c.placed, ancestor, c.names);
    FitReport report;
    Diagnostics diagnostics;
    const auto fitted = fit(*c.expanded, model, *c.map, report, diagnostics);
    REQUIRE_MESSAGE(fitted, render(diagnostics, false));
    CHECK(diagnostics.all().empty());
    const auto direction = [&](math::Vec3 v) { return normalised(ancestor.linear * v); };
    CHECK(distance(direction(fitted->character.up), {0, 1, 0}) < 1e-9);
    CHECK(distance(direction(fitted->character.left), {1, 0, 0}) < 1e-9);
    CHECK(distance(direction(fitted->character.forward), {0, 0, 1}) < 1e-9);
    CHECK(length(ancestor.linear * (fitted->character.up * fitted->character.unit)) ==
          doctest::Approx(1));
    CHECK(report.height_metres ==
          doctest::Approx(c.placed->character.height - 0.015).epsilon(0.01));
    const std::size_t root = joint_named(*fitted, "root");
    CHECK(fitted->joints[root].foreign_node == -1);
    CHECK(distance(ancestor * fitted->world(root).origin, {0, 0, 0}) < 1e-9);
  }
}

TEST_CASE("templates fit: bones between and beside the matched ones stay as untagged joints") {
  Case c;
  auto model = as_model(*c.placed, {}, c.names);
  std::size_t elbow = 0;
  for (std::size_t i = 0; i < model.joints.size(); ++i)
    if (model.joints[i].name == "mixamorig:LeftForeArm") elbow = i;
  tags::ForeignJoint twist = model.joints[elbow];
  twist.name = "twist";
  twist.node = 900;
  twist.in_skin = false;
  twist.parent = model.joints[elbow].parent;
  model.joints[elbow].parent = static_cast<int>(model.joints.size());
  model.joints.push_back(twist);
  tags::ForeignJoint hair = twist;
  hair.name = "hair";
  hair.node = 901;
  hair.in_skin = true;
  hair.parent = 0;
  model.joints.push_back(hair);
  tags::ForeignJoint loose = hair;
  loose.name = "attachment";
  loose.node = 902;
  loose.in_skin = false;
  model.joints.push_back(loose);

  FitReport report;
  const auto fitted = fit(*c.expanded, model, *c.map, report, c.diagnostics);
  REQUIRE_MESSAGE(fitted, render(c.diagnostics, false));
  const std::size_t between = joint_named(*fitted, "twist");
  CHECK(fitted->joints[between].commands.empty());
  CHECK(fitted->joints[between].ids.local.empty());
  CHECK(fitted->joints[between].ids.global == "biped");
  CHECK(fitted->joints[joint_named(*fitted, "mixamorig:LeftForeArm")].parent ==
        static_cast<int>(between));
  CHECK(fitted->joints[joint_named(*fitted, "hair")].foreign_node == 901);
  CHECK(report.extra == std::vector<std::string>{"hair"});
  CHECK(report.twists == std::vector<std::string>{"twist"});
  std::set<JointKey> keys;
  for (const tags::TaggedJoint& joint : fitted->joints) {
    CHECK(joint.name != "attachment");
    CHECK(keys.insert(joint.key).second);
  }
}

TEST_CASE(
    "templates fit: a chain takes the model's count, optional joints are dropped, children move "
    "up") {
  Case c;
  auto names = [&](const tags::TaggedJoint& joint) -> std::string {
    const std::string name = c.names(joint);
    if (name.find("Toe") != std::string::npos || name.find("Shoulder") != std::string::npos)
      return "";
    if (joint.ids.local == "head_neck") return "";
    if (name == "mixamorig:Spine1") return "mixamorig:Spine";  // the chain's only bone
    if (name == "mixamorig:Spine") return "";
    return name;
  };
  const auto model = as_model(*c.placed, {}, names);
  FitReport report;
  const auto fitted = fit(*c.expanded, model, *c.map, report, c.diagnostics);
  REQUIRE_MESSAGE(fitted, render(c.diagnostics, false));
  std::set<std::string> dropped(report.dropped.begin(), report.dropped.end());
  // Mixamo has no metacarpals, and no lids.
  CHECK(std::erase_if(dropped, [](const std::string& name) { return name.ends_with("_lid"); }) ==
        4);
  CHECK(std::erase_if(dropped,
                      [](const std::string& name) { return name.ends_with("_metacarpal"); }) == 8);
  CHECK(dropped == std::set<std::string>{"head_neck", "arm_l_clavicle", "arm_r_clavicle",
                                         "leg_l_ball", "leg_l_tip", "leg_r_ball", "leg_r_tip"});
  std::size_t chain = 0;
  for (const tags::TaggedJoint& joint : fitted->joints)
    chain += joint.ids.local == "spine" && joint.ids.label.empty() ? 1 : 0;
  CHECK(chain == 1);
  const std::size_t arm = joint_named(*fitted, "mixamorig:LeftArm");
  CHECK(fitted->joints[static_cast<std::size_t>(fitted->joints[arm].parent)].name ==
        "mixamorig:Spine2");
}

TEST_CASE("templates fit: a longer chain has ordinals and takes bones that the map does not name") {
  Case c;
  auto model = as_model(*c.placed, {}, c.names);
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    if (model.joints[i].name != "mixamorig:Spine1") continue;
    tags::ForeignJoint extra = model.joints[i];
    extra.name = "SpineExtra";
    extra.node = 950;
    model.joints[i].parent = static_cast<int>(model.joints.size());
    model.joints.push_back(extra);
    break;
  }
  FitReport report;
  const auto fitted = fit(*c.expanded, model, *c.map, report, c.diagnostics);
  REQUIRE_MESSAGE(fitted, render(c.diagnostics, false));
  std::vector<std::string> chain;
  std::vector<std::uint32_t> ordinals;
  for (const tags::TaggedJoint& joint : fitted->joints)
    if (joint.ids.local == "spine" && joint.ids.label.empty()) {
      chain.push_back(joint.name);
      ordinals.push_back(joint.key.ordinal);
    }
  CHECK(chain == std::vector<std::string>{"mixamorig:Spine", "SpineExtra", "mixamorig:Spine1"});
  CHECK(ordinals == std::vector<std::uint32_t>{0, 1, 2});
  CHECK(report.extra.empty());
}

TEST_CASE("templates fit: what is missing is an error with the nearest bones") {
  Case c;
  const auto model = as_model(*c.placed, {}, [&](const tags::TaggedJoint& joint) -> std::string {
    const std::string name = c.names(joint);
    return name == "mixamorig:LeftForeArm" ? "mixamorig:LeftForearn" : name;
  });
  FitReport report;
  CHECK_FALSE(fit(*c.expanded, model, *c.map, report, c.diagnostics));
  CHECK(numbers(c.diagnostics) == std::vector<int>{343});
  CHECK(c.diagnostics.all()[0].hint.find("LeftForearn") != std::string::npos);
  CHECK(c.diagnostics.all()[0].hint.find("free below mixamorig:LeftArm: mixamorig:LeftForearn") !=
        std::string::npos);
  CHECK(report.missing == std::vector<std::string>{"arm_l_elbow"});

  Diagnostics second;
  Map partial = *c.map;
  std::erase_if(partial.entries, [](const MapEntry& entry) { return entry.label == "elbow"; });
  FitReport other;
  CHECK_FALSE(fit(*c.expanded, as_model(*c.placed, {}, c.names), partial, other, second));
  CHECK(numbers(second) == std::vector<int>{344, 344});

  Diagnostics third;
  Map twice = *c.map;
  for (MapEntry& entry : twice.entries)
    if (entry.local == "arm_l" && entry.label == "wrist") entry.bones = {{"LeftForeArm"}};
  CHECK_FALSE(fit(*c.expanded, as_model(*c.placed, {}, c.names), twice, other, third));
  CHECK(numbers(third) == std::vector<int>{345, 343});

  Diagnostics fourth;
  auto circle = as_model(*c.placed, {}, c.names);
  circle.joints[0].parent = 1;
  CHECK_FALSE(fit(*c.expanded, circle, *c.map, other, fourth));
  CHECK(numbers(fourth) == std::vector<int>{350});
}

TEST_CASE(
    "templates fit: a required joint that the map calls absent is made in line with its bone") {
  Case c;
  for (MapEntry& entry : c.map->entries) {
    if (entry.label != "wrist" && entry.label != "clavicle") continue;
    entry.bones.clear();
    entry.absent = true;
  }
  // The left forearm points down and is half as long as the template's: so does what is made.
  auto model = as_model(*c.placed, {}, [&](const tags::TaggedJoint& joint) -> std::string {
    const bool gone = joint.ids.label == "wrist" || joint.ids.local.find("hand") == 6;
    return gone ? "" : c.names(joint);
  });
  math::Vec3 shoulder, elbow;
  for (tags::ForeignJoint& joint : model.joints) {
    if (joint.name == "mixamorig:LeftArm") shoulder = joint.rest.origin;
    if (joint.name != "mixamorig:LeftForeArm") continue;
    elbow = joint.rest.origin = shoulder + math::Vec3{0, -0.14, 0};
  }
  FitReport report;
  const auto fitted = fit(*c.expanded, model, *c.map, report, c.diagnostics);
  REQUIRE_MESSAGE(fitted, render(c.diagnostics, false));
  CHECK(report.helpers == std::vector<std::string>{"root", "arm_l_wrist", "arm_r_wrist"});
  const std::set<std::string> dropped(report.dropped.begin(), report.dropped.end());
  CHECK(dropped.count("arm_l_clavicle") == 1);
  const std::size_t wrist = joint_named(*fitted, "arm_l_wrist");
  CHECK(fitted->joints[wrist].foreign_node == -1);
  CHECK(fitted->joints[wrist].ids.label == "wrist");
  CHECK(fitted->joints[static_cast<std::size_t>(fitted->joints[wrist].parent)].name ==
        "mixamorig:LeftForeArm");
  const math::Vec3 forearm = fitted->world(wrist).origin - elbow;
  CHECK(length(forearm) == doctest::Approx(0.125).epsilon(0.02));
  CHECK(dot(normalised(forearm), math::Vec3{0, -1, 0}) > 0.98);
}

TEST_CASE("templates fit: twist bones beside the next one are told from other bones") {
  Case c;
  auto model = as_model(*c.placed, {}, c.names);
  int arm = -1;
  math::Vec3 shoulder, elbow;
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    if (model.joints[i].name == "mixamorig:LeftArm") {
      arm = static_cast<int>(i);
      shoulder = model.joints[i].rest.origin;
    }
    if (model.joints[i].name == "mixamorig:LeftForeArm") elbow = model.joints[i].rest.origin;
  }
  const auto add = [&](const std::string& name, math::Vec3 at) {
    tags::ForeignJoint bone = model.joints[static_cast<std::size_t>(arm)];
    bone.name = name;
    bone.node = 900 + static_cast<int>(model.joints.size());
    bone.parent = arm;
    bone.rest.origin = at;
    model.joints.push_back(bone);
  };
  add("twist_01", math::lerp(shoulder, elbow, 0.0));
  add("twist_02", math::lerp(shoulder, elbow, 0.6));
  add("sleeve", math::lerp(shoulder, elbow, 0.5) + math::Vec3{0, -0.1, 0});
  FitReport report;
  const auto fitted = fit(*c.expanded, model, *c.map, report, c.diagnostics);
  REQUIRE_MESSAGE(fitted, render(c.diagnostics, false));
  CHECK(report.twists == std::vector<std::string>{"twist_01", "twist_02"});
  CHECK(report.extra == std::vector<std::string>{"sleeve"});
}

TEST_CASE("templates fit: another kind of creature is a warning") {
  Case c;
  auto model = as_model(*c.placed, {}, c.names);
  FitReport same;
  CHECK(fit(*c.expanded, model, *c.map, same, c.diagnostics));
  CHECK(same.misfit < 1e-6);
  // On all fours: what was up is forward, and the limbs hang down.
  for (tags::ForeignJoint& joint : model.joints) {
    const math::Vec3 at = joint.rest.origin;
    const bool limb = joint.name.find("Arm") != std::string::npos ||
                      joint.name.find("Hand") != std::string::npos ||
                      joint.name.find("Leg") != std::string::npos ||
                      joint.name.find("Foot") != std::string::npos;
    const bool left = joint.name.find("Left") != std::string::npos;
    const math::Vec3 spine{0, 0.5, at.y};  // lies along the ground
    joint.rest.origin = limb ? math::Vec3{left ? 0.1 : -0.1, 0.5 - 0.6 * std::abs(at.x),
                                          joint.name.find("Arm") != std::string::npos ||
                                                  joint.name.find("Hand") != std::string::npos
                                              ? 1.0
                                              : 0.2}
                             : spine;
  }
  Diagnostics diagnostics;
  FitReport other;
  CHECK(fit(*c.expanded, model, *c.map, other, diagnostics));
  CHECK(other.misfit > 0.65);
  CHECK(numbers(diagnostics) == std::vector<int>{349});
}

TEST_CASE("templates fit: bones whose sides are exchanged are a warning") {
  Case c;
  auto model = as_model(*c.placed, {}, c.names);
  for (tags::ForeignJoint& joint : model.joints) {
    const std::size_t left = joint.name.find("Left"), right = joint.name.find("Right");
    if (left != std::string::npos) joint.name.replace(left, 4, "Right");
    if (right != std::string::npos) joint.name.replace(right, 5, "Left");
  }
  FitReport report;
  CHECK(fit(*c.expanded, model, *c.map, report, c.diagnostics));
  CHECK(numbers(c.diagnostics) == std::vector<int>{351});
}

TEST_CASE("templates fit: a flat template is measured by its size, and one on end by its line") {
  Diagnostics diagnostics;
  const auto expanded = expand_text(
      with_head("joints:\n"
                "  - {name: palm, at: [0, 0, 0], local: hand, label: palm}\n"
                "  - {name: tip, parent: palm, at: [0.1, 0.001, 0], local: hand, label: tip}\n"
                "  - {name: side, parent: palm, at: [0, 0, 0.05], local: hand, label: side}\n"),
      diagnostics);
  REQUIRE_MESSAGE(expanded, render(diagnostics, false));
  const auto placed = place(*expanded, diagnostics);
  REQUIRE(placed);
  Map map;
  map.name = "flat";
  for (const char* label : {"palm", "tip", "side"}) {
    MapEntry entry;
    entry.local = "hand";
    entry.label = label;
    entry.bones = {{label}};
    map.entries.push_back(entry);
  }
  const math::Affine ancestor = math::rotation(math::axis_angle({0, 0, 1}, 0.7)) *
                                math::Affine{{{3, 0, 0}, {0, 3, 0}, {0, 0, 3}}, {1, 2, 3}};
  const auto name = [](const tags::TaggedJoint& joint) { return joint.ids.label; };
  auto model = as_model(*placed, {}, name);
  for (tags::ForeignJoint& joint : model.joints) joint.rest = ancestor * joint.rest;
  FitReport report;
  const auto fitted = fit(*expanded, model, map, report, diagnostics);
  REQUIRE_MESSAGE(fitted, render(diagnostics, false));
  CHECK(fitted->character.unit == doctest::Approx(3).epsilon(1e-6));
  CHECK(distance(fitted->character.left,
                 math::rotate(math::axis_angle({0, 0, 1}, 0.7), {1, 0, 0})) < 1e-9);

  model.joints.pop_back();  // two joints left, on a line
  Map line = map;
  line.entries.pop_back();
  line.entries.push_back({"hand", "side", {}, true, {}});
  FitReport other;
  const auto on_line = fit(*expanded, model, line, other, diagnostics);
  REQUIRE_MESSAGE(on_line, render(diagnostics, false));
  CHECK(other.helpers == std::vector<std::string>{"side"});
  CHECK(on_line->character.unit == doctest::Approx(3).epsilon(1e-6));
}

TEST_CASE("templates fit: asymmetry above two percent, other hierarchies and shear are warnings") {
  Case c;
  auto model = as_model(*c.placed, {}, c.names);
  model.file = "hero.glb";
  for (tags::ForeignJoint& joint : model.joints)
    if (joint.name == "mixamorig:LeftHand") joint.rest.origin.y -= 0.1;
  FitReport report;
  CHECK(fit(*c.expanded, model, *c.map, report, c.diagnostics));
  CHECK(numbers(c.diagnostics) == std::vector<int>{346});
  CHECK(c.diagnostics.all()[0].place.file == "hero.glb");
  REQUIRE(report.asymmetry);
  CHECK(report.asymmetry->metres == doctest::Approx(0.1));

  Diagnostics second;
  auto flat = as_model(*c.placed, {}, c.names);
  for (tags::ForeignJoint& joint : flat.joints)
    if (joint.name == "mixamorig:LeftHandIndex2") joint.parent = 0;
  FitReport other;
  CHECK(fit(*c.expanded, flat, *c.map, other, second));
  CHECK(numbers(second) == std::vector<int>{347});

  Diagnostics third;
  auto sheared = as_model(*c.placed, {}, c.names);
  for (tags::ForeignJoint& joint : sheared.joints)
    if (joint.name == "mixamorig:Head")
      joint.rest.linear.x = joint.rest.linear.x + joint.rest.linear.y * 0.5;
  FitReport last;
  CHECK(fit(*c.expanded, sheared, *c.map, last, third));
  CHECK(numbers(third) == std::vector<int>{348});
}

TEST_CASE("templates fit: Xbot's bones match, and its character is measured from them") {
  const auto xbot = read_xbot();
  if (!xbot) {
    MESSAGE("corpus not there: Xbot is not tested");
    return;
  }
  Case c;
  const auto map = detect_map(*c.expanded, *xbot, {template_folder()}, c.diagnostics);
  REQUIRE(map);
  CHECK(map->name == "mixamo");
  FitReport report;
  const auto fitted = fit(*c.expanded, *xbot, *map, report, c.diagnostics);
  REQUIRE_MESSAGE(fitted, render(c.diagnostics, false));
  CHECK(c.diagnostics.all().empty());
  CHECK(report.matched.size() == 67);
  CHECK(report.extra.empty());
  CHECK(report.dropped.size() == 12);  // the metacarpals and lids
  CHECK(fitted->joints.size() == 68);
  CHECK(report.height_metres == doctest::Approx(1.8).epsilon(0.06));
  CHECK(fitted->character.unit == doctest::Approx(1).epsilon(0.1));
  CHECK(fitted->character.up == math::Vec3{0, 1, 0});
  CHECK(fitted->character.left == math::Vec3{1, 0, 0});
  CHECK(distance(fitted->character.forward, {0, 0, 1}) < 1e-12);
  REQUIRE(report.asymmetry);
  CHECK(report.asymmetry->share < 0.02);
  for (std::size_t i = 0; i < fitted->joints.size(); ++i)
    for (const tags::ForeignJoint& joint : xbot->joints)
      if (joint.node == fitted->joints[i].foreign_node)
        CHECK(distance(fitted->world(i).origin, joint.rest.origin) < 1e-6);
  const std::size_t root = joint_named(*fitted, "root");
  CHECK(std::abs(fitted->world(root).origin.y) < 0.05);
  const std::size_t hips = joint_named(*fitted, "mixamorig:Hips");
  CHECK(std::abs(fitted->world(root).origin.x - fitted->world(hips).origin.x) < 0.01);
}
