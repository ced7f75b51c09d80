// SPDX-License-Identifier: MIT
// Diagnostic codes 750..799: what only the whole pipeline can see.
#pragma once

#include "base/diagnostics.h"

namespace rigc::pipeline::codes {

inline constexpr Code kNoSkeleton{750, Severity::error, "model has no skeleton",
                                  "The model has no skin, so there is nothing to fit the template "
                                  "to. Without --model the template brings its own skeleton."};
inline constexpr Code kSeveralSkeletons{
    751, Severity::error, "model has several skeletons",
    "Name one with --skeleton: the name or number of a node in it."};
inline constexpr Code kNoSuchSkeleton{
    752, Severity::error, "no such skeleton",
    "--skeleton takes the name or number of a node that belongs to a skeleton of the model."};
inline constexpr Code kHasRig{753, Severity::error, "skeleton has a rig already",
                              "The model carries a rig on this skeleton. `rigc update` moves it to "
                              "another template version and keeps its keys."};
inline constexpr Code kNoRig{
    754, Severity::error, "file has no rig",
    "The file has no RIGC_rig. `rigc build TEMPLATE --model FILE` makes one."};
inline constexpr Code kNoSuchClip{
    755, Severity::error, "no such clip",
    "--clip takes the name or number of a clip in the file; `rigc inspect` lists them."};
inline constexpr Code kForeignChannels{
    756, Severity::warning, "clip has channels on driven joints",
    "The clip animates joints that the rig drives. Where it also animates controls, the controls "
    "win and bake replaces those channels."};
inline constexpr Code kBadRange{757, Severity::error, "empty range",
                                "--start lies after --end, or the frame rate is not above 0."};
inline constexpr Code kShear{
    758, Severity::warning, "joints are sheared",
    "Non-uniform scale above a rotated joint shears it, which translation, rotation and scale "
    "cannot say. The largest error is given."};
inline constexpr Code kUnknownFormat{759, Severity::error, "unknown kind of file",
                                     "rigc writes .glb and .gltf; the name's ending says which."};
inline constexpr Code kNotOneSelector{760, Severity::error, "query needs one rig",
                                      "The file has several rigs: begin the selector with a rig's "
                                      "global group, for example hero:arm_l/control."};

inline constexpr Code kNoSuchModule{761, Severity::error, "no such module",
                                    "`rigc modules` lists the modules that this run of rigc knows; "
                                    "--modules and RIGC_MODULES add more."};

inline constexpr Code kLockedKeys{
    795, Severity::warning, "keys on locked attributes",
    "The rig has locked attributes that the clip keys. They keep their value and the keys have no "
    "effect; take the keys away, or build without the `lock`."};

// What check finds.
inline constexpr Code kNothingFits{
    775, Severity::warning, "no template fits the skeleton",
    "The maps that rigc has do not find the joints that a template needs. `rigc map MODEL -o "
    "map.yaml` writes a first guess to correct."};
inline constexpr Code kNoAttributeKeyed{
    776, Severity::warning, "keys on an attribute that is not there",
    "The clip animates an attribute that the rig's control does not have; the keys have no "
    "effect."};
inline constexpr Code kDrivenKeyed{
    777, Severity::warning, "keys on what is not offered for keying",
    "A connection of the rig decides the attribute, or the control does not offer it: the keys "
    "have no effect, or one that the rig does not expect."};
inline constexpr Code kNotAControl{
    778, Severity::warning, "keys on a node between the controls",
    "The clip animates a node that the rig places itself. Key controls: other nodes may be "
    "others in the next version."};
inline constexpr Code kOutsideLimits{
    779, Severity::warning, "keys outside of limits",
    "The value of a key lies beyond the smallest or largest that the rig allows."};
inline constexpr Code kNodesMoved{
    780, Severity::warning, "nodes have other numbers",
    "Another program numbered the nodes anew. What the nodes say in extras.rigc counts, so the rig "
    "is whole; building it again brings both into agreement."};
inline constexpr Code kNoIdentity{
    781, Severity::warning, "nodes do not say what they are",
    "Nodes of the rig have no extras.rigc, so they are found only as long as no program numbers "
    "the nodes anew."};
inline constexpr Code kCannotPin{782, Severity::error, "pins cannot be written",
                                 "`rigc check --pin` writes `modules:` into template files."};
inline constexpr Code kNothingToCheck{
    783, Severity::error, "nothing to check",
    "In a folder, `rigc check` takes .glb, .gltf and .vrm files, and YAML files with the key "
    "`rigc`, `map` or `module`."};

// Extract and adopt: 850..879.
inline constexpr Code kWhichRig{850, Severity::error, "which rig",
                                "The file has several rigs, or none of that name. --rig names one "
                                "by its global group; `rigc inspect` lists them."};
inline constexpr Code kNotATemplateName{
    851, Severity::error, "not a template's name or version",
    "A template's name has letters, digits, `_` and `-` and does not start with a digit; its "
    "version is an integer from 1."};

inline constexpr Code kNothingToAdopt{
    852, Severity::error, "no node to adopt from",
    "Nodes are known by the custom property `rigc`. The edited file has none, or those of another "
    "rig. Blender exports them with `Include > Custom Properties`."};
inline constexpr Code kCopiedNode{
    853, Severity::error, "two nodes say that they are one",
    "A node was duplicated with its custom property `rigc`. Remove that from the copy."};
inline constexpr Code kStrangers{
    854, Severity::warning, "nodes that the rig does not have",
    "The edited file has nodes of a rig, or of a version of it, that the file given by --rig does "
    "not have. What was done to them is not adopted."};
inline constexpr Code kNoMorphTarget{
    859, Severity::warning, "no such morph target",
    "A `morph_targets` command names targets as the model does: in `extras.targetNames` of its "
    "meshes, those that the rig's joints move. What it drives is not seen on this model."};

inline constexpr const Code* kPipelineCodes[] = {
    &kNoSkeleton,     &kSeveralSkeletons, &kNoSuchSkeleton,   &kHasRig,
    &kNoRig,          &kNoSuchClip,       &kForeignChannels,  &kBadRange,
    &kShear,          &kUnknownFormat,    &kNotOneSelector,   &kNoSuchModule,
    &kLockedKeys,     &kNothingFits,      &kNoAttributeKeyed, &kDrivenKeyed,
    &kNotAControl,    &kOutsideLimits,    &kNodesMoved,       &kNoIdentity,
    &kCannotPin,      &kNothingToCheck,   &kWhichRig,         &kNotATemplateName,
    &kNothingToAdopt, &kCopiedNode,       &kStrangers,        &kNoMorphTarget};

}  // namespace rigc::pipeline::codes
