// SPDX-License-Identifier: MIT
// The keys of module descriptors and of shapes. The helps are what an editor shows. Test:
// tools/node/check_templates.mjs
#include "catalog/format.h"

#include "catalog/reader.h"

namespace rigc::catalog {

using yaml::Form;
using yaml::Section;

const Section& descriptor_format() {
  static const Section kFormat{
      "descriptor",
      "descriptor",
      {{"module", Form::name, "The module's name, which is the file's.", {.required = true}},
       {"version",
        Form::integer,
        "Raised where parameters, units or defaults change.",
        {.required = true, .min = 1, .max = 1'000'000}},
       {"title", Form::text, "What an editor shows.", {.required = true}},
       {"category", Form::name, "Family of modules.", {.required = true}},
       {"stage", Form::word, "When its commands run (default: build).", {.words = stage_names()}},
       {"summary", Form::text, "One sentence: what it does.", {.required = true}},
       {"help", Form::text, "What a user must know besides."},
       {"implementation", Form::name,
        "`builtin`, or the name of another module, whose constructor runs."},
       {"parameters", Form::parameters, "In the order and frames in which an editor shows them."},
       {"creates", Form::list, "The nodes that it makes.", {.section = &creates_format()}},
       {"replaces", Form::values,
        "Modules that this one succeeds, with their roles, and values of attributes that do what "
        "they did: `{fk_chain: {fk: fk, settings.ik_fk: 0}}`."},
       {"changes",
        Form::list,
        "What changed from version to version.",
        {.section = &change_format()}},
       {"example", Form::text, "A whole small template that uses it."}}};
  return kFormat;
}

const Section& frame_format() {
  static const Section kFormat{
      "frame", "frame", {{"frame", Form::text, "A heading in an editor.", {.required = true}}}};
  return kFormat;
}

const Section& parameter_format() {
  static const Section kFormat{
      "module_parameter",
      "parameter",
      {{"name", Form::name, "Key in `with:`.", {.required = true}},
       {"type", Form::word, "What it takes.", {.required = true, .words = type_names()}},
       {"title", Form::text, "What an editor shows (default: from the name)."},
       {"help", Form::text, "What it does.", {.required = true}},
       {"kind", Form::name, "Of node and nodes: the kind that is accepted."},
       {"required", Form::boolean, "A command must give it."},
       {"default", Form::any, "Its value where a command gives none."},
       {"optional", Form::boolean, "May be left out; the help says what then."},
       {"unit", Form::text, "Unit of numbers: metre, degree."},
       {"values", Form::texts, "The words of an enum."},
       {"min", Form::number, "The smallest value."},
       {"max", Form::number, "The largest value."},
       {"side",
        Form::word,
        "signed: changes sign, or side, on mirrored joints.",
        {.words = {"signed"}}}}};
  return kFormat;
}

const Section& creates_format() {
  static const Section kFormat{"creates",
                               "creates",
                               {{"role",
                                 Form::name,
                                 "The word by which the module tells its nodes apart.",
                                 {.required = true}},
                                {"kind", Form::name, "Kind of the node.", {.required = true}},
                                {"per",
                                 Form::word,
                                 "One for the command, or one for each joint (default: command).",
                                 {.words = {"command", "joint"}}},
                                {"help", Form::text, "What it is for.", {.required = true}}}};
  return kFormat;
}

const Section& change_format() {
  static const Section kFormat{
      "change",
      "change",
      {{"version", Form::integer, "The version that changed it.", {.required = true, .min = 2}},
       {"parameter", Form::name, "The parameter, by the name that it has now."},
       {"attribute", Form::name, "Or an attribute of its controls, by the name that it has now."},
       {"was", Form::name, "Its earlier name."},
       {"factor", Form::number, "A number from before times this (default: 1)..."},
       {"offset", Form::number, "... and plus this (default: 0) is what the version takes."},
       {"default_was", Form::any, "Its earlier default, as it was written then."},
       {"min_was", Form::number, "Its earlier smallest value, as it was written then."},
       {"max_was", Form::number, "Its earlier largest value, as it was written then."},
       {"note", Form::text, "What changed, for people."}}};
  return kFormat;
}

const Section& shape_format() {
  static const Section kFormat{
      "shape",
      "a shape",
      {{"help", Form::text, "What it looks like."},
       {"lines", Form::lines, "Lists of points, `[x, z]` or `[x, y, z]`."},
       {"curves", Form::lines, "The same, smoothed."},
       {"circles", Form::list, "Circles and arcs.", {.section = &circle_format()}},
       {"repeat",
        Form::integer,
        "Turns lines and curves about Y, this often.",
        {.min = 2, .max = 64}},
       {"mirror",
        Form::word,
        "Adds their mirror images across this axis.",
        {.words = {"x", "y", "z"}}}},
      {},
      {"lines", "curves", "circles"}};
  return kFormat;
}

const Section& circle_format() {
  static const Section kFormat{
      "circle",
      "circle",
      {{"radius", Form::number, "Default: 0.5.", {.max = kFarthest, .above = 0}},
       {"centre", Form::point, "`[x, z]` or `[x, y, z]`."},
       {"normal", Form::word, "Axis through its middle (default: y).", {.words = {"x", "y", "z"}}},
       {"segments", Form::integer, "Straight pieces.", {.min = 3, .max = 128}},
       {"from", Form::number, "First angle of an arc, degrees.", {.min = -360, .max = 360}},
       {"to",
        Form::number,
        "Last angle, at most 360 degrees from the first.",
        {.min = -720, .max = 720}}}};
  return kFormat;
}

}  // namespace rigc::catalog
