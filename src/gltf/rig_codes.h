// SPDX-License-Identifier: MIT
// Diagnostic codes 700..749: rigs in files (RIGC_rig and what stands for it in the nodes).
// Test: every code is provoked by a test in tests/gltf.
#pragma once

#include "base/diagnostics.h"

namespace rigc::gltf::codes {

// The text of RIGC_rig.
inline constexpr Code kRigVersion{
    700, Severity::error, "unknown version of RIGC_rig",
    "The rig was written by a newer rigc, or `version` is missing. Use that version of rigc."};
inline constexpr Code kRigType{
    701, Severity::error, "missing or wrong type in RIGC_rig",
    "A member of the rig's data is missing or has another JSON type than docs/RIGC_rig.md says. "
    "The "
    "file was edited by hand or damaged; build it again from its template."};
inline constexpr Code kRigIndex{
    702, Severity::error, "index out of range in RIGC_rig",
    "A number in the rig's data names an element that does not exist, or must come earlier."};
inline constexpr Code kRigWord{
    703, Severity::error, "unknown word in RIGC_rig",
    "The rig's data name a kind, an attribute or a flavour that rigc does not have."};
inline constexpr Code kRigText{704, Severity::error, "bad text in RIGC_rig",
                               "Uids are 16 hex digits, identities "
                               "`rig:owner:holder:command:role:counter`, names of attributes "
                               "letters, digits, `_` and `-`."};
inline constexpr Code kRigDuplicate{
    705, Severity::error, "duplicate in RIGC_rig",
    "Ids of rigs, keys of joints, identities, connected plugs and names of attributes are unique."};
inline constexpr Code kRigHierarchy{706, Severity::error, "bad hierarchy in RIGC_rig",
                                    "Parents and children of the rig's nodes contradict each "
                                    "other, lead back to themselves, or are "
                                    "nested more than 1,024 deep."};
inline constexpr Code kRigConnection{
    707, Severity::error, "bad connection in RIGC_rig",
    "A connection leads from a plug to an input of the same type; both must exist."};
inline constexpr Code kRigValue{
    708, Severity::error, "value does not fit in RIGC_rig",
    "The value of an attribute has another type, or another count of numbers, than its kind says."};
inline constexpr Code kRigTooLarge{709, Severity::error, "rig is too large",
                                   "A rig has at most 16,384 joints, 32,768 nodes and 32,768 "
                                   "commands, a file at most 1,024 rigs."};

// Rigs in nodes.
inline constexpr Code kSameIdentity{715, Severity::error, "two nodes with one identity",
                                    "extras.rigc says which node of the rig a glTF node is. "
                                    "Somebody copied one; remove extras.rigc "
                                    "from the copy."};
inline constexpr Code kNodeLost{
    716, Severity::warning, "node of the rig is gone",
    "The file has no node that stands for this part of the rig: another program removed it."};
inline constexpr Code kExtraNotNumber{
    717, Severity::warning, "attribute is not a number",
    "Attributes of controls are plain numbers in extras. The value of the rig is used instead."};
inline constexpr Code kNotWritable{718, Severity::error, "number cannot be written",
                                   "A value of the rig is not finite, or too large for the 32-bit "
                                   "numbers of glTF. Look at sizes and "
                                   "scales in the template."};

inline constexpr Code kLockedMoved{
    745, Severity::warning, "locked attribute was changed",
    "Another program moved a control where its rig has locked it. The rig's value is used."};

// Skins that share their weights with joints of a rig.
inline constexpr Code kMovesNothing{
    910, Severity::warning, "feature moves no vertex",
    "The joints that it drives have no weight in the model's skins, and no mesh hangs below them. "
    "Joints that a rig makes along a bone, as twist and ribbons do, bend a model where its skins "
    "are "
    "bound to them: `rigc build --split-weights`, or `rigc rebuild --split-weights on` where a rig "
    "is there, gives them a share of what is weighted to the bone's joint."};
inline constexpr Code kNotShared{
    911, Severity::warning, "weights are not shared",
    "A skin needs inverse bind matrices, and a mesh one skin and vertices that are not compressed, "
    "to be bound to further joints. It stays bound as it was."};

inline constexpr const Code* kRigCodes[] = {
    &kRigVersion,   &kRigType,      &kRigIndex,       &kRigWord,     &kRigText,
    &kRigDuplicate, &kRigHierarchy, &kRigConnection,  &kRigValue,    &kRigTooLarge,
    &kSameIdentity, &kNodeLost,     &kExtraNotNumber, &kNotWritable, &kLockedMoved,
    &kMovesNothing, &kNotShared};

}  // namespace rigc::gltf::codes
