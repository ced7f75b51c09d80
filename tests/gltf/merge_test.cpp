// SPDX-License-Identifier: MIT
// Merging: bytes, rigs and scenes of several files in one; what cannot be merged is refused by its
// name.
#include "gltf/merge.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/text.h"
#include "file_helpers.h"
#include "merge_helpers.h"
#include "rig_helpers.h"

using namespace rigc;
using namespace rigc::gltf;
using namespace rigc::gltf::test;

namespace {

/// A file in memory, as if it lay where the tests' files lie.
File text_file(const std::string& text) {
  Diagnostics diagnostics;
  auto file = gltf::open("model.gltf", Bytes(std::string(text)), diagnostics);
  REQUIRE_MESSAGE(file, render(diagnostics, false));
  return *std::move(file);
}

std::deque<File> files_of(const std::vector<std::string>& texts) {
  std::deque<File> files;
  for (const std::string& text : texts) files.push_back(text_file(text));
  return files;
}

/// Numbers of what merging these texts reports.
std::vector<int> reported(const std::vector<std::string>& texts) {
  Diagnostics diagnostics;
  merged(files_of(texts), diagnostics);
  return numbers(diagnostics);
}

/// An asset and what else is given.
std::string with(const std::string& members) {
  return R"({"asset":{"version":"2.0"},)" + members + "}";
}

std::string view_bytes(const File& file, std::size_t view) {
  const json::Value value = file.root()["bufferViews"].items()[view];
  const auto buffer = static_cast<std::size_t>(*value["buffer"].integer());
  return text(file.buffers[buffer].bytes.part(
      static_cast<std::uint64_t>(value["byteOffset"].integer().value_or(0)),
      static_cast<std::uint64_t>(*value["byteLength"].integer())));
}

std::string rigged(const std::string& text, const std::string& global, std::uint32_t id) {
  Diagnostics diagnostics;
  const File file = text_file(text);
  Rig rig = sample_rig(diagnostics, 0, 1);
  rig.id = id;
  tags::TaggedSkeleton& skeleton = rig.skeleton;
  for (tags::TaggedJoint& joint : skeleton.joints) joint.ids.global = global;
  skeleton.global = global;
  Patch patch(file);
  REQUIRE(write_rig(patch, rig, -1, diagnostics));
  const auto output = patch.finish(true, diagnostics);
  REQUIRE(output);
  return whole(*output);
}

std::deque<File> rigged_files() {
  std::deque<File> files;
  Diagnostics diagnostics;
  for (const char* global : {"left", "right", "third"}) {
    auto file = gltf::open("model.glb", Bytes(rigged(small_model(), global, 7)), diagnostics);
    REQUIRE(file);
    files.push_back(*std::move(file));
  }
  return files;
}

}  // namespace

TEST_CASE("merge: the first file keeps its bytes, the others' come behind them") {
  const std::deque<File> files = files_of({small_model(), small_model(), small_model()});
  Diagnostics diagnostics;
  for (const bool binary : {true, false}) {
    const auto file = merged(files, diagnostics, {binary, false});
    REQUIRE(file);
    CHECK(file->root()["buffers"].size() == (binary ? 1 : 3));
    for (std::size_t i = 0; i < 12; ++i)
      CHECK(view_bytes(*file, i) == view_bytes(files.front(), i % 4));
    for (const char* array : {"nodes", "meshes", "skins", "animations", "accessors"}) {
      const auto before = files.front().root()[array].items();
      const auto after = file->root()[array].items();
      REQUIRE(after.size() == 3 * before.size());
      for (std::size_t i = 0; i < before.size(); ++i) CHECK(after[i].text() == before[i].text());
    }
    CHECK(file->root()["scenes"].size() == 1);
    CHECK(at(file->root(), "/scenes/0/nodes").text() == "[0, 2, 3, 5, 6, 8]");
    CHECK(at(file->root(), "/nodes/3").text() ==
          R"({"name": "root", "children": [4], "translation": [0, 0, 0]})");
  }
  CHECK(numbers(diagnostics).empty());
}

TEST_CASE("merge: bytes begin on a multiple of 8, whatever lies before them") {
  const std::string view = R"("bufferViews":[{"buffer":0,"byteLength":3}],"buffers":[)";
  std::deque<File> files;
  files.push_back(opened(with(view + R"({"byteLength":5}])"), "abcde", "a.glb"));
  files.push_back(opened(with(view + R"({"byteLength":3}])"), "xyz", "b.glb"));
  Diagnostics diagnostics;
  const auto file = merged(files, diagnostics);
  REQUIRE(file);
  CHECK(at(file->root(), "/bufferViews/1/byteOffset").integer() == 8);
  CHECK(view_bytes(*file, 0) == "abc");
  CHECK(view_bytes(*file, 1) == "xyz");
}

TEST_CASE("merge: compressed views name their bytes and the buffer that a decoder fills") {
  const std::string text = with(
      R"("extensionsUsed":["EXT_meshopt_compression"],"extensionsRequired":["EXT_meshopt_compression"],)"
      R"("buffers":[{"byteLength":4},{"byteLength":8}],"bufferViews":[{"buffer":1,"byteLength":8,)"
      R"("extensions":{"EXT_meshopt_compression":{"buffer":0,"byteOffset":1,"byteLength":3}}}])");
  std::deque<File> files;
  for (const char* bin : {"abcd", "efgh"}) files.push_back(opened(text, bin, "a.glb"));
  Diagnostics diagnostics;
  const auto file = merged(files, diagnostics);
  REQUIRE(file);
  CHECK(at(file->root(), "/bufferViews/0").text() == at(files[0].root(), "/bufferViews/0").text());
  CHECK(at(file->root(), "/bufferViews/1/buffer").integer() == 2);
  CHECK(!at(file->root(), "/bufferViews/1")["byteOffset"]);
  const std::string compressed = "/bufferViews/1/extensions/EXT_meshopt_compression/";
  CHECK(at(file->root(), compressed + "buffer").integer() == 0);
  CHECK(at(file->root(), compressed + "byteOffset").integer() == 9);
  CHECK(file->root()["extensionsRequired"].size() == 1);
}

TEST_CASE("merge: a file without buffers or scenes takes those that come") {
  const std::string other = with(R"("buffers":[{"byteLength":1,"uri":"data:,a"}])");
  std::deque<File> files = files_of({with(R"("nodes":[{}])"), other});
  files.push_back(opened(with(R"("buffers":[{"byteLength":4}],"bufferViews":[{"buffer":0,)"
                              R"("byteLength":4}],"nodes":[{}],"scene":1,"scenes":[{},)"
                              R"({"nodes":[0]}])"),
                         "abcd", "b.glb"));
  files.push_back(text_file(with(R"("nodes":[{}],"scenes":[{"nodes":[0]}])")));
  Diagnostics diagnostics;
  const auto file = merged(files, diagnostics, {false, false});
  REQUIRE(file);
  CHECK(file->root()["scene"].integer() == 1);
  CHECK(file->root()["scenes"].text() == R"([{},{"nodes":[1,2]}])");
  CHECK(file->root()["buffers"].size() == 2);
  const auto glb = merged(files, diagnostics);
  REQUIRE(glb);
  CHECK(view_bytes(*glb, 0) == "abcd");
  CHECK(glb->root()["buffers"].text() == R"([{"byteLength":12}])");
}

TEST_CASE("merge: clips of one name become one clip where that is asked for") {
  const std::string walk = replaced(small_model(), "\"turn\"", "\"walk\"");
  const std::deque<File> files = files_of({small_model(), walk, small_model()});
  Diagnostics diagnostics;
  const auto apart = merged(files, diagnostics);
  REQUIRE(apart);
  CHECK(apart->root()["animations"].size() == 3);
  const auto joined = merged(files, diagnostics, {true, true});
  REQUIRE(joined);
  REQUIRE(joined->root()["animations"].size() == 2);
  const json::Value clip = joined->root()["animations"].items()[0];
  REQUIRE(clip["channels"].size() == 2);
  REQUIRE(clip["samplers"].size() == 2);
  const json::Value channel = clip["channels"].items()[1];
  CHECK(channel["sampler"].integer() == 1);
  CHECK(channel["target"]["node"].integer() == 7);
  CHECK(clip["samplers"].items()[1]["input"].integer() == 9);
  CHECK(joined->root()["animations"].items()[1]["name"].string() == "walk");
}

TEST_CASE("merge: what clips say besides comes with them into one, or is said to be left out") {
  const auto noted = [](const std::string& note) {
    return replaced(small_model(), R"("name": "turn",)",
                    R"("name": "turn", "extras": )" + note + ",");
  };
  Diagnostics diagnostics;
  const auto file =
      merged(files_of({small_model(), noted("1"), noted("1")}), diagnostics, {true, true});
  REQUIRE(file);
  CHECK(diagnostics.all().empty());
  CHECK(file->root()["animations"].items()[0]["extras"].integer() == 1);
  REQUIRE(merged(files_of({noted("1"), noted("2")}), diagnostics, {true, true}));
  CHECK(numbers(diagnostics) == std::vector<int>{688});
}

TEST_CASE("merge: lists that are the same in both files come both") {
  const std::string lit =
      with(R"("nodes":[{"extensions":{"KHR_lights_punctual":{"light":0}}}],)"
           R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"}]}})");
  Diagnostics diagnostics;
  const auto file = merged(files_of({lit, lit, lit}), diagnostics);
  REQUIRE(file);
  CHECK(diagnostics.all().empty());
  const auto nodes = file->root()["nodes"].items();
  REQUIRE(nodes.size() == 3);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    CHECK(nodes[i]["extensions"]["KHR_lights_punctual"]["light"].integer() ==
          static_cast<std::int64_t>(i));
  CHECK(file->root()["extensions"]["KHR_lights_punctual"]["lights"].size() == 3);
}

TEST_CASE("merge: what cannot be merged is refused by its name") {
  const std::string plain = with(R"("nodes":[{}])");
  const std::string unknown = with(R"("nodes":[{"extensions":{"ACME_wheels":{"node":0}}}])");
  CHECK(reported({plain, unknown}) == std::vector<int>{681});
  CHECK(reported({unknown, plain}).empty());
  CHECK(reported({plain, with(R"("extensionsUsed":["ACME_wheels"])")}) == std::vector<int>{681});
  const std::string hidden =
      R"("nodes":[{"extensions":{"KHR_lights_punctual":{"light":0,"extensions":{"ACME_x":{}}}}}],)"
      R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"}]}})";
  CHECK(reported({plain, with(hidden)}) == std::vector<int>{681});
  CHECK(reported({plain, with(R"("nodes":[{"extras":{"extensions":{"ACME_x":{}}}}])")}).empty());

  const std::string light = R"("nodes":[{"extensions":{"KHR_lights_punctual":{"light":1}}}])";
  CHECK(reported({plain, with(light)}) == std::vector<int>{682});
  const std::string odd = R"("nodes":[{"extensions":{"MSFT_lod":{"ids":["0"]}}}])";
  CHECK(reported({plain, with(odd)}) == std::vector<int>{682});

  const auto vrm = [](const char* name) {
    return with(R"("extensions":{")" + std::string(name) + R"(":{"humanoid":{}}})");
  };
  CHECK(reported({plain, vrm("VRMC_vrm")}).empty());
  CHECK(reported({vrm("VRMC_vrm"), vrm("VRMC_vrm_animation")}).empty());
  CHECK(reported({vrm("VRM"), plain}).empty());
  CHECK(reported({plain, vrm("VRM")}) == std::vector<int>{683});
  CHECK(reported({vrm("VRM"), vrm("VRM")}) == std::vector<int>{683});
  CHECK(reported({vrm("VRMC_vrm"), vrm("VRMC_vrm")}).empty());
  const std::string hips = R"("nodes":[{}],"extensions":{"VRMC_vrm":{"humanoid":{"humanBones":)"
                           R"({"hips":{"node":0}}}}})";
  CHECK(reported({with(hips), with(hips)}) == std::vector<int>{683});
  const auto spring = [](const char* version) {
    return with(R"("extensions":{"VRMC_springBone":{"specVersion":")" + std::string(version) +
                "\"}}");
  };
  CHECK(reported({spring("1.0"), spring("1.0")}).empty());
  CHECK(reported({spring("1.0"), spring("1.0-beta")}) == std::vector<int>{683});
}

TEST_CASE("merge: animation pointers that cannot be followed are refused") {
  const auto clip = [](const std::string& pointer) {
    return replaced(small_model(), R"("target": {"node": 1, "path": "rotation"})",
                    R"("target": {"path": "pointer", "extensions": {"KHR_animation_pointer": )"
                    R"({"pointer": ")" +
                        pointer + "\"}}}");
  };
  const std::string plain = with(R"("nodes":[{}])");
  CHECK(reported({plain, clip("/nodes/1/rotation")}).empty());
  CHECK(reported({plain, clip("/nodes/9/rotation")}) == std::vector<int>{682});
  CHECK(reported({plain, clip("/materials/0/alphaCutoff")}) == std::vector<int>{682});
  CHECK(reported({plain, clip("/extensions/ACME_x/0/y")}) == std::vector<int>{682});
}

TEST_CASE("merge: members of the root that one file can have are said to be left out") {
  const std::string plain = with(R"("nodes":[{}])"), extras = with(R"("extras":{"a":1})");
  Diagnostics diagnostics;
  const auto file = merged(files_of({plain, extras}), diagnostics);
  REQUIRE(file);
  CHECK(file->root()["extras"].text() == R"({"a":1})");
  CHECK(diagnostics.all().empty());
  CHECK(reported({with(R"("extras":1)"), extras}) == std::vector<int>{688});
  CHECK(reported({plain, R"({"asset":{"version":"2.0","copyright":"me"}})"}) ==
        std::vector<int>{688});
  CHECK(reported({plain, with(R"("odd":[1])")}) == std::vector<int>{688});
}

TEST_CASE("merge: rigs get ids of their own and stand for the same nodes") {
  const std::deque<File> files = rigged_files();
  Diagnostics diagnostics;
  const auto file = merged(files, diagnostics);
  REQUIRE_MESSAGE(file, render(diagnostics, false));
  const auto rigs = read_rigs(*file, diagnostics);
  REQUIRE_MESSAGE(rigs, render(diagnostics, false));
  CHECK(numbers(diagnostics).empty());
  REQUIRE(rigs->size() == 3);
  const auto nodes = file->root()["nodes"].items();
  std::set<int> taken;
  std::map<std::uint32_t, std::string> globals;
  for (const Rig& rig : *rigs) {
    globals[rig.id] = rig.skeleton.global;
    const auto before = read_rigs(files[0], diagnostics);
    REQUIRE(before);
    REQUIRE(rig.scene.size() == before->front().scene.size());
    for (const scene::NodeId id : rig.scene.nodes()) {
      CHECK(rig.scene[id].identity.rig == rig.id);
      const int node = rig.nodes[id.index], old = before->front().nodes[id.index];
      CHECK((node < 0) == (old < 0));
      if (node < 0) continue;
      CHECK(taken.insert(node).second);
      const json::Value mark = nodes[static_cast<std::size_t>(node)]["extras"]["rigc"];
      CHECK(mark.string() == to_text(rig.scene[id].identity));
      CHECK(nodes[static_cast<std::size_t>(node)]["name"].string() ==
            files[0].root()["nodes"].items()[static_cast<std::size_t>(old)]["name"].string());
    }
    for (std::size_t i = 0; i < rig.skeleton.joints.size(); ++i)
      CHECK((rig.skeleton.joints[i].foreign_node < 0) ==
            (before->front().skeleton.joints[i].foreign_node < 0));
    CHECK(rig.owned.goes.nodes.runs.size() == before->front().owned.goes.nodes.runs.size());
  }
  CHECK(globals == std::map<std::uint32_t, std::string>{{0, "right"}, {1, "third"}, {7, "left"}});
}

TEST_CASE("merge: taking all rigs out of a merged file leaves the models") {
  const std::deque<File> files = rigged_files();
  Diagnostics diagnostics;
  const auto file = merged(files, diagnostics);
  REQUIRE(file);
  const auto rigs = read_rigs(*file, diagnostics);
  REQUIRE(rigs);
  Patch patch(*file);
  strip_rigs(patch, *file, *rigs, Strip::nothing);
  const auto output = patch.finish(true, diagnostics);
  REQUIRE(output);
  const auto stripped = gltf::open("m.glb", Bytes(whole(*output)), diagnostics);
  REQUIRE(stripped);
  const File& left = *stripped;
  const File model = text_file(small_model());
  CHECK(!left.root()["extensions"]);
  CHECK(!left.root()["extensionsUsed"]);
  CHECK(at(left.root(), "/scenes/0/nodes").size() == 6);
  std::size_t meshes = 0;
  for (const json::Value& mesh : left.root()["meshes"].items())
    meshes += mesh["extras"]["rigc"] ? 0 : 1;
  CHECK(meshes == 3);
  for (const json::Value& node : left.root()["nodes"].items()) {
    const json::Value mark = node["extras"]["rigc"];
    CHECK((!mark || mark["free"]));
  }
  // Those of the first file are what they were, byte for byte.
  for (const char* array : {"nodes", "skins", "animations", "meshes"}) {
    const auto before = model.root()[array].items(), after = left.root()[array].items();
    for (std::size_t i = 0; i < before.size(); ++i) CHECK(after[i].text() == before[i].text());
  }
  CHECK(view_bytes(left, 0) == view_bytes(model, 0));
}

TEST_CASE("merge: two rigs of one global group are refused") {
  std::deque<File> files = rigged_files();
  Diagnostics diagnostics;
  auto again = gltf::open("again.glb", Bytes(rigged(small_model(), "left", 2)), diagnostics);
  REQUIRE(again);
  files.push_back(*std::move(again));
  CHECK(!merged(files, diagnostics));
  CHECK(numbers(diagnostics) == std::vector<int>{684});
}

TEST_CASE("merge: holders of orphans follow their rig") {
  std::deque<File> files = rigged_files();
  std::string text(files[1].json.text());
  text = replaced(text, R"("owned":)",
                  R"("orphans":[{"node":1,"identity":"7:00000000000000aa:00000000000000bb:c:r:0",)"
                  R"("name":"lost","kind":"control","other":7}],"owned":)");
  text = replaced(text, R"({"name": "body", "mesh": 0, "skin": 0})",
                  R"({"name": "body", "mesh": 0, "skin": 0, "extras": )"
                  R"({"rigc": "orphan:7:00000000000000aa:00000000000000bb:c:r:0"}})");
  Diagnostics diagnostics;
  auto changed =
      gltf::open("b.glb", Bytes(glb(text, gltf::test::text(*files[1].bin))), diagnostics);
  REQUIRE_MESSAGE(changed, render(diagnostics, false));
  const auto first = static_cast<int>(files[0].root()["nodes"].size());
  files[1] = *std::move(changed);
  const auto file = merged(files, diagnostics);
  REQUIRE_MESSAGE(file, render(diagnostics, false));
  CHECK(at(file->root(), "/extensions/RIGC_rig/rigs/1/orphans").text() ==
        R"([{"node":)" + std::to_string(first + 2) +
            R"(,"identity":"0:00000000000000aa:00000000000000bb:c:r:0",)" +
            R"("name":"lost","kind":"control","other":7}])");
  const auto rigs = read_rigs(*file, diagnostics);
  REQUIRE_MESSAGE(rigs, render(diagnostics, false));
  REQUIRE(rigs->front().orphans.size() == 1);
  CHECK(rigs->front().orphans[0].node == first + 2);
  CHECK(at(file->root(), "/nodes/" + std::to_string(first + 2) + "/extras/rigc").string() ==
        "orphan:0:00000000000000aa:00000000000000bb:c:r:0");
}
