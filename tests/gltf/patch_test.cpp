// SPDX-License-Identifier: MIT
// Patches: what is not named stays, byte for byte and index for index (law 8).
#include "gltf/patch.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <random>

#include "gltf/splice.h"
#include "gltf/uri.h"
#include "tests/gltf/file_helpers.h"

using namespace rigc;
using namespace rigc::gltf;
using namespace rigc::gltf::test;

namespace {

constexpr const char* kArrays[] = {"accessors", "animations", "bufferViews", "buffers", "cameras",
                                   "images",    "materials",  "meshes",      "nodes",   "samplers",
                                   "scenes",    "skins",      "textures"};

Output finished(Patch& patch, bool binary) {
  Diagnostics diagnostics;
  auto output = patch.finish(binary, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(output);
  CHECK(diagnostics.ok());
  return *std::move(output);
}

File reopened(const Output& output, const std::string& path, const std::string& source_folder) {
  write_output(output, path, source_folder);
  Diagnostics diagnostics;
  auto file = gltf::open(path, diagnostics);
  INFO(path, "\n", render(diagnostics, false));
  REQUIRE(file);
  return *std::move(file);
}

File opened(const std::string& path) {
  Diagnostics diagnostics;
  auto file = gltf::open(path, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(file);
  return *std::move(file);
}

File small() {
  Diagnostics diagnostics;
  auto file = open_text(small_model(), diagnostics);
  REQUIRE(file);
  return *std::move(file);
}

NewAccessor some_accessor(std::mt19937_64& random) {
  NewAccessor accessor;
  accessor.count = random() % 5 + 1;
  accessor.component = ComponentType::unsigned_byte;
  for (std::size_t i = 0; i < accessor.count; ++i) accessor.data += static_cast<char>(random());
  return accessor;
}

/// Texts of a top-level array's elements, copied.
std::vector<std::string> texts(const File& file, const char* array) {
  std::vector<std::string> list;
  for (const json::Value& item : file.root()[array].items()) list.emplace_back(item.text());
  return list;
}

/// A tail of our own in most arrays.
void append_tail(Patch& patch, std::mt19937_64& random) {
  for (int i = 0; i < 3; ++i) {
    patch.append(some_accessor(random));
    NewAccessor points;
    points.data = floats({0, 0, 0, 1, 2, 3});
    points.type = "VEC3";
    points.count = 2;
    points.min = {0, 0, 0};
    points.max = {1, 2, 3};
    points.target = 34962;
    const int position = patch.append(std::move(points));
    patch.append("meshes", R"({"primitives":[{"mode":1,"attributes":{"POSITION":)" +
                               std::to_string(position) + "}}]}");
    patch.append("nodes", R"({"name":"ours"})");
  }
  const int first = patch.count("nodes") - 3;
  patch.add_child(-1, first);
  patch.add_child(first, first + 1);
  patch.append("materials", "{}");
  patch.set_root_extension("RIGC_rig",
                           R"({"version":1,"rigs":[],"before":)" + patch.before() + "}");
  patch.use_extension("KHR_animation_pointer");
}

}  // namespace

TEST_CASE("gltf patch: a splice keeps spelling and white space") {
  const auto spliced = [](const char* text, auto&& change) {
    Diagnostics diagnostics;
    const auto document = json::parse(text, "", 0, diagnostics);
    REQUIRE(document);
    Splice splice(document->root());
    change(splice);
    return splice.text();
  };
  const char* pretty = "{\n  \"a\" : 1.0e0 ,\n  \"b\": [ ],\n  \"c\": 3\n}";
  CHECK(spliced(pretty, [](Splice&) {}) == pretty);
  CHECK(spliced(pretty, [](Splice& s) { s.set("b", "7"); }) ==
        "{\n  \"a\" : 1.0e0 ,\n  \"b\": 7,\n  \"c\": 3\n}");
  CHECK(spliced(pretty, [](Splice& s) { s.set("d", "4"); }) ==
        "{\n  \"a\" : 1.0e0 ,\n  \"b\": [ ],\n  \"c\": 3,\n  \"d\": 4\n}");
  CHECK(spliced(pretty, [](Splice& s) {
          s.set("d", "4");
          s.set("d", "");
        }) == pretty);
  CHECK(spliced(pretty, [](Splice& s) { s.set("c", ""); }) ==
        "{\n  \"a\" : 1.0e0 ,\n  \"b\": [ ]\n}");
  CHECK(spliced(pretty, [](Splice& s) { s.set("a", ""); }) == "{\n  \"b\": [ ],\n  \"c\": 3\n}");
  CHECK(spliced("{\"\\u0061\":1}", [](Splice& s) { s.set("a", "2"); }) == "{\"\\u0061\":2}");
  CHECK(spliced("[ 1 , 2 ]", [](Splice& s) { s.append("3"); }) == "[ 1 , 2, 3 ]");
  CHECK(spliced("[]", [](Splice& s) { s.append("3"); }) == "[3]");
  CHECK(spliced("[1,2,3]", [](Splice& s) { s.truncate(1); }) == "[1]");
}

TEST_CASE("gltf patch: without changes every file comes out as it went in") {
  for (const std::string& path : corpus()) {
    const File file = opened(path);
    INFO(path);
    Patch patch(file);
    const Output output = finished(patch, file.binary);
    CHECK(output.unchanged);
    CHECK(whole(output) == text(file.whole));

    if (!file.root()["nodes"]) continue;
    Patch and_back(file);
    and_back.append("nodes", "{}");
    and_back.truncate("nodes", and_back.count("nodes") - 1);
    and_back.set_root_extension("RIGC_rig", "{}");
    and_back.set_root_extension("RIGC_rig", "");
    and_back.set_extra(0, "rigc", "1");
    and_back.set_extra(0, "rigc", "");
    CHECK(whole(finished(and_back, file.binary)) == text(file.whole));
  }
}

TEST_CASE("gltf patch: what a file had stays at its index and in its bytes") {
  std::mt19937_64 random(11);
  const std::string folder = make_folder("append");
  for (const std::string& path : corpus()) {
    INFO(path);
    const File file = opened(path);
    Patch patch(file);
    append_tail(patch, random);
    const std::string copy = folder + "/" + std::filesystem::path(path).filename().string();
    const File changed = reopened(finished(patch, file.binary), copy, folder_of(path));
    allow_messages_of(copy, path);

    for (const char* array : kArrays) {
      INFO(array);
      const auto before = texts(file, array);
      auto after = texts(changed, array);
      REQUIRE(after.size() >= before.size());
      after.resize(before.size());
      if (std::string_view(array) == "scenes" || std::string_view(array) == "buffers") continue;
      CHECK(after == before);
    }
    for (const auto& [key, value] : file.root().members()) {
      const bool touched =
          key == "extensions" || key == "extensionsUsed" ||
          std::find(std::begin(kArrays), std::end(kArrays), key) != std::end(kArrays);
      if (!touched) CHECK(changed.root()[key].text() == value.text());
    }
    for (std::size_t i = 0; i < file.buffers.size(); ++i)
      CHECK(text(changed.buffers[i].bytes.part(0, file.buffers[i].bytes.size())) ==
            text(file.buffers[i].bytes));
    CHECK(changed.other_chunks.size() == file.other_chunks.size());

    Patch back(changed);
    for (const char* array : {"nodes", "meshes", "materials", "accessors", "bufferViews"})
      back.truncate(array, static_cast<int>(file.root()[array].size()));
    back.remove_child(-1, static_cast<int>(file.root()["nodes"].size()));
    back.set_root_extension("RIGC_rig", "");
    bool had_pointer = false;
    for (const json::Value& name : file.root()["extensionsUsed"].items())
      had_pointer |= name.string() == "KHR_animation_pointer";
    if (!had_pointer) back.drop_extension("KHR_animation_pointer");
    const std::string second = folder + "/back_" + std::filesystem::path(path).filename().string();
    const File again = reopened(finished(back, file.binary), second, folder);
    allow_messages_of(second, path);
    CHECK(text(again.whole) == text(file.whole));
  }
}

TEST_CASE("gltf patch: a cut tail takes its bytes along without being told the length") {
  std::mt19937_64 random(5);
  const std::string folder = make_folder("broken/cut");
  for (const bool with_bin : {false, true}) {
    const std::string base = with_bin
                                 ? R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4}],)"
                                   R"("bufferViews":[{"buffer":0,"byteLength":4}]})"
                                 : R"({"asset":{"version":"2.0"}})";
    const std::string original = glb(base, with_bin ? "abcd" : "");
    write_bytes(folder + "/a.glb", original);
    const File file = opened(folder + "/a.glb");
    Patch patch(file);
    for (int i = 0; i < 4; ++i) patch.append(some_accessor(random));
    const File longer = reopened(finished(patch, true), folder + "/b.glb", folder);
    CHECK(longer.whole.size() > original.size());
    Patch back(longer);
    back.truncate("accessors", 0);
    back.truncate("bufferViews", with_bin ? 1 : 0);
    CHECK(whole(finished(back, true)) == original);
  }
}

TEST_CASE("gltf patch: new data of a .gltf lie in a file named by content") {
  const std::string folder = make_folder("broken/separate");
  const File file = small();
  const auto build = [&](std::uint64_t seed) {
    std::mt19937_64 random(seed);
    Patch patch(file);
    patch.append(some_accessor(random));
    return finished(patch, false);
  };
  const Output output = build(1);
  REQUIRE(output.extra_files.size() == 1);
  CHECK(build(1).extra_files[0].name == output.extra_files[0].name);
  CHECK(build(2).extra_files[0].name != output.extra_files[0].name);
  const File changed = reopened(output, folder + "/a.gltf", folder);
  REQUIRE(changed.buffers.size() == 2);
  CHECK(changed.buffers[1].uri == output.extra_files[0].name);
  CHECK(text(changed.buffers[1].bytes) == text(output.extra_files[0].bytes));
  Patch back(changed);
  back.truncate("accessors", 4);
  back.truncate("bufferViews", 4);
  CHECK(whole(finished(back, false)) == text(file.whole));
}

TEST_CASE("gltf patch: from .gltf to .glb and back the data are the same") {
  std::mt19937_64 random(17);
  const std::string folder = make_folder("convert");
  const std::string unseen = make_folder("broken/convert");
  int number = 0;
  for (const std::string& path : corpus()) {
    INFO(path);
    const File file = opened(path);
    // The validator warns of every data URI in a .glb.
    bool data_uris = false;
    for (std::size_t i = 1; i < file.buffers.size(); ++i)
      data_uris |= is_data_uri(file.buffers[i].uri);
    for (const bool with_data : {false, true}) {
      Patch patch(file);
      if (with_data) patch.append(some_accessor(random));
      const Output output = finished(patch, !file.binary);
      const std::string copy = (data_uris ? unseen : folder) + "/" + std::to_string(number++) +
                               (file.binary ? ".gltf" : ".glb");
      const File changed = reopened(output, copy, folder_of(path));
      allow_messages_of(copy, path);
      CHECK(changed.binary != file.binary);
      for (std::size_t i = 0; i < file.buffers.size(); ++i)
        CHECK(text(changed.buffers[i].bytes.part(0, file.buffers[i].bytes.size())) ==
              text(file.buffers[i].bytes));
      if (!file.buffers.empty() && !file.buffers[0].bytes.empty())
        CHECK(changed.buffers[0].uri.empty() == changed.binary);
      for (const char* array : {"nodes", "meshes", "images", "animations"})
        CHECK(texts(changed, array) == texts(file, array));
    }
  }
}

TEST_CASE("gltf patch: a .glb whose first buffer is a file gets a buffer of its own") {
  const std::string folder = make_folder("broken/foreign_first");
  write_bytes(folder + "/first.bin", "12345678");
  write_bytes(folder + "/picture one.png", "png");
  write_bytes(folder + "/a.glb",
              glb(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":8,"uri":"first.bin"}],)"
                  R"("images":[{"uri":"picture%20one.png"},{"uri":"data:image/png;base64,"},)"
                  R"({"uri":"http://example.org/a.png"}]})",
                  ""));
  const File file = opened(folder + "/a.glb");
  std::mt19937_64 random(1);
  Patch patch(file);
  NewAccessor accessor = some_accessor(random);
  const std::string data = accessor.data;
  patch.append(std::move(accessor));
  const Output output = finished(patch, true);
  CHECK(output.copies == std::vector<std::string>{"first.bin", "picture one.png"});
  CHECK(output.extra_files.size() == 1);
  const File changed = reopened(output, folder + "/b.glb", folder);
  REQUIRE(changed.buffers.size() == 2);
  CHECK(changed.buffers[1].uri == output.extra_files[0].name);
  CHECK(text(changed.buffers[1].bytes) == data);
  CHECK(text(changed.buffers[0].bytes) == "12345678");
}

TEST_CASE("gltf patch: members, children and extras of nodes") {
  const File file = small();
  Patch patch(file);
  patch.set_extra(1, "rigc", "\"x\"");
  CHECK(
      patch.element("nodes", 1) ==
      R"({"name": "tip", "translation": [0, 1, 0], "rotation": [0, 0, 0, 1], "extras": {"rigc":"x"}})");
  patch.set_extra(1, "ik_fk", "1.0");
  patch.set_extra(1, "rigc", "");
  CHECK(patch.element("nodes", 1).find(R"("extras": {"ik_fk":1.0})") != std::string::npos);
  patch.set_extra(1, "ik_fk", "");
  CHECK(patch.element("nodes", 1) == file.root()["nodes"].items()[1].text());

  patch.set_member("nodes", 2, "extras", "[1, 2]");
  patch.set_extra(2, "rigc", "\"x\"");
  CHECK(patch.element("nodes", 2) == R"({"name": "body", "mesh": 0, "skin": 0, "extras": [1, 2]})");

  const int node = patch.append("nodes", "{}");
  CHECK(node == 3);
  patch.add_child(1, node);
  CHECK(patch.element("nodes", 1).find(R"("children": [3])") != std::string::npos);
  patch.remove_child(1, node);
  CHECK(patch.element("nodes", 1) == file.root()["nodes"].items()[1].text());
  patch.add_child(0, node);
  CHECK(patch.element("nodes", 0).find(R"("children": [1,3])") != std::string::npos);
  patch.add_child(-1, node);
  CHECK(patch.element("scenes", 0) == R"({"nodes": [0, 2, 3]})");
  patch.remove_child(-1, 0);
  patch.remove_child(-1, 2);
  patch.remove_child(-1, 3);
  CHECK(patch.element("scenes", 0) == "{}");
}

TEST_CASE("gltf patch: the empty file becomes a model") {
  const File file = empty_file();
  std::mt19937_64 random(2);
  Patch patch(file);
  const int node = patch.append("nodes", R"({"name":"a"})");
  patch.add_child(-1, node);
  patch.append(some_accessor(random));
  const std::string folder = make_folder("empty");
  for (const bool binary : {true, false}) {
    Patch copy(file);
    copy.add_child(-1, copy.append("nodes", R"({"name":"a"})"));
    copy.append(some_accessor(random));
    const File made =
        reopened(finished(copy, binary), folder + (binary ? "/a.glb" : "/a.gltf"), folder);
    CHECK(made.root()["scenes"].items()[0].text() == R"({"nodes":[0]})");
    CHECK(made.buffers.size() == 1);
  }
  Patch none(file);
  const File bare = reopened(finished(none, true), folder + "/bare.glb", folder);
  CHECK(bare.root().text() == file.root().text());
  CHECK_FALSE(bare.bin);
}

TEST_CASE("gltf patch: a file without scenes gets one") {
  Diagnostics diagnostics;
  const auto file = open_text(R"({"asset":{"version":"2.0"},"nodes":[{}]})", diagnostics);
  REQUIRE(file);
  Patch patch(*file);
  patch.add_child(-1, 0);
  CHECK(whole(finished(patch, false)) ==
        R"({"asset":{"version":"2.0"},"nodes":[{}],"scenes":[{"nodes":[0]}],"scene":0})");
}

TEST_CASE("gltf patch: placeholders are valid elements") {
  const File file = small();
  const std::string folder = make_folder("placeholder");
  Patch patch(file);
  for (const char* array : {"accessors", "bufferViews", "animations", "skins", "meshes", "nodes"})
    for (int i = 0; i < patch.count(array); ++i) patch.replace(array, i, "");
  const File changed = reopened(finished(patch, false), folder + "/a.gltf", folder);
  CHECK(changed.root()["nodes"].size() == 3);
  CHECK(changed.root()["nodes"].items()[2].text() == R"({"extras":{"rigc":{"free":true}}})");
}

TEST_CASE("gltf patch: extensions come and go") {
  const File file = small();
  Patch patch(file);
  patch.set_root_extension("RIGC_rig", "{}");
  patch.use_extension("KHR_animation_pointer");
  patch.use_extension("KHR_animation_pointer");
  const std::string text = whole(finished(patch, false));
  CHECK(text.find(R"("extensions": {"RIGC_rig":{}})") != std::string::npos);
  CHECK(text.find(R"("extensionsUsed": ["RIGC_rig","KHR_animation_pointer"])") !=
        std::string::npos);
  Diagnostics diagnostics;
  const auto changed = open_text(text, diagnostics);
  REQUIRE(changed);
  Patch back(*changed);
  back.set_root_extension("RIGC_rig", "");
  back.drop_extension("KHR_animation_pointer");
  CHECK(whole(finished(back, false)) == small_model());
}

TEST_CASE("gltf patch: extra chunks are kept in a .glb and missed in a .gltf") {
  const std::string folder = make_folder("broken/chunks");
  std::string bytes = glb(R"({"asset":{"version":"2.0"}})", "abcd");
  bytes += std::string("\x04\0\0\0XTRAdata", 12);
  bytes[8] = static_cast<char>(bytes[8] + 12);
  write_bytes(folder + "/a.glb", bytes);
  const File file = opened(folder + "/a.glb");
  Patch patch(file);
  patch.append("nodes", "{}");
  const std::string after = whole(finished(patch, true));
  CHECK(after.substr(after.size() - 12) == bytes.substr(bytes.size() - 12));
  Patch text(file);
  Diagnostics diagnostics;
  CHECK(text.finish(false, diagnostics));
  CHECK(numbers(diagnostics) == std::vector<int>{653});
}

TEST_CASE("gltf patch: a .glb cannot have more than 4 GiB") {
  File file = small();
  const std::string chunk(std::size_t{1} << 26, 'x');
  file.other_chunks.assign(65, chunk);
  Patch patch(file);
  Diagnostics diagnostics;
  CHECK_FALSE(patch.finish(true, diagnostics));
  CHECK(numbers(diagnostics) == std::vector<int>{652});
}
