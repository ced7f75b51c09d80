// SPDX-License-Identifier: MIT
// A built rig as it is written into and read from a file, and taken out of it again. The text of a
// rig is rig_json.h's; docs/RIGC_rig.md describes it. Test: tests/gltf/rig_test.cpp
#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "gltf/file.h"
#include "gltf/patch.h"
#include "scene/scene.h"
#include "tags/tags.h"

namespace rigc::gltf {

struct Slim;

/// One executed command, for inspect and for messages.
struct CommandRecord {
  JointKey holder;
  std::string joint;  ///< name of the joint that holds it
  std::string id;
  std::string module;
  bool ran = true;   ///< false: skipped because an optional selector was empty
  std::string file;  ///< of the template line
  int line = 0;
};

/// Elements of a top-level array, as runs of neighbours.
struct Range {
  int first = 0;
  int count = 0;
  bool operator==(const Range&) const = default;
};
struct Slots {
  std::vector<Range> runs;
  bool empty() const { return runs.empty(); }
  bool contains(int index) const;
  void add(int index);
  bool operator==(const Slots&) const = default;
};

/// What a rig added to the arrays of its file, in two parts. Where there were no free places, each
/// was at the end when it was written: so that taking the second away leaves no holes.
struct Owned {
  struct Part {
    Slots nodes, meshes, materials, skins, accessors, buffer_views;
    bool operator==(const Part&) const = default;
  };
  Part stays;  ///< joints and proxy meshes: part of a character that was built from a template
  Part goes;   ///< controls, zeros, handles, and the controls' shapes
  bool operator==(const Owned&) const = default;
};

/// What of the model's skins a rig changed so that joints of its own bend them, and what it was.
/// The model's accessors stay in the file.
struct Rebound {
  /// An attribute of a primitive, `JOINTS_0` or the like: accessors.
  struct Attribute {
    std::string name;
    int before = -1;  ///< -1: it had none
    int now = -1;
    bool operator==(const Attribute&) const = default;
  };
  struct Primitive {
    int mesh = -1, primitive = -1;
    std::vector<Attribute> attributes;
    bool operator==(const Primitive&) const = default;
  };
  struct Skin {
    int skin = -1;
    int joints = 0;             ///< how many it had: those of the rig stand behind them
    int before = -1, now = -1;  ///< accessors of its inverse bind matrices
    bool operator==(const Skin&) const = default;
  };
  std::vector<Skin> skins;
  std::vector<Primitive> primitives;
  bool operator==(const Rebound&) const = default;
};

/// A value that an animator set without keying it.
struct Posed {
  scene::Plug plug;    ///< translate, rotation or scale of a control, or an attribute of a user
  scene::Value built;  ///< what the build gave it
};

/// Keys and values of a node that its rig no longer has, or of attributes that the node no longer
/// has: an empty node of the file holds them until what they belong to is back.
struct Orphan {
  int node = -1;      ///< glTF node that holds them
  Identity identity;  ///< of the node that they belong to
  std::string name;   ///< its name, for people
  Identifiers ids;
  scene::Kind kind = scene::Kind::control;
  std::string module;  ///< that made it
  math::Mat3 space;    ///< axes of its parent at rest, rig space: what its transform is seen from
  math::Trs rest;      ///< of the node in that space
  math::Trs local;     ///< what is held, in that space
  std::vector<scene::UserAttribute>
      attributes;  ///< that are held; `initial` is what the build gave
};

struct Rig {
  /// Number of the rig, unique in its file.
  std::uint32_t id = 0;
  tags::TaggedSkeleton skeleton;
  tags::Settings settings;
  /// Name and version of each module that its tags name.
  std::vector<std::pair<std::string, int>> modules;
  /// In the order they ran; Node::command is an index into it.
  std::vector<CommandRecord> commands;
  /// With what animators set: as the file stands.
  scene::Scene scene;
  /// What they set, and what it was before.
  std::vector<Posed> posed;
  std::vector<Orphan> orphans;
  /// glTF node of each scene node, -1: none (constraints and other utilities).
  std::vector<int> nodes;
  /// glTF node that the rig's roots are under: the rig's space; -1: the scene.
  int ancestor = -1;
  Owned owned;
  Rebound rebound;
};

/// The scene of a rig as it was built: without what animators set.
scene::Scene built_scene(const Rig& rig);

/// Adds a rig to a file (or to empty_file()): nodes, control shapes, proxy mesh and skin, RIGC_rig,
/// identities. Joints with a foreign node keep it untouched but for extras.rigc and children of
/// ours. `ancestor`: node that the rig's roots go under; -1: the scenes that the model's joints are
/// in, the default scene where no joint is the model's. Other rigs of the file stay. Fills
/// rig.nodes and rig.owned.
bool write_rig(Patch& patch, Rig& rig, int ancestor, Diagnostics& diagnostics);

/// Where the nodes of a rig that is read say that they come from: for messages.
enum class Origins { templates, file };

/// All rigs of a file, ordered by id, with what animators set without keying (transforms, extras)
/// taken over into the scenes. A file without any gives an empty list. A RIGC_rig that lies about
/// itself is an error. `known`: of this file, where that has been read already.
std::optional<std::vector<Rig>> read_rigs(const File& file, Diagnostics& diagnostics,
                                          Origins origins = Origins::templates,
                                          const Slim* known = nullptr);

/// What remains of a rig that is taken out of its file.
enum class Strip {
  character,  ///< joints and proxy meshes that it brought: they are the character's
  nothing     ///< what is the model's own: the model's file as it was, byte for byte
};

/// Takes rigs out of their file: controls with their shapes, identities and RIGC_rig go; all that
/// others added stays. Comes before anything is appended to the patch, which then takes the free
/// places first. Gives the glTF nodes that are gone: channels on them are the caller's to drop.
std::set<int> strip_rigs(Patch& patch, const File& file, const std::vector<Rig>& rigs,
                         Strip remains = Strip::character);
inline void strip_rig(Patch& patch, const File& file, const Rig& rig,
                      Strip remains = Strip::character) {
  strip_rigs(patch, file, {rig}, remains);
}

/// A rig that takes the place of another, as an update makes it.
struct Replacement {
  const Rig* old = nullptr;  ///< as it was read from the file
  Rig* fresh = nullptr;      ///< nodes and owned are filled; its orphans may hold a node of `old`
  std::vector<int> places;  ///< by scene node of `fresh`: glTF node of `old` that it takes over, -1
  Sources sources;          ///< that spans of `fresh` point into
};

/// By scene node: its glTF node where that is the rig's own and no joint of the model; else -1.
std::vector<int> own_nodes(const Rig& rig);

/// glTF nodes of a rig, and its orphans', to which others have added extras, extensions or the
/// like.
std::set<int> nodes_with_additions(const File& file, const Rig& rig);

/// Takes rigs out and writes their successors. A node that takes over one of the old rig keeps its
/// index and whatever others added to it: children, extras, extensions. Nodes that skins of others
/// use or that carry something of others stay. False where a rig cannot be written.
bool replace_rigs(Patch& patch, const File& file, std::vector<Replacement>& replacements,
                  Diagnostics& diagnostics);

/// Where a joint's node stands in its file, which may differ from the scene: a foreign node keeps
/// its parent and the transform that its author left it in.
struct Standing {
  scene::NodeId base;    ///< nearest node of the rig above it in the file; invalid: the rig's space
  math::Affine between;  ///< from the base (or the rig's space) to the node's parent in the file
  math::Trs local;       ///< of the node in the file
  std::vector<math::Vec3> points;  ///< in its space: nodes below it that are not the rig's
};
/// By scene node; meaningful where the rig has a glTF node. `slim`: of the file.
std::vector<Standing> standings(const Slim& slim, const Rig& rig);
std::optional<std::vector<Standing>> standings(const File& file, const Rig& rig,
                                               Diagnostics& diagnostics);

}  // namespace rigc::gltf
