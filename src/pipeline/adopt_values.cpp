// SPDX-License-Identifier: MIT
// Adopting what is not keyed: transforms and attributes of controls, placements of joints.
// Test: tests/pipeline/adopt_test.cpp
#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "gltf/float_text.h"
#include "gltf/rig_json_joints.h"
#include "gltf/skeletons.h"
#include "gltf/splice.h"
#include "pipeline/adopt_steps.h"
#include "scene/access.h"
#include "tags/fitted.h"
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

/// Where all nodes of a file rest.
struct Rested {
  std::vector<Affine> worlds;  ///< by node
  std::vector<bool> bound;     ///< by node: a joint of a skin, or between some
};

/// Joints of skins in their bind pose, whatever pose the program left them in; what hangs under
/// them with them.
Rested rest_of(const Side& side) {
  const std::size_t count = side.slim.nodes.size();
  Rested out{std::vector<Affine>(count), std::vector<bool>(count, false)};
  Diagnostics quiet;
  const auto skeletons = gltf::read_skeletons(side.file, "bind", quiet);
  for (std::size_t i = 0; skeletons && i < skeletons->size(); ++i) {
    const tags::ForeignSkeleton& skeleton = (*skeletons)[i];
    for (const tags::ForeignJoint& joint : skeleton.joints) {
      const auto node = static_cast<std::size_t>(joint.node);
      out.worlds[node] = skeleton.ancestor_world * joint.rest;
      out.bound[node] = true;
    }
  }
  for (const int index : side.slim.preorder) {
    const auto node = static_cast<std::size_t>(index);
    if (out.bound[node]) continue;
    const gltf::SlimNode& own = side.slim.nodes[node];
    out.worlds[node] =
        own.parent < 0 ? own.matrix : out.worlds[static_cast<std::size_t>(own.parent)] * own.matrix;
  }
  return out;
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

/// What guides did to a joint, which stands now where somebody put it by hand.
std::string with_fitted(std::string joint, const std::optional<math::Trs>& fitted) {
  joint = gltf::with_member(joint, "moved", "");
  if (!fitted) return gltf::with_member(joint, "fitted", "");
  json::Writer writer;
  gltf::write_rest(writer.begin_object(), *fitted);
  return gltf::with_member(joint, "fitted", writer.end_object().take());
}

/// Where joints rest now; and where they are fitted, where guides moved what they hang on.
struct NewRest {
  math::Trs rest;
  std::optional<math::Trs> fitted;
};
using Rests = std::map<JointKey, NewRest>;

using JointTwins = std::map<JointKey, const Twin*>;

bool same_place(const Twin& twin, const Affine& a, const Affine& b) {
  const math::Trs left = math::decompose(a), right = math::decompose(b);
  return same_value(twin, Path::translation, &left.translation.x, &right.translation.x) &&
         same_value(twin, Path::rotation, &left.rotation.x, &right.rotation.x);
}

/// The motion that most joints of a rig have in common: Blender binds a skin in the pose in which
/// it finds the topmost joint, so that the whole character rests elsewhere although nobody moved
/// it.
Affine common_motion(const JointTwins& joints, const std::vector<Affine>& now,
                     const std::vector<Affine>& before) {
  constexpr std::size_t kTried = 16;
  std::vector<const Twin*> all;
  for (const auto& [key, twin] : joints) all.push_back(twin);
  const auto world = [](const std::vector<Affine>& worlds, int node) {
    return worlds[static_cast<std::size_t>(node)];
  };
  Affine best;
  std::size_t most = 0;
  for (std::size_t i = 0; i < all.size(); i += 1 + all.size() / kTried) {
    const Affine motion = world(now, all[i]->edited) * inverse(world(before, all[i]->original));
    const auto count = std::count_if(all.begin(), all.end(), [&](const Twin* twin) {
      return same_place(*twin, motion * world(before, twin->original), world(now, twin->edited));
    });
    if (static_cast<std::size_t>(count) <= most) continue;
    most = static_cast<std::size_t>(count);
    best = motion;
  }
  return 2 * most > all.size() ? best : Affine();
}

/// The joints of a rig that rest elsewhere below their parents. A joint of a model stands in the
/// author's pose, so what counts is by how much it was moved.
Rests moved_joints(const gltf::Rig& rig, const JointTwins& twins, const Rested& now,
                   const Rested& before) {
  Rests out;
  const auto& joints = rig.skeleton.joints;
  const Affine back = inverse(common_motion(twins, now.worlds, before.worlds));
  for (const tags::TaggedJoint& joint : joints) {
    const auto own = twins.find(joint.key);
    if (own == twins.end()) continue;
    const Twin* parent = nullptr;
    if (joint.parent >= 0) {
      const auto found = twins.find(joints[static_cast<std::size_t>(joint.parent)].key);
      if (found == twins.end()) continue;
      parent = found->second;
    }
    const auto below = [](const Affine* above, const Affine& world) {
      return above ? inverse(*above) * world : world;
    };
    const auto at = [](const Rested& rested, int node) {
      return &rested.worlds[static_cast<std::size_t>(node)];
    };
    const auto bound = [&](const Twin* twin) {
      return twin && now.bound[static_cast<std::size_t>(twin->edited)];
    };
    const bool carried = bound(own->second) && !bound(parent);
    const Affine world = *at(now, own->second->edited);
    const Affine was =
        below(parent ? at(before, parent->original) : nullptr, *at(before, own->second->original));
    const Affine is =
        below(parent ? at(now, parent->edited) : nullptr, carried ? back * world : world);
    if (same_place(*own->second, was, is)) continue;
    math::Trs rest =
        templates::tidy(math::decompose(math::compose(joint.rest) * inverse(was) * is));
    rest.scale = joint.rest.scale;
    out.emplace(joint.key, NewRest{rest, {}});
  }
  return out;
}

/// What was adopted is there to stay: no guides put it elsewhere.
void find_fitted(const tags::TaggedSkeleton& skeleton, Rests& rests) {
  tags::TaggedSkeleton now = skeleton;
  std::set<JointKey> keys;
  for (tags::TaggedJoint& joint : now.joints) {
    const auto found = rests.find(joint.key);
    if (found == rests.end()) continue;
    joint.rest = found->second.rest;
    keys.insert(joint.key);
  }
  tags::settle(now, keys);
  for (const tags::TaggedJoint& joint : now.joints)
    if (const auto found = rests.find(joint.key); found != rests.end())
      found->second.fitted = joint.guide.fitted;
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
        joints.replace(j, with_fitted(with_rest(std::string(texts[j].text()), rest->second.rest),
                                      rest->second.fitted));
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
  const Rested now = rest_of(edited), before = rest_of(original);
  std::map<std::uint32_t, std::pair<const gltf::Rig*, JointTwins>> by_rig;
  for (const Twin& twin : twins) {
    const scene::Node& node = twin.rig->scene[twin.id];
    if (!node.is_skeleton()) continue;
    by_rig[twin.rig->id].first = twin.rig;
    by_rig[twin.rig->id].second.emplace(node.identity.owner, &twin);
  }
  std::map<std::uint32_t, Rests> moved;
  for (const auto& [id, own] : by_rig) {
    const auto& [rig, joints] = own;
    Rests rests = moved_joints(*rig, joints, now, before);
    report.joints += rests.size();
    find_fitted(rig->skeleton, rests);
    for (const tags::TaggedJoint& joint : rig->skeleton.joints) {
      const auto rest = rests.find(joint.key);
      if (rest == rests.end() || joint.foreign_node >= 0) continue;  // the model's own stay
      const int node = joints.at(joint.key)->original;
      patch.set_member("nodes", node, "translation",
                       gltf::float_list(&rest->second.rest.translation.x, 3));
      patch.set_member("nodes", node, "rotation",
                       gltf::float_list(&rest->second.rest.rotation.x, 4));
    }
    if (!rests.empty()) moved.emplace(id, std::move(rests));
  }
  if (!moved.empty())
    patch.set_root_extension("RIGC_rig",
                             with_rests(original.file.root()["extensions"]["RIGC_rig"], moved));
}

}  // namespace rigc::pipeline
