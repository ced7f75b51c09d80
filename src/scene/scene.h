// SPDX-License-Identifier: MIT
// The scene that commands build: nodes, attributes, connections, hierarchy. It knows nothing of
// YAML or glTF. Changes go through Edit (edit.h), which journals them.
// Test: tests/scene/scene_test.cpp
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/ids.h"
#include "base/span.h"
#include "scene/kinds.h"
#include "scene/value.h"

namespace rigc::scene {

/// A handle inside one scene; never compared between scenes, never written out.
struct NodeId {
  std::uint32_t index = UINT32_MAX;
  bool valid() const { return index != UINT32_MAX; }
  auto operator<=>(const NodeId&) const = default;
};

/// User attributes are numbered from here in plugs.
inline constexpr std::uint16_t kUserAttributes = 1000;

/// One attribute of a node, one element of an array attribute, or one component of a vector.
struct Plug {
  NodeId node;
  std::uint16_t attribute = 0;
  std::int32_t element = -1;   ///< of an array attribute
  std::int8_t component = -1;  ///< 0 x, 1 y, 2 z, 3 w
  auto operator<=>(const Plug&) const = default;
};

/// A number that a rigger or module added for animators.
struct UserAttribute {
  enum class Flavour : std::uint8_t { number, integer, boolean, angle /* degrees */ };
  std::string name;
  Flavour flavour = Flavour::number;
  double value = 0;
  double initial = 0;
  std::optional<double> min, max;
  bool keyable = true;
  bool hidden = false;  ///< a list of attributes leaves it out
  bool operator==(const UserAttribute&) const = default;
};

struct Connection {
  Plug to;  ///< an input of the node that stores it
  Plug from;
  auto operator<=>(const Connection&) const = default;
};

struct Node {
  Kind kind = Kind::transform;
  NodeId parent;
  std::vector<NodeId> children;  ///< in order of creation or reparenting
  std::string name;              ///< for people
  Identifiers ids;
  Identity identity;
  std::uint32_t command =
      UINT32_MAX;      ///< index in the command list; UINT32_MAX: joint of the skeleton
  std::string module;  ///< module of that command; empty: joint of the skeleton
  Origin origin;
  std::vector<std::vector<Value>>
      attributes;  ///< by index of the kind's table: one value, or an array's elements
  std::vector<UserAttribute> user;
  std::vector<Connection> inputs;  ///< connections into this node, sorted by `to`
  bool is_skeleton() const { return command == UINT32_MAX; }
};

class Edit;

class Scene {
 public:
  std::size_t size() const { return nodes_.size(); }  ///< nodes ever made and not undone
  const Node& operator[](NodeId id) const { return nodes_[id.index]; }
  /// All nodes in the order they were made.
  std::vector<NodeId> nodes() const;

  /// The value as set; where the plug is connected, the value it had before the connection.
  Value value(const Plug& plug) const;
  double number(const Plug& plug) const;
  std::optional<Plug> source(const Plug& plug) const;  ///< what is connected into exactly this plug
  /// Type of what the plug carries (a component is a number); nothing if there is no such plug. One
  /// element past the end of an array is a plug: what set and connect append.
  std::optional<Type> type(const Plug& plug) const;
  /// Plug by attribute name ("translate", "roll") and component name ("x" or empty).
  std::optional<Plug> find_plug(NodeId node, std::string_view attribute,
                                std::string_view component = {}) const;
  /// Names of what find_plug would find, for messages.
  std::vector<std::string> plug_names(NodeId node) const;
  std::string plug_name(const Plug& plug) const;  ///< `translate.x`, `weights[1]`
  Role role(const Plug& plug) const;

  /// Local transform as set (T, R, S attributes).
  math::Trs local(NodeId transform) const;
  /// World matrix in rig space from set values alone: the rest pose; connections are not evaluated.
  math::Affine rest_world(NodeId transform) const;

  /// A canonical text of everything: nodes by (command, order made), values, connections. Two
  /// scenes are equal exactly when their dumps are.
  std::string dump() const;

 private:
  math::Trs stored(NodeId transform) const;  // the rotation of any length

  friend class Edit;
  std::vector<Node> nodes_;
};

}  // namespace rigc::scene
