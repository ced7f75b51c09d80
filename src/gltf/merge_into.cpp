// SPDX-License-Identifier: MIT
// Joins rigs: finds what hangs under what, makes one text of two, hangs the nodes. Test:
// tests/pipeline/merge_into_test.cpp
#include "gltf/merge_into.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "gltf/float_text.h"
#include "gltf/merge_codes.h"
#include "gltf/merge_into_parts.h"
#include "gltf/merge_places.h"
#include "gltf/splice.h"

namespace rigc::gltf {
namespace {

using json::Value;

std::vector<std::string> global_groups(const PatchRigs& rigs) {
  std::vector<std::string> out;
  for (const PatchRig& rig : rigs.rigs) out.push_back(rig.rig.skeleton.global);
  return out;
}

bool has_group(const Rig& rig, const std::string& local) {
  const auto& joints = rig.skeleton.joints;
  return std::any_of(joints.begin(), joints.end(),
                     [&](const tags::TaggedJoint& joint) { return joint.ids.local == local; });
}

int root_of(const Rig& rig, int joint) {
  const auto& joints = rig.skeleton.joints;
  while (joints[static_cast<std::size_t>(joint)].parent >= 0)
    joint = joints[static_cast<std::size_t>(joint)].parent;
  return joint;
}

/// Finds what the words of the command line mean.
class Finder {
 public:
  Finder(const PatchRigs& rigs, const std::string& path, Diagnostics& diagnostics)
      : rigs_(rigs), path_(path), diagnostics_(diagnostics) {}

  const PatchRig* target(const std::string& global) const {
    for (const PatchRig& rig : rigs_.rigs)
      if (rig.rig.skeleton.global == global) return &rig;
    report(fmt::format("there is no rig \"{}\" to join to", printable(global, 60)),
           suggest(global, global_groups(rigs_)));
    return nullptr;
  }

  /// The rig that an attachment speaks of.
  const PatchRig* source(const PatchRig& target, const Attach& attach) const {
    const PatchRig* found = nullptr;
    std::size_t count = 0;
    for (const PatchRig& rig : rigs_.rigs) {
      if (&rig == &target || !has_group(rig.rig, attach.local)) continue;
      if (!attach.global.empty() && rig.rig.skeleton.global != attach.global) continue;
      found = &rig;
      ++count;
    }
    if (count == 1) return found;
    report(
        count == 0
            ? fmt::format("no other rig has a local group \"{}\"", printable(attach.local, 60))
            : fmt::format("{} rigs have a local group \"{}\"", count, printable(attach.local, 60)),
        count == 0 ? "" : "say which one: --attach GLOBAL:LOCAL=LOCAL.LABEL");
    return nullptr;
  }

  /// The joint that takes it; -1 where there is not exactly one.
  int joint(const PatchRig& target, const Attach& attach) const {
    const auto& joints = target.rig.skeleton.joints;
    int found = -1;
    std::vector<std::string> words;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      if (joints[i].ids.local != attach.to_local) continue;
      if (!joints[i].ids.label.empty()) words.push_back(joints[i].ids.label);
      if (joints[i].ids.label != attach.to_label) continue;
      found = found == -1 ? static_cast<int>(i) : -2;
    }
    if (found >= 0) return found;
    report(fmt::format("the rig \"{}\" has {} \"{}.{}\"", target.rig.skeleton.global,
                       found == -1 ? "no joint" : "several joints", printable(attach.to_local, 60),
                       printable(attach.to_label, 60)),
           suggest(attach.to_label, words));
    return -1;
  }

  std::nullopt_t twice(const Attach& attach) const {
    report(
        fmt::format("the root above \"{}\" is attached to two joints", printable(attach.local, 60)),
        "");
    return std::nullopt;
  }

 private:
  void report(std::string message, std::string hint) const {
    diagnostics_.report(codes::kNoSuchJoin, Place(path_), std::move(message), std::move(hint));
  }

  const PatchRigs& rigs_;
  const std::string& path_;
  Diagnostics& diagnostics_;
};

/// Every root joint has one place to go to.
bool check_roots(const Joining& joining, const std::string& path, Diagnostics& diagnostics) {
  const auto& joints = joining.from.rig.skeleton.joints;
  bool complete = true;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (joints[i].parent >= 0 || joining.roots.count(static_cast<int>(i))) continue;
    complete = false;
    diagnostics.report(codes::kNotAttached, Place(path),
                       fmt::format("root \"{}\" of the rig \"{}\" is not attached to anything",
                                   printable(joints[i].name), joining.from.rig.skeleton.global),
                       fmt::format("add --attach {}=LOCAL.LABEL",
                                   joints[i].ids.local.empty() ? "GROUP" : joints[i].ids.local));
  }
  return complete;
}

/// Nothing comes to hang under itself, because one rig's joints may stand above the other's in the
/// file, and nothing under a joint that somebody took out of the rig's scene.
bool check_above(const Joining& joining, const Moved& moved, const PatchNodes& nodes,
                 const std::string& path, Diagnostics& diagnostics) {
  const Rig &into = joining.into.rig, &from = joining.from.rig;
  for (const auto& [id, place] : moved.nodes) {
    const auto& joint = into.skeleton.joints[static_cast<std::size_t>(place.first)];
    const int node = nodes.node_of(from, id);
    const scene::NodeId taker = joint_node(into, joint.key);
    if (!taker.valid()) {
      diagnostics.report(codes::kRigsClash, Place(path, "/extensions/RIGC_rig"),
                         fmt::format("the joint \"{}\" of the rig \"{}\" has no node",
                                     printable(joint.name), into.skeleton.global));
      return false;
    }
    int at = nodes.node_of(into, taker);
    while (at >= 0 && at != node) at = nodes.parents[static_cast<std::size_t>(at)];
    if (at < 0) continue;
    diagnostics.report(
        codes::kRigsClash, Place(path, fmt::format("/nodes/{}", node)),
        fmt::format("\"{}\" of the rig \"{}\" hangs under \"{}\", which cannot "
                    "hang under it",
                    printable(joint.name), into.skeleton.global, printable(from.scene[id].name)));
    return false;
  }
  return true;
}

/// Hangs the nodes of what had no parent under the nodes of joints, and gives them.
std::set<int> hang_nodes(Patch& patch, const Joining& joining, const Moved& moved,
                         PatchNodes& nodes) {
  std::set<int> hung;
  for (const auto& [id, place] : moved.nodes) {
    const Rig &into = joining.into.rig, &from = joining.from.rig;
    const auto& joint = into.skeleton.joints[static_cast<std::size_t>(place.first)];
    const int above = nodes.node_of(into, joint_node(into, joint.key));
    const int node = nodes.node_of(from, id);
    if (node < 0 || above < 0) continue;
    const auto at = static_cast<std::size_t>(node);
    const int known =
        from.scene[id].is_skeleton() ? from.skeleton.find(from.scene[id].identity.owner) : -1;
    const bool foreign =
        known >= 0 && from.skeleton.joints[static_cast<std::size_t>(known)].foreign_node >= 0;
    // A model's joint stays where the file has it, which may be in the middle of a clip.
    const math::Trs local =
        foreign ? math::decompose(math::inverse(nodes.world(above)) * nodes.world(node))
                : place.second;
    patch.remove_child(nodes.parents[at], node);
    patch.add_child(above, node);
    patch.set_member("nodes", node, "matrix", "");
    patch.set_member("nodes", node, "translation", float_list(&local.translation.x, 3));
    patch.set_member("nodes", node, "rotation", float_list(&local.rotation.x, 4));
    patch.set_member("nodes", node, "scale", float_list(&local.scale.x, 3));
    nodes.parents[at] = above;
    nodes.locals[at] = math::compose(local);
    hung.insert(node);
  }
  return hung;
}

/// `skeleton` of a skin is above all of its joints, or is not given.
void check_skins(Patch& patch, const PatchNodes& nodes) {
  for (int i = 0; i < patch.count("skins"); ++i) {
    const json::Document skin = parsed(patch.element("skins", i));
    const auto top = skin.root()["skeleton"].integer();
    if (!top) continue;
    const auto joints = skin.root()["joints"].items();
    const bool above_all = std::all_of(joints.begin(), joints.end(), [&](const Value& joint) {
      auto at = static_cast<int>(joint.integer().value_or(-1));
      while (at >= 0 && at != *top) at = nodes.parents[static_cast<std::size_t>(at)];
      return at == *top;
    });
    if (!above_all) patch.set_member("skins", i, "skeleton", "");
  }
}

/// What nodes say that they are.
void rename_marks(Patch& patch, std::uint32_t from, std::uint32_t into) {
  Places places;
  places.rigs[from] = into;
  for (int i = 0; i < patch.count("nodes"); ++i) {
    const json::Document node = parsed(patch.element("nodes", i));
    const auto mark = node.root()["extras"]["rigc"].string();
    const auto now = mark ? renumbered(*mark, places) : std::nullopt;
    if (now) patch.set_extra(i, "rigc", json::quote(*now));
  }
}

void report_keys(const Patch& patch, const std::string& path, const std::set<int>& hung,
                 Diagnostics& diagnostics) {
  for (int i = 0; i < patch.count("animations"); ++i) {
    const json::Document clip = parsed(patch.element("animations", i));
    for (const Value& channel : clip.root()["channels"].items()) {
      const auto node = channel["target"]["node"].integer();
      if (!node || hung.count(static_cast<int>(*node)) == 0) continue;
      diagnostics.report(
          codes::kKeysOnRoot, Place(path, fmt::format("/animations/{}", i)),
          fmt::format("clip \"{}\" has keys on node {}, which hangs under a joint now",
                      printable(clip.root()["name"].string().value_or("")), *node));
      break;
    }
  }
}

/// RIGC_rig with the joined rig's text, and without the one that joined.
std::string with_joined(const PatchRigs& rigs, const Joining& joining, const std::string& text) {
  const Value list = rigs.text->root()["rigs"];
  Splice items(list);
  const auto all = list.items();
  std::size_t gone = all.size();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].begin() == joining.into.item.begin()) items.replace(i, text);
    if (all[i].begin() == joining.from.item.begin()) gone = i;
  }
  items.erase(gone);
  Splice whole(rigs.text->root());
  whole.set("rigs", items.text());
  return whole.text();
}

/// Joins one rig: those whose attachments lead to the same one as the first.
std::optional<std::vector<Attach>> join_first(Patch& patch, const std::string& path,
                                              const std::string& into,
                                              const std::vector<Attach>& attach, Joined& joined,
                                              Diagnostics& diagnostics) {
  const auto rigs = read_patch_rigs(patch, path, diagnostics);
  if (!rigs) return std::nullopt;
  const Finder finder(*rigs, path, diagnostics);
  const PatchRig* target = finder.target(into);
  const PatchRig* source = target ? finder.source(*target, attach.front()) : nullptr;
  if (!source) return std::nullopt;
  PatchNodes nodes(patch);
  Joining joining{*target, *source, {}, {}};
  std::vector<Attach> others;
  for (const Attach& one : attach) {
    const PatchRig* rig = finder.source(*target, one);
    const int to = rig ? finder.joint(*target, one) : -1;
    if (to < 0) return std::nullopt;
    if (rig != source) {
      others.push_back(one);
      continue;
    }
    for (std::size_t i = 0; i < rig->rig.skeleton.joints.size(); ++i) {
      if (rig->rig.skeleton.joints[i].ids.local != one.local) continue;
      const int root = root_of(rig->rig, static_cast<int>(i));
      if (joining.roots.emplace(root, to).first->second != to) return finder.twice(one);
    }
  }
  joining.space = math::inverse(nodes.world(nodes.ancestor(target->rig))) *
                  nodes.world(nodes.ancestor(source->rig));
  const bool complete = check_roots(joining, path, diagnostics);
  if (!check_distinct(joining, path, diagnostics) || !complete) return std::nullopt;

  const Moved moved = move_roots(joining);
  if (!check_above(joining, moved, nodes, path, diagnostics)) return std::nullopt;
  const std::string text = joined_text(joining, moved);
  const std::set<int> hung = hang_nodes(patch, joining, moved, nodes);
  check_skins(patch, nodes);
  rename_marks(patch, source->rig.id, target->rig.id);
  report_keys(patch, path, hung, diagnostics);
  patch.set_root_extension("RIGC_rig", with_joined(*rigs, joining, text));
  joined.rigs.push_back(source->rig.skeleton.global);
  joined.joints = target->rig.skeleton.joints.size() + source->rig.skeleton.joints.size();
  joined.nodes = target->rig.scene.size() + source->rig.scene.size();
  return others;
}

}  // namespace

std::optional<Joined> join_into(Patch& patch, const std::string& path, const std::string& into,
                                const std::vector<Attach>& attach, Diagnostics& diagnostics) {
  Joined joined;
  std::vector<Attach> open = attach;
  while (!open.empty()) {
    auto others = join_first(patch, path, into, open, joined, diagnostics);
    if (!others) return std::nullopt;
    open = *std::move(others);
  }
  return joined;
}

}  // namespace rigc::gltf
