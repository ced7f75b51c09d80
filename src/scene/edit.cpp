// SPDX-License-Identifier: MIT
// Changing a scene, with a journal entry for each change, and taking changes back.
// Test: tests/scene/edit_test.cpp
#include "scene/edit.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "scene/storage.h"

namespace rigc::scene {

namespace {

bool is_rotation(const Node& node, std::uint16_t attribute) {
  return spec(node.kind).is_transform && attribute == transform::kRotation;
}

bool is_euler_view(const Node& node, std::uint16_t attribute) {
  return spec(node.kind).is_transform && attribute == transform::kRotate;
}

// `rotate` always shows what `rotation` is.
void update_euler_view(Node& node) {
  const auto q = std::get<math::Quat>(node.attributes[transform::kRotation][0]);
  node.attributes[transform::kRotate][0] = math::to_euler_degrees(q);
}

std::size_t place_of(const std::vector<NodeId>& children, NodeId node) {
  const auto found = std::find(children.begin(), children.end(), node);
  assert(found != children.end());
  return static_cast<std::size_t>(found - children.begin());
}

auto input_at(std::vector<Connection>& inputs, const Plug& to) {
  return std::lower_bound(inputs.begin(), inputs.end(), to,
                          [](const Connection& c, const Plug& plug) { return c.to < plug; });
}

bool has_input(const std::vector<Connection>& inputs, std::vector<Connection>::const_iterator at,
               const Plug& to) {
  return at != inputs.end() && at->to == to;
}

}  // namespace

NodeId Edit::make(Node node) {
  const NodeId id{static_cast<std::uint32_t>(scene_.nodes_.size())};
  assert(!node.parent.valid() || node.parent < id);
  node.children.clear();
  node.attributes.clear();
  node.user.clear();
  node.inputs.clear();
  for (const AttributeSpec& attribute : spec(node.kind).attributes) {
    node.attributes.emplace_back();
    if (!attribute.array) node.attributes.back().push_back(initial_value(attribute));
  }
  if (node.parent.valid()) scene_.nodes_[node.parent.index].children.push_back(id);
  scene_.nodes_.push_back(std::move(node));
  journal_.entries_.push_back(Journal::Made{id});
  if (observer_) observer_->added(scene_, id);
  return id;
}

void Edit::reparent(NodeId node, NodeId parent) {
  Node& moved = scene_.nodes_[node.index];
  if (moved.parent == parent) return;
  for (NodeId at = parent; at.valid(); at = scene_[at].parent) assert(at != node);
  Journal::Parented entry{node, moved.parent, 0};
  if (moved.parent.valid()) {
    auto& siblings = scene_.nodes_[moved.parent.index].children;
    entry.place_before = place_of(siblings, node);
    siblings.erase(siblings.begin() + static_cast<std::ptrdiff_t>(entry.place_before));
  }
  if (parent.valid()) scene_.nodes_[parent.index].children.push_back(node);
  moved.parent = parent;
  journal_.entries_.push_back(entry);
}

void Edit::set(const Plug& plug, const Value& value) {
  assert(scene_.type(plug) == type_of(value) && scene_.role(plug) != Role::output);
  Node& node = scene_.nodes_[plug.node.index];
  if (plug.attribute >= kUserAttributes) {
    const std::size_t index = plug.attribute - kUserAttributes;
    journal_.entries_.push_back(Journal::UserSet{plug.node, index, node.user[index]});
    node.user[index].value = std::get<double>(value);
    return;
  }
  if (is_euler_view(node, plug.attribute)) {
    Value angles = node.attributes[plug.attribute][0];
    if (plug.component < 0) {
      angles = value;
    } else {
      set_component(angles, plug.component, std::get<double>(value));
    }
    // Setting the angles that are there must not disturb the last bits of the rotation.
    if (angles == node.attributes[plug.attribute][0]) return;
    set({plug.node, transform::kRotation}, math::from_euler_degrees(std::get<math::Vec3>(angles)));
    return;
  }
  auto& stored = node.attributes[plug.attribute];
  journal_.entries_.push_back(Journal::Set{plug, stored});
  const auto element = static_cast<std::size_t>(plug.element < 0 ? 0 : plug.element);
  if (element == stored.size()) {
    stored.push_back(initial_value(spec(node.kind).attributes[plug.attribute]));
  }
  if (plug.component < 0) {
    stored[element] = value;
  } else {
    set_component(stored[element], plug.component, std::get<double>(value));
  }
  if (is_rotation(node, plug.attribute)) update_euler_view(node);
}

Plug Edit::add_attribute(NodeId node, UserAttribute attribute) {
  assert(!scene_.find_plug(node, attribute.name));
  auto& user = scene_.nodes_[node.index].user;
  user.push_back(std::move(attribute));
  journal_.entries_.push_back(Journal::UserAdded{node});
  return {node, static_cast<std::uint16_t>(kUserAttributes + user.size() - 1)};
}

void Edit::set_access(const Plug& plug, bool keyable, bool hidden) {
  assert(plug.attribute >= kUserAttributes && scene_.type(plug));
  const std::size_t index = plug.attribute - kUserAttributes;
  UserAttribute& attribute = scene_.nodes_[plug.node.index].user[index];
  journal_.entries_.push_back(Journal::UserSet{plug.node, index, attribute});
  attribute.keyable = keyable;
  attribute.hidden = hidden;
}

void Edit::connect(const Plug& from, const Plug& to) {
  assert(scene_.type(from) && scene_.type(from) == scene_.type(to));
  assert(scene_.role(to) == Role::input);
  Node& node = scene_.nodes_[to.node.index];
  if (to.element >= 0) {
    const auto& stored = node.attributes[to.attribute];
    const auto& attribute = spec(node.kind).attributes[to.attribute];
    if (static_cast<std::size_t>(to.element) == stored.size()) {
      set({to.node, to.attribute, to.element}, initial_value(attribute));
    }
  }
  const auto at = input_at(node.inputs, to);
  if (has_input(node.inputs, at, to)) {
    journal_.entries_.push_back(Journal::Connected{to, at->from});
    at->from = from;
  } else {
    journal_.entries_.push_back(Journal::Connected{to, std::nullopt});
    node.inputs.insert(at, Connection{to, from});
  }
}

void Edit::disconnect(const Plug& to) {
  Node& node = scene_.nodes_[to.node.index];
  const auto at = input_at(node.inputs, to);
  if (!has_input(node.inputs, at, to)) return;
  journal_.entries_.push_back(Journal::Connected{to, at->from});
  node.inputs.erase(at);
}

void Edit::undo(Scene& scene, Journal& journal, Observer* observer) {
  struct Undo {
    std::vector<Node>& nodes;
    const Scene& scene;
    Observer* observer;

    void operator()(const Journal::Made& entry) {
      assert(entry.node.index + 1 == nodes.size());
      if (observer) observer->removing(scene, entry.node);
      const NodeId parent = nodes.back().parent;
      if (parent.valid()) {
        assert(nodes[parent.index].children.back() == entry.node);
        nodes[parent.index].children.pop_back();
      }
      nodes.pop_back();
    }
    void operator()(const Journal::Parented& entry) {
      Node& node = nodes[entry.node.index];
      if (node.parent.valid()) {
        assert(nodes[node.parent.index].children.back() == entry.node);
        nodes[node.parent.index].children.pop_back();
      }
      node.parent = entry.before;
      if (!node.parent.valid()) return;
      auto& siblings = nodes[node.parent.index].children;
      siblings.insert(siblings.begin() + static_cast<std::ptrdiff_t>(entry.place_before),
                      entry.node);
    }
    void operator()(Journal::Set& entry) {
      Node& node = nodes[entry.plug.node.index];
      node.attributes[entry.plug.attribute] = std::move(entry.before);
      if (is_rotation(node, entry.plug.attribute)) update_euler_view(node);
    }
    void operator()(const Journal::UserAdded& entry) { nodes[entry.node.index].user.pop_back(); }
    void operator()(Journal::UserSet& entry) {
      nodes[entry.node.index].user[entry.index] = std::move(entry.before);
    }
    void operator()(const Journal::Connected& entry) {
      auto& inputs = nodes[entry.to.node.index].inputs;
      const auto at = input_at(inputs, entry.to);
      if (!has_input(inputs, at, entry.to)) {
        inputs.insert(at, Connection{entry.to, *entry.before});
      } else if (entry.before) {
        at->from = *entry.before;
      } else {
        inputs.erase(at);
      }
    }
  };
  Undo undo{scene.nodes_, scene, observer};
  while (!journal.entries_.empty()) {
    std::visit(undo, journal.entries_.back());
    journal.entries_.pop_back();
  }
}

}  // namespace rigc::scene
