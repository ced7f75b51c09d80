// SPDX-License-Identifier: MIT
// Damaged skins and animations.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "hostile/hostile_helpers.h"

using namespace rigc::test;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Floats put over an element of an accessor.
struct Bytes {
  const char* name;
  const char* accessor;  ///< a word: ibm, times, values
  std::size_t element;
  std::vector<float> value;
  int code;
  const char* place;
  Ask ask = Ask::inspect;
};

void expect_bytes(const std::vector<Bytes>& rows, const std::string& folder_name) {
  const std::filesystem::path folder = broken_folder(folder_name);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Bytes& row = rows[i];
    Victim victim = skinned_victims()[i % skinned_victims().size()];
    const std::string bytes = floats(row.value);
    victim.bin.replace(victim.offset_of(row.accessor, row.element), bytes.size(), bytes);
    expect({row.name, {"/asset/copyright", "\"\""}, row.code, row.place, row.ask}, victim, folder);
  }
}

}  // namespace

TEST_CASE("hostile animations: skins") {
  expect(
      {{"joints_empty", {"/skins/0/joints", "[]"}, 675, "/skins/0"},
       {"joints_missing", {"/skins/0/joints", nullptr}, 675, "/skins/0"},
       {"joints_twice", {"/skins/0/joints", "[{joint}, {joint}]"}, 675, "/skins/0"},
       {"joints_beyond", {"/skins/0/joints/1", "{nodes}"}, 657},
       {"joints_negative", {"/skins/0/joints/1", "-1"}, 657},
       {"joints_fraction", {"/skins/0/joints/1", "1.5"}, 655},
       {"joints_huge", {"/skins/0/joints/1", "1e30"}, 655},
       {"joints_object", {"/skins/0/joints", "{}"}, 655},
       {"joints_node", {"/skins/0/joints/0", R"({"name": "hips"})"}, 655},
       {"skeleton_beyond", {"/skins/0/skeleton", "{nodes}"}, 657},
       {"matrices_beyond", {"/skins/0/inverseBindMatrices", "{accessors}"}, 657},
       {"matrices_are_times", {"/skins/0/inverseBindMatrices", "{times}"}, 676},
       {"matrices_of_shorts",
        {"/accessors/{ibm}/componentType", "5123"},
        676,
        "/skins/0/inverseBindMatrices"},
       {"matrices_of_vectors",
        {"/accessors/{ibm}/type", R"("VEC4")"},
        676,
        "/skins/0/inverseBindMatrices"},
       {"matrices_too_few", {"/accessors/{ibm}/count", "1"}, 676, "/skins/0/inverseBindMatrices"},
       {"matrices_absurd",
        {"/accessors/{ibm}",
         R"({"componentType": 5126, "count": 9007199254740992, "type": "MAT4"})"},
        677,
        "/skins/0/inverseBindMatrices",
        Ask::build},
       {"skin_of_node_beyond", {"/nodes/{joint}/skin", "{skins}"}, 657},
       {"skin_null", {"/skins/0", "null"}, 655},
       {"skins_number", {"/skins", "1"}, 655},
       {"mesh_of_node_beyond", {"/nodes/{joint}/mesh", "{meshes}"}, 657},
       {"mesh_attribute_beyond",
        {"/meshes/0/primitives/0/attributes/POSITION", "{accessors}"},
        657},
       {"mesh_material_beyond", {"/meshes/0/primitives/0/material", "99"}, 657},
       {"mesh_indices_negative", {"/meshes/0/primitives/0/indices", "-1"}, 657},
       {"mesh_primitives_object", {"/meshes/0/primitives", "{}"}, 655},
       {"camera_of_node_beyond", {"/nodes/{joint}/camera", "0"}, 657}},
      "skins");
}

TEST_CASE("hostile animations: bytes of skins and keys") {
  const std::vector<float> zeros(16, 0.0f);
  expect_bytes({{"matrix_zero", "ibm", 0, zeros, 677, "/skins/0/inverseBindMatrices", Ask::build},
                {"matrix_nan", "ibm", 1, {kNan}, 673, "/accessors/{ibm}", Ask::build},
                {"matrix_infinite", "ibm", 1, {INFINITY}, 673, "/accessors/{ibm}", Ask::build},
                {"matrix_flat",
                 "ibm",
                 1,
                 {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0},
                 677,
                 "/skins/0/inverseBindMatrices",
                 Ask::build},
                {"matrix_projective",
                 "ibm",
                 1,
                 {1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0},
                 690,
                 "/skins/0/inverseBindMatrices",
                 Ask::build},
                {"times_fall", "times", 1, {-0.5f}, 679, "/accessors/{times}"},
                {"times_negative", "times", 0, {-1}, 679, "/accessors/{times}"},
                {"times_nan", "times", 1, {kNan}, 673, "/accessors/{times}"},
                {"times_infinite", "times", 1, {INFINITY}, 673, "/accessors/{times}"},
                {"times_equal", "times", 0, {1, 1}, 679, "/accessors/{times}"},
                {"values_nan", "values", 1, {0, kNan, 0, 1}, 673, "/accessors/{values}"},
                {"values_infinite", "values", 0, {-INFINITY, 0, 0, 1}, 673, "/accessors/{values}"},
                {"values_zero", "values", 1, {0, 0, 0, 0}, 663, "/accessors/{values}"}},
               "bytes");
}

TEST_CASE("hostile animations: samplers and channels") {
  const char* kTarget = "/animations/0/channels/{channel}/target";
  expect(
      {{"sampler_beyond", {"/animations/0/channels/{channel}/sampler", "{samplers}"}, 657},
       {"sampler_negative", {"/animations/0/channels/{channel}/sampler", "-1"}, 658},
       {"sampler_missing",
        {"/animations/0/channels/{channel}/sampler", nullptr},
        656,
        "/animations/0/channels/{channel}"},
       {"sampler_fraction", {"/animations/0/channels/{channel}/sampler", "0.5"}, 655},
       {"target_missing", {kTarget, nullptr}, 656, "/animations/0/channels/{channel}"},
       {"target_text", {kTarget, R"("hips")"}, 656, "/animations/0/channels/{channel}"},
       {"node_beyond", {"/animations/0/channels/{channel}/target/node", "{nodes}"}, 657},
       {"node_negative", {"/animations/0/channels/{channel}/target/node", "-1"}, 657},
       {"node_huge", {"/animations/0/channels/{channel}/target/node", "1e30"}, 655},
       {"path_unknown", {"/animations/0/channels/{channel}/target/path", R"("visibility")"}, 658},
       {"path_missing", {"/animations/0/channels/{channel}/target/path", nullptr}, 656, kTarget},
       {"path_number", {"/animations/0/channels/{channel}/target/path", "1"}, 658},
       {"path_of_other_width",
        {"/animations/0/channels/{channel}/target/path", R"("translation")"},
        678,
        "/animations/0/channels/{channel}"},
       {"path_weights",
        {"/animations/0/channels/{channel}/target/path", R"("weights")"},
        678,
        "/animations/0/channels/{channel}"},
       {"interpolation_unknown",
        {"/animations/0/samplers/{sampler}/interpolation", R"("BEZIER")"},
        658},
       {"interpolation_number", {"/animations/0/samplers/{sampler}/interpolation", "3"}, 658},
       {"cubic_counts",
        {"/animations/0/samplers/{sampler}/interpolation", R"("CUBICSPLINE")"},
        678,
        "/animations/0/channels/{channel}"},
       {"input_beyond", {"/animations/0/samplers/{sampler}/input", "{accessors}"}, 657},
       {"input_missing",
        {"/animations/0/samplers/{sampler}/input", nullptr},
        656,
        "/animations/0/samplers/{sampler}"},
       {"input_of_vectors", {"/animations/0/samplers/{sampler}/input", "{values}"}, 678},
       {"input_of_shorts",
        {"/accessors/{times}/componentType", "5123"},
        678,
        "/animations/0/samplers/{sampler}/input"},
       {"output_beyond", {"/animations/0/samplers/{sampler}/output", "{accessors}"}, 657},
       {"output_missing",
        {"/animations/0/samplers/{sampler}/output", nullptr},
        656,
        "/animations/0/samplers/{sampler}"},
       {"output_of_matrices",
        {"/animations/0/samplers/{sampler}/output", "{ibm}"},
        678,
        "/animations/0/channels/{channel}"},
       {"output_too_short",
        {"/accessors/{values}/count", "1"},
        678,
        "/animations/0/channels/{channel}"},
       {"samplers_object", {"/animations/0/samplers", "{}"}, 655},
       {"sampler_null", {"/animations/0/samplers/0", "null"}, 655},
       {"channels_text", {"/animations/0/channels", R"("channels")"}, 655},
       {"channel_array", {"/animations/0/channels/0", "[]"}, 655},
       {"animations_object", {"/animations", "{}"}, 655},
       {"animation_number", {"/animations/0", "0"}, 655},
       {"pointer_missing", {kTarget, R"({"path": "pointer"})"}, 692, kTarget},
       {"pointer_number",
        {kTarget,
         R"({"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": 3}}})"},
        692,
        kTarget},
       {"pointer_node_beyond",
        {kTarget,
         R"({"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": "/nodes/99999/rotation"}}})"},
        692,
        kTarget},
       {"pointer_node_negative",
        {kTarget,
         R"({"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": "/nodes/-1/rotation"}}})"},
        692,
        kTarget},
       {"pointer_relative",
        {kTarget,
         R"({"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": "nodes/0/rotation"}}})"},
        692,
        kTarget},
       {"pointer_width",
        {kTarget,
         R"({"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": "/nodes/0/translation"}}})"},
        678,
        "/animations/0/channels/{channel}"}},
      "channels");
}
