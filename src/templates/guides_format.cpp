// SPDX-License-Identifier: MIT
// The keys of guides files. Test: tests/templates/guides_test.cpp
#include "templates/format.h"

namespace rigc::templates {

using yaml::Form;
using yaml::Section;

const Section& guides_format() {
  static const Section kFormat{
      "guides",
      "guides",
      {{"guides", Form::name, "Name of the template that they lie over.", {.required = true}},
       {"units",
        Form::word,
        "Of every length in this file (default: metre).",
        {.words = {"metre", "centimetre"}}},
       {"mirror",
        Form::word,
        "What is moved or edited on one side is on the other too, where that has nothing of its "
        "own. `x` and `both`: either side.",
        {.words = {"left_to_right", "right_to_left", "both", "x"}}},
       {"joints",
        Form::values,
        "`GROUP.LABEL`, or `GROUP[INDEX]`, to a place `[x, y, z]` in model space or `{at: [x, y, "
        "z], fitted: [x, y, z]}`: moved where the two differ.",
        {.null = true}},
       {"controls",
        Form::values,
        "A selector of a control to `{shape, size, offset, rotate, color}`; `{}`: as the template "
        "has it.",
        {.null = true}}}};
  return kFormat;
}

const Section& guide_format() {
  static const Section kFormat{
      "joint_guide",
      "a guide",
      {{"at", Form::numbers, "Where the joint is to be, in model space.", {.count = 3}},
       {"fitted",
        Form::numbers,
        "Where it was when the file was written; `rigc guides` keeps it up to date.",
        {.count = 3}}}};
  return kFormat;
}

const Section& control_edit_format() {
  static const Section kFormat{
      "control_edit",
      "an edit of a control",
      {{"shape", Form::text, "Another shape, in the place and size of the present one."},
       {"size", Form::number, "How many times as large.", {.above = 0}},
       {"offset", Form::numbers, "Moves the shape along the control's axes.", {.count = 3}},
       {"rotate", Form::numbers, "Turns the shape, degrees, X, then Y, then Z.", {.count = 3}},
       {"color", Form::any, "A colour's name or [r, g, b]."}}};
  return kFormat;
}

}  // namespace rigc::templates
