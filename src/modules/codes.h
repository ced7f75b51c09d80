// SPDX-License-Identifier: MIT
// Diagnostic codes 460..499 and 860..899: what module constructors refuse.
#pragma once

#include "base/diagnostics.h"

namespace rigc::modules::codes {

inline constexpr Code kNotAChain{
    460, Severity::error, "joints are no chain",
    "Joints of a chain are named from first to last: none lies above one "
    "that comes before it. An `ik_handle` also needs its last joint to hang "
    "below the first."};
inline constexpr Code kTooFewJoints{461, Severity::error, "too few joints",
                                    "The module needs more joints than the selectors found."};
inline constexpr Code kUnknownShape{462, Severity::error, "unknown shape",
                                    "No shape has this name, neither among those that come with "
                                    "rigc nor in the template's `shapes:`."};
inline constexpr Code kAlreadyDriven{463, Severity::error, "already driven",
                                     "Something drives this plug already. Two commands that drive "
                                     "one joint fight: switch one off, or blend them "
                                     "with a constraint that has both as targets."};
inline constexpr Code kAttributeExists{
    464, Severity::error, "attribute exists already",
    "The node has an attribute of this name. Choose another name."};
inline constexpr Code kValueDoesNotFit{
    465, Severity::error, "value does not fit the attribute",
    "The attribute takes another type of value, or the value lies outside its range."};
inline constexpr Code kNotSettable{466, Severity::error, "attribute cannot be set",
                                   "Outputs are computed and data are fixed when a node is made: "
                                   "neither can be set or connected into."};
inline constexpr Code kTypesDiffer{467, Severity::error, "plugs of different types",
                                   "A connection carries a value as it is: number to number, "
                                   "vector to vector. Name a component such as `.x`."};
inline constexpr Code kNotATransform{468, Severity::error, "node has no place in space",
                                     "The parameter needs a joint, control or transform."};
inline constexpr Code kUnderItself{
    469, Severity::error, "node would hang under itself",
    "A node cannot become a child of itself or of something below it."};
inline constexpr Code kWeightCount{
    470, Severity::error, "weights and targets differ in number",
    "There is one weight for each target, in the same order, and none is negative."};
inline constexpr Code kZeroLengthBone{
    471, Severity::error, "bone of no length",
    "Two joints of the chain lie in one place, so that the bone between them has no direction."};
inline constexpr Code kRootExists{472, Severity::error, "second root",
                                  "A rig has one `root` command."};
inline constexpr Code kNotMadeByCommand{
    473, Severity::error, "node belongs to the skeleton",
    "Joints of the skeleton stay where they are in the hierarchy; constraints move them."};

inline constexpr Code kSameAxis{
    474, Severity::error, "one axis for two directions",
    "`aim` and `up` of an aim_constraint name different axes: x, y or z, of either sign."};

inline constexpr Code kNoSolver{480, Severity::error, "no IK solver",
                                "The parameter names a handle or solver that `ik_handle` made."};
inline constexpr Code kPoleOnLine{
    481, Severity::error, "pole on the line of the chain",
    "A pole on the line from a chain's start to its end says no side to bend to."};

inline constexpr Code kTwistUnknown{
    912, Severity::error, "twist cannot be told from what it causes",
    "The end of the bone hangs under twist joints of the model: its turn is read from the "
    "constraint that drives it, and it has none."};

inline constexpr Code kEmptyRange{490, Severity::error, "least value above the largest",
                                  "No value lies between the limits. Exchange the two."};
inline constexpr Code kRestOutside{
    491, Severity::error, "rest lies outside the limits",
    "A control rests at 0 (scale at 1), and limits are measured from there: the least value is "
    "never above it and the largest never below."};
inline constexpr Code kNotMirrored{
    492, Severity::warning, "limit cannot be mirrored",
    "The axes of the control on the other side are no mirror image, so the limit was left away "
    "there. Give the control `orient: bone` or `character`, or limit both sides outside of the "
    "part."};
inline constexpr Code kNoLimit{493, Severity::error, "nothing is limited",
                               "The command gives neither a least nor a largest value."};
inline constexpr Code kNotLockable{
    494, Severity::error, "attribute cannot be locked",
    "Only what animators key can be locked or hidden: translate, rotate and scale of controls, "
    "their components, and attributes that were added to controls."};
inline constexpr Code kSettingsDiffer{
    495, Severity::error, "layer or set has other settings",
    "Commands that name one layer or set add to it. What they say about it must agree; say it once "
    "and leave it out in the others."};
inline constexpr Code kSetInItself{496, Severity::error, "set contains itself",
                                   "Following `parent` from set to set must never lead back."};
inline constexpr Code kGroupName{
    497, Severity::error, "not a name of a layer or set",
    "Names of layers, sets and switches have letters, digits, `_` and `-`, and do not start with a "
    "digit."};

inline constexpr Code kNoLimb{
    498, Severity::error, "not an IK/FK limb",
    "The command adds to a limb that `ik_fk_limb` built: name one of its controls."};

inline constexpr Code kNoRadius{
    499, Severity::error, "a wheel of no size",
    "A wheel is as large as its axle rests above what carries it. Give `radius`, or a `carrier` on "
    "the ground."};

inline constexpr Code kNames{870, Severity::error, "names do not fit",
                             "Each item has one name of its own, in the same order: letters, "
                             "digits, `_` and `-`, not starting with a digit."};
inline constexpr Code kNoZero{
    871, Severity::error, "control has no zero",
    "What a control follows is switched at the transform above it, which holds its rest placement. "
    "Controls that rigc's commands make have one."};
inline constexpr Code kTable{872, Severity::error, "table does not fit",
                             "Each row of a table has a number for each thing that it is about, "
                             "and no two rows say the same."};

inline constexpr Code kNotAbove{
    890, Severity::error, "control does not carry the limb",
    "A foot rolls under its IK control or under a control that this hangs under."};

// 860..869: curves, and what they squash.

inline constexpr Code kDrivenBelow{
    860, Severity::error, "something below would be sheared",
    "A joint that is squashed is scaled unevenly. What turns or moves by itself below it would be "
    "sheared: squash a joint of its own for the shape, without such children."};

inline constexpr Code kSoleGuessed{
    891, Severity::warning, "sole is guessed",
    "Where a foot rolls is measured from the vertices that it moves, else from joints of the foot, "
    "else from the height of the ankle alone."};

inline constexpr Code kNoFkChain{
    892, Severity::error, "not the controls of an FK chain",
    "The command adds to what `fk_chain` made: name its controls, each under the one before, from "
    "the first to the last."};

inline constexpr Code kNoSurface{
    895, Severity::warning, "surface is not in the model",
    "The model has no mesh of this name, or there is no model: the command makes nothing, so that "
    "one template serves characters with it and without it."};

inline constexpr Code kNoLine{
    896, Severity::error, "surface has no line to lie on",
    "A ribbon lies where one texture coordinate of a mesh stays the same while the other rises: "
    "the mesh has a name of its own, triangles, texture coordinates in which the strip lies "
    "straight, and joints of the rig that move it."};

inline constexpr Code kAlongOrSurface{
    897, Severity::error, "ribbon lies on one thing",
    "Give `along`, joints that the ribbon lies over, or `surface`, a mesh that it lies on, and not "
    "both."};

inline constexpr Code kTwistedBefore{
    898, Severity::warning, "bone is twisted before its ribbon",
    "Two commands share out the weights of one bone, and the first leaves the second none. A "
    "`twist_joints` that comes after the ribbon twists the ribbon's joints in place of its own."};

inline constexpr Code kFeetCount{893, Severity::error, "feet and legs differ in number",
                                 "There is one foot for each leg, in the order of the legs, or "
                                 "none at all."};

inline constexpr const Code* kModulesCodes[] = {
    &kNotAChain,       &kTooFewJoints,     &kUnknownShape,  &kAlreadyDriven,
    &kAttributeExists, &kValueDoesNotFit,  &kNotSettable,   &kTypesDiffer,
    &kNotATransform,   &kUnderItself,      &kWeightCount,   &kZeroLengthBone,
    &kRootExists,      &kNotMadeByCommand, &kSameAxis,      &kNoSolver,
    &kPoleOnLine,      &kTwistUnknown,     &kEmptyRange,    &kRestOutside,
    &kNotMirrored,     &kNoLimit,          &kNotLockable,   &kSettingsDiffer,
    &kSetInItself,     &kGroupName,        &kNoLimb,        &kNoRadius,
    &kNames,           &kNoZero,           &kTable,         &kNotAbove,
    &kDrivenBelow,     &kSoleGuessed,      &kNoFkChain,     &kNoSurface,
    &kNoLine,          &kAlongOrSurface,   &kTwistedBefore, &kFeetCount};

}  // namespace rigc::modules::codes
