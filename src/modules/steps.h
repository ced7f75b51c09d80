// SPDX-License-Identifier: MIT
// Steps that modules share: frames from geometry, controls under zeros, hanging, driving. A module
// that uses these never looks at a joint's axes. Test: tests/modules/steps_test.cpp
#pragma once

#include <string>
#include <vector>

#include "modules/builder.h"

namespace rigc::modules {

/// Where a control's axes come from: tells how its values are copied to the other side.
enum class AxesFrom : std::uint8_t { character, bone, joint };

// --- geometry at rest, rig space ---

math::Affine rest(const Builder& b, NodeId node);
math::Vec3 position(const Builder& b, NodeId node);
/// x left, y up, z forward of the character, right-handed (x is turned round where the rig space is
/// mirrored).
math::Mat3 character_axes(const Builder& b);
/// Direction of a joint's bone: to its child in its own group, else to the middle of its children,
/// else on from its parent; up where there is none of them.
math::Vec3 bone_direction(const Builder& b, NodeId joint);
/// Length of that bone; for a leaf the length of its parent's, at least 1 % of the character's
/// height.
double bone_length(const Builder& b, NodeId joint);
/// Direction of the bone of a chain's n-th joint: to the next one; of the last, where it has no
/// child, on from the one before.
math::Vec3 chain_direction(const Builder& b, const std::vector<NodeId>& chain, std::size_t n);
/// x along `direction`, y as near as it can be to the character's forward (or up, for bones that
/// point forward); on mirrored joints x and y are turned round, so that equal local rotations of
/// both sides mirror each other.
math::Mat3 bone_frame(const Builder& b, NodeId joint, math::Vec3 direction);
/// `orient:` of controls and transforms: character, world, joint or bone, at the joint's position.
math::Affine oriented(const Builder& b, NodeId joint, const std::string& orient);
/// The same where the joint's bone has another direction than the skeleton says.
math::Affine oriented(const Builder& b, NodeId joint, const std::string& orient,
                      math::Vec3 direction);
AxesFrom axes_from(const std::string& orient);
bool is_mirrored(const Builder& b, NodeId joint);
/// 1 on the character's left, -1 on its right, 0 in the middle.
int side_of(const Builder& b, NodeId joint);
/// An offset along a frame's own axes (`offset:` with `orient:`), so that both sides mirror each
/// other: on mirrored joints the template's expansion has turned x round, as the axes of the
/// character need it; axes of the bone or joint are all turned round there.
math::Vec3 own_offset(const Builder& b, NodeId joint, const std::string& orient, math::Vec3 offset);
/// forward, backward, left, right, up, down of the character as a unit vector.
math::Vec3 character_direction(const Builder& b, const std::string& name);

// --- hierarchy ---

/// The innermost control of the rig's root; invalid without one.
NodeId root_control(const Builder& b);
/// The joint that a joint hangs under in the template, else in the model; invalid: none.
NodeId joint_above(const Builder& b, NodeId joint);
/// What a joint's control hangs under where nobody says: the control that alone drives the nearest
/// driven joint above it in the template's order, or that joint itself where a blend or solver
/// drives it; else the root control; else nothing.
NodeId space_of(const Builder& b, NodeId joint);
/// The skeleton joints from `first` down to `last`, both included; fails where `last` is not below
/// `first`.
std::vector<NodeId> chain_between(Builder& b, NodeId first, NodeId last,
                                  std::string_view parameter);
/// Whether the joints are in order: none lies above one that comes before it in the list, and none
/// comes twice; fails where one does. They need not hang below one another: models have feet that
/// hang under the root, and fingers that are siblings.
bool check_order(Builder& b, const std::vector<NodeId>& joints, std::string_view parameter);
/// Whether the skeleton itself takes `joint` along with `space`, which is what its control follows:
/// the joint that moves as `space` does lies above it, or `space` moves no joint and something else
/// moves one above it. A joint that is not carried gets its translation driven too, so that it
/// moves as if it hung there.
bool carried_by(const Builder& b, NodeId joint, NodeId space);
/// Whether a node has a place in space; fails where it has none.
bool check_place(Builder& b, NodeId node, std::string_view parameter);
/// The node of a parameter that something hangs under or follows, or what stands for it where it
/// was left out; fails where the node has no place in space.
NodeId space_from(Builder& b, std::string_view parameter, NodeId otherwise);

// --- making ---

struct ControlSpec {
  NodeId joint;  ///< that it belongs to
  std::string role = "control";
  std::string suffix;  ///< of its name; empty: its role, nothing for `control`
  math::Affine frame;  ///< rest placement, rig space
  NodeId space;        ///< what it hangs under or follows; invalid: nothing
  std::string shape = "circle";
  double size = 0.1;           ///< rig units
  math::Vec3 color;            ///< sRGB
  math::Vec3 facing{0, 1, 0};  ///< axis of the control that the shape's normal points along
  math::Vec3 offset;           ///< of the shape, control axes, rig units, as the parameter gives it
  AxesFrom axes = AxesFrom::character;
  bool translate = true, rotate = true, scale = false;
  std::string shape_parameter = "shape";  ///< named in messages
};

struct ControlNodes {
  NodeId zero, control;
};

/// A control at rest under a zero that holds its placement.
ControlNodes make_control(Builder& b, const ControlSpec& spec);

/// Lets `node` (a transform that this command made) hang under `space`: as its child where space is
/// a control or transform, by a constraint that keeps the rest offset where it is a joint. Places
/// the node at `frame`.
void hang(Builder& b, NodeId node, NodeId space, const math::Affine& frame);

/// Colour parameter, or by side where it was left out: blue left, red right, yellow between.
math::Vec3 side_color(const Builder& b, NodeId joint, std::string_view parameter);
/// Points the shape of a control along its axis x, y or z, or (bone) along a direction in rig
/// space.
void face(const Builder& b, ControlSpec& spec, const std::string& axis, math::Vec3 bone);

// --- driving ---

struct Target {
  Plug world;         ///< matrix
  math::Affine rest;  ///< where it rests, rig space
};
inline Plug world_of(NodeId node) { return {node, scene::transform::kWorld}; }
Target target(const Builder& b, NodeId node);

/// A constraint of `kind` that makes `driven` follow weighted targets, keeping the rest offset
/// where `maintain`. Its outputs are not connected yet. `weights`: numbers, empty for all the same.
NodeId make_constraint(Builder& b, scene::Kind kind, NodeId driven,
                       const std::vector<Target>& targets, const std::vector<double>& weights,
                       bool maintain, const std::string& role, NodeId owner = {});

/// Makes a joint follow the control that was made by `spec` for it: rotation always, translation
/// where the control may be moved or the joint is not carried by what the control follows, scale
/// where nothing above the joint is driven (so that master scale enters a skeleton once).
void drive(Builder& b, const ControlSpec& spec, NodeId control);

/// Makes a joint keep its place seen from `follows` (a joint or a control); its rotation is
/// somebody else's. Scale as in `drive`.
void carry(Builder& b, NodeId joint, NodeId follows);

bool is_driven(const scene::Scene& scene, NodeId transform);

}  // namespace rigc::modules
