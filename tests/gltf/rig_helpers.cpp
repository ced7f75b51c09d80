// SPDX-License-Identifier: MIT
// Rigs for the tests of src/gltf, made by hand.
#include "rig_helpers.h"

#include <doctest/doctest.h>

#include "file_helpers.h"

namespace rigc::gltf::test {

using scene::Kind;
using scene::NodeId;
using scene::Plug;
namespace transform = scene::transform;

RigMaker::RigMaker(std::uint32_t id)
    : RigMaker(id, std::make_unique<Rig>(), std::make_unique<scene::Journal>()) {}

RigMaker::RigMaker(std::uint32_t id, std::unique_ptr<Rig> rig,
                   std::unique_ptr<scene::Journal> journal)
    : edit(rig->scene, *journal, nullptr), rig_(std::move(rig)), journal_(std::move(journal)) {
  rig_->id = id;
  rig_->skeleton.name = "lamp";
  rig_->skeleton.global = "lamp";
}

NodeId RigMaker::joint(const std::string& name, int parent, const math::Trs& rest,
                       int foreign_node) {
  tags::TaggedJoint joint;
  joint.name = name;
  joint.key.uid = hash64(name);
  joint.parent = parent;
  joint.ids = {"lamp", "arm", name};
  joint.rest = rest;
  joint.foreign_node = foreign_node;
  rig_->skeleton.joints.push_back(joint);

  scene::Node node;
  node.kind = Kind::joint;
  node.name = name;
  node.ids = joint.ids;
  node.identity.rig = rig_->id;
  node.identity.owner = joint.key;
  node.origin.joint = name;
  if (parent >= 0)
    node.parent = joint_named(*rig_, rig_->skeleton.joints[static_cast<std::size_t>(parent)].name);
  const NodeId id = edit.make(node);
  edit.set({id, transform::kTranslate}, rest.translation);
  edit.set({id, transform::kRotation}, rest.rotation);
  edit.set({id, transform::kScale}, rest.scale);
  return id;
}

NodeId RigMaker::node(Kind kind, const std::string& role, NodeId parent, std::uint32_t command) {
  const CommandRecord& record = rig_->commands[command];
  scene::Node node;
  node.kind = kind;
  node.parent = parent;
  node.name = record.joint + "_" + role;
  node.ids = {"lamp", "arm", record.joint};
  node.identity = {rig_->id, record.holder, record.holder, record.id, role, 0};
  node.command = command;
  node.module = record.module;
  node.origin = {{}, record.joint, record.id};
  return edit.make(node);
}

void RigMaker::command(const std::string& id, const std::string& module) {
  const tags::TaggedJoint& joint = rig_->skeleton.joints.back();
  rig_->commands.push_back({joint.key, joint.name, id, module, true, "templates/lamp.yaml", 12});
}

namespace {

/// Numbers of the two template files, which are the first that anybody adds.
std::pair<std::uint32_t, std::uint32_t> add_files(Diagnostics& diagnostics) {
  const std::uint32_t file = diagnostics.sources().add("templates/lamp.yaml", "");
  return {file, diagnostics.sources().add("templates/parts/arm.yaml", "")};
}

void add_tags(Rig& rig, Diagnostics& diagnostics) {
  tags::TaggedSkeleton& skeleton = rig.skeleton;
  const auto [file, part] = add_files(diagnostics);
  skeleton.templates = {{"lamp", 3, "lamp.yaml", hex16(hash64("lamp"))},
                        {"arm", 2, "parts/arm", hex16(hash64("arm"))}};
  skeleton.module_pins = {{"control", 1}};
  skeleton.features = {{"ikfk", "limb", "IK/FK", "switches \"it\"", true, {"arms", "legs"}},
                       {"stretch", "limb", "", "", false, {}}};
  skeleton.shapes = {
      {"blade", {{{0, 0, 0}, {0.1, 0.2, 1.0 / 3}}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}}};
  skeleton.character.height = 1.25;
  skeleton.character.unit = 100;
  rig.settings.features = {{"arm", "ikfk", "arms", false}, {"", "stretch", "", true}};
  rig.settings.groups = {{"hand", false}};
  rig.settings.rest = "walk@0.5";
  rig.modules = {{"control", 1}, {"parent_constraint", 2}};

  tags::TaggedJoint& joint = skeleton.joints.back();
  joint.was = {{hash64("upperarm"), 0}, {hash64("humerus"), 3}};
  joint.mirror = {true, {hash64("other"), 0}};
  joint.template_parent = {hash64("above"), 1};
  joint.optional = true;
  joint.template_index = 1;
  joint.span = {file, 4, 5, 0};
  joint.features = {{"ikfk", "limb", "arms", false, {part, 7, 3, 0}}, {}};
  tags::CommandTag command;
  command.module = "control";
  command.id = "main";
  command.comment = "moves \n it";
  command.stage = "finish";
  command.on = false;
  command.feature = 1;
  command.was = {"elbow/main"};
  command.span = {part, 9, 1, 0};
  Literal list;
  list.kind = Literal::Kind::list;
  list.items = {Literal::of(0.1), Literal::of("x"), Literal::of(true), Literal{}};
  command.with = {
      {"shape", {}, Literal::of("true")}, {"size", {}, Literal::of(0.3)}, {"offset", {}, list}};
  joint.commands = {command};
}

/// A control under a zero at a joint's rest, and a constraint that makes the joint follow.
NodeId add_control(RigMaker& maker, NodeId joint, NodeId parent, std::uint32_t command) {
  const scene::Scene& scene = maker.edit.scene();
  const NodeId zero = maker.node(Kind::transform, "zero", parent, command);
  const math::Affine above = parent.valid() ? scene.rest_world(parent) : math::Affine{};
  const math::Trs rest = math::decompose(math::inverse(above) * scene.rest_world(joint));
  maker.edit.set({zero, transform::kTranslate}, rest.translation);
  maker.edit.set({zero, transform::kRotation}, rest.rotation);
  const NodeId control = maker.node(Kind::control, "control", zero, command);
  maker.edit.set({control, scene::control::kShape}, std::string("square"));
  maker.edit.set({control, scene::control::kPoints},
                 std::vector<double>{5, -1, 0, -1, 1, 0, -1, 1, 0, 1, -1, 0, 1, -1, 0, -1});
  maker.edit.set({control, scene::control::kColor}, math::Vec3{1, 0.5, 0});
  const NodeId driver = maker.node(Kind::parent_constraint, "driver", {}, command);
  namespace constraint = scene::constraint;
  maker.edit.connect({joint, transform::kParent}, {driver, constraint::kParent});
  maker.edit.connect({control, transform::kWorld}, {driver, constraint::kTargets, 0});
  maker.edit.set({driver, constraint::kWeights, 0}, 1.0);
  maker.edit.set({driver, constraint::kOffsets, 0}, math::Affine{});
  maker.edit.connect({driver, constraint::kTranslate}, {joint, transform::kTranslate});
  maker.edit.connect({driver, constraint::kRotation}, {joint, transform::kRotation});
  return control;
}

RigMaker make_sample(Diagnostics& diagnostics, int foreign_base, int foreign_tip) {
  RigMaker maker(0);
  const double third = 1.0 / 3;
  maker.joint("root", -1, {});
  maker.joint("base", 0, {{0, 0.25, 0}, math::axis_angle({0, 0, 1}, third), {1, 1, 1}},
              foreign_base);
  const NodeId base = joint_named(maker.rig(), "base");
  maker.command("main", "control");
  const NodeId base_control = add_control(maker, base, {}, 0);
  const NodeId tip = maker.joint("tip", 1, {{0, 1, 0}, {}, {1, 1, 1}}, foreign_tip);
  maker.command("aim", "control");
  const NodeId tip_control = add_control(maker, tip, base_control, 1);
  using Flavour = scene::UserAttribute::Flavour;
  maker.edit.add_attribute(tip_control, {"ik_fk", Flavour::number, 1, 0.1, 0, 1, true});
  maker.edit.add_attribute(tip_control, {"roll", Flavour::angle, third, 0, {}, {}, true});
  maker.edit.add_attribute(tip_control, {"count", Flavour::integer, 3, 0, {}, {}, true});
  maker.edit.add_attribute(tip_control, {"secret", Flavour::boolean, 1, 1, {}, {}, false});
  const NodeId expression = maker.node(Kind::expression, "sum", {}, 1);
  maker.edit.set({expression, scene::expression::kCode}, std::string("$0 * 2 < 3"));
  maker.edit.connect({tip_control, scene::kUserAttributes},
                     {expression, scene::expression::kInputs, 0});
  maker.edit.connect({expression, scene::expression::kOutput},
                     {tip_control, transform::kScale, -1, 1});
  // Children in an order that is not the one they were made in.
  const NodeId late = maker.node(Kind::transform, "late", {}, 1);
  maker.edit.reparent(maker.edit.scene()[base_control].children[0], late);
  maker.edit.reparent(late, base_control);
  maker.edit.reparent(with_role(maker.rig(), "zero"), joint_named(maker.rig(), "root"));
  add_tags(maker.rig(), diagnostics);
  return maker;
}

}  // namespace

Rig sample_rig(Diagnostics& diagnostics, int foreign_base, int foreign_tip) {
  return make_sample(diagnostics, foreign_base, foreign_tip).take();
}

Rig proxy_rig(Diagnostics& diagnostics) {
  RigMaker maker = make_sample(diagnostics, -1, -1);
  maker.command("body", "proxy_mesh");
  const NodeId mesh = maker.node(Kind::mesh, "mesh", {}, 2);
  std::vector<double> parts;
  std::int32_t element = 0;
  for (const char* name : {"base", "tip"}) {
    maker.edit.connect({joint_named(maker.rig(), name), transform::kWorld},
                       {mesh, scene::mesh::kJoints, element});
    const double style = element++;
    parts.insert(parts.end(), {style, 0, 0, 0, 0, 0.8, 0, 1, 0, 0, 0.2, 0.15, 0.2, 0.5, 0.9});
  }
  maker.edit.set({mesh, scene::mesh::kParts}, parts);
  return maker.take();
}

File model_file(const std::string& text, const std::string& name) {
  const std::string path = make_folder("broken/" + name) + "/model.gltf";
  write_bytes(path, text);
  Diagnostics diagnostics;
  auto opened = gltf::open(path, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(opened);
  return std::move(*opened);
}

File written(const File& file, Rig& rig, const std::string& name, int ancestor) {
  Diagnostics diagnostics;
  add_files(diagnostics);
  Patch patch(file);
  REQUIRE(write_rig(patch, rig, ancestor, diagnostics));
  const auto output = patch.finish(true, diagnostics);
  REQUIRE(output);
  const std::string path = make_folder(name) + "/rig.glb";
  write_output(*output, path, folder_of(file.path));
  if (!file.path.empty()) allow_messages_of(path, file.path);
  auto opened = gltf::open(path, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(opened);
  return std::move(*opened);
}

NodeId with_role(const Rig& rig, std::string_view role) {
  for (const NodeId id : rig.scene.nodes())
    if (rig.scene[id].identity.role == role) return id;
  FAIL("no node with role " << role);
  return {};
}

NodeId joint_named(const Rig& rig, std::string_view name) {
  for (const NodeId id : rig.scene.nodes())
    if (rig.scene[id].is_skeleton() && rig.scene[id].name == name) return id;
  FAIL("no joint " << name);
  return {};
}

}  // namespace rigc::gltf::test
