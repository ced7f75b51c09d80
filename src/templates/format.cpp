// SPDX-License-Identifier: MIT
// The keys of template files. The helps are what an editor shows. Test:
// tools/node/check_templates.mjs
#include "templates/format.h"

#include "catalog/descriptor.h"
#include "catalog/format.h"

namespace rigc::templates {

using yaml::Form;
using yaml::Section;

const Section& template_format() {
  static const Section kFormat{
      "template",
      "a template",
      {{"rigc", Form::word, "Format of this file: 1.", {.required = true, .words = {"1"}}},
       {"name",
        Form::name,
        "Identity of the template: updates look templates up by it.",
        {.required = true}},
       {"was", Form::names,
        "Names it had before, oldest first, or the template it was copied from: whose uids it "
        "keeps."},
       {"version",
        Form::integer,
        "Raise it with every published change.",
        {.required = true, .min = 1, .max = kMostVersion}},
       {"description", Form::text, "A line for people."},
       {"preview", Form::text, "A picture beside the file."},
       {"global", Form::name,
        "The rig's name in selectors (default: the template's name); `rigc build --global hero` "
        "renames it."},
       {"units",
        Form::word,
        "Of every length in this file (default: metre).",
        {.words = {"metre", "centimetre"}}},
       {"features",
        Form::named,
        "Catalogue of the features: what a loader shows. Where there is one, other features and "
        "switches are errors.",
        {.null = true, .section = &feature_declaration_format()}},
       {"modules", Form::versions,
        "Module versions that the template was written for: their defaults stay what they were. "
        "`rigc check --pin` writes them."},
       {"parameters",
        Form::named,
        "What a part takes from its user: `$name` stands for the value in `with:`, `count:` and "
        "`if:`.",
        {.section = &parameter_format()}},
       {"needs", Form::names,
        "Local groups of its surroundings that a part names in its selectors; its user binds them "
        "with `groups:`."},
       {"groups", Form::values,
        "Local groups, each with the one that it lies beneath, whose settings count for it too; "
        "those "
        "of parts do anyway."},
       {"joints",
        Form::list,
        "The skeleton; each joint may carry tags.",
        {.null = true, .section = &joint_format()}},
       {"parts",
        Form::list,
        "Other templates whose joints join this skeleton.",
        {.null = true, .section = &part_format()}},
       {"shapes",
        Form::named,
        "Control shapes of this template, for `shape:`.",
        {.section = &catalog::shape_format()}}},
      {},
      {"joints", "parts"}};
  return kFormat;
}

const Section& parameter_format() {
  static const Section kFormat{
      "parameter",
      "a parameter",
      {{"type",
        Form::word,
        "What the parameter takes.",
        {.required = true,
         .words = {"float", "int", "bool", "angle", "length", "vec3", "color", "enum", "string"}}},
       {"default", Form::any, "Its value where the part's user gives none; without it, one must."},
       {"min", Form::number, "The smallest value."},
       {"max", Form::number, "The largest value."},
       {"values", Form::names, "The words of an enum."},
       {"help", Form::text, "What it does."}}};
  return kFormat;
}

const Section& feature_declaration_format() {
  static const Section kFormat{
      "feature_declaration",
      "a feature",
      {{"kind", Form::name, "Features of one kind and name in a local group act as one."},
       {"title", Form::text, "What a loader shows."},
       {"help", Form::text, "What it does."},
       {"default", Form::boolean, "Whether it is on unless somebody says otherwise (default: on)."},
       {"switches", Form::names, "Names of toggles inside the feature."}}};
  return kFormat;
}

const Section& joint_format() {
  static const Section kFormat{
      "joint",
      "a joint",
      {{"name", Form::name, "A handle inside this file, unique in it.", {.required = true}},
       {"parent",
        Form::name,
        "A joint of this file (or its label), or of a part: `arm_l_elbow`. Without it: a root.",
        {.null = true}},
       {"at",
        Form::numbers,
        "Place in model space: `[x, y, z]`; X left, Y up, Z forward.",
        {.count = 3}},
       {"translate", Form::numbers, "Place in the parent's space, instead of `at`.", {.count = 3}},
       {"rotate", Form::numbers, "Degrees in the parent's space, X, then Y, then Z.", {.count = 3}},
       {"quat", Form::numbers, "Orientation in the parent's space: `[x, y, z, w]`.", {.count = 4}},
       {"orient", Form::map, "Orientation aimed along the bone.", {.section = &orient_format()}},
       {"scale",
        Form::numbers,
        "Three numbers above 0; leave it out.",
        {.above = kSmallestScale, .count = 3}},
       {"guide",
        Form::map,
        "The joint lies between two others until somebody moves it.",
        {.section = &between_format()}},
       {"local", Form::name, "Identifier: the limb that the joint belongs to."},
       {"global", Form::name, "Identifier: the rig, if not this template's own."},
       {"label", Form::name, "Identifier: which joint of the limb it is."},
       {"chain",
        Form::map,
        "The joint is a row of joints, which adapts to a fitted model.",
        {.section = &chain_format()}},
       {"optional", Form::boolean,
        "A model that the template is fitted to may lack it: its tags go, its children hang on "
        "the nearest joint that is there."},
       {"helper", Form::boolean, "Not a bone: rigc makes it where a model lacks it."},
       {"was", Form::names, "Earlier names, oldest first: animation survives a rename."},
       {"uid", Form::uid,
        "Identity, 16 hexadecimal digits, if it shall not come from the name; a list where it had "
        "others before, the one that counts first."},
       {"mirrored", Form::boolean,
        "Its frame is one of the mirrored side, as in a part with `mirror:` (default: false)."},
       {"opposite",
        Form::name,
        "The joint on the other side, where the names do not say it by `_l` and `_r`; without a "
        "value: none.",
        {.null = true}},
       {"if", Form::condition, "The joint and all below it are there only then."},
       {"tags", Form::tags, "Commands and features, run top to bottom.", {.null = true}}},
      {{"at", "translate"}, {"rotate", "quat", "orient"}}};
  return kFormat;
}

namespace {

const std::vector<std::string> kAxes = {"+x", "-x", "+y", "-y", "+z", "-z", "x", "y", "z"};

}  // namespace

const Section& orient_format() {
  static const Section kFormat{
      "orient",
      "orient",
      {{"aim",
        Form::word,
        "The joint's axis that points at `toward` (default: +y).",
        {.words = kAxes}},
       {"toward", Form::name,
        "A joint that is placed by `at` (default: the next of the chain, else the first child)."},
       {"up",
        Form::word,
        "The joint's axis that is turned to `up_toward` (default: +z).",
        {.words = kAxes}},
       {"up_toward",
        Form::numbers,
        "A direction of model space (default: the axis of the same name as `up`).",
        {.count = 3}}}};
  return kFormat;
}

const Section& chain_format() {
  static const Section kFormat{"chain",
                               "a chain",
                               {{"count",
                                 Form::count,
                                 "How many joints, or `$parameter`, where 0 takes the chain away.",
                                 {.required = true, .min = 1, .max = kMostInChain}},
                                {"to",
                                 Form::numbers,
                                 "Place of the last joint in model space: they stand in a line.",
                                 {.count = 3}},
                                {"steps",
                                 Form::list,
                                 "Places of the joints after the first, each in the space of the "
                                 "one before, instead of `to`.",
                                 {.section = &step_format()}}},
                               {{"to", "steps"}}};
  return kFormat;
}

const Section& step_format() {
  static const Section kFormat{
      "step",
      "a step of a chain",
      {{"translate", Form::numbers, "From the joint before, in its space.", {.count = 3}},
       {"rotate", Form::numbers, "Degrees, X, then Y, then Z.", {.count = 3}},
       {"quat", Form::numbers, "Orientation: `[x, y, z, w]`.", {.count = 4}},
       {"scale",
        Form::numbers,
        "Three numbers above 0; leave it out.",
        {.above = kSmallestScale, .count = 3}}},
      {{"rotate", "quat"}}};
  return kFormat;
}

const Section& command_format() {
  static const Section kFormat{
      "command",
      "a command",
      {{"command", Form::module, "The module that runs.", {.required = true}},
       {"id", Form::name,
        "Stable id on this joint, which keeps animation (default: the module's name)."},
       {"comment", Form::text, "A line for people."},
       {"stage",
        Form::word,
        "Another stage than the module's.",
        {.words = {"build", "connect", "finish", "optimize"}}},
       {"on", Form::boolean, "Off: written, but not run."},
       {"with", Form::arguments, "The module's parameters.", {.null = true}},
       {"was", Form::holders,
        "JOINT/ID that this command's nodes had before, oldest first; a joint also by its uid."},
       {"if", Form::condition, "The command is there only then."}}};
  return kFormat;
}

const Section& feature_format() {
  static const Section kFormat{
      "feature",
      "a feature",
      {{"feature", Form::name, "Name of the feature that the commands belong to.", {.null = true}},
       {"kind", Form::name, "Kind of the feature, where no catalogue declares it."},
       {"switch", Form::name, "Switch of the feature that they belong to."},
       {"on", Form::boolean, "Off: written, but not run."},
       {"if", Form::condition, "The commands are there only then."},
       {"commands",
        Form::list,
        "The commands, run top to bottom.",
        {.required = true, .null = true, .section = &command_format()}}}};
  return kFormat;
}

const Section& part_format() {
  static const Section kFormat{
      "part",
      "a part",
      {{"template",
        Form::text,
        "`parts/arm`: parts/arm.yaml beside this file, else in the template folders.",
        {.required = true}},
       {"as", Form::name, "Names its joints and groups.", {.required = true}},
       {"was", Form::names, "Earlier `as`, oldest first."},
       {"attach", Form::text,
        "A joint, label or GROUP.LABEL of this template: what its roots hang on."},
       {"mirror",
        Form::word,
        "Reflected at the plane across this axis, by behaviour: equal rotations give mirrored "
        "poses.",
        {.words = {"x", "y", "z"}}},
       {"at", Form::numbers, "Its origin in this template's model space.", {.count = 3}},
       {"rotate", Form::numbers, "Degrees, X, then Y, then Z.", {.count = 3}},
       {"size", Form::number, "Scales its positions.", {.above = kSmallestScale}},
       {"with", Form::values, "Its parameters.", {.null = true}},
       {"groups", Form::names_by_name, "The groups that it needs: theirs -> ours."},
       {"if", Form::condition, "The part is there only then."}}};
  return kFormat;
}

const Section& map_format() {
  static const Section kFormat{
      "map",
      "a map",
      {{"map", Form::name, "Name of the map, for `--map`.", {.required = true}},
       {"title", Form::text, "What models it is for."},
       {"names",
        Form::word,
        "How names of bones are compared: `bones` without case, prefix and suffix (default), "
        "`words` word by word, `humanoid` by the VRM humanoid table.",
        {.words = {"bones", "words", "humanoid"}}},
       {"prefixes", Form::texts,
        "Cut from the begin of bone names; `#` stands for any digits, or none."},
       {"suffixes", Form::texts, "Cut from their end."},
       {"ignore", Form::texts, "Words in names that say nothing."},
       {"sides", Form::texts_by_name,
        "What `{s}` in a key and `{side}` in a bone's name stand for: `{l: Left, r: Right}`."},
       {"requires", Form::text_lists,
        "For detection: such bones must be there; of a list inside one."},
       {"joints",
        Form::bones,
        "`GROUP.LABEL: Bone` or a list of which the first counts that is there; `GROUP: [Bone, "
        "...]` for the group's chain; `~` where the model has no such bone.",
        {.required = true}}}};
  return kFormat;
}

const Section& between_format() {
  static const Section kFormat{
      "guide",
      "a guide",
      {{"between", Form::names, "The two joints that it lies between.", {.required = true}},
       {"at",
        Form::number,
        "How much of the second one's way it goes along, 0 to 1 (default: 0.5).",
        {.min = 0, .max = 1}}}};
  return kFormat;
}

}  // namespace rigc::templates
