// SPDX-License-Identifier: MIT
// display_layer: shows, hides, colours and protects nodes together.
// Test: tests/modules/display_layer_test.cpp
#include <fmt/format.h>

#include "modules/codes.h"
#include "modules/registry.h"
#include "modules/steps_groups.h"
#include "modules/wiring.h"

namespace rigc::modules {
namespace {

namespace attribute = scene::display_layer;
namespace transform = scene::transform;

/// Gives a layer a setting that it does not have yet; fails where another command said otherwise.
bool agree(Builder& b, NodeId layer, std::uint16_t at, std::string_view parameter,
           const scene::Value& usual, const scene::Value& value) {
  const Plug plug{layer, at};
  const scene::Value now = b.scene().value(plug);
  if (now == value) return true;
  if (now == usual && !b.scene().source(plug)) {
    b.set(plug, value);
    return true;
  }
  b.fail(
      codes::kSettingsDiffer, parameter,
      fmt::format("the layer \"{}\" was made with another {}", b.with().text("layer"), parameter),
      "leave it out where the layer is only added to");
  return false;
}

NodeId find_or_make(Builder& b) {
  const std::string& name = b.with().text("layer");
  const NodeId found = find_group(b, scene::Kind::display_layer, attribute::kLayer, name);
  if (found.valid()) return found;
  const NodeId layer = b.make({.kind = scene::Kind::display_layer,
                               .role = "layer",
                               .joint = {},
                               .parent = {},
                               .suffix = name + "_layer"});
  b.set({layer, attribute::kLayer}, name);
  b.set({layer, attribute::kMode}, std::string("normal"));
  return layer;
}

/// What the command says about the look of the layer.
bool set_look(Builder& b, NodeId layer) {
  const Parameters& with = b.with();
  bool good = true;
  if (with.has("visible")) {
    const double visible = with.flag("visible") ? 1 : 0;
    good = agree(b, layer, attribute::kVisible, "visible", 1.0, visible);
  }
  if (with.has("mode")) {
    const std::string usual = "normal";
    good = agree(b, layer, attribute::kMode, "mode", usual, with.text("mode")) && good;
  }
  if (with.has("color")) {
    const math::Vec3 c = with.vec3("color");
    const std::vector<double> none, color{c.x, c.y, c.z};
    good = agree(b, layer, attribute::kColor, "color", none, color) && good;
  }
  return good;
}

/// The attribute on a control that shows and hides the layer; one that is there is used.
void add_switch(Builder& b, NodeId layer) {
  const Parameters& with = b.with();
  const NodeId control = with.node("switch_on");
  const std::string name =
      with.has("attribute") ? with.text("attribute") : with.text("layer") + "_visible";
  auto plug = b.scene().find_plug(control, name);
  if (plug && plug->attribute < scene::kUserAttributes) {
    b.fail(codes::kAttributeExists, "attribute",
           fmt::format("every control has an attribute \"{}\" of its own", name));
    return;
  }
  if (!plug) {
    plug = add_number(b, control,
                      {.name = name,
                       .value = b.scene().number({layer, attribute::kVisible}),
                       .flavour = scene::UserAttribute::Flavour::boolean});
  } else if (b.scene().number({layer, attribute::kVisible}) == 0 && b.scene().number(*plug) != 0) {
    b.fail(codes::kSettingsDiffer, "visible",
           fmt::format("the layer is hidden, but {} of {} is on", name,
                       traversal::describe(b.scene(), control)));
    return;
  }
  const auto source = b.scene().source({layer, attribute::kVisible});
  if (source == plug) return;
  if (source) {
    b.fail(codes::kSettingsDiffer, "switch_on",
           fmt::format("the layer \"{}\" has a switch already, {} of {}", with.text("layer"),
                       b.scene().plug_name(*source), traversal::describe(b.scene(), source->node)));
    return;
  }
  b.connect(*plug, {layer, attribute::kVisible});
}

/// A node is shown where its layer is and what drove it before does.
void follow(Builder& b, NodeId node, NodeId layer) {
  const Plug visible{node, transform::kVisible}, shown{layer, attribute::kVisible};
  const auto before = b.scene().source(visible);
  if (!before) {
    if (b.scene().number(visible) != 0) b.connect(shown, visible);
    return;
  }
  const NodeId owner = b.index().joint(b.scene()[node].identity.owner);
  b.reconnect(formula(b, owner, "visible", "$0 * $1", {*before, shown}, "utility"), visible);
}

void color_members(Builder& b, NodeId layer) {
  const auto color = std::get<std::vector<double>>(b.scene().value({layer, attribute::kColor}));
  if (color.size() != 3) return;
  for (NodeId node : members_of(b.scene(), layer, attribute::kMembers)) {
    if (b.scene()[node].kind == scene::Kind::control)
      b.set({node, scene::control::kColor}, math::Vec3{color[0], color[1], color[2]});
  }
}

}  // namespace

void display_layer(Builder& b) {
  const Parameters& with = b.with();
  if (!check_group_name(b, "layer")) return;
  if (with.has("attribute") && !check_group_name(b, "attribute")) return;
  const auto nodes = group_members(b);
  if (!nodes) return;
  for (NodeId node : *nodes) {
    if (!check_place(b, node, "nodes")) return;
  }
  const NodeId layer = find_or_make(b);
  if (!set_look(b, layer)) return;
  if (with.has("switch_on")) add_switch(b, layer);
  if (b.failed()) return;
  for (NodeId node : add_members(b, layer, attribute::kMembers, *nodes)) follow(b, node, layer);
  color_members(b, layer);
}

}  // namespace rigc::modules
