// SPDX-License-Identifier: MIT
// Adopting what is not keyed: transforms and attributes of controls, placements of joints.
// Test: tests/pipeline/adopt_test.cpp
#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "gltf/float_text.h"
#include "gltf/skeletons.h"
#include "gltf/splice.h"
#include "pipeline/adopt_steps.h"
#include "scene/access.h"
#include "templates/chain.h"

namespace rigc::pipeline {
namespace {

using anim::Path;
using math::Affine;

struct Part {
  Path path;
  const char* member;
  unsigned bits;  ///< scene::component_bits
  const double* first;
  const double* before;
  std::size_t count;
};

/// Takes over the parts of a transform that neither keys nor connections nor locks decide.
bool adopt_transform(const Side& edited, const Side& original, const Twin& twin,
                     const std::set<Target>& keyed, gltf::Patch& patch) {
  const math::Trs now = edited.slim.node(twin.edited).local;
  const math::Trs before = original.slim.node(twin.original).local;
  const scene::Scene& scene = twin.rig->scene;
  const unsigned held =
      scene::bits_at(scene, twin.id, scene::control::kLocked) | scene::driven_bits(scene, twin.id);
  const Part parts[] = {
      {Path::translation, "translation", scene::kTranslateBits, &now.translation.x,
       &before.translation.x, 3},
      {Path::rotation, "rotation", scene::kRotateBits, &now.rotation.x, &before.rotation.x, 4},
      {Path::scale, "scale", scene::kScaleBits, &now.scale.x, &before.scale.x, 3}};
  bool moved = false;
  for (const Part& part : parts) {
    const bool decided =
        (held & part.bits) == part.bits || keyed.count({twin.original, part.path}) != 0;
    if (decided || same_value(twin, part.path, part.first, part.before)) continue;
    patch.set_member("nodes", twin.original, part.member, gltf::float_list(part.first, part.count));
    moved = true;
  }
  return moved;
}

/// Takes over custom properties; those that the other program lost stay as they are.
std::size_t adopt_attributes(const json::Value& extras, const Twin& twin, gltf::Patch& patch) {
  using Flavour = scene::UserAttribute::Flavour;
  const scene::Scene& scene = twin.rig->scene;
  std::size_t count = 0;
  for (std::size_t i = 0; i < scene[twin.id].user.size(); ++i) {
    const scene::UserAttribute& attribute = scene[twin.id].user[i];
    const scene::Plug plug{twin.id, static_cast<std::uint16_t>(scene::kUserAttributes + i)};
    const json::Value value = extras[attribute.name];
    if (!value || !attribute.keyable || scene.source(plug)) continue;
    std::optional<double> number = value.number();
    if (const auto flag = value.boolean()) number = *flag ? 1 : 0;
    if (!number || same_value(twin, Path::attribute, &*number, &attribute.value)) continue;
    const bool whole =
        attribute.flavour == Flavour::integer || attribute.flavour == Flavour::boolean;
    std::string text = whole ? number_text(std::round(*number)) : gltf::float_text(*number);
    if (!whole && text.find_first_of(".e") == std::string::npos) text += ".0";
    patch.set_extra(twin.original, attribute.name, text);
    ++count;
  }
  return count;
}

/// World matrices of all nodes at rest: joints of skins in their bind pose, whatever pose the
/// program left them in.
std::vector<Affine> rest_worlds(const Side& side) {
  std::vector<Affine> worlds;
  for (const gltf::SlimNode& node : side.slim.nodes) worlds.push_back(node.world);
  Diagnostics quiet;
  const auto skeletons = gltf::read_skeletons(side.file, "bind", quiet);
  if (!skeletons) return worlds;
  for (const tags::ForeignSkeleton& skeleton : *skeletons)
    for (const tags::ForeignJoint& joint : skeleton.joints)
      worlds[static_cast<std::size_t>(joint.node)] = skeleton.ancestor_world * joint.rest;
  return worlds;
}

/// A joint's new rest in the rig's text: `translation`, `rotation`, `scale`, as write_rig has them.
std::string with_rest(std::string joint, const math::Trs& rest) {
  const auto numbers = [](const double* first, std::size_t count) {
    json::Writer writer;
    return writer.numbers(first, count).take();
  };
  const bool turned = rest.rotation != math::Quat{}, scaled = rest.scale != math::Vec3{1, 1, 1};
  joint =
      gltf::with_member(joint, "translation",
                        rest.translation == math::Vec3{} ? "" : numbers(&rest.translation.x, 3));
  joint = gltf::with_member(joint, "rotation", turned ? numbers(&rest.rotation.x, 4) : "");
  return gltf::with_member(joint, "scale", scaled ? numbers(&rest.scale.x, 3) : "");
}

using Rests = std::map<JointKey, math::Trs>;

/// The joints of a rig that rest elsewhere below their parents. A joint of a model stands in the
/// author's pose, so what counts is by how much it was moved.
Rests moved_joints(const gltf::Rig& rig, const std::map<JointKey, const Twin*>& twins,
                   const std::vector<Affine>& now, const std::vector<Affine>& before) {
  Rests out;
  const auto& joints = rig.skeleton.joints;
  for (const tags::TaggedJoint& joint : joints) {
    const auto own = twins.find(joint.key);
    if (own == twins.end()) continue;
    const Twin* parent = nullptr;
    if (joint.parent >= 0) {
      const auto found = twins.find(joints[static_cast<std::size_t>(joint.parent)].key);
      if (found == twins.end()) continue;
      parent = found->second;
    }
    const auto below = [](const std::vector<Affine>& worlds, int above, int node) {
      const Affine& world = worlds[static_cast<std::size_t>(node)];
      return above < 0 ? world : inverse(worlds[static_cast<std::size_t>(above)]) * world;
    };
    const Affine was = below(before, parent ? parent->original : -1, own->second->original);
    const Affine is = below(now, parent ? parent->edited : -1, own->second->edited);
    const math::Trs a = math::decompose(was), b = math::decompose(is);
    const Twin& twin = *own->second;
    if (same_value(twin, Path::translation, &a.translation.x, &b.translation.x) &&
        same_value(twin, Path::rotation, &a.rotation.x, &b.rotation.x))
      continue;
    math::Trs rest =
        templates::tidy(math::decompose(math::compose(joint.rest) * inverse(was) * is));
    rest.scale = joint.rest.scale;
    out.emplace(joint.key, rest);
  }
  return out;
}

/// RIGC_rig with the rests of some joints changed.
std::string with_rests(const json::Value& extension, const std::map<std::uint32_t, Rests>& rests) {
  gltf::Splice rigs(extension["rigs"]);
  const auto items = extension["rigs"].items();
  for (std::size_t r = 0; r < items.size(); ++r) {
    const auto id = items[r]["id"].integer();
    const auto moved = rests.find(static_cast<std::uint32_t>(id.value_or(0)));
    if (moved == rests.end()) continue;
    gltf::Splice joints(items[r]["joints"]);
    const auto texts = items[r]["joints"].items();
    for (std::size_t j = 0; j < texts.size(); ++j) {
      const auto key = parse_joint_key(texts[j]["key"].string().value_or(""));
      const auto rest = key ? moved->second.find(*key) : moved->second.end();
      if (rest != moved->second.end())
        joints.replace(j, with_rest(std::string(texts[j].text()), rest->second));
    }
    rigs.replace(r, gltf::with_member(std::string(items[r].text()), "joints", joints.text()));
  }
  return gltf::with_member(std::string(extension.text()), "rigs", rigs.text());
}

}  // namespace

void adopt_values(const Side& edited, const Side& original, const std::vector<Twin>& twins,
                  const std::set<Target>& keyed, gltf::Patch& patch, Adopted& report) {
  const auto nodes = edited.file.root()["nodes"].items();
  for (const Twin& twin : twins) {
    if (!twin.is_control()) continue;
    report.transforms += adopt_transform(edited, original, twin, keyed, patch) ? 1 : 0;
    const json::Value node = nodes[static_cast<std::size_t>(twin.edited)];
    report.attributes += adopt_attributes(node["extras"], twin, patch);
  }
}

void adopt_joints(const Side& edited, const Side& original, const std::vector<Twin>& twins,
                  gltf::Patch& patch, Adopted& report) {
  const std::vector<Affine> now = rest_worlds(edited), before = rest_worlds(original);
  std::map<const gltf::Rig*, std::map<JointKey, const Twin*>> by_rig;
  for (const Twin& twin : twins) {
    const scene::Node& node = twin.rig->scene[twin.id];
    if (node.is_skeleton()) by_rig[twin.rig].emplace(node.identity.owner, &twin);
  }
  std::map<std::uint32_t, Rests> moved;
  for (const auto& [rig, joints] : by_rig) {
    Rests rests = moved_joints(*rig, joints, now, before);
    report.joints += rests.size();
    for (const tags::TaggedJoint& joint : rig->skeleton.joints) {
      const auto rest = rests.find(joint.key);
      if (rest == rests.end() || joint.foreign_node >= 0) continue;  // the model's own stay
      const int node = joints.at(joint.key)->original;
      patch.set_member("nodes", node, "translation",
                       gltf::float_list(&rest->second.translation.x, 3));
      patch.set_member("nodes", node, "rotation", gltf::float_list(&rest->second.rotation.x, 4));
    }
    if (!rests.empty()) moved.emplace(rig->id, std::move(rests));
  }
  if (!moved.empty())
    patch.set_root_extension("RIGC_rig",
                             with_rests(original.file.root()["extensions"]["RIGC_rig"], moved));
}

}  // namespace rigc::pipeline
