// SPDX-License-Identifier: MIT
// Single channels get other targets and values; what they share with others stays theirs.
#include "gltf/channels.h"

#include <doctest/doctest.h>

#include "gltf/clips.h"
#include "tests/gltf/file_helpers.h"

using namespace rigc;
using namespace rigc::gltf;
using namespace rigc::gltf::test;

namespace {

/// Three nodes. Clip `one`: translations of nodes 0 and 1 by one sampler, the rotation of node 2,
/// an attribute of node 0 by pointer. Clip `two` uses the accessors of the first, and animates
/// weights, a camera and a pointer that nobody knows.
std::string model() {
  const std::string bytes = floats({0, 1}) + floats({1, 2, 3, 4, 5, 6}) +
                            floats({0, 0, 0, 1, 1, 0, 0, 0}) + floats({0.25f, 0.75f});
  return R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_animation_pointer"],)"
         R"("nodes":[{"extras":{"ik_fk":0}},{"mesh":0},{"extras":{"ik_fk":0,"roll":0}}],)"
         R"("meshes":[{"primitives":[{"attributes":{},"targets":[{}]}]}],)"
         R"("animations":[{"name":"one","extras":{"by":"hand"},"channels":[)"
         R"({"sampler":0,"target":{"node":0,"path":"translation"},"extras":{"color":1.50}},)"
         R"({"sampler":0,"target":{"node":1,"path":"translation"}},)"
         R"({"sampler":1,"target":{"node":2,"path":"rotation","extras":{"note":"x"}}},)"
         R"({"sampler":2,"target":{"path":"pointer","extensions":{"KHR_animation_pointer":)"
         R"({"pointer":"/nodes/0/extras/ik_fk","extras":7},"VENDOR_x":{}}}}],)"
         R"("samplers":[{"input":0,"output":1,"extras":"kept"},)"
         R"({"input":0,"output":2,"interpolation":"LINEAR"},{"input":0,"output":3}]},)"
         R"({"name":"two","channels":[{"sampler":0,"target":{"node":2,"path":"translation"}},)"
         R"({"sampler":1,"target":{"node":1,"path":"weights"}},)"
         R"({"sampler":1,"target":{"path":"pointer","extensions":{"KHR_animation_pointer":)"
         R"({"pointer":"/cameras/0/perspective/yfov"}}}}],)"
         R"("samplers":[{"input":0,"output":1},{"input":0,"output":3}]}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":2,"type":"SCALAR",)"
         R"("min":[0],"max":[1]},)"
         R"({"bufferView":1,"componentType":5126,"count":2,"type":"VEC3"},)"
         R"({"bufferView":2,"componentType":5126,"count":2,"type":"VEC4"},)"
         R"({"bufferView":3,"componentType":5126,"count":2,"type":"SCALAR"}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":8},{"buffer":0,"byteOffset":8,"byteLength":24},)"
         R"({"buffer":0,"byteOffset":32,"byteLength":32},)"
         R"({"buffer":0,"byteOffset":64,"byteLength":8}],)"
         R"("buffers":[{"byteLength":72,"uri":")" +
         data_uri(bytes) + "\"}]}";
}

File opened() {
  Diagnostics diagnostics;
  auto file = open_text(model(), diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(file);
  return *std::move(file);
}

File finished(Patch& patch, const File& file) {
  Diagnostics diagnostics;
  const auto output = patch.finish(true, diagnostics);
  REQUIRE(output);
  const std::string path = make_folder("broken/channels") + "/model.glb";
  write_output(*output, path, folder_of(file.path));
  auto result = gltf::open(path, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(result);
  return *std::move(result);
}

File edited(const File& file, const std::vector<ChannelEdit>& edits) {
  Patch patch(file);
  edit_channels(patch, file, edits);
  return finished(patch, file);
}

std::vector<anim::Clip> clips_of(const File& file) {
  Diagnostics diagnostics;
  auto clips = read_clips(file, diagnostics);
  REQUIRE(clips);
  return std::move(clips->clips);
}

json::Value element(const File& file, const char* array, std::size_t index) {
  return file.root()[array].items()[index];
}

std::string channel_text(const File& file, std::size_t animation, std::size_t channel) {
  return std::string(element(file, "animations", animation)["channels"].items()[channel].text());
}

ChannelEdit to_node(int channel, int node) {
  ChannelEdit edit;
  edit.channel = channel;
  edit.node = node;
  return edit;
}

}  // namespace

TEST_CASE("gltf channels: another node for a channel changes nothing else") {
  const File file = opened();
  const File after = edited(file, {to_node(0, 2)});
  CHECK(channel_text(after, 0, 0) ==
        R"({"sampler":0,"target":{"node":2,"path":"translation"},"extras":{"color":1.50}})");
  for (std::size_t channel = 1; channel < 4; ++channel)
    CHECK(channel_text(after, 0, channel) == channel_text(file, 0, channel));
  CHECK(element(after, "animations", 0)["samplers"].text() ==
        element(file, "animations", 0)["samplers"].text());
  CHECK(element(after, "animations", 0)["extras"].text() == R"({"by":"hand"})");
  CHECK(element(after, "animations", 1).text() == element(file, "animations", 1).text());
  CHECK(after.root()["accessors"].text() == file.root()["accessors"].text());
}

TEST_CASE("gltf channels: a pointer goes to another node and name, with what stands beside it") {
  const File file = opened();
  ChannelEdit edit = to_node(3, 2);
  edit.path = anim::Path::attribute;
  edit.attribute = "roll";
  edit.width = 1;
  const File after = edited(file, {edit});
  CHECK(channel_text(after, 0, 3) ==
        R"({"sampler":2,"target":{"path":"pointer","extensions":{"KHR_animation_pointer":)"
        R"({"pointer":"/nodes/2/extras/roll","extras":7},"VENDOR_x":{}}}})");
  const auto clips = clips_of(after);
  CHECK(clips[0].channels[3].node == 2);
  CHECK(clips[0].channels[3].attribute == "roll");
}

TEST_CASE("gltf channels: new values take the place of the old") {
  const File file = opened();
  ChannelEdit edit = to_node(2, 2);
  edit.path = anim::Path::rotation;
  edit.width = 4;
  edit.values = {0, 1, 0, 0, 0, 0, 1, 0};
  const File after = edited(file, {edit});
  const auto clips = clips_of(after);
  CHECK(clips[0].channels[2].curve.values == *edit.values);
  CHECK(clips[0].channels[0].curve.values == std::vector<float>{1, 2, 3, 4, 5, 6});
  CHECK(element(after, "animations", 0)["samplers"].items().size() == 3);
  // Nothing grows: the accessor, its view and its bytes were the clip's alone.
  CHECK(after.root()["accessors"].items().size() == 4);
  CHECK(after.root()["bufferViews"].items().size() == 4);
  CHECK(after.root()["buffers"].items()[0]["byteLength"].integer() == 72);
}

TEST_CASE("gltf channels: a sampler that others use is copied, an accessor that others use stays") {
  const File file = opened();
  ChannelEdit shared = to_node(1, 1);
  shared.values = {9, 9, 9, 8, 8, 8};
  ChannelEdit pointer = to_node(3, 0);
  pointer.path = anim::Path::attribute;
  pointer.attribute = "ik_fk";
  pointer.width = 1;
  pointer.values = {1, 0};
  const File after = edited(file, {shared, pointer});
  const auto clips = clips_of(after);
  CHECK(clips[0].channels[0].curve.values == std::vector<float>{1, 2, 3, 4, 5, 6});
  CHECK(clips[0].channels[1].curve.values == *shared.values);
  CHECK(clips[0].channels[3].curve.values == *pointer.values);
  const json::Value one = element(after, "animations", 0);
  CHECK(one["samplers"].items().size() == 4);
  CHECK(one["samplers"].items()[0].text() == R"({"input":0,"output":1,"extras":"kept"})");
  // The copy keeps what stood in the sampler, and the times.
  CHECK(one["samplers"].items()[3]["extras"].string() == "kept");
  CHECK(one["samplers"].items()[3]["input"].integer() == 0);
  // The second clip plays what it played.
  CHECK(element(after, "animations", 1).text() == element(file, "animations", 1).text());
  CHECK(clips[1].channels[0].curve.values == std::vector<float>{1, 2, 3, 4, 5, 6});
  for (const std::size_t accessor : {0u, 1u, 2u, 3u})
    CHECK(element(after, "accessors", accessor).text() ==
          element(file, "accessors", accessor).text());
}

TEST_CASE("gltf channels: no edit, no change") {
  const File file = opened();
  Patch patch(file);
  edit_channels(patch, file, {});
  CHECK(drop_channels(patch, file, {}) == 0);
  const File after = finished(patch, file);
  CHECK(after.root()["animations"].text() == file.root()["animations"].text());
}

TEST_CASE("gltf channels: animated nodes, and channels that go with a node") {
  const File file = opened();
  CHECK(animated_nodes(file) == std::set<int>{0, 1, 2});
  Patch patch(file);
  CHECK(drop_channels(patch, file, {0, 2}) == 4);
  const File after = finished(patch, file);
  CHECK(animated_nodes(after) == std::set<int>{1});
  const json::Value one = element(after, "animations", 0), two = element(after, "animations", 1);
  CHECK(one["channels"].items().size() == 1);
  CHECK(one["name"].string() == "one");
  CHECK(two["channels"].items().size() == 2);
  CHECK(clips_of(after)[0].channels[0].curve.values == std::vector<float>{1, 2, 3, 4, 5, 6});
}
