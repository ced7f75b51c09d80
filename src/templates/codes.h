// SPDX-License-Identifier: MIT
// Diagnostic codes 220..399: reading (220..269), arguments (270..289), the library and parts
// (290..329), placing (330..339), maps and fitting (340..369, 380..399). Test: tests/bad and
// tests/templates.
#pragma once

#include "base/diagnostics.h"

namespace rigc::templates::codes {

// Reading one file.
inline constexpr Code kUnknownFormat{
    220, Severity::error, "unknown template format",
    "A template begins with `rigc: 1`, the format that this program reads."};
inline constexpr Code kMissingKey{221, Severity::error, "required key is missing",
                                  "Something cannot be left out here: a template's name and "
                                  "version, a joint's name, a part's template."};
inline constexpr Code kNotAllowed{222, Severity::error, "value is not allowed",
                                  "The value has the right type but not a sensible amount: a "
                                  "version below 1, a count of 0, a scale of 0."};
inline constexpr Code kUnknownWord{
    223, Severity::error, "unknown word",
    "One of a few words is expected here: units, axes, stages, types of parameters."};
inline constexpr Code kDuplicateJoint{
    224, Severity::error, "two joints of one name",
    "A joint's name is its handle inside the template and unique in it."};
inline constexpr Code kUnknownJoint{225, Severity::error, "no such joint",
                                    "`parent`, `toward` and `attach` name a joint (or a label) of "
                                    "the same template, or a joint of one of its "
                                    "parts: `arm_l_elbow`."};
inline constexpr Code kJointCycle{226, Severity::error, "joints hang in a circle",
                                  "Following the parents of the joint leads back to it."};
inline constexpr Code kPlacementTwice{227, Severity::error, "placed twice",
                                      "A joint's place is `at` or `translate`; its orientation is "
                                      "one of `rotate`, `quat` and `orient`."};
inline constexpr Code kZeroQuaternion{
    228, Severity::error, "quaternion of no length",
    "A rotation is a quaternion [x, y, z, w] of length 1; [0, 0, 0, 1] is none."};
inline constexpr Code kBadAxes{
    229, Severity::error, "axes do not span a frame",
    "`aim` and `up` of `orient` name two different axes, and `up_toward` is a direction."};
inline constexpr Code kBadUid{230, Severity::error, "not a uid",
                              "A uid has exactly 16 hexadecimal digits, not all of them 0."};
inline constexpr Code kNotATag{231, Severity::error, "neither a command nor a feature",
                               "An item of `tags` is `command: MODULE`, or `feature: NAME` with "
                               "`commands`, or only `commands`."};
inline constexpr Code kCommandIdTwice{
    232, Severity::error, "two commands of one id on a joint",
    "A command's id, by default its module's name, keeps animation at its nodes. Give one of them "
    "an `id:`; an "
    "automatic number would hand one control's keys to another as soon as a command is inserted."};
inline constexpr Code kUndeclaredFeature{
    233, Severity::error, "feature is not declared",
    "The template has a catalogue `features:` and this feature is not in it."};
inline constexpr Code kUndeclaredSwitch{
    234, Severity::error, "switch is not declared",
    "The feature's entry in `features:` does not list this switch."};
inline constexpr Code kFeatureKind{
    235, Severity::error, "feature of two kinds",
    "A feature's kind is the one in the catalogue `features:`, also in parts."};
inline constexpr Code kUnknownModule{
    236, Severity::error, "no such module",
    "No descriptor has this name. `rigc modules` lists all; `--modules` adds folders."};
inline constexpr Code kModuleVersion{
    237, Severity::error, "module version does not exist",
    "The template is pinned to a version of the module that this program does not have."};
inline constexpr Code kUnknownParameter{
    238, Severity::error, "no such parameter",
    "`$name` stands for a parameter that the template declares in `parameters:`."};
inline constexpr Code kBadCondition{
    239, Severity::error, "condition cannot be read",
    "`if` takes `$name`, `not $name`, or `$name OP value` with one of == != < <= > >=."};
inline constexpr Code kBadParameter{
    240, Severity::error, "parameter's declaration does not fit itself",
    "The default of a parameter has its type and lies in its range, and an enum lists its values."};
inline constexpr Code kDuplicatePart{
    241, Severity::error, "two parts of one name",
    "`as` names a part's joints and groups and is unique in the template."};
inline constexpr Code kEmptyTemplate{242, Severity::error, "template without joints",
                                     "A template has `joints`, or `parts`, or both."};
inline constexpr Code kDuplicateWord{243, Severity::error, "named twice",
                                     "A list of names has one of them twice."};

// Arguments of commands.
inline constexpr Code kUnknownArgument{270, Severity::error, "module has no such parameter",
                                       "The keys of `with` are the parameters of the module's "
                                       "descriptor. `rigc modules NAME` explains them."};
inline constexpr Code kMissingArgument{
    271, Severity::error, "required parameter is missing",
    "The module cannot do without this parameter. `rigc modules NAME` explains it."};
inline constexpr Code kArgumentValue{272, Severity::error, "value does not fit the parameter",
                                     "Type, range or choice of the value are not those that the "
                                     "descriptor or `parameters:` declare."};
inline constexpr Code kPlugNeedsAttribute{
    273, Severity::error, "selector names no attribute",
    "The parameter takes an attribute of a node: add `@attribute` to the selector."};
inline constexpr Code kNodeWithAttribute{
    274, Severity::error, "selector names an attribute",
    "The parameter takes a node: remove `@attribute` from the selector."};

// The library, parts, expanding.
inline constexpr Code kUnknownTemplate{290, Severity::error, "template not found",
                                       "There is no such file, and no template of this name in the "
                                       "folders --templates, RIGC_TEMPLATES and the "
                                       "data folder."};
inline constexpr Code kUnknownPart{291, Severity::error, "part not found",
                                   "A part is looked for beside the template that names it, then "
                                   "in the template folders; `parts/arm` is the "
                                   "file parts/arm.yaml there."};
inline constexpr Code kPartOutside{292, Severity::error, "part lies outside",
                                   "Parts are files in the folder of the template or in a template "
                                   "folder, or below: no absolute paths, no `..` "
                                   "and no links that lead out."};
inline constexpr Code kPartCycle{293, Severity::error, "template is part of itself",
                                 "Following the parts of the template leads back to it."};
inline constexpr Code kTooMuch{
    294, Severity::error, "template grows too large",
    "Parts may be nested 16 deep, and a skeleton has at most 20,000 joints."};
inline constexpr Code kUnboundGroup{296, Severity::error, "group that the part needs is not bound",
                                    "The part lists groups of its surroundings in `needs:`; "
                                    "`groups: {theirs: ours}` says which they are."};
inline constexpr Code kNotNeeded{
    297, Severity::error, "part does not need this group",
    "`groups` binds the groups that the part lists in `needs:`, and no others."};
inline constexpr Code kUnknownPartParameter{
    298, Severity::error, "part has no such parameter",
    "The keys of a part's `with` are those that the part declares in `parameters:`."};
inline constexpr Code kJointNameTaken{
    299, Severity::error, "joint's name is taken",
    "A joint of a part is named PART_JOINT; another joint of the template has that name."};
inline constexpr Code kUidTwice{300, Severity::error, "two joints of one uid",
                                "A uid comes from `uid:`, else from the (earliest) name. Two "
                                "joints have the same: give one of them a `uid:` "
                                "of its own."};
inline constexpr Code kAmbiguousLabel{
    301, Severity::error, "label of several joints",
    "The word is no joint's name but the label of several; name a joint, or GROUP.LABEL."};
inline constexpr Code kNoJointsLeft{302, Severity::error, "no joint is left",
                                    "The conditions of the template take away every joint."};

// Placing.
inline constexpr Code kNowhereToAim{330, Severity::error, "nothing to aim at",
                                    "`orient` points at the joint `toward`, by default the next of "
                                    "the chain or the first child; there is none, or "
                                    "it lies in the same place."};
inline constexpr Code kUpAlongBone{331, Severity::error, "up lies along the bone",
                                   "`up_toward` of `orient` is parallel to the bone, so that the "
                                   "joint's turn about the bone is not determined."};

// Maps and fitting.
inline constexpr Code kUnknownMap{
    340, Severity::error, "map not found",
    "There is no such file, and no map of this name in `maps/` of the template folders."};
inline constexpr Code kNoMapFits{341, Severity::error, "no map fits the skeleton",
                                 "None of the maps finds its required bones. Name one with --map, "
                                 "or write one for this skeleton."};
inline constexpr Code kBadMapEntry{342, Severity::error, "map entry cannot be read",
                                   "A map's `joints:` go from GROUP.LABEL, or GROUP for the "
                                   "group's chain, to a bone's name or a list of them."};
inline constexpr Code kMissingBone{343, Severity::error, "model lacks a required joint",
                                   "A joint of the template that is neither `optional` nor "
                                   "`helper` has no bone in the model. Correct the map, or "
                                   "make the joint optional in the template."};
inline constexpr Code kNotInMap{
    344, Severity::error, "map says nothing about a required joint",
    "The map has no entry for a joint of the template that is neither `optional` nor `helper`."};
inline constexpr Code kBoneTwice{
    345, Severity::error, "one bone for two joints",
    "Two joints of the template were matched with the same bone of the model."};
inline constexpr Code kAsymmetric{346, Severity::warning, "rest pose is asymmetric",
                                  "A joint is farther from the mirror image of its opposite than 2 "
                                  "% of the height. The rest pose may be a frame "
                                  "of a clip; `--rest bind` uses the bind pose."};
inline constexpr Code kHierarchyDiffers{347, Severity::warning, "bones hang differently",
                                        "A joint hangs below another in the template, but its bone "
                                        "not below the other's in the model."};
inline constexpr Code kSheared{348, Severity::warning, "rest pose is sheared",
                               "Scales that differ by axis above a turned joint shear it. A "
                               "joint's rest has no shear; what is left out is "
                               "stated."};
inline constexpr Code kBuiltOtherwise{
    349, Severity::warning, "model is built otherwise than the template",
    "No turn and no size of the template comes near to where the matched joints are: the model may "
    "be "
    "another kind of creature, or the map names the wrong bones. The rig is built as asked."};
inline constexpr Code kMirrorImage{
    351, Severity::warning, "model is the template's mirror image",
    "The matched joints lie as the template's would in a mirror. The map, or the names of the "
    "bones, "
    "exchange left and right, and the rig would face backward; or a right hand was given to the "
    "template of a left one."};
inline constexpr Code kBadModel{350, Severity::error, "skeleton is malformed",
                                "The skeleton's joints do not form a forest."};

// Versions of templates and modules.
inline constexpr Code kVersionTwice{
    352, Severity::warning, "two files are one version of a template",
    "A template's name and version say which one a rig was made from and which is newer. Two files "
    "of one folder claim the same ones."};
inline constexpr Code kClamped{
    353, Severity::warning, "value lies outside of the module's newer range",
    "The command was written for an earlier version of the module, which allowed the value. The "
    "nearest value that the module takes now is used."};
inline constexpr Code kArgumentTwice{354, Severity::error, "parameter is given by two names",
                                     "The template is pinned to an earlier version of the module: "
                                     "the parameter may have its earlier "
                                     "or its present name, but not both."};
inline constexpr Code kArgumentGone{355, Severity::warning, "module has no such parameter any more",
                                    "The command was written for an earlier version of the module, "
                                    "whose parameter is gone. What it "
                                    "said has no effect."};

inline constexpr Code kBadSides{380, Severity::error, "sides of a map cannot be read",
                                "`sides: {l: Left, r: Right}` says what {s} in a key and {side} in "
                                "a bone's name stand for. A line for both sides has both."};
inline constexpr Code kMapEntryTwice{381, Severity::error, "map has a joint twice",
                                     "Each joint, or chain of a group, has one line in a map. A "
                                     "line with {s} stands for one line of each side."};
inline constexpr Code kMapEntryIdle{
    382, Severity::warning, "template has no such joint",
    "A line of the map given with --map names a joint that the template does not have."};
inline constexpr Code kMapBoneAbsent{
    383, Severity::warning, "model has no such bone",
    "A line of the map given with --map names a bone that the model does not have. Write `~` where "
    "the model has none."};

inline constexpr Code kTooMuchToGuess{
    384, Severity::error, "skeleton is too large to guess its map",
    "Guessing compares every joint of the template with every bone, and stops at four million "
    "pairs. Write the map by hand."};

// Guides: 900 to 909.
inline constexpr Code kBadGuide{900, Severity::error, "guides cannot be read",
                                "A guides file names joints and controls and says where they are "
                                "and what they look like; `rigc guides TEMPLATE -o guides.yaml` "
                                "writes one."};
inline constexpr Code kOtherGuides{901, Severity::error, "guides are of another template",
                                   "`guides:` names the template that the file lies over. A "
                                   "template that was renamed says so with `was:`."};
inline constexpr Code kUnknownGuide{
    902, Severity::error, "no such joint or control",
    "Guides are called by group and label (arm_l.elbow), by group and number (spine[1]), or, "
    "without a group, by the joint's handle in the template."};
inline constexpr Code kGuideTwice{903, Severity::error, "joint has two guides",
                                  "Two names of one joint: keep one of them."};
inline constexpr Code kGuideOfModel{
    904, Severity::error, "joint of the model cannot be moved",
    "The model's skin is bound to its joints where they stand, and its clips move them from there; "
    "rigc leaves both as they are. Move the joint in the program that made the model, or let a map "
    "give the template's joint no bone (`~`): rigc then makes one."};
inline constexpr Code kGuideGone{905, Severity::warning, "moved joint is gone",
                                 "The template, fitted to this model, has no such joint any more. "
                                 "What was said of it stays in the file as a comment."};
inline constexpr Code kBadBetween{906, Severity::error, "guide lies between nothing",
                                  "`guide: {between: [a, b]}` takes two different joints, neither "
                                  "of which lies between others itself."};

inline constexpr const Code* kTemplatesCodes[] = {&kUnknownFormat,
                                                  &kMissingKey,
                                                  &kNotAllowed,
                                                  &kUnknownWord,
                                                  &kDuplicateJoint,
                                                  &kUnknownJoint,
                                                  &kJointCycle,
                                                  &kPlacementTwice,
                                                  &kZeroQuaternion,
                                                  &kBadAxes,
                                                  &kBadUid,
                                                  &kNotATag,
                                                  &kCommandIdTwice,
                                                  &kUndeclaredFeature,
                                                  &kUndeclaredSwitch,
                                                  &kFeatureKind,
                                                  &kUnknownModule,
                                                  &kModuleVersion,
                                                  &kUnknownParameter,
                                                  &kBadCondition,
                                                  &kBadParameter,
                                                  &kDuplicatePart,
                                                  &kEmptyTemplate,
                                                  &kDuplicateWord,
                                                  &kUnknownArgument,
                                                  &kMissingArgument,
                                                  &kArgumentValue,
                                                  &kPlugNeedsAttribute,
                                                  &kNodeWithAttribute,
                                                  &kUnknownTemplate,
                                                  &kUnknownPart,
                                                  &kPartOutside,
                                                  &kPartCycle,
                                                  &kTooMuch,
                                                  &kUnboundGroup,
                                                  &kNotNeeded,
                                                  &kUnknownPartParameter,
                                                  &kJointNameTaken,
                                                  &kUidTwice,
                                                  &kAmbiguousLabel,
                                                  &kNoJointsLeft,
                                                  &kNowhereToAim,
                                                  &kUpAlongBone,
                                                  &kUnknownMap,
                                                  &kNoMapFits,
                                                  &kBadMapEntry,
                                                  &kMissingBone,
                                                  &kNotInMap,
                                                  &kBoneTwice,
                                                  &kAsymmetric,
                                                  &kHierarchyDiffers,
                                                  &kSheared,
                                                  &kBuiltOtherwise,
                                                  &kMirrorImage,
                                                  &kBadModel,
                                                  &kVersionTwice,
                                                  &kClamped,
                                                  &kArgumentTwice,
                                                  &kArgumentGone,
                                                  &kBadSides,
                                                  &kMapEntryTwice,
                                                  &kMapEntryIdle,
                                                  &kMapBoneAbsent,
                                                  &kTooMuchToGuess,
                                                  &kBadGuide,
                                                  &kOtherGuides,
                                                  &kUnknownGuide,
                                                  &kGuideTwice,
                                                  &kGuideOfModel,
                                                  &kGuideGone,
                                                  &kBadBetween};

}  // namespace rigc::templates::codes
