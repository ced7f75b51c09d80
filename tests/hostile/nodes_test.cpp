// SPDX-License-Identifier: MIT
// Damaged hierarchies, transforms, scenes and meshes: what rigc reads or would break is refused.
#include <doctest/doctest.h>

#include "hostile/hostile_helpers.h"

using namespace rigc::test;

TEST_CASE("hostile nodes: hierarchies that are no trees") {
  expect(
      {{"own_child", {"/nodes/{joint}/children", "[{joint}]"}, 660, "/nodes/{joint}"},
       {"cycle", {"/nodes/{joint}/children", "[{root}]"}, 661, "/nodes/{root}"},
       {"two_parents", {"/nodes/{root}/children", "[{joint}, {joint}]"}, 660, "/nodes/{joint}"},
       {"child_beyond", {"/nodes/{joint}/children", "[{nodes}]"}, 657, "/nodes/{joint}/children/0"},
       {"child_negative", {"/nodes/{joint}/children", "[-1]"}, 657, "/nodes/{joint}/children/0"},
       {"child_fraction", {"/nodes/{joint}/children", "[0.5]"}, 655, "/nodes/{joint}/children/0"},
       {"child_huge", {"/nodes/{joint}/children", "[1e30]"}, 655, "/nodes/{joint}/children/0"},
       {"child_2_to_53",
        {"/nodes/{joint}/children", "[9007199254740992]"},
        657,
        "/nodes/{joint}/children/0"},
       {"child_2_to_64",
        {"/nodes/{joint}/children", "[18446744073709551616]"},
        655,
        "/nodes/{joint}/children/0"},
       {"child_text", {"/nodes/{joint}/children", R"(["0"])"}, 655, "/nodes/{joint}/children/0"},
       {"child_null", {"/nodes/{joint}/children", "[null]"}, 655, "/nodes/{joint}/children/0"},
       {"children_object", {"/nodes/{joint}/children", "{}"}, 655},
       {"children_number", {"/nodes/{joint}/children", "7"}, 655},
       {"scene_beyond", {"/scene", "9"}, 657},
       {"scene_negative", {"/scene", "-1"}, 657},
       {"scene_text", {"/scene", R"("main")"}, 655},
       {"scene_root_beyond", {"/scenes/0/nodes", "[{nodes}]"}, 657, "/scenes/0/nodes/0"},
       {"scene_roots_object", {"/scenes/0/nodes", "{}"}, 655}},
      "hierarchy");
}

TEST_CASE("hostile nodes: transforms") {
  expect({{"translation_short", {"/nodes/{joint}/translation", "[0, 1]"}, 662},
          {"translation_long", {"/nodes/{joint}/translation", "[0, 1, 2, 3]"}, 662},
          {"translation_empty", {"/nodes/{joint}/translation", "[]"}, 662},
          {"translation_object", {"/nodes/{joint}/translation", R"({"x": 1})"}, 662},
          {"translation_null", {"/nodes/{joint}/translation", "null"}, 662},
          {"translation_text", {"/nodes/{joint}/translation", R"(["0", 1, 2])"}, 662},
          {"translation_nested", {"/nodes/{joint}/translation", "[[0], [1], [2]]"}, 662},
          {"rotation_short", {"/nodes/{joint}/rotation", "[0, 0, 1]"}, 662},
          {"rotation_zero", {"/nodes/{joint}/rotation", "[0, 0, 0, 0]"}, 663},
          {"rotation_tiny", {"/nodes/{joint}/rotation", "[0, 1e-30, 0, 0]"}, 663},
          {"rotation_number", {"/nodes/{joint}/rotation", "90"}, 662},
          {"scale_short", {"/nodes/{joint}/scale", "[1]"}, 662},
          {"scale_number", {"/nodes/{joint}/scale", "1"}, 662},
          {"matrix_short", {"/nodes/{joint}/matrix", "[1, 0, 0, 0]"}, 662},
          {"matrix_rows", {"/nodes/{joint}/matrix", "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]"}, 662},
          {"nan", {"/nodes/{joint}/translation", "[NaN, 0, 0]"}, 60, "@1"},
          {"infinity", {"/nodes/{joint}/translation", "[Infinity, 0, 0]"}, 60, "@1"},
          {"overflow", {"/nodes/{joint}/translation", "[1e999, 0, 0]"}, 66, "@1"},
          {"minus_overflow", {"/nodes/{joint}/scale", "[1, -1e400, 1]"}, 66, "@4"},
          {"leading_zero", {"/nodes/{joint}/translation", "[01, 0, 0]"}, 60, "@1"}},
         "transforms");
}

TEST_CASE("hostile nodes: a skeleton in a space of no size") {
  Victim victim = small_victim();
  victim.json["nodes"].push_back({{"children", {0}}, {"scale", {1, 0, 1}}});
  victim.json["scenes"][0]["nodes"] = {3, 2};
  const auto folder = broken_folder("flat");
  expect({"flat", {"/nodes/3/name", "\"flat\""}, 691, "/nodes/3", Ask::build}, victim, folder);
  expect({"flat", {"/nodes/3/name", "\"flat\""}, 0, "", Ask::inspect}, victim, folder);
  // Where the products of numbers that are there are not.
  victim.json["nodes"][3]["scale"] = {1e300, 1e300, 1e300};
  expect({"huge", {"/nodes/0/scale", "[1e300, 1, 1]"}, 691, "/nodes/3", Ask::build}, victim,
         folder);
}
