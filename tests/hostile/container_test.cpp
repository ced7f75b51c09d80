// SPDX-License-Identifier: MIT
// Damaged .glb containers: headers and chunks that lie, files that are cut off.
#include <doctest/doctest.h>

#include <functional>

#include "hostile/hostile_helpers.h"

using namespace rigc::test;

namespace {

std::string at_byte(std::size_t byte) {
  char text[32];
  std::snprintf(text, sizeof text, "@0x%zx", byte);
  return text;
}

void put(std::string& bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(value >> (8 * i) & 255);
}

/// `bytes` with correct lengths in its header, whatever stands in its chunks.
std::string with_length(std::string bytes) {
  put(bytes, 8, static_cast<std::uint32_t>(bytes.size()));
  return bytes;
}

struct Container {
  std::string whole;
  std::size_t bin;  ///< where the BIN chunk's header begins
};

struct Spoiled {
  const char* name;
  std::function<std::string(const Container&)> spoil;
  int code;
  std::function<std::size_t(const Container&)> place;
};

std::size_t first(const Container&) { return 0; }
std::size_t length_field(const Container&) { return 8; }
std::size_t json_chunk(const Container&) { return 12; }
std::size_t bin_chunk(const Container& c) { return c.bin; }
std::size_t end(const Container& c) { return c.whole.size(); }

std::function<std::string(const Container&)> field(std::size_t at, std::uint32_t value) {
  return [=](const Container& c) {
    std::string bytes = c.whole;
    put(bytes, at, value);
    return bytes;
  };
}

std::function<std::string(const Container&)> bin_field(std::size_t at, std::uint32_t value) {
  return [=](const Container& c) {
    std::string bytes = c.whole;
    put(bytes, c.bin + at, value);
    return bytes;
  };
}

std::function<std::string(const Container&)> cut(std::size_t size) {
  return [=](const Container& c) { return c.whole.substr(0, size); };
}

/// Cut off, with a header that agrees.
std::function<std::string(const Container&)> cut_short(
    std::function<std::size_t(const Container&)> size) {
  return [=](const Container& c) { return with_length(c.whole.substr(0, size(c))); };
}

std::string chunk(std::uint32_t length, const char* type, const std::string& bytes) {
  std::string out(4, '\0');
  put(out, 0, length);
  return out + std::string(type, 4) + bytes;
}

std::function<std::string(const Container&)> followed_by(const std::string& bytes) {
  return [=](const Container& c) { return with_length(c.whole + bytes); };
}

}  // namespace

TEST_CASE("hostile container: headers and chunks") {
  const std::vector<Spoiled> rows = {
      {"magic_alone", cut(4), 650, first},
      {"header_cut_at_5", cut(5), 650, first},
      {"header_cut_at_11", cut(11), 650, first},
      {"header_alone", cut_short([](const Container&) { return 12; }), 651, json_chunk},
      {"version_1", field(4, 1), 650, [](const Container&) { return 4; }},
      {"version_3", field(4, 3), 650, [](const Container&) { return 4; }},
      {"version_2_to_31", field(4, 0x80000002u), 650, [](const Container&) { return 4; }},
      {"length_zero", field(8, 0), 650, length_field},
      {"length_short", field(8, 20), 650, length_field},
      {"length_4_gb", field(8, 0xffffffffu), 650, length_field},
      {"cut_in_chunk_header", cut_short([](const Container&) { return 16; }), 651, json_chunk},
      {"cut_after_chunk_header", cut_short([](const Container&) { return 20; }), 651, json_chunk},
      {"cut_in_json", cut_short([](const Container& c) { return c.bin / 2; }), 651, json_chunk},
      {"cut_before_json_ends", cut_short([](const Container& c) { return c.bin - 1; }), 651,
       json_chunk},
      {"cut_in_bin_header", cut_short([](const Container& c) { return c.bin + 4; }), 651,
       bin_chunk},
      {"cut_after_bin_header", cut_short([](const Container& c) { return c.bin + 8; }), 651,
       bin_chunk},
      {"cut_in_bin", cut_short([](const Container& c) { return c.bin + 20; }), 651, bin_chunk},
      {"cut_one_byte", cut_short([](const Container& c) { return c.whole.size() - 1; }), 651,
       bin_chunk},
      {"cut_but_length_stays",
       [](const Container& c) { return c.whole.substr(0, c.whole.size() - 1); }, 650, length_field},
      {"byte_too_many", [](const Container& c) { return c.whole + '\0'; }, 650, length_field},
      {"json_length_zero", field(12, 0), 651, [](const Container&) { return 20; }},
      {"json_length_odd", field(12, 21), 651, json_chunk},
      {"json_length_4_gb", field(12, 0xfffffffcu), 651, json_chunk},
      {"json_length_wraps", field(12, 0xfffffff8u), 651, json_chunk},
      {"json_is_bin", field(16, 0x004e4942), 651, json_chunk},
      {"json_is_unknown", field(16, 0x12345678), 651, json_chunk},
      {"json_lower_case", field(16, 0x6e6f736a), 651, json_chunk},
      {"bin_length_4_gb", bin_field(0, 0xfffffffcu), 651, bin_chunk},
      {"bin_length_odd", bin_field(0, 7), 651, bin_chunk},
      {"bin_is_json", bin_field(4, 0x4e4f534a), 651, bin_chunk},
      {"second_json", followed_by(chunk(4, "JSON", "{}  ")), 651, end},
      {"second_bin", followed_by(chunk(4, "BIN\0", "1234")), 651, end},
      {"third_chunk_cut", followed_by(chunk(8, "TEST", "1234")), 651, end},
      {"third_chunk_header_cut", followed_by("1234"), 651, end},
      {"bin_alone",
       [](const Container& c) {
         return with_length(c.whole.substr(0, 12) + c.whole.substr(c.bin));
       },
       651, json_chunk},
      {"bin_too_short_for_buffer",
       [](const Container& c) {
         return with_length(c.whole.substr(0, c.bin) + chunk(4, "BIN\0", "1234"));
       },
       667, nullptr},
  };
  const auto folder = broken_folder("container");
  const auto& victims = skinned_victims();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Victim& victim = victims[i % victims.size()];
    const std::string json = victim.json.dump();
    const Container container{glb(json, victim.bin), 20 + (json.size() + 3) / 4 * 4};
    const auto file = folder / (std::string(rows[i].name) + "_" + victim.name + ".glb");
    write_file(file, rows[i].spoil(container));
    expect(Ask::inspect, file,
           {rows[i].code, rows[i].place ? at_byte(rows[i].place(container)) : "#/buffers/0"});
  }
}

TEST_CASE("hostile container: files that are no glTF") {
  const auto folder = broken_folder("no_gltf");
  struct Text {
    const char* name;
    std::string bytes;
    int code;
    const char* place;
  };
  const Text rows[] = {
      {"empty.glb", "", 60, "@0x0"},
      {"empty.gltf", "", 60, "@0x0"},
      {"blank.gltf", " \n\t ", 60, "@0x4"},
      {"byte_order_mark.gltf", "\xef\xbb\xbf{\"asset\": {\"version\": \"2.0\"}}", 60, "@0x0"},
      {"utf16.gltf", std::string("\xff\xfe{\0}\0", 6), 60, "@0x0"},
      {"zeros.gltf", std::string(64, '\0'), 60, "@0x0"},
      {"array.gltf", "[1, 2]", 655, "@0x0"},
      {"number.gltf", " 7", 655, "@0x1"},
      {"text.gltf", "\"glTF\"", 655, "@0x0"},
      {"null.gltf", "null", 655, "@0x0"},
      {"array.glb", glb("[1]", "1234"), 655, "@0x14"},
      {"yaml.gltf", "rigc: 1\n", 60, "@0x0"},
      {"two_values.gltf", "{} {}", 67, "@0x3"},
      {"zero_padded.glb", glb(std::string("{\"asset\": {\"version\": \"2.0\"}}\0", 30), "1234"), 67,
       "@0x31"},
      {"no_asset.gltf", "{}", 654, "#/asset"},
      {"no_version.gltf", "{\"asset\": {}}", 654, "#/asset"},
      {"asset_text.gltf", "{\"asset\": \"2.0\"}", 654, "#/asset"},
      {"version_1.gltf", "{\"asset\": {\"version\": \"1.0\"}}", 654, "#/asset/version"},
      {"version_number.gltf", "{\"asset\": {\"version\": 2.0}}", 654, "#/asset/version"},
      {"version_newer.gltf", "{\"asset\": {\"version\": \"2.1\", \"minVersion\": \"2.1\"}}", 654,
       "#/asset/minVersion"},
      {"cut.gltf", "{\"asset\": {\"version\": \"2.0\"", 60, "@0x1b"},
      {"cut_in_text.gltf", "{\"asset\": {\"version\": \"2.", 60, "@0x16"},
      {"comment.gltf", "{/* glTF */}", 60, "@0x1"},
      {"single_quotes.gltf", "{'asset': 1}", 60, "@0x1"},
      {"comma.gltf", "{\"asset\": {\"version\": \"2.0\"},}", 60, "@0x1d"},
  };
  for (const Text& row : rows) {
    write_file(folder / row.name, row.bytes);
    expect(Ask::check, folder / row.name, {row.code, row.place});
  }
}
