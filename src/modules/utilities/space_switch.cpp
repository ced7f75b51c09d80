// SPDX-License-Identifier: MIT
// space_switch: what a control follows, switched or blended by attributes. The zero above the
// control is driven by a weighted mean of the spaces, each with the offset that it has at rest; the
// control keeps its own values.
// Test: tests/modules/space_switch_test.cpp
#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "modules/codes.h"
#include "modules/layers.h"
#include "modules/registry.h"
#include "modules/utilities/utilities.h"

namespace rigc::modules {
namespace {

namespace transform = scene::transform;
namespace constraint = scene::constraint;

struct Spaces {
  std::vector<std::string> names;
  std::vector<Target> targets;
  std::size_t first = 0;  ///< the one that counts at rest
};

/// The transform that holds the control's rest placement: above it, or above layers of its own;
/// zero_of would go on past another control, whose zero is not this one's.
NodeId zero_from(Builder& b, NodeId control) {
  const NodeId zero = zero_of(b, control);
  NodeId at = b.scene()[control].parent;
  while (at != zero && b.scene()[at].kind == scene::Kind::transform) at = b.scene()[at].parent;
  if (zero.valid() && at == zero) return zero;
  b.fail(codes::kNoZero, "control",
         fmt::format("nothing above {} can be moved in its place",
                     traversal::describe(b.scene(), control)));
  return {};
}

/// A transform that stays where the zero would be without this command.
NodeId make_own(Builder& b, NodeId zero) {
  const NodeId own = b.make({.kind = scene::Kind::transform,
                             .role = "space",
                             .joint = {},
                             .parent = b.scene()[zero].parent,
                             .suffix = "own_space"});
  for (const std::uint16_t attribute :
       {transform::kTranslate, transform::kRotation, transform::kScale}) {
    const Plug from{zero, attribute}, to{own, attribute};
    b.set(to, b.scene().value(from));
    if (const auto source = b.scene().source(from)) b.connect(*source, to);
  }
  return own;
}

Spaces spaces_from(Builder& b, NodeId zero) {
  const Parameters& with = b.with();
  Spaces spaces;
  const std::vector<NodeId>& nodes = with.nodes("spaces");
  spaces.names = names_from(b, nodes.size());
  for (const NodeId node : nodes) {
    if (check_place(b, node, "spaces")) spaces.targets.push_back(target(b, node));
  }
  if (b.failed()) return spaces;
  if (with.has("own")) {
    spaces.names.insert(spaces.names.begin(), with.text("own"));
    spaces.targets.insert(spaces.targets.begin(), target(b, make_own(b, zero)));
  }
  if (b.failed() || !check_names(b, spaces.names) || !with.has("default")) return spaces;
  const auto found = std::find(spaces.names.begin(), spaces.names.end(), with.text("default"));
  spaces.first = static_cast<std::size_t>(found - spaces.names.begin());
  if (found == spaces.names.end()) {
    b.fail(codes::kNames, "default",
           fmt::format("there is no space \"{}\"", printable(with.text("default"))),
           suggest(with.text("default"), spaces.names));
  }
  return spaces;
}

/// Says which attributes these are, for programs that change the space and keep the pose.
void say(Builder& b, const Spaces& spaces, const Plug& chosen, const std::vector<Plug>& shares) {
  namespace at = scene::spaces;
  const NodeId node = b.make({.kind = scene::Kind::spaces,
                              .role = "driver",
                              .joint = {},
                              .parent = {},
                              .suffix = "spaces"});
  b.connect(world_of(b.with().node("control")), {node, at::kControl});
  b.set({node, at::kNames}, join(spaces.names, " "));
  b.connect(chosen, {node, at::kNumber});
  for (std::size_t i = 0; i < shares.size(); ++i)
    b.connect(shares[i], {node, at::kShares, static_cast<std::int32_t>(i)});
}

/// What each space counts: its own attribute, and what these leave of 1 where `name` says its
/// number.
std::vector<Plug> weights(Builder& b, const Spaces& spaces, const std::string& name) {
  const NodeId holder = b.with().has("on") ? b.with().node("on") : b.with().node("control");
  const auto last = static_cast<double>(spaces.names.size() - 1);
  const Plug chosen = add_to(b, holder,
                             {.name = name,
                              .value = static_cast<double>(spaces.first),
                              .min = 0,
                              .max = last,
                              .flavour = scene::UserAttribute::Flavour::integer},
                             "attribute");
  std::vector<Plug> shares;
  std::string sum;
  for (const std::string& space : spaces.names) {
    if (b.failed()) return {};
    sum += fmt::format("{}${}", sum.empty() ? "" : " + ", shares.size());
    shares.push_back(add_to(b, holder, {.name = name + "_" + space, .value = 0, .min = 0, .max = 1},
                            "attribute"));
    if (!b.with().flag("weights")) b.set_access(shares.back(), false, false);
  }
  if (b.failed()) return {};
  say(b, spaces, chosen, shares);
  const Plug left = formula(b, {}, name + "_left", "max(0, 1 - (" + sum + "))", shares);
  std::vector<Plug> all;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    all.push_back(formula(b, {}, name + "_weight",
                          fmt::format("$0 + (round(clamp($1, 0, {})) == {} ? $2 : 0)", last, i),
                          {shares[i], chosen, left}));
  }
  return all;
}

/// Lets the zero take one or both of place and rotation from the spaces.
void follow(Builder& b, NodeId zero, const Spaces& spaces, const std::string& name,
            const std::vector<std::pair<std::uint16_t, std::uint16_t>>& outputs) {
  std::vector<double> at_rest(spaces.names.size(), 0);
  at_rest[spaces.first] = 1;
  const std::vector<Plug> counts = weights(b, spaces, name);
  if (b.failed()) return;
  const NodeId node = make_constraint(b, scene::Kind::parent_constraint, zero, spaces.targets,
                                      at_rest, true, "space");
  for (std::size_t i = 0; i < counts.size(); ++i)
    b.connect(counts[i], {node, constraint::kWeights, static_cast<std::int32_t>(i)});
  for (const auto& [from, to] : outputs) b.reconnect({node, from}, {zero, to});
}

}  // namespace

void space_switch(Builder& b) {
  const Parameters& with = b.with();
  const NodeId zero = zero_from(b, with.node("control"));
  if (b.failed()) return;
  const Spaces spaces = spaces_from(b, zero);
  if (b.failed()) return;
  const std::pair place{constraint::kTranslate, transform::kTranslate};
  const std::pair turn{constraint::kRotation, transform::kRotation};
  const std::string& name = with.text("attribute");
  const bool places = with.flag("translate"), turns = with.flag("rotate");
  if (places && turns && with.flag("separate")) {
    follow(b, zero, spaces, name + "_translate", {place});
    if (!b.failed()) follow(b, zero, spaces, name + "_rotate", {turn});
  } else if (places || turns) {
    std::vector<std::pair<std::uint16_t, std::uint16_t>> outputs;
    if (places) outputs.push_back(place);
    if (turns) outputs.push_back(turn);
    follow(b, zero, spaces, name, outputs);
  }
}

}  // namespace rigc::modules
