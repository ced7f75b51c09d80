// SPDX-License-Identifier: MIT
// Matches the nodes of two rigs. Test: tests/update/match_test.cpp
#include "update/match.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

#include "base/trace.h"

namespace rigc::update {
namespace {

using scene::NodeId;

/// What a node is, whichever rig of a file it is in.
Identity in_any_rig(Identity identity) {
  identity.rig = 0;
  return identity;
}

bool has_place(scene::Kind kind) {
  return scene::spec(kind).is_transform || kind == scene::Kind::mesh;
}

/// Keys that a joint has or had, and holders and ids that a command had.
class Names {
 public:
  explicit Names(const tags::TaggedSkeleton& skeleton) {
    for (const tags::TaggedJoint& joint : skeleton.joints) {
      if (!joint.was.empty()) joints_[joint.key] = joint.was;
      for (const tags::CommandTag& command : joint.commands) {
        for (const std::string& was : command.was) {
          const std::size_t slash = was.find('/');
          const auto key = parse_joint_key(was.substr(0, slash));
          if (key && slash != std::string::npos)
            commands_[{joint.key, command.id}].emplace_back(*key, was.substr(slash + 1));
        }
      }
    }
  }

  /// Earlier identities of a node, the latest first. `along`: what a command made for its own joint
  /// and took along to another joint; else what it made for the node's joint.
  std::vector<Identity> earlier(const Identity& now, bool along) const {
    if (along && now.owner != now.holder) return {};
    const std::vector<JointKey> owners = keys(now.owner);
    std::vector<std::pair<JointKey, std::string>> holders;
    for (const JointKey& key : keys(now.holder)) holders.emplace_back(key, now.command);
    const auto moved = commands_.find({now.holder, now.command});
    if (moved != commands_.end())
      for (auto was = moved->second.rbegin(); was != moved->second.rend(); ++was)
        for (const JointKey& key : with_earlier(was->first)) holders.emplace_back(key, was->second);
    std::vector<Identity> out;
    for (const auto& [holder, command] : holders) {
      Identity identity = now;
      identity.holder = holder;
      identity.command = command;
      for (const JointKey& owner : along ? std::vector<JointKey>{holder} : owners) {
        identity.owner = owner;
        out.push_back(identity);
      }
    }
    return out;
  }

  /// A joint's key and those that it had, the latest first.
  std::vector<JointKey> keys(const JointKey& key) const {
    std::vector<JointKey> out = {key};
    const auto was = joints_.find(key);
    if (was != joints_.end()) out.insert(out.end(), was->second.rbegin(), was->second.rend());
    return out;
  }

 private:
  std::vector<JointKey> with_earlier(const JointKey& key) const { return keys(key); }

  std::map<JointKey, std::vector<JointKey>> joints_;
  std::map<std::pair<JointKey, std::string>, std::vector<std::pair<JointKey, std::string>>>
      commands_;
};

class Matcher {
 public:
  Matcher(const std::vector<Source>& sources, const scene::Scene& fresh,
          const tags::TaggedSkeleton& skeleton, const catalog::Catalogue& catalogue)
      : sources_(sources), fresh_(fresh), names_(skeleton), catalogue_(catalogue) {
    out_.resize(sources.size());
    held_.assign(fresh.size(), Held::by_none);
    for (std::size_t i = 0; i < sources.size(); ++i)
      by_identity_[in_any_rig(sources[i].identity)].push_back(i);
    for (const NodeId id : fresh.nodes())
      if (has_place(fresh[id].kind)) open_.push_back(id);
  }

  std::vector<std::optional<Match>> run() {
    by_identity();
    by_was();
    for (const bool orphans : {false, true}) by_replaces(orphans);
    for (const bool orphans : {false, true}) by_label(orphans);
    return std::move(out_);
  }

 private:
  /// Who has a node. An orphan is a few keys that had no place in the old rig: it goes to a node
  /// that none has, and does not keep it from what plays in the old rig. Where both have the same
  /// property, the carrier lets the orphan wait on.
  enum class Held : std::uint8_t { by_none, by_orphan, by_node };

  /// Gives a node to all sources of one identity that can have it; true where a node of the old rig
  /// has it now.
  bool give(const Identity& identity, NodeId to, Rule rule) {
    const auto found = by_identity_.find(identity);
    if (found == by_identity_.end()) return false;
    const Held before = held_[to.index];
    Held& held = held_[to.index];
    for (const std::size_t source : found->second) {
      const Held by = is_orphan(source) ? Held::by_orphan : Held::by_node;
      const bool open = before == Held::by_none || by > before;
      if (out_[source] || !open || !fits(sources_[source], to)) continue;
      out_[source] = Match{to, rule};
      held = std::max(held, by);
    }
    return held == Held::by_node;
  }

  bool is_orphan(std::size_t source) const { return !sources_[source].node.valid(); }

  /// Joints stay joints, and meshes meshes: they are other things in a file.
  bool fits(const Source& source, NodeId to) const {
    const auto is = [&](scene::Kind kind) {
      return (source.kind == kind) == (fresh_[to].kind == kind);
    };
    return is(scene::Kind::mesh) && is(scene::Kind::joint);
  }

  void drop_taken() {
    std::erase_if(open_, [&](NodeId id) { return held_[id.index] == Held::by_node; });
  }

  void by_identity() {
    for (const NodeId id : open_) give(in_any_rig(fresh_[id].identity), id, Rule::identity);
    drop_taken();
  }

  void by_was() {
    for (const bool along : {false, true}) {
      for (const NodeId id : open_)
        for (const Identity& earlier : names_.earlier(in_any_rig(fresh_[id].identity), along))
          if (give(earlier, id, Rule::was)) break;
      drop_taken();
    }
  }

  /// A node for a joint succeeds the one that another module made for that joint.
  void by_replaces(bool orphans) {
    using Key = std::tuple<JointKey, std::string, std::string, std::uint32_t>;
    std::map<Key, std::vector<std::size_t>> made;
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      const Identity& identity = sources_[i].identity;
      if (!out_[i] && is_orphan(i) == orphans && !sources_[i].module.empty())
        made[{identity.owner, sources_[i].module, identity.role, identity.counter}].push_back(i);
    }
    if (made.empty()) return;
    for (const NodeId id : open_) replace(fresh_[id], id, made);
    drop_taken();
  }

  template <class Made>
  void replace(const scene::Node& node, NodeId id, const Made& made) {
    const catalog::Descriptor* descriptor = catalogue_.find(node.module);
    if (!descriptor) return;
    for (const auto& [module, roles] : descriptor->replaces) {
      for (const auto& [was, now] : roles) {
        if (now != node.identity.role) continue;
        for (const JointKey& owner : names_.keys(node.identity.owner)) {
          const auto found = made.find({owner, module, was, node.identity.counter});
          // Several commands made one: none is the one that is meant.
          if (found == made.end() || !same_identity(found->second)) continue;
          if (give(in_any_rig(sources_[found->second.front()].identity), id, Rule::replaces))
            return;
        }
      }
    }
  }

  bool same_identity(const std::vector<std::size_t>& sources) const {
    return std::all_of(sources.begin(), sources.end(), [&](std::size_t i) {
      return in_any_rig(sources_[i].identity) == in_any_rig(sources_[sources.front()].identity);
    });
  }

  void by_label(bool orphans) {
    using Key = std::tuple<std::string, std::string, scene::Kind, std::string>;
    std::map<Key, std::vector<NodeId>> nodes;
    for (const NodeId id : fresh_.nodes())
      if (!fresh_[id].ids.label.empty() && fresh_[id].kind == scene::Kind::control)
        nodes[{fresh_[id].ids.local, fresh_[id].ids.label, fresh_[id].kind,
               fresh_[id].identity.role}]
            .push_back(id);
    std::map<Key, std::vector<std::size_t>> lost;
    for (std::size_t i = 0; i < sources_.size(); ++i)
      if (!out_[i] && is_orphan(i) == orphans && !sources_[i].ids.label.empty() &&
          sources_[i].kind == scene::Kind::control)
        lost[{sources_[i].ids.local, sources_[i].ids.label, sources_[i].kind,
              sources_[i].identity.role}]
            .push_back(i);
    for (const auto& [key, from] : lost) {
      const auto to = nodes.find(key);
      const bool single = to != nodes.end() && to->second.size() == 1 && same_identity(from);
      if (single)
        give(in_any_rig(sources_[from.front()].identity), to->second.front(), Rule::label);
    }
  }

  const std::vector<Source>& sources_;
  const scene::Scene& fresh_;
  Names names_;
  const catalog::Catalogue& catalogue_;
  std::vector<std::optional<Match>> out_;
  std::vector<Held> held_;  ///< by node of `fresh_`
  std::vector<NodeId> open_;
  std::map<Identity, std::vector<std::size_t>> by_identity_;
};

}  // namespace

std::string_view name_of(Rule rule) {
  constexpr std::array<std::string_view, 4> kNames = {"identity", "was", "replaces", "label"};
  return kNames[static_cast<std::size_t>(rule)];
}

Frame frame_of(const scene::Scene& built, NodeId node) {
  NodeId parent = built[node].parent;
  while (parent.valid() && !scene::spec(built[parent].kind).is_transform)
    parent = built[parent].parent;
  Frame frame;
  if (parent.valid()) frame.space = built.rest_world(parent).linear;
  if (scene::spec(built[node].kind).is_transform) frame.rest = built.local(node);
  return frame;
}

std::vector<Source> sources_of(const scene::Scene& built) {
  std::vector<Source> out;
  for (const NodeId id : built.nodes()) {
    const scene::Node& node = built[id];
    if (!has_place(node.kind)) continue;
    out.push_back(
        {node.identity, node.name, node.ids, node.kind, node.module, frame_of(built, id), id});
  }
  return out;
}

std::vector<std::optional<Match>> match(const std::vector<Source>& sources,
                                        const scene::Scene& fresh,
                                        const tags::TaggedSkeleton& skeleton,
                                        const catalog::Catalogue& catalogue) {
  const trace::Span span("match");
  return Matcher(sources, fresh, skeleton, catalogue).run();
}

}  // namespace rigc::update
