// SPDX-License-Identifier: MIT
// Files: the corpus opens, every mistake has its code and place, nothing crashes.
#include "gltf/file.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <random>
#include <set>

#include "base/codes.h"
#include "gltf/clips.h"
#include "gltf/patch.h"
#include "gltf/skeletons.h"
#include "gltf/uri.h"
#include "tests/gltf/file_helpers.h"

using namespace rigc;
using namespace rigc::gltf;
using namespace rigc::gltf::test;

namespace {

struct Bad {
  const char* name;
  const char* from;  ///< text of small_model()
  const char* to;
  int code;
  const char* pointer;
};

constexpr Bad kBad[] = {
    {"version", R"("version": "2.0")", R"("version": "1.0")", 654, "/asset/version"},
    {"no version", R"("asset": {"version": "2.0"})", R"("asset": {})", 654, ""},
    {"minVersion", R"("version": "2.0")", R"("version": "2.1", "minVersion": "2.1")", 654,
     "/asset/minVersion"},
    {"textures no array", R"("meshes": [{)", R"("textures": 1, "meshes": [{)", 655, "/textures"},
    {"element no object", R"("meshes": [{)", R"("materials": [3], "meshes": [{)", 655,
     "/materials/0"},
    {"children no array", R"("children": [1])", R"("children": 1)", 655, "/nodes/0/children"},
    {"child no integer", R"("children": [1])", R"("children": [1.5])", 655, "/nodes/0/children/0"},
    {"child out of range", R"("children": [1])", R"("children": [3])", 657, "/nodes/0/children/0"},
    {"negative child", R"("children": [1])", R"("children": [-1])", 657, "/nodes/0/children/0"},
    {"mesh", R"("mesh": 0)", R"("mesh": 1)", 657, "/nodes/2/mesh"},
    {"skin", R"("skin": 0)", R"("skin": 7)", 657, "/nodes/2/skin"},
    {"camera", R"("skin": 0)", R"("skin": 0, "camera": 0)", 657, "/nodes/2/camera"},
    {"scene", R"("scene": 0)", R"("scene": 1)", 657, "/scene"},
    {"scene node", R"([{"nodes": [0, 2]}])", R"([{"nodes": [0, 5]}])", 657, "/scenes/0/nodes/1"},
    {"cycle", R"("name": "tip")", R"("name": "tip", "children": [0])", 661, ""},
    {"own child", R"("name": "body")", R"("name": "body", "children": [2])", 661, ""},
    {"two parents", R"("name": "body")", R"("name": "body", "children": [1])", 660, "/nodes/1"},
    {"child twice", R"("children": [1])", R"("children": [1, 1])", 660, "/nodes/1"},
    {"translation", R"("translation": [0, 1, 0])", R"("translation": [0, 1])", 662,
     "/nodes/1/translation"},
    {"rotation text", R"("rotation": [0, 0, 0, 1])", R"("rotation": [0, 0, "0", 1])", 662,
     "/nodes/1/rotation"},
    {"matrix", R"("name": "body")", R"("name": "body", "matrix": [1])", 662, "/nodes/2/matrix"},
    {"matrix and trs", R"("name": "tip")",
     R"("name": "tip", "matrix": [1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1])", 662, "/nodes/1/matrix"},
    {"zero rotation", R"("rotation": [0, 0, 0, 1])", R"("rotation": [0, 0, 0, 0])", 663,
     "/nodes/1/rotation"},
    {"attribute", R"("POSITION": 3)", R"("POSITION": 4)", 657,
     "/meshes/0/primitives/0/attributes/POSITION"},
    {"indices", R"({"attributes")", R"({"indices": -1, "attributes")", 657,
     "/meshes/0/primitives/0/indices"},
    {"no joints", R"("joints": [0, 1])", R"("joints": [])", 675, "/skins/0"},
    {"joint twice", R"("joints": [0, 1])", R"("joints": [0, 0])", 675, "/skins/0"},
    {"joint range", R"("joints": [0, 1])", R"("joints": [0, 9])", 657, "/skins/0/joints/1"},
    {"skeleton", R"("joints": [0, 1])", R"("joints": [0, 1], "skeleton": 3)", 657,
     "/skins/0/skeleton"},
    {"matrix count", R"("joints": [0, 1])", R"("joints": [0, 1, 2])", 676,
     "/skins/0/inverseBindMatrices"},
    {"matrix type", R"("inverseBindMatrices": 0)", R"("inverseBindMatrices": 2)", 676,
     "/skins/0/inverseBindMatrices"},
    {"view missing", R"({"bufferView": 0, )", R"({"bufferView": 4, )", 657,
     "/accessors/0/bufferView"},
    {"count missing", R"("count": 3, )", "", 656, "/accessors/3"},
    {"count zero", R"("count": 3, )", R"("count": 0, )", 658, "/accessors/3/count"},
    {"count text", R"("count": 3, )", R"("count": "3", )", 655, "/accessors/3/count"},
    {"count huge", R"("count": 3, )", R"("count": 9007199254740992, )", 670, "/accessors/3"},
    {"offset huge", R"("count": 3, )", R"("count": 3, "byteOffset": 9007199254740992, )", 670,
     "/accessors/3"},
    {"offset negative", R"("count": 3, )", R"("count": 3, "byteOffset": -4, )", 658,
     "/accessors/3/byteOffset"},
    {"type", R"("count": 3, "type": "VEC3")", R"("count": 3, "type": "VEC5")", 658,
     "/accessors/3/type"},
    {"component", R"({"bufferView": 3, "componentType": 5126)",
     R"({"bufferView": 3, "componentType": 5124)", 658, "/accessors/3/componentType"},
    {"sparse count", R"("count": 3, )",
     R"("count": 3, "sparse": {"count": 4, "indices": {"bufferView": 0, "componentType": 5121},
        "values": {"bufferView": 0}}, )",
     671, "/accessors/3/sparse/count"},
    {"sparse type", R"("count": 3, )",
     R"("count": 3, "sparse": {"count": 1, "indices": {"bufferView": 0, "componentType": 5126},
        "values": {"bufferView": 0}}, )",
     658, "/accessors/3/sparse/indices/componentType"},
    {"sparse range", R"("count": 3, )",
     R"("count": 3, "sparse": {"count": 3, "indices": {"bufferView": 0, "componentType": 5121},
        "values": {"bufferView": 2}}, )",
     670, "/accessors/3/sparse/values"},
    {"sparse half", R"("count": 3, )",
     R"("count": 3, "sparse": {"count": 1, "values": {"bufferView": 0}}, )", 656,
     "/accessors/3/sparse"},
    {"buffer range", R"({"buffer": 0, "byteLength": 128})", R"({"buffer": 1, "byteLength": 128})",
     657, "/bufferViews/0/buffer"},
    {"view range", R"("byteOffset": 168, "byteLength": 36)",
     R"("byteOffset": 172, "byteLength": 36)", 668, "/bufferViews/3"},
    {"view length", R"({"buffer": 0, "byteLength": 128})", R"({"buffer": 0})", 656,
     "/bufferViews/0"},
    {"stride", R"("byteOffset": 168, "byteLength": 36)",
     R"("byteOffset": 168, "byteLength": 36, "byteStride": 13)", 669, "/bufferViews/3/byteStride"},
    {"small stride", R"("byteOffset": 168, "byteLength": 36)",
     R"("byteOffset": 168, "byteLength": 36, "byteStride": 8)", 669, "/accessors/3"},
    {"accessor range", R"("byteOffset": 168, "byteLength": 36)",
     R"("byteOffset": 168, "byteLength": 32)", 670, "/accessors/3"},
    {"buffer length", R"("byteLength": 204)", R"("byteLength": -1)", 658, "/buffers/0/byteLength"},
    {"buffer short", R"("byteLength": 204)", R"("byteLength": 205)", 667, "/buffers/0"},
    {"base64", ";base64,", ";base64,=", 665, "/buffers/0"},
    {"scheme", "data:application/octet-stream;base64,", "http://example.org/", 665, "/buffers/0"},
    {"sampler", R"({"sampler": 0, )", R"({"sampler": 1, )", 657,
     "/animations/0/channels/0/sampler"},
    {"no target", R"("target": {"node": 1, "path": "rotation"})", R"("extras": 1)", 656,
     "/animations/0/channels/0"},
    {"path", R"("path": "rotation")", R"("path": "rotatoin")", 658,
     "/animations/0/channels/0/target/path"},
    {"target node", R"({"node": 1, "path")", R"({"node": 4, "path")", 657,
     "/animations/0/channels/0/target/node"},
    {"output type", R"("path": "rotation")", R"("path": "translation")", 678,
     "/animations/0/channels/0"},
    {"input type", R"("input": 1, "output": 2)", R"("input": 2, "output": 2)", 678,
     "/animations/0/samplers/0/input"},
    {"output count", R"("LINEAR")", R"("CUBICSPLINE")", 678, "/animations/0/channels/0"},
    {"interpolation", R"("LINEAR")", R"("LINER")", 658, "/animations/0/samplers/0/interpolation"},
    {"input missing", R"("input": 1, )", "", 656, "/animations/0/samplers/0"},
};

}  // namespace

TEST_CASE("gltf file: every corpus file opens") {
  const auto files = corpus();
  if (files.empty()) MESSAGE("no corpus: nothing opened");
  for (const std::string& path : files) {
    Diagnostics diagnostics;
    const auto file = gltf::open(path, diagnostics);
    INFO(path, "\n", render(diagnostics, false));
    REQUIRE(file);
    CHECK(diagnostics.all().empty());
    CHECK(file->buffers.size() == file->root()["buffers"].size());
  }
}

TEST_CASE("gltf file: the small model is valid, and so is the empty file") {
  Diagnostics diagnostics;
  const auto file = open_text(small_model(), diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(file);
  CHECK(file->buffers[0].bytes.size() == 204);
  CHECK_FALSE(file->binary);
  const File empty = empty_file();
  CHECK(open_text(text(empty.whole), diagnostics));
}

TEST_CASE("gltf file: every mistake has its code and its place") {
  for (const Bad& bad : kBad) {
    Diagnostics diagnostics;
    const auto file = open_text(replaced(small_model(), bad.from, bad.to), diagnostics);
    INFO(bad.name, "\n", render(diagnostics, false));
    CHECK_FALSE(file);
    CHECK(numbers(diagnostics) == std::vector<int>{bad.code});
    REQUIRE_FALSE(diagnostics.all().empty());
    if (*bad.pointer) CHECK(diagnostics.all()[0].place.pointer == bad.pointer);
  }
}

TEST_CASE("gltf file: all mistakes are reported in one run") {
  std::string text = small_model();
  std::set<int> expected;
  for (const char* name :
       {"mesh", "zero rotation", "joint twice", "path", "view range", "count huge"})
    for (const Bad& bad : kBad)
      if (std::string_view(bad.name) == name && text.find(bad.from) != std::string::npos) {
        text = replaced(text, bad.from, bad.to);
        expected.insert(bad.code);
      }
  Diagnostics diagnostics;
  CHECK_FALSE(open_text(text, diagnostics));
  const auto reported = numbers(diagnostics);
  CHECK(std::set<int>(reported.begin(), reported.end()) == expected);
  CHECK(expected.size() == 6);
}

TEST_CASE("gltf file: containers") {
  const std::string good = glb(R"({"asset":{"version":"2.0"}})", "abcd");
  const std::string path = make_folder("broken/container") + "/model.glb";
  const auto open_bytes = [&](const std::string& bytes) {
    write_bytes(path, bytes);
    Diagnostics diagnostics;
    const auto file = gltf::open(path, diagnostics);
    CHECK(file.has_value() == diagnostics.ok());
    return numbers(diagnostics);
  };
  const auto with = [](std::string bytes, std::size_t at, std::string_view change) {
    return bytes.replace(at, change.size(), change);
  };
  CHECK(open_bytes(good).empty());
  CHECK(open_bytes(good.substr(0, 11)) == std::vector<int>{650});
  CHECK(open_bytes(with(good, 4, "\x01")) == std::vector<int>{650});
  CHECK(open_bytes(good + "....") == std::vector<int>{650});
  CHECK(open_bytes(good.substr(0, good.size() - 4)) == std::vector<int>{650});
  CHECK(open_bytes(with(good, 16, "BIN")) == std::vector<int>{651});
  CHECK(open_bytes(with(good, 12, "\xff")) == std::vector<int>{651});
  CHECK(open_bytes(with(good, 12, "\x1d")) == std::vector<int>{651});
  CHECK(open_bytes(with(good, good.size() - 8, "JSON")) == std::vector<int>{651});
  std::string unknown_first = with(good, good.size() - 8, "XTRA");
  CHECK(open_bytes(unknown_first).empty());
  std::string two_bins = good + good.substr(good.size() - 12);
  two_bins[8] = static_cast<char>(two_bins[8] + 12);
  CHECK(open_bytes(two_bins) == std::vector<int>{651});
  CHECK(open_bytes(with(good, 12 + 8, "[")) == std::vector<int>{rigc::codes::kJsonSyntax.number});
  CHECK(open_bytes("[]") == std::vector<int>{655});
}

TEST_CASE("gltf file: buffers are confined to the folder") {
  const std::string folder = make_folder("broken/confined");
  std::filesystem::create_directories(folder + "/model/a b");
  write_bytes(folder + "/outside.bin", "12345678");
  write_bytes(folder + "/model/a b/in%side.bin", "12345678");
  std::filesystem::create_symlink("../outside.bin", folder + "/model/link.bin");
  const auto open_uri = [&](const std::string& uri) {
    write_bytes(folder + "/model/model.gltf",
                R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":5,"uri":)" +
                    json::quote(uri) + "}]}");
    Diagnostics diagnostics;
    const auto file = gltf::open(folder + "/model/model.gltf", diagnostics);
    if (file) CHECK(text(file->buffers[0].bytes) == "12345");
    return numbers(diagnostics);
  };
  CHECK(open_uri("a%20b/in%25side.bin").empty());
  CHECK(open_uri("./a b/../a%20b/in%25side.bin").empty());
  CHECK(open_uri("../outside.bin") == std::vector<int>{666});
  CHECK(open_uri("%2e%2e/outside.bin") == std::vector<int>{666});
  CHECK(open_uri("link.bin") == std::vector<int>{666});
  CHECK(open_uri("/etc/hostname") == std::vector<int>{665});
  CHECK(open_uri("file:///etc/hostname") == std::vector<int>{665});
  CHECK(open_uri("a%2") == std::vector<int>{665});
  CHECK(open_uri("a%00b") == std::vector<int>{665});
  CHECK(open_uri("") == std::vector<int>{665});
  CHECK(open_uri("a b") == std::vector<int>{694});
  CHECK(open_uri("none.bin") == std::vector<int>{rigc::codes::kCannotRead.number});
}

TEST_CASE("gltf file: where other files are left alone their buffers are empty") {
  const std::string text = R"({"asset":{"version":"2.0"},"buffers":[
      {"byteLength":5,"uri":"/etc/hostname"},
      {"byteLength":3,"uri":"data:application/octet-stream;base64,QUJD"}]})";
  Diagnostics diagnostics;
  const auto file = gltf::open("memory", Bytes(text), diagnostics, OtherFiles::left_alone);
  REQUIRE(file);
  CHECK(file->buffers[0].bytes.empty());
  CHECK(gltf::test::text(file->buffers[1].bytes) == "ABC");
}

TEST_CASE("gltf file: base64 and data URIs") {
  std::mt19937_64 random(3);
  for (std::size_t size = 0; size < 40; ++size) {
    std::string bytes;
    for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(random());
    CHECK(base64_decoded(base64(bytes)) == bytes);
    CHECK(data_uri_bytes(data_uri(bytes)) == bytes);
  }
  CHECK(base64("Man") == "TWFu");
  CHECK(base64("Ma") == "TWE=");
  CHECK(base64("M") == "TQ==");
  for (const char* bad : {"T", "TQ=", "TQ==TQ==", "TR==", "TWF=", "T Fu", "====", "=QQQ"})
    CHECK_FALSE(base64_decoded(bad));
  CHECK(data_uri_bytes("data:,a%20b") == "a b");
  CHECK_FALSE(data_uri_bytes("data:application/octet-stream"));
}

TEST_CASE("gltf file: random damage never crashes") {
  std::mt19937_64 random(7);
  const std::string good = small_model();
  const std::size_t end = good.find("data:");
  const std::string path = make_folder("broken/damage") + "/model.gltf";
  std::size_t opened = 0;
  constexpr std::size_t kRounds = 1500;
  for (std::size_t round = 0; round < kRounds; ++round) {
    std::string text = good;
    for (std::uint64_t n = random() % 3 + 1; n > 0; --n) {
      const char* parts[] = {"-1", "1e99", "[]", "{}", "null", "9", "0", "2", "0.5", "3"};
      const std::size_t at = text.find_first_of("0123456789", random() % end);
      const std::size_t length = random() % 2 + 1;  // one draw a statement
      text.replace(at, length, parts[random() % 10]);
    }
    write_bytes(path, text);
    Diagnostics diagnostics;
    const auto file = gltf::open(path, diagnostics);
    CHECK(file.has_value() == diagnostics.ok());
    if (!file) continue;
    ++opened;
    const bool clips = read_clips(*file, diagnostics).has_value();
    const bool skeletons = read_skeletons(*file, "bind", diagnostics).has_value();
    CHECK((clips && skeletons) == diagnostics.ok());
    Patch patch(*file);
    patch.add_child(-1, patch.append("nodes", "{}"));
    Diagnostics none;
    CHECK(patch.finish(random() % 2 == 0, none));
  }
  CHECK(opened > kRounds / 50);
  CHECK(opened < kRounds * 3 / 4);
}
