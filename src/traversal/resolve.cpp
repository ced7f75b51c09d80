// SPDX-License-Identifier: MIT
// Resolves selectors: scope, then what was made, then indices, kind and attribute.
// Test: tests/traversal/resolve_test.cpp
#include "traversal/resolve.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "traversal/codes.h"

namespace rigc::traversal {
namespace {

using scene::Kind;
using scene::Node;
using selector::Choice;
using selector::Index;
using selector::IndexItem;
using selector::Scope;

constexpr std::size_t kCandidatesShown = 8;

/// The answer of one choice: nodes, or why there are none.
struct Answer {
  std::vector<NodeId> nodes;
  std::string why;
  const Code* code = &codes::kNothingFound;
  bool absent_rig = false;
};

/// Position in a list of `size`, or nothing.
std::optional<std::size_t> position(const Index& index, std::size_t size) {
  const auto count = static_cast<long long>(size);
  long long at = 0;
  switch (index.kind) {
    case Index::Kind::number:
      at = index.number < 0 ? count + index.number : index.number;
      break;
    case Index::Kind::start:
      at = 0;
      break;
    case Index::Kind::middle:
      at = (count - 1) / 2;
      break;
    case Index::Kind::end:
      at = count - 1;
      break;
  }
  if (at < 0 || at >= count) return std::nullopt;
  return static_cast<std::size_t>(at);
}

/// Keeps what the items name, in their order. An index outside the list empties the answer and says
/// so.
void pick(const std::vector<IndexItem>& items, std::string_view what, Answer& answer) {
  if (items.empty() || answer.nodes.empty()) return;
  const std::vector<NodeId> all = std::move(answer.nodes);
  answer.nodes.clear();
  for (const IndexItem& item : items) {
    if (item.all) {
      answer.nodes.insert(answer.nodes.end(), all.begin(), all.end());
      continue;
    }
    const auto first = position(item.first, all.size());
    const auto last = item.last ? position(*item.last, all.size()) : first;
    if (!first || !last) {
      answer.nodes.clear();
      answer.code = &codes::kIndexOutside;
      answer.why = fmt::format("{} has {} to choose from: 0..{}", what, all.size(), all.size() - 1);
      return;
    }
    const bool down = *first > *last;
    for (std::size_t at = *first;; down ? --at : ++at) {
      answer.nodes.push_back(all[at]);
      if (at == *last) break;
    }
  }
}

bool auxiliary(const std::string& role) {
  return role == "zero" || role == "driver" || role == "space";
}

bool matches(const Node& node, const selector::Made& made) {
  if (made.module != "*" && node.module != made.module) return false;
  if (!made.id.empty() && node.identity.command != made.id) return false;
  if (!made.role.empty()) return node.identity.role == made.role;
  return made.module == "*" || !auxiliary(node.identity.role);
}

class Resolver {
 public:
  /// `reported`: whether anybody will read why nothing was found.
  Resolver(const Context& context, bool reported) : context_(context), reported_(reported) {}

  Answer resolve(const Choice& choice) {
    Answer answer;
    const std::string& global = choice.global.empty() ? context_.global : choice.global;
    if (!context_.index.has_global(global)) {
      answer.absent_rig = true;
      answer.why = fmt::format("there is no rig \"{}\"", printable(global));
      return answer;
    }
    std::vector<NodeId> joints = scope(choice, global, answer);
    if (choice.made) {
      answer.nodes = made(choice, joints, global);
      if (answer.nodes.empty() && answer.why.empty()) answer.why = why_not_made(choice, joints);
      pick(choice.made->indices, "this command", answer);
    } else {
      answer.nodes = std::move(joints);
    }
    filter_kind(choice, answer);
    return answer;
  }

 private:
  const Node& node(NodeId id) const { return context_.scene[id]; }

  /// What the scope names: joints as a rule, all nodes of a group where a kind asks for them.
  std::vector<NodeId> scope(const Choice& choice, const std::string& global, Answer& answer) {
    if (choice.scope == Scope::self) return of_kind(choice, {context_.self});
    if (choice.scope == Scope::parent) {
      const NodeId parent = node(context_.self).parent;
      if (parent.valid()) return of_kind(choice, {parent});
      answer.why = "this joint has no parent";
      return {};
    }
    if (!choice.label.empty()) return labelled(choice, global, answer);
    const bool whole_group = !choice.made && !choice.kind.empty() && choice.indices.empty();
    answer.nodes = whole_group ? context_.index.group(global, choice.local)
                               : context_.index.joints(global, choice.local);
    if (answer.nodes.empty()) {
      answer.why = fmt::format("there is no local group \"{}\"", printable(choice.local));
      const std::string hint = suggest(choice.local, context_.index.groups(global));
      if (!hint.empty()) answer.why += "; " + hint;
    }
    pick(choice.indices, fmt::format("group \"{}\"", choice.local), answer);
    std::vector<NodeId> found = std::exchange(answer.nodes, {});
    return whole_group ? found : of_kind(choice, std::move(found));
  }

  /// Where a kind other than joints is asked for without a module: what belongs to the joints.
  std::vector<NodeId> of_kind(const Choice& choice, std::vector<NodeId> joints) const {
    if (choice.made || choice.kind.empty() || choice.kind == "joint") return joints;
    std::vector<NodeId> nodes;
    for (NodeId joint : joints) {
      const auto& made = context_.index.made_for(node(joint).identity.owner);
      nodes.insert(nodes.end(), made.begin(), made.end());
    }
    return nodes;
  }

  std::vector<NodeId> labelled(const Choice& choice, const std::string& global, Answer& answer) {
    std::vector<NodeId> nodes = context_.index.labelled(global, choice.local, choice.label);
    // A command's nodes repeat their joint's label: the label means the joint wherever there is
    // one.
    std::vector<NodeId> joints;
    for (NodeId id : nodes) {
      if (node(id).is_skeleton()) joints.push_back(id);
    }
    const bool wants_made_nodes = !choice.made && !choice.kind.empty() && choice.kind != "joint";
    if (!joints.empty() && !wants_made_nodes) return joints;
    if (!nodes.empty() && !choice.made) {
      if (!wants_made_nodes) {
        std::erase_if(nodes, [&](NodeId id) { return auxiliary(node(id).identity.role); });
      }
      return nodes;
    }
    if (nodes.empty()) answer.why = why_no_label(choice, global);
    return nodes;
  }

  std::string why_no_label(const Choice& choice, const std::string& global) const {
    if (const std::string later = forecast(choice); !later.empty()) return later;
    if (context_.index.group(global, choice.local).empty()) {
      const std::string hint = suggest(choice.local, context_.index.groups(global));
      return fmt::format("there is no local group \"{}\"{}{}", printable(choice.local),
                         hint.empty() ? "" : "; ", hint);
    }
    const std::string hint = suggest(choice.label, context_.index.labels(global, choice.local));
    return fmt::format("group \"{}\" has no label \"{}\"{}{}", choice.local,
                       printable(choice.label), hint.empty() ? "" : "; ", hint);
  }

  std::vector<NodeId> made(const Choice& choice, const std::vector<NodeId>& scope,
                           const std::string& global) const {
    std::vector<NodeId> nodes;
    const bool whole_group =
        choice.scope == Scope::group && choice.label.empty() && choice.indices.empty();
    if (whole_group) {
      for (NodeId id : context_.index.group(global, choice.local)) {
        if (!node(id).is_skeleton() && matches(node(id), *choice.made)) nodes.push_back(id);
      }
      return nodes;
    }
    for (NodeId from : scope) {
      if (!node(from).is_skeleton()) {  // a labelled node that a command made
        if (matches(node(from), *choice.made)) nodes.push_back(from);
        continue;
      }
      for (NodeId id : context_.index.made_for(node(from).identity.owner)) {
        if (matches(node(id), *choice.made)) nodes.push_back(id);
      }
    }
    return nodes;
  }

  std::string why_not_made(const Choice& choice, const std::vector<NodeId>& joints) const {
    if (const std::string later = forecast(choice); !later.empty()) return later;
    std::vector<std::string> modules;
    for (NodeId joint : joints) {
      for (NodeId id : context_.index.made_for(node(joint).identity.owner)) {
        const Node& candidate = node(id);
        std::string text = candidate.module + "." + candidate.identity.role;
        if (std::find(modules.begin(), modules.end(), text) == modules.end())
          modules.push_back(text);
      }
    }
    std::sort(modules.begin(), modules.end());
    if (modules.empty()) return "nothing has been made there yet";
    if (modules.size() > kCandidatesShown) modules.resize(kCandidatesShown);
    return "what has been made there: " + join(modules, ", ");
  }

  std::string forecast(const Choice& choice) const {
    return reported_ && context_.forecast ? context_.forecast(choice) : std::string();
  }

  void filter_kind(const Choice& choice, Answer& answer) const {
    if (choice.kind.empty() || answer.nodes.empty()) return;
    const auto kind = scene::parse_kind(choice.kind);
    std::erase_if(answer.nodes, [&](NodeId id) { return !kind || node(id).kind != *kind; });
    if (answer.nodes.empty())
      answer.why = fmt::format("no node there is of kind {}", printable(choice.kind));
  }

  const Context& context_;
  bool reported_;
};

/// The plugs that `choice` names on nodes; false where an attribute is missing (reported).
bool find_plugs(const Choice& choice, const Context& context, Found& found,
                Diagnostics& diagnostics) {
  if (choice.attribute.empty()) return true;
  for (NodeId id : found.nodes) {
    const auto plug = context.scene.find_plug(id, choice.attribute, choice.component);
    if (!plug) {
      const std::string name =
          choice.component.empty() ? choice.attribute : choice.attribute + "." + choice.component;
      diagnostics.report(
          codes::kNoAttribute, choice.span,
          fmt::format("{} has no attribute \"{}\"", describe(context.scene, id), printable(name)),
          suggest(choice.attribute, context.scene.plug_names(id)));
      return false;
    }
    found.plugs.push_back(*plug);
  }
  return true;
}

}  // namespace

std::string describe(const scene::Scene& scene, NodeId id) {
  const Node& node = scene[id];
  std::string text = node.ids.local.empty() ? node.name : node.ids.local;
  if (!node.ids.local.empty() && !node.ids.label.empty()) text += "." + node.ids.label;
  if (!node.is_skeleton()) {
    text += "/" + node.module;
    if (node.identity.command != node.module) text += "#" + node.identity.command;
    text += "." + node.identity.role;
  }
  return fmt::format("{} ({} \"{}\")", printable(text), scene::spec(node.kind).name,
                     printable(node.name));
}

std::optional<Found> resolve(const selector::Selector& selector, const Context& context,
                             Diagnostics& diagnostics) {
  Resolver resolver(context, !selector.optional);
  Answer last;
  for (const Choice& choice : selector.choices) {
    Answer answer = resolver.resolve(choice);
    if (!answer.nodes.empty()) {
      Found found;
      found.nodes = std::move(answer.nodes);
      if (!find_plugs(choice, context, found, diagnostics)) return std::nullopt;
      return found;
    }
    last = std::move(answer);
  }
  Found nothing;
  if (last.absent_rig) {
    nothing.absent_rig = true;
    diagnostics.report(codes::kAbsentRig, selector.span,
                       fmt::format("\"{}\": {}; the default is used", print(selector), last.why));
    return nothing;
  }
  if (selector.optional) return nothing;
  diagnostics.report(*last.code, selector.span,
                     fmt::format("\"{}\" finds nothing", print(selector)), last.why);
  return std::nullopt;
}

}  // namespace rigc::traversal
