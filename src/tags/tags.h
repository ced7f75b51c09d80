// SPDX-License-Identifier: MIT
// Tags and the skeleton that carries them: what a template becomes, what a rig file stores, what
// the command list is made from. Test: tests/tags/tags_test.cpp
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "base/literal.h"
#include "base/span.h"
#include "math/math.h"

namespace rigc::tags {

struct Argument {
  std::string name;
  Span span;  ///< of the name
  Literal value;
  bool operator==(const Argument& o) const { return name == o.name && value == o.value; }
};

/// A module's name and its parameters, checked against the descriptor when they were read.
struct CommandTag {
  std::string module;
  std::string id;  ///< stable id, unique on its joint
  std::string comment;
  std::string stage;  ///< empty: the descriptor's
  bool on = true;
  int feature = -1;            ///< index into TaggedJoint::features, -1: none
  std::vector<Argument> with;  ///< selectors as texts
  std::vector<std::string>
      was;  ///< earlier holders and ids, "<joint key>/<command id>", oldest first
  Span span;
  const Literal* find(std::string_view argument) const;
};

struct FeatureTag {
  std::string name;  ///< empty: only groups
  std::string kind;
  std::string switch_name;
  bool on = true;
  Span span;
};

/// How a mirrored part's joint came about: modules mirror behaviour by it.
struct Mirror {
  bool mirrored = false;
  JointKey opposite;  ///< the joint on the other side; uid 0: none
};

/// What guides did to a joint, and what it goes along with.
struct Guiding {
  std::optional<math::Trs> fitted;  ///< its rest before guides; empty: they left it as it was
  std::optional<math::Vec3> moved;  ///< how far they moved it itself, in the rig's space; empty: it
                                    ///< went along with others, or stayed
  std::array<JointKey, 2> between;  ///< joints that take it along; uid 0: none
  double share = 0.5;               ///< how much of the second one's way it goes
  JointKey toward;                  ///< the joint that its axes follow; uid 0: its parent
  math::Vec3 up;                    ///< beside that: in the rig's space
};

struct TaggedJoint {
  std::string name;  ///< for people
  JointKey key;
  std::vector<JointKey> was;  ///< earlier keys, oldest first
  int parent = -1;            ///< index into TaggedSkeleton::joints, smaller than its own
  JointKey template_parent;   ///< what it hangs under in the template, where a model hangs it
                              ///< elsewhere; uid 0: its parent, or one above that
  Identifiers ids;            ///< global always set
  math::Trs rest;  ///< local rest transform, relative to the parent (roots: to the rig's space)
  bool optional = false;
  Mirror mirror;
  Guiding guide;
  std::vector<FeatureTag> features;
  std::vector<CommandTag> commands;  ///< top to bottom
  int template_index = 0;            ///< into TaggedSkeleton::templates
  int foreign_node = -1;             ///< glTF node of the model it was fitted to
  Span span;
};

struct FeatureDeclaration {
  std::string name, kind, title, help;
  bool on = true;
  std::vector<std::string> switches;
};

struct TemplateReference {
  std::string name;
  int version = 0;
  std::string file;    ///< as written by the user or a part's reference, never absolute
  std::string digest;  ///< 16 hex digits of the text's XXH3-64
  /// Of a rig that others were joined to: not a part, but the main template of one of these; its
  /// parts follow. The first is the main one anyway.
  bool main = false;
};

struct NamedShape {
  std::string name;
  std::vector<std::vector<math::Vec3>> lines;
};

/// What the character is, in the space of its rig: measured from the joints when fitted or placed.
struct Character {
  math::Vec3 up{0, 1, 0};
  math::Vec3 left{1, 0, 0};
  math::Vec3 forward{0, 0, 1};
  double height = 1;  ///< extent of the joints along up
  double unit = 1;  ///< length in rig space of one metre of the template: scales sizes and lengths
};

/// Joints parents first in document order; the input of the command list.
struct TaggedSkeleton {
  std::string name;  ///< of the template
  std::string global;
  std::vector<TaggedJoint> joints;
  std::vector<FeatureDeclaration> features;
  std::vector<TemplateReference> templates;  ///< the main one first, then its parts
  std::vector<std::pair<std::string, int>> module_pins;
  std::vector<NamedShape> shapes;  ///< that templates bring
  /// Local groups of parts, each with the group that it was made beneath: `arm_l_hand`, `arm_l`.
  std::vector<std::pair<std::string, std::string>> groups;
  Character character;
  bool aims = false;  ///< joints say what their axes follow (Guiding::toward)
  /// Rest matrix of a joint in rig space.
  math::Affine world(std::size_t joint) const;
  /// Index by key; -1 if absent.
  int find(const JointKey& key) const;
};

/// Which features, switches and groups a build turns on or off, over what the template says.
struct Settings {
  struct Feature {
    std::string group;  ///< local group; empty: all
    std::string name;
    std::string switch_name;  ///< empty: the feature itself
    bool on = true;
  };
  std::vector<Feature> features;
  std::vector<std::pair<std::string, bool>> groups;
  std::string rest = "bind";
  bool split_weights = false;  ///< skins share weights with joints that commands make for that
};

/// A skeleton in somebody's file, as the fit sees it. Parents first is not promised.
struct ForeignJoint {
  int node = -1;    ///< glTF node
  int parent = -1;  ///< index into ForeignSkeleton::joints
  std::string name;
  bool in_skin = false;
  math::Trs local;    ///< the file's own node transform (as TRS)
  math::Affine rest;  ///< rest pose in rig space (space of the ancestor)
};

struct ForeignSkeleton {
  std::string file;  ///< as the user named it, for messages
  std::vector<ForeignJoint> joints;
  int ancestor = -1;  ///< glTF node under which the rig's root goes: lowest common non-joint
                      ///< ancestor; -1: the scene
  math::Affine ancestor_world;  ///< of that node, as the file stands
  std::vector<std::pair<std::string, int>>
      humanoid;  ///< VRM humanoid bone -> index into joints; empty without
  std::vector<std::string> notes;
};

/// A vertex of a model that joints move.
struct BoundVertex {
  math::Vec3 at;      ///< in the space of the first of these joints, as it was bound
  double weight = 0;  ///< of all of them together, 0..1
};

/// A mesh of a model with its places in a texture.
struct Surface {
  std::vector<std::pair<int, math::Affine>> bound;  ///< nodes that move it, each with what leads
                                                    ///< from the mesh's space into the node's
  std::vector<math::Vec3> places;                   ///< [vertices], in the space of the mesh
  std::vector<std::array<double, 2>> texture;       ///< [vertices], u and v
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::string trouble;  ///< why there is nothing but `bound`; empty: there is
};

/// What commands read of a model's meshes. Without a model both are empty.
struct Geometry {
  /// The vertices that nodes of a model and all below them move.
  std::function<std::vector<BoundVertex>(const std::vector<int>& nodes)> vertices;
  /// The meshes of nodes of a name, or else those of this name.
  std::function<std::vector<Surface>(const std::string& name)> surfaces;
};

}  // namespace rigc::tags
