// SPDX-License-Identifier: MIT
// The table of node kinds: what a node of each kind takes, gives and stores. A new kind is one row
// here and one kernel in eval. Test: tests/scene/kinds_test.cpp
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "scene/value.h"

namespace rigc::scene {

enum class Kind : std::uint8_t {
  joint,      ///< a bone of the skeleton, or one that a command made
  transform,  ///< a plain transform: zeros, spaces
  control,    ///< a transform that animators key, with a shape
  handle,     ///< a transform that shows where a solver's goal is
  point_constraint,
  orient_constraint,
  scale_constraint,
  parent_constraint,
  aim_constraint,
  ik_two_bone,
  ik_chain,
  expression,
  remap,
  mesh,           ///< a proxy mesh bound rigidly to joints; data only
  limits,         ///< bounds of a transform's translate, rotation and scale
  display_layer,  ///< transforms that are shown, coloured and selected as one
  control_set,    ///< controls that animators select and key as one; data only
  compute,        ///< a program over numbers, vectors, rotations and matrices
  spline,         ///< frames along a curve through controls
  skin_split,     ///< joints that take a share of another's skin weights; data only
  match,          ///< what keys a limb in FK and in IK; data only
  morph,          ///< weights of a model's morph targets; data only
  spaces,         ///< what says which space a control follows; data only
  count
};

/// What an attribute is for.
enum class Role : std::uint8_t {
  input,   ///< set, keyed or connected
  output,  ///< computed; never set or connected into
  data     ///< set by the constructor, constant while the rig runs
};

struct AttributeSpec {
  std::string_view name;
  Type type;
  Role role;
  bool array = false;    ///< a list of values; plugs name an element
  bool keyable = false;  ///< animators may key it (on controls)
  double initial = 0;    ///< number: the default; vec3: all three; quat and matrix: identity
  std::string_view help = {};
};

struct KindSpec {
  Kind kind;
  std::string_view name;
  bool is_transform;  ///< has the attributes of namespace transform below and a place in the
                      ///< hierarchy
  std::span<const AttributeSpec> attributes;
};

const KindSpec& spec(Kind kind);
std::optional<Kind> parse_kind(std::string_view name);

/// Attribute indices that every transform kind shares.
/// world = parent.world * T * R * S. `rotate` is the Euler view of `rotation` (degrees, X then Y
/// then Z about fixed axes): reading it gives the angles; a connection into it, or into a
/// component, overrides `rotation`.
namespace transform {
inline constexpr std::uint16_t kTranslate = 0;  ///< vec3, parent space
inline constexpr std::uint16_t kRotation = 1;   ///< quat, parent space
inline constexpr std::uint16_t kScale = 2;      ///< vec3
inline constexpr std::uint16_t kRotate = 3;     ///< vec3, degrees: Euler view
inline constexpr std::uint16_t kVisible = 4;    ///< number 0 or 1
inline constexpr std::uint16_t kWorld = 5;      ///< matrix, output, rig space
inline constexpr std::uint16_t kParent =
    6;  ///< matrix, output: the parent's world; identity for roots
inline constexpr std::uint16_t kCount = 7;
}  // namespace transform

/// Attributes of a control after the shared ones: data that viewers draw.
namespace control {
inline constexpr std::uint16_t kShape = 7;  ///< text: name of the shape
inline constexpr std::uint16_t kPoints =
    8;  ///< numbers: polylines, flattened: count, x, y, z, ... repeated; control space
inline constexpr std::uint16_t kColor = 9;  ///< vec3, sRGB 0..1
/// number: bits 1 translate, 2 rotate, 4 scale; each where some component of it is not locked
inline constexpr std::uint16_t kKeyable = 10;
inline constexpr std::uint16_t kOpposite = 11;  ///< text: identity of the control on the other side
/// numbers: for x, y, z the sign with which a translation is copied to the opposite control to
/// mirror the pose; a rotation about that axis takes the other sign; 0 where copying cannot mirror.
/// Empty without an opposite.
inline constexpr std::uint16_t kMirror = 12;
inline constexpr std::uint16_t kLocked =
    13;  ///< number: component_bits() that keep their value whatever is keyed or set
inline constexpr std::uint16_t kHidden =
    14;  ///< number: component_bits() that a list of attributes leaves out
}  // namespace control

/// A constraint with weighted targets. All matrices in rig space. Output goes to the driven
/// transform.
namespace constraint {
inline constexpr std::uint16_t kParent = 0;   ///< matrix, input: the driven transform's `parent`
inline constexpr std::uint16_t kTargets = 1;  ///< matrix[], input: worlds of the targets
inline constexpr std::uint16_t kWeights =
    2;  ///< number[], input, one each; used relative to their sum (all 0: equal)
inline constexpr std::uint16_t kOffsets =
    3;  ///< matrix[], data: rest(target)^-1 * rest(driven) where the offset is kept; of a point
        ///< constraint a translation in the parent's space: targets may turn without moving it
inline constexpr std::uint16_t kTranslate = 4;  ///< vec3, output, parent space
inline constexpr std::uint16_t kRotation = 5;   ///< quat, output, parent space
inline constexpr std::uint16_t kScale = 6;      ///< vec3, output
inline constexpr std::uint16_t kRotate =
    7;  ///< vec3, output: Euler view of rotation, for per-axis use
}  // namespace constraint

/// Aims an axis of the driven transform at the weighted mean of targets; the second axis toward up.
namespace aim {
inline constexpr std::uint16_t kParent = 0;    ///< matrix, input
inline constexpr std::uint16_t kTargets = 1;   ///< matrix[], input
inline constexpr std::uint16_t kWeights = 2;   ///< number[], input
inline constexpr std::uint16_t kPosition = 3;  ///< vec3, input: the driven transform's translate
inline constexpr std::uint16_t kUpTarget = 4;  ///< matrix, input: used where up_mode is 1 (toward
                                               ///< its origin) or 2 (its rotation times up_vector)
inline constexpr std::uint16_t kUpMode = 5;    ///< number, data: 0 up_vector in rig space, 1, 2
inline constexpr std::uint16_t kUpVector = 6;  ///< vec3, input
inline constexpr std::uint16_t kOffset =
    7;  ///< quat, data: driven rest rotation seen from the aim frame (x at target, y up)
inline constexpr std::uint16_t kRotation = 8;  ///< quat, output, parent space
inline constexpr std::uint16_t kRotate = 9;    ///< vec3, output
}  // namespace aim

/// Analytic two-bone IK. Lengths are measured from the live translates, so length changes are
/// honoured. The frame of a bone has x along the bone and z along the bend normal (cross(end -
/// start, pole - start)); offsets hold the joints' rest rotations seen from these frames, so no
/// joint axis is assumed.
namespace ik2 {
inline constexpr std::uint16_t kBase = 0;    ///< matrix, input: `parent` of the start joint
inline constexpr std::uint16_t kGoal = 1;    ///< matrix, input: goal for the end joint's position
inline constexpr std::uint16_t kPole = 2;    ///< matrix, input: its origin is the pole
inline constexpr std::uint16_t kTwist = 3;   ///< number, input: degrees about start -> goal, added
inline constexpr std::uint16_t kStart = 4;   ///< vec3, input: translate of the start joint
inline constexpr std::uint16_t kMiddle = 5;  ///< vec3, input: translate of the middle joint
inline constexpr std::uint16_t kEnd = 6;     ///< vec3, input: translate of the end joint
inline constexpr std::uint16_t kStartScale = 7;   ///< vec3, input: scale of the start joint
inline constexpr std::uint16_t kMiddleScale = 8;  ///< vec3, input: scale of the middle joint
inline constexpr std::uint16_t kGoalOffset =
    9;  ///< vec3, data: end joint's rest position in the goal's rest space
inline constexpr std::uint16_t kOffsets =
    10;  ///< quat[2], data: joint rest rotation seen from its bone frame
inline constexpr std::uint16_t kNormal =
    11;  ///< vec3, data: bend normal in base space where the pole does not say one
inline constexpr std::uint16_t kStartWorld =
    12;  ///< matrix, output: solved world of the start joint
inline constexpr std::uint16_t kMiddleWorld =
    13;  ///< matrix, output: solved world of the middle joint
inline constexpr std::uint16_t kStartTwist =
    14;  ///< number, input: degrees that the start joint is turned about its bone, right-handed
inline constexpr std::uint16_t kMiddleTwist = 15;  ///< number, input: the same of the middle joint
}  // namespace ik2

/// Iterative IK for a chain of n joints (FABRIK, Aristidou 2011, fixed number of iterations),
/// started from the rest pose each frame, so that a frame's result does not depend on the frame
/// before.
namespace ik_chain {
inline constexpr std::uint16_t kBase = 0;     ///< matrix, input: `parent` of the first joint
inline constexpr std::uint16_t kGoal = 1;     ///< matrix, input
inline constexpr std::uint16_t kPole = 2;     ///< matrix, input; used where has_pole is 1
inline constexpr std::uint16_t kHasPole = 3;  ///< number, data
inline constexpr std::uint16_t kTwist = 4;    ///< number, input: degrees
inline constexpr std::uint16_t kTranslates =
    5;  ///< vec3[n], input: translates of the joints, first to last
inline constexpr std::uint16_t kRests = 6;       ///< quat[n], data: rest rotations, parent space
inline constexpr std::uint16_t kIterations = 7;  ///< number, data
inline constexpr std::uint16_t kGoalOffset =
    8;  ///< vec3, data: last joint's rest position in the goal's rest space
inline constexpr std::uint16_t kRotations = 9;  ///< quat[n - 1], output, parent spaces
}  // namespace ik_chain

/// output = the expression in `code` over `inputs`: `$0`, `$1`, ... stand for inputs in the code.
namespace expression {
inline constexpr std::uint16_t kCode = 0;    ///< text, data
inline constexpr std::uint16_t kInputs = 1;  ///< number[], input
inline constexpr std::uint16_t kOutput = 2;  ///< number, output
}  // namespace expression

/// A curve of points over a normalised input: output = output_min + curve((input - input_min) /
/// range) * range.
namespace remap {
inline constexpr std::uint16_t kInput = 0;      ///< number, input
inline constexpr std::uint16_t kInputMin = 1;   ///< number, input
inline constexpr std::uint16_t kInputMax = 2;   ///< number, input, default 1
inline constexpr std::uint16_t kOutputMin = 3;  ///< number, input
inline constexpr std::uint16_t kOutputMax = 4;  ///< number, input, default 1
inline constexpr std::uint16_t kPoints =
    5;  ///< numbers, data: position, value, interpolation (0 none, 1 linear, 2 smooth, 3 spline)
        ///< each; positions rise
inline constexpr std::uint16_t kClamp =
    6;  ///< number, data: 1 clamps the input to its range, 0 extends the ends linearly
inline constexpr std::uint16_t kOutput = 7;  ///< number, output
}  // namespace remap

/// Rigid boxes, capsules and cylinders, each bound to one joint.
namespace mesh {
inline constexpr std::uint16_t kJoints =
    0;  ///< matrix[], input: worlds of the joints (a connection names the joint)
inline constexpr std::uint16_t kParts =
    1;  ///< numbers, data: for each joint: style (0 capsule, 1 box, 2 cylinder), head xyz, tail
        ///< xyz, side xyz (unit), width, depth, color rgb; joint space
}  // namespace mesh

/// What a transform's values are clamped to, after keys and connections: everything that reads
/// them, its world too, gets the clamped values. Several of one transform count one after another.
namespace limits {
inline constexpr std::uint16_t kNode = 0;  ///< matrix, input: world of the transform (a connection
                                           ///< names it)
inline constexpr std::uint16_t kBounds =
    1;  ///< numbers, data: channel (0 1 2 translate x y z, 3 4 5 rotate, 6 7 8 scale), side (0 min,
        ///< 1 max), value each; lengths in the parent's space, degrees, factors
inline constexpr std::uint16_t kOrder =
    2;  ///< text, data: order of the angles about fixed axes, `xyz`: x first
inline constexpr std::uint16_t kAxes =
    3;  ///< quat, data: axes of translate and rotate, parent space; of a control none
inline constexpr std::uint16_t kOrigin =
    4;  ///< vec3, data: where translate counts as 0, parent space
inline constexpr std::uint16_t kRest = 5;  ///< quat, data: rotation that counts as none
}  // namespace limits

/// A named layer.
namespace display_layer {
inline constexpr std::uint16_t kLayer = 0;    ///< text, data: its name
inline constexpr std::uint16_t kVisible = 1;  ///< number, input: 0 hides its members
inline constexpr std::uint16_t kMode = 2;     ///< text, data: normal, template or reference
inline constexpr std::uint16_t kColor = 3;    ///< numbers, data: sRGB 0..1, or none
inline constexpr std::uint16_t kMembers =
    4;  ///< matrix[], input: worlds of its members (a connection names each)
}  // namespace display_layer

/// A named set of controls.
namespace control_set {
inline constexpr std::uint16_t kSet = 0;      ///< text, data: its name
inline constexpr std::uint16_t kParent = 1;   ///< text, data: the set that it is in; empty: none
inline constexpr std::uint16_t kMembers = 2;  ///< matrix[], input: worlds of its controls
}  // namespace control_set

/// What a program (formula.h) gives. It names its inputs and outputs; each is the element of its
/// type's array that its place among those of its type says.
namespace compute {
inline constexpr std::uint16_t kCode = 0;         ///< text, data
inline constexpr std::uint16_t kNumbers = 1;      ///< number[], input
inline constexpr std::uint16_t kVectors = 2;      ///< vec3[], input
inline constexpr std::uint16_t kRotations = 3;    ///< quat[], input
inline constexpr std::uint16_t kMatrices = 4;     ///< matrix[], input
inline constexpr std::uint16_t kNumberOut = 5;    ///< number[], output
inline constexpr std::uint16_t kVectorOut = 6;    ///< vec3[], output
inline constexpr std::uint16_t kRotationOut = 7;  ///< quat[], output
inline constexpr std::uint16_t kMatrixOut = 8;    ///< matrix[], output
/// The array of inputs or outputs of a type.
inline constexpr std::uint16_t input_of(Type type) {
  return static_cast<std::uint16_t>(kNumbers + static_cast<std::uint16_t>(type));
}
inline constexpr std::uint16_t output_of(Type type) {
  return static_cast<std::uint16_t>(kNumberOut + static_cast<std::uint16_t>(type));
}
}  // namespace compute

/// A curve through controls, and frames along it. It passes through every control; its direction
/// there turns with the control, and its speed follows the distance to the next: so it has no
/// corners, and no loops where controls come near each other. An output's x is the curve's
/// direction, or points at the next output; the other axes turn with the controls around it, so
/// that twist between two controls is spread evenly. Parameters, and what is exact at rest, are
/// counted from the controls at rest.
namespace spline {
inline constexpr std::uint16_t kBase = 0;      ///< matrix, input: lengths are measured in its scale
inline constexpr std::uint16_t kControls = 1;  ///< matrix[n], input: worlds, 2 to 32
/// number, input: 0 outputs keep their places between the controls, however long the curve is; 1
/// they keep their distances from each other, from the start, beyond the end in its direction
inline constexpr std::uint16_t kPreserve = 2;
inline constexpr std::uint16_t kTwists =
    3;  ///< number[n] or none, input: degrees about the curve at each control, right-handed
inline constexpr std::uint16_t kRests = 4;  ///< matrix[n], data: controls at rest, base space
/// number[n], data: how much the curve's direction turns with each control: 0 it passes through as
/// the controls beside it lie, 1 wholly
inline constexpr std::uint16_t kFollows = 5;
inline constexpr std::uint16_t kParameters =
    6;  ///< number[k], data: place of each output, rising: i at control i (math::Spline)
inline constexpr std::uint16_t kPlaces =
    7;  ///< matrix[k], data: outputs at rest, base space; rotations and places
inline constexpr std::uint16_t kAims = 8;     ///< number, data: 1 x points at the next output
inline constexpr std::uint16_t kWorlds = 9;   ///< matrix[k], output: of the base's scale, rig space
inline constexpr std::uint16_t kLength = 10;  ///< number, output: of the curve, in base units
inline constexpr std::uint16_t kStretch = 11;  ///< number, output: the same relative to rest
/// numbers, input: how short and how long the outputs' way may become, times its length at rest;
/// beyond, lengths are kept as with `preserve`
inline constexpr std::uint16_t kLeast = 12;
inline constexpr std::uint16_t kMost = 13;
}  // namespace spline

/// Joints along a bone among which skins share what is weighted to the bone's joint.
namespace skin_split {
inline constexpr std::uint16_t kJoints =
    0;  ///< matrix[], input: worlds (a connection names each) of the bone's joint, of the joint at
        ///< its end, then of those that take a share
inline constexpr std::uint16_t kFractions =
    1;  ///< numbers, data: where along the bone, 0 to 1, the weights are all of one joint: of the
        ///< bone's joint (less than 0: it keeps none), then of those that take a share
inline constexpr std::uint16_t kLine =
    2;  ///< numbers, data: x, y, z of points of a line in the space of the bone's joint, along
        ///< which the fractions lie in place of the bone; empty: the bone
inline constexpr std::uint16_t kSurface =
    3;  ///< text, data: name of the node, or else of the mesh, whose vertices alone share; empty:
        ///< of every mesh that the joint moves
}  // namespace skin_split

/// A limb that can be keyed in two ways, for tools that carry a pose from one to the other.
namespace match {
inline constexpr std::uint16_t kLimb = 0;    ///< text, data: its name, as `arm_l`
inline constexpr std::uint16_t kJoints = 1;  ///< matrix[3], input: worlds of start, middle and end
inline constexpr std::uint16_t kFk =
    2;  ///< matrix[3], input: worlds of the controls that turn them
inline constexpr std::uint16_t kIk = 3;      ///< matrix, input: world of the control of the end
inline constexpr std::uint16_t kPole = 4;    ///< matrix, input: world of the control of the middle
inline constexpr std::uint16_t kSolver = 5;  ///< matrix, input: of an ik_two_bone its start world
inline constexpr std::uint16_t kSwitch = 6;  ///< number, input: an attribute: 0 FK, 1 IK
inline constexpr std::uint16_t kMeanings =
    7;  ///< text, data: a word for each of the numbers, with a blank between two: upper_twist
        ///< lower_twist (degrees in IK), upper_length lower_length (factors in IK), fk_upper_length
        ///< fk_lower_length (in FK), stretch squash soft slide pin (0 has no effect)
inline constexpr std::uint16_t kNumbers = 8;  ///< number[], input: attributes
inline constexpr std::uint16_t kHeld =
    9;  ///< matrix[], input: worlds of controls above the limb that go along with its controls
}  // namespace match

/// Weights of morph targets, on every mesh that the rig's joints move and that has them.
namespace morph {
inline constexpr std::uint16_t kTargets =
    0;  ///< text, data: names of morph targets, with a line break between two: what the model calls
        ///< them (glTF: `extras.targetNames` of the mesh)
inline constexpr std::uint16_t kWeights = 1;  ///< number[], input: one each
}  // namespace morph

/// A control that can follow one of several spaces, for tools that change it and keep the pose.
namespace spaces {
inline constexpr std::uint16_t kControl = 0;  ///< matrix, input: world of the control
inline constexpr std::uint16_t kNames =
    1;  ///< text, data: of the spaces, with a blank between two, in the order of their numbers
inline constexpr std::uint16_t kNumber = 2;  ///< number, input: an attribute: the space's number
inline constexpr std::uint16_t kShares =
    3;  ///< number[], input: attributes: how much each space counts beside that number, 0 to 1
}  // namespace spaces

}  // namespace rigc::scene
