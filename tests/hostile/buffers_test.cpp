// SPDX-License-Identifier: MIT
// Buffers, views and accessors that reach beyond what holds them, count absurdly or lie.
#include <doctest/doctest.h>

#include "hostile/hostile_helpers.h"

using namespace rigc::test;

TEST_CASE("hostile buffers: views") {
  expect(
      {{"view_offset_beyond",
        {"/bufferViews/{times_view}/byteOffset", "999999999"},
        668,
        "/bufferViews/{times_view}"},
       {"view_length_beyond",
        {"/bufferViews/{ibm_view}/byteLength", "999999999"},
        668,
        "/bufferViews/{ibm_view}"},
       {"view_length_2_to_53",
        {"/bufferViews/{ibm_view}/byteLength", "9007199254740992"},
        668,
        "/bufferViews/{ibm_view}"},
       {"view_length_overflows",
        {"/bufferViews/{ibm_view}/byteLength", "9223372036854775807"},
        655},
       {"view_offset_2_to_53",
        {"/bufferViews/{ibm_view}/byteOffset", "9007199254740992"},
        668,
        "/bufferViews/{ibm_view}"},
       {"view_length_zero", {"/bufferViews/{times_view}/byteLength", "0"}, 658},
       {"view_length_negative", {"/bufferViews/{times_view}/byteLength", "-8"}, 658},
       {"view_length_missing",
        {"/bufferViews/{times_view}/byteLength", nullptr},
        656,
        "/bufferViews/{times_view}"},
       {"view_length_text", {"/bufferViews/{times_view}/byteLength", R"("8")"}, 655},
       {"view_offset_negative", {"/bufferViews/{times_view}/byteOffset", "-4"}, 658},
       {"view_offset_fraction", {"/bufferViews/{times_view}/byteOffset", "0.5"}, 655},
       {"view_buffer_beyond", {"/bufferViews/{times_view}/buffer", "1"}, 657},
       {"view_buffer_negative", {"/bufferViews/{times_view}/buffer", "-1"}, 657},
       {"view_buffer_missing",
        {"/bufferViews/{times_view}/buffer", nullptr},
        656,
        "/bufferViews/{times_view}"},
       {"view_null", {"/bufferViews/{times_view}", "null"}, 655},
       {"view_stride_zero", {"/bufferViews/{position_view}/byteStride", "0"}, 669},
       {"view_stride_1", {"/bufferViews/{position_view}/byteStride", "1"}, 669},
       {"view_stride_256", {"/bufferViews/{position_view}/byteStride", "256"}, 669},
       {"view_stride_2_to_53",
        {"/bufferViews/{position_view}/byteStride", "9007199254740992"},
        669},
       {"view_stride_small", {"/bufferViews/{ibm_view}/byteStride", "4"}, 669, "/accessors/{ibm}"},
       {"view_stride_wide", {"/bufferViews/{ibm_view}/byteStride", "252"}, 670, "/accessors/{ibm}"},
       {"buffer_length_zero", {"/buffers/0/byteLength", "0"}, 658},
       {"buffer_length_missing", {"/buffers/0/byteLength", nullptr}, 656, "/buffers/0"},
       {"buffer_length_small", {"/buffers/0/byteLength", "4"}, 668, "/bufferViews/0"},
       {"buffer_length_large", {"/buffers/0/byteLength", "999999999"}, 667, "/buffers/0"},
       {"buffer_length_2_to_53", {"/buffers/0/byteLength", "9007199254740992"}, 667, "/buffers/0"},
       {"buffer_length_1e30", {"/buffers/0/byteLength", "1e30"}, 655},
       {"buffers_object", {"/buffers", R"({"0": {"byteLength": 4}})"}, 655},
       {"views_text", {"/bufferViews", R"("views")"}, 655}},
      "views");
}

TEST_CASE("hostile buffers: accessors") {
  expect(
      {{"accessor_offset_beyond",
        {"/accessors/{times}/byteOffset", "999999999"},
        670,
        "/accessors/{times}"},
       {"accessor_offset_2_to_53",
        {"/accessors/{times}/byteOffset", "9007199254740992"},
        670,
        "/accessors/{times}"},
       {"accessor_offset_negative", {"/accessors/{times}/byteOffset", "-4"}, 658},
       {"accessor_count_4e9",
        {"/accessors/{values}/count", "4000000000"},
        670,
        "/accessors/{values}"},
       {"accessor_count_4e9_real",
        {"/accessors/{values}/count", "4e9"},
        670,
        "/accessors/{values}"},
       {"accessor_count_2_to_53",
        {"/accessors/{ibm}/count", "9007199254740992"},
        670,
        "/accessors/{ibm}"},
       {"accessor_count_2_to_63", {"/accessors/{ibm}/count", "9223372036854775808"}, 655},
       {"accessor_count_zero", {"/accessors/{times}/count", "0"}, 658},
       {"accessor_count_negative", {"/accessors/{times}/count", "-1"}, 658},
       {"accessor_count_fraction", {"/accessors/{times}/count", "1.5"}, 655},
       {"accessor_count_missing", {"/accessors/{times}/count", nullptr}, 656, "/accessors/{times}"},
       {"accessor_view_beyond", {"/accessors/{times}/bufferView", "{bufferViews}"}, 657},
       {"accessor_view_negative", {"/accessors/{times}/bufferView", "-1"}, 657},
       {"accessor_view_fraction", {"/accessors/{times}/bufferView", "0.25"}, 655},
       {"accessor_component_unknown", {"/accessors/{position}/componentType", "5124"}, 658},
       {"accessor_component_missing",
        {"/accessors/{position}/componentType", nullptr},
        656,
        "/accessors/{position}"},
       {"accessor_component_text", {"/accessors/{position}/componentType", R"("FLOAT")"}, 655},
       {"accessor_type_unknown", {"/accessors/{position}/type", R"("VEC5")"}, 658},
       {"accessor_type_missing",
        {"/accessors/{position}/type", nullptr},
        656,
        "/accessors/{position}"},
       {"accessor_type_number", {"/accessors/{position}/type", "3"}, 658},
       {"accessor_number", {"/accessors/{position}", "3"}, 655},
       {"accessors_null", {"/accessors", "null"}, 655}},
      "accessors");
}

TEST_CASE("hostile buffers: sparse accessors") {
  const char* kSparse = "/accessors/{times}/sparse";
  expect(
      {{"sparse_count_beyond",
        {kSparse,
         R"({"count": 999999, "indices": {"bufferView": 0, "componentType": 5125}, "values": {"bufferView": 0}})"},
        671,
        "/accessors/{times}/sparse/count"},
       {"sparse_count_zero",
        {kSparse,
         R"({"count": 0, "indices": {"bufferView": 0, "componentType": 5125}, "values": {"bufferView": 0}})"},
        658,
        "/accessors/{times}/sparse/count"},
       {"sparse_count_missing", {kSparse, "{}"}, 656},
       {"sparse_indices_missing", {kSparse, R"({"count": 1, "values": {"bufferView": 0}})"}, 656},
       {"sparse_values_missing",
        {kSparse, R"({"count": 1, "indices": {"bufferView": 0, "componentType": 5125}})"},
        656},
       {"sparse_view_beyond",
        {kSparse,
         R"({"count": 1, "indices": {"bufferView": 0, "componentType": 5125}, "values": {"bufferView": {bufferViews}}})"},
        657,
        "/accessors/{times}/sparse/values/bufferView"},
       {"sparse_view_missing",
        {kSparse,
         R"({"count": 1, "indices": {"componentType": 5125}, "values": {"bufferView": 0}})"},
        656,
        "/accessors/{times}/sparse/indices"},
       {"sparse_index_type",
        {kSparse,
         R"({"count": 1, "indices": {"bufferView": 0, "componentType": 5126}, "values": {"bufferView": 0}})"},
        658,
        "/accessors/{times}/sparse/indices/componentType"},
       {"sparse_offset_beyond",
        {kSparse,
         R"({"count": 1, "indices": {"bufferView": 0, "byteOffset": 99999999, "componentType": 5125}, "values": {"bufferView": 0}})"},
        670,
        "/accessors/{times}/sparse/indices"},
       {"sparse_offset_negative",
        {kSparse,
         R"({"count": 1, "indices": {"bufferView": 0, "byteOffset": -4, "componentType": 5125}, "values": {"bufferView": 0}})"},
        658,
        "/accessors/{times}/sparse/indices/byteOffset"},
       {"sparse_indices_do_not_rise",
        {kSparse,
         R"({"count": 2, "indices": {"bufferView": {ibm_view}, "componentType": 5125}, "values": {"bufferView": 0}})"},
        671,
        "/accessors/{times}"},
       {"sparse_text", {kSparse, "true"}, 656}},
      "sparse");
}

TEST_CASE("hostile buffers: data that an extension keeps from us") {
  const std::string extension =
      R"("extensions": {"EXT_meshopt_compression": {"buffer": 0, "byteLength": 4}})";
  const std::string view = R"({"buffer": 1, "byteLength": 1000000, )" + extension + "}";
  const std::filesystem::path folder = broken_folder("compressed");
  for (const Victim& victim : skinned_victims()) {
    // The view lies in a buffer that only a decoder can fill.
    Victim changed = victim;
    changed.json["extensionsRequired"] = {"EXT_meshopt_compression"};
    changed.json["buffers"].push_back({{"byteLength", 1000000}});
    auto& buffers = changed.json["buffers"];
    buffers[1]["extensions"]["EXT_meshopt_compression"]["fallback"] = true;
    const Change times{"/bufferViews/{times_view}", view.c_str()};
    const Change matrices{"/bufferViews/{ibm_view}", view.c_str()};
    expect({"times", times, 672, "/accessors/{times}"}, changed, folder);
    expect({"matrices", matrices, 672, "/accessors/{ibm}", Ask::build}, changed, folder);
    // The same in the first buffer, which has bytes that mean something else.
    changed.json = victim.json;
    changed.json["buffers"][0]["extensions"]["EXT_meshopt_compression"]["fallback"] = true;
    const std::string value = R"({"EXT_meshopt_compression": {"buffer": 0, "byteLength": 4}})";
    const Change first{"/bufferViews/{times_view}/extensions", value.c_str()};
    expect({"first_buffer", first, 672, "/accessors/{times}"}, changed, folder);
  }
}
