// SPDX-License-Identifier: MIT
// Clips: accessors of every form are read right, a clip that is written comes back, the rest of an
// animation stays.
#include "gltf/clips.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <random>

#include "gltf/accessor.h"
#include "tests/gltf/file_helpers.h"

using namespace rigc;
using namespace rigc::gltf;
using namespace rigc::gltf::test;

namespace {

ClipFile read(const File& file) {
  Diagnostics diagnostics;
  auto clips = read_clips(file, diagnostics);
  INFO(file.path, "\n", render(diagnostics, false));
  REQUIRE(clips);
  CHECK(diagnostics.ok());
  return *std::move(clips);
}

File text_file(const std::string& text) {
  Diagnostics diagnostics;
  auto file = open_text(text, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(file);
  return *std::move(file);
}

File patched(Patch& patch, const File& file) {
  Diagnostics diagnostics;
  const auto output = patch.finish(true, diagnostics);
  REQUIRE(output);
  const std::string path = make_folder("broken/clips") + "/model.glb";
  write_output(*output, path, folder_of(file.path));
  auto result = gltf::open(path, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(result);
  return *std::move(result);
}

bool same(const anim::Curve& a, const anim::Curve& b) {
  return a.interpolation == b.interpolation && a.width == b.width && *a.times == *b.times &&
         a.values == b.values;
}

/// A file with one accessor over `bytes`, and what read_floats makes of it.
std::optional<std::vector<float>> floats_of(const std::string& accessor, const std::string& views,
                                            const std::string& bytes, std::vector<int>* errors) {
  const File file =
      text_file(R"({"asset":{"version":"2.0"},"accessors":[)" + accessor + R"(],"bufferViews":[)" +
                views + R"(],"buffers":[{"byteLength":)" + std::to_string(bytes.size()) +
                R"(,"uri":")" + data_uri(bytes) + "\"}]}");
  Diagnostics diagnostics;
  const auto slim = read_slim(file, diagnostics);
  REQUIRE(slim);
  auto values = read_floats(file, *slim, 0, slim->accessors[0].count, diagnostics);
  CHECK(values.has_value() == diagnostics.ok());
  if (errors) *errors = numbers(diagnostics);
  return values;
}

anim::Clip make_clip(int node) {
  anim::Clip clip;
  clip.name = "made";
  const auto times = std::make_shared<const std::vector<float>>(std::vector<float>{0, 0.1f, 2});
  const auto add = [&](anim::Path path, int width, anim::Interpolation interpolation) {
    anim::Channel channel;
    channel.node = node;
    channel.path = path;
    if (path == anim::Path::attribute) channel.attribute = "ik~fk/a";
    channel.curve.interpolation = interpolation;
    channel.curve.width = width;
    channel.curve.times = times;
    const int keys = interpolation == anim::Interpolation::cubic ? 9 : 3;
    for (int i = 0; i < keys * width; ++i)
      channel.curve.values.push_back(static_cast<float>(i) / 3);
    clip.channels.push_back(std::move(channel));
  };
  add(anim::Path::translation, 3, anim::Interpolation::linear);
  add(anim::Path::rotation, 4, anim::Interpolation::cubic);
  add(anim::Path::scale, 3, anim::Interpolation::step);
  add(anim::Path::attribute, 1, anim::Interpolation::cubic);
  return clip;
}

}  // namespace

TEST_CASE("gltf clips: every channel of the corpus is read or counted") {
  std::size_t channels = 0;
  for (const std::string& path : corpus()) {
    Diagnostics diagnostics;
    const auto file = gltf::open(path, diagnostics);
    REQUIRE(file);
    const ClipFile clips = read(*file);
    const auto animations = file->root()["animations"].items();
    REQUIRE(clips.clips.size() == animations.size());
    for (std::size_t i = 0; i < animations.size(); ++i) {
      const anim::Clip& clip = clips.clips[i];
      CHECK(clip.source_animation == static_cast<int>(i));
      CHECK(clip.name == animations[i]["name"].string().value_or(""));
      CHECK(clip.channels.size() + static_cast<std::size_t>(clips.other_channels[i]) ==
            animations[i]["channels"].size());
      channels += clip.channels.size();
      for (const anim::Channel& channel : clip.channels) {
        const anim::Curve& curve = channel.curve;
        const bool cubic = curve.interpolation == anim::Interpolation::cubic;
        CHECK(curve.values.size() ==
              curve.times->size() * static_cast<std::size_t>(curve.width) * (cubic ? 3 : 1));
        const auto target =
            animations[i]["channels"]
                .items()[static_cast<std::size_t>(channel.source_channel)]["target"];
        if (target["node"]) CHECK(target["node"].integer() == channel.node);
      }
    }
  }
  if (corpus().empty())
    MESSAGE("no corpus: no channels read");
  else
    CHECK(channels > 4000);
}

TEST_CASE("gltf clips: every clip of the corpus comes back as it was written") {
  const std::string folder = make_folder("clips");
  int number = 0;
  for (const std::string& path : corpus()) {
    Diagnostics diagnostics;
    const auto file = gltf::open(path, diagnostics);
    REQUIRE(file);
    const ClipFile clips = read(*file);
    if (clips.clips.empty()) continue;
    INFO(path);
    Patch patch(*file);
    for (anim::Clip clip : clips.clips) {
      clip.source_animation = -1;
      write_clip(patch, *file, clip, {});
    }
    const File changed = patched(patch, *file);
    const std::string kept = folder + "/" + std::to_string(number++) + ".glb";
    std::filesystem::rename(changed.path, kept);
    if (file->binary)
      allow_messages_of(kept, path);
    else
      std::filesystem::remove(kept);  // what it refers to is not beside it
    const ClipFile again = read(changed);
    std::size_t next = clips.clips.size();
    for (const anim::Clip& clip : clips.clips) {
      if (clip.channels.empty()) continue;
      const anim::Clip& copy = again.clips[next++];
      REQUIRE(copy.channels.size() == clip.channels.size());
      for (std::size_t i = 0; i < clip.channels.size(); ++i) {
        CHECK(copy.channels[i].node == clip.channels[i].node);
        CHECK(copy.channels[i].path == clip.channels[i].path);
        CHECK(same(copy.channels[i].curve, clip.channels[i].curve));
      }
    }
    CHECK(again.clips.size() == next);
  }
}

TEST_CASE("gltf clips: normalised integers, strides and offsets") {
  const std::string view = R"({"buffer":0,"byteLength":)";
  const auto one = [&](const char* component, const std::string& bytes, bool normalised) {
    return *floats_of(std::string(R"({"bufferView":0,"count":1,"type":"VEC3","componentType":)") +
                          component + (normalised ? R"(,"normalized":true})" : "}"),
                      view + std::to_string(bytes.size()) + "}", bytes, nullptr);
  };
  using Floats = std::vector<float>;
  CHECK(one("5120", std::string("\x7f\x80\x00", 3), true) == Floats{1, -1, 0});
  CHECK(one("5121", std::string("\xff\x00\x33", 3), true) == Floats{1, 0, 0.2f});
  CHECK(one("5122", std::string("\xff\x7f\x01\x80\x00\x80", 6), true) == Floats{1, -1, -1});
  CHECK(one("5123", std::string("\xff\xff\x00\x00\x33\x33", 6), true) == Floats{1, 0, 0.2f});
  CHECK(one("5122", std::string("\xff\x7f\x01\x80\x00\x80", 6), false) ==
        Floats{32767, -32767, -32768});
  CHECK(one("5125", std::string("\x01\0\0\0\x02\0\0\0\x03\0\0\0", 12), false) == Floats{1, 2, 3});
  CHECK(one("5126", floats({1, 2, 3}), false) == Floats{1, 2, 3});

  CHECK(*floats_of(R"({"bufferView":0,"byteOffset":4,"count":2.0,"type":"SCALAR",)"
                   R"("componentType":5126})",
                   R"({"buffer":0,"byteOffset":4,"byteLength":16,"byteStride":8})",
                   floats({9, 9, 1, 9, 2}), nullptr) == Floats{1, 2});
}

TEST_CASE("gltf clips: sparse accessors") {
  const std::string bytes = floats({1, 2, 3, 4, 10, 20}) + std::string("\x01\x00\x03\x00", 4);
  const auto sparse = [&](const std::string& base, const std::string& index_bytes) {
    std::vector<int> errors;
    const auto values =
        floats_of("{" + base +
                      R"("count":4,"type":"SCALAR","componentType":5126,"sparse":{)"
                      R"("count":2,"indices":{"bufferView":1,"componentType":5123},)"
                      R"("values":{"bufferView":2}}})",
                  R"({"buffer":0,"byteLength":16},{"buffer":0,"byteOffset":24,"byteLength":4},)"
                  R"({"buffer":0,"byteOffset":16,"byteLength":8})",
                  bytes.substr(0, 24) + index_bytes, &errors);
    return values ? *values : std::vector<float>(errors.begin(), errors.end());
  };
  using Floats = std::vector<float>;
  CHECK(sparse(R"("bufferView":0,)", bytes.substr(24)) == Floats{1, 10, 3, 20});
  CHECK(sparse("", bytes.substr(24)) == Floats{0, 10, 0, 20});
  CHECK(sparse("", std::string("\x03\x00\x03\x00", 4)) == Floats{671});
  CHECK(sparse("", std::string("\x03\x00\x04\x00", 4)) == Floats{671});
}

TEST_CASE("gltf clips: data that cannot be used") {
  std::vector<int> errors;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::string scalar = R"("count":1,"type":"SCALAR","componentType":5126})";
  floats_of(R"({"bufferView":0,)" + scalar, R"({"buffer":0,"byteLength":4})", floats({nan}),
            &errors);
  CHECK(errors == std::vector<int>{673});
  floats_of(R"({"count":9007199254740992,"type":"MAT4","componentType":5126})",
            R"({"buffer":0,"byteLength":4})", "abcd", &errors);
  CHECK(errors == std::vector<int>{672});

  const auto clip_errors = [](const std::string& text) {
    const File file = text_file(text);
    Diagnostics diagnostics;
    CHECK_FALSE(read_clips(file, diagnostics));
    return numbers(diagnostics);
  };
  const std::string model = small_model();
  const std::size_t uri = model.find(R"(, "uri")");
  const std::string without = model.substr(0, uri) + model.substr(model.find("}]\n}", uri));
  CHECK(clip_errors(without) == std::vector<int>{672});
  const auto times = [&](float a, float b) {
    const std::string bytes =
        floats(std::vector<float>(32, 0)) + floats({a, b}) + floats(std::vector<float>(17, 1));
    return model.substr(0, uri) + R"(, "uri": ")" + data_uri(bytes) + "\"}]}";
  };
  CHECK(clip_errors(times(0, 0)) == std::vector<int>{679});
  CHECK(clip_errors(times(1, 0.5f)) == std::vector<int>{679});
  CHECK(clip_errors(times(-1, 0.5f)) == std::vector<int>{679});
  CHECK(read(text_file(times(0, 1))).clips.size() == 1);
}

TEST_CASE("gltf clips: what the reader refuses and the checks did not see is an error") {
  Diagnostics diagnostics;
  auto json =
      json::parse(R"({"animations":[{"samplers":[{}],"channels":[]}]})", "", 0, diagnostics);
  REQUIRE(json);
  File unchecked;
  unchecked.json = *std::move(json);
  CHECK_FALSE(read_slim(unchecked, diagnostics));
  CHECK(numbers(diagnostics) == std::vector<int>{680});
}

TEST_CASE("gltf clips: shared accessors cannot ask for any amount of memory") {
  std::string channels, samplers;
  for (int i = 0; i < 40; ++i) {
    channels += (i ? "," : "") + std::string(R"({"sampler":)") + std::to_string(i) +
                R"(,"target":{"node":0,"path":"translation"}})";
    samplers += (i ? "," : "") + std::string(R"({"input":0,"output":1})");
  }
  const File file = text_file(
      R"({"asset":{"version":"2.0"},"nodes":[{}],"animations":[{"channels":[)" + channels +
      R"(],"samplers":[)" + samplers +
      R"(]}],"accessors":[{"count":1000000,"type":"SCALAR","componentType":5126,)"
      R"("sparse":{"count":1,"indices":{"bufferView":0,"componentType":5121},)"
      R"("values":{"bufferView":0}}},{"count":1000000,"type":"VEC3","componentType":5126}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":4}],)"
      R"("buffers":[{"byteLength":4,"uri":")" +
      data_uri("abcd") + "\"}]}");
  Diagnostics diagnostics;
  CHECK_FALSE(read_clips(file, diagnostics));
}

TEST_CASE("gltf clips: pointers to node properties are channels, others are counted") {
  const auto channel = [](const std::string& pointer, int sampler) {
    return R"(,{"sampler":)" + std::to_string(sampler) +
           R"(,"target":{"path":"pointer","extensions":{"KHR_animation_pointer":{"pointer":")" +
           pointer + "\"}}}}";
  };
  const std::string last = R"("path": "rotation"}})";
  const File file = text_file(replaced(
      replaced(small_model(), last,
               last + channel("/nodes/0/extras/ik~1fk~0", 1) + channel("/nodes/1/rotation", 0) +
                   channel("/materials/0/alphaCutoff", 1) + channel("/nodes/0/extras/a/b", 1) +
                   R"(,{"sampler":0,"target":{"path":"rotation"}})"),
      R"("interpolation": "LINEAR"})", R"("interpolation": "LINEAR"}, {"input": 1, "output": 1})"));
  const ClipFile clips = read(file);
  REQUIRE(clips.clips[0].channels.size() == 3);
  CHECK(clips.other_channels[0] == 3);
  const anim::Channel& attribute = clips.clips[0].channels[1];
  CHECK(attribute.path == anim::Path::attribute);
  CHECK(attribute.attribute == "ik/fk~");
  CHECK(attribute.source_channel == 1);
  CHECK(attribute.curve.width == 1);
  CHECK(attribute.curve.values == std::vector<float>{0, 1});
  CHECK(clips.clips[0].channels[2].path == anim::Path::rotation);
  CHECK(clips.clips[0].channels[0].curve.times == attribute.curve.times);
}

TEST_CASE("gltf clips: a new clip is written and read") {
  const File file = text_file(small_model());
  Patch patch(file);
  write_clip(patch, file, make_clip(0), {});
  CHECK(patch.count("accessors") == 4 + 1 + 4);
  const File changed = patched(patch, file);
  CHECK(changed.root()["extensionsUsed"].text() == R"(["KHR_animation_pointer"])");
  const ClipFile clips = read(changed);
  REQUIRE(clips.clips.size() == 2);
  const anim::Clip made = make_clip(0);
  CHECK(clips.clips[1].name == "made");
  REQUIRE(clips.clips[1].channels.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(clips.clips[1].channels[i].path == made.channels[i].path);
    CHECK(clips.clips[1].channels[i].attribute == made.channels[i].attribute);
    CHECK(same(clips.clips[1].channels[i].curve, made.channels[i].curve));
  }
  const auto input = changed.root()["accessors"].items()[4];
  CHECK(input["min"].text() == "[0]");
  CHECK(input["max"].text() == "[2]");
}

TEST_CASE("gltf clips: bytes that were free and are cut off are forgotten") {
  // Of four pieces the third goes, then the last; the view of the second lies behind the third's.
  std::string text = R"({"asset":{"version":"2.0"},"nodes":[{},{}],"buffers":[{"byteLength":96,)"
                     R"("uri":"data:application/octet-stream;base64,AAAAAAAAgD8A)";
  text += std::string(116, 'A') +
          R"("}],"bufferViews":[{"buffer":0,"byteLength":8},)"
          R"({"buffer":0,"byteOffset":48,"byteLength":24},{"buffer":0,"byteOffset":8,)"
          R"("byteLength":24},{"buffer":0,"byteOffset":72,"byteLength":24}],"accessors":[)"
          R"({"bufferView":0,"componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[1]})";
  for (const char* view : {"1", "2", "3"})
    text += std::string(R"(,{"bufferView":)") + view +
            R"(,"componentType":5126,"count":2,"type":"VEC3"})";
  text += R"(],"animations":[)";
  for (const char* output : {"1", "2", "3"})
    text += std::string(output[0] == '1' ? "" : ",") +
            R"({"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}],)"
            R"("samplers":[{"input":0,"output":)" +
            output + "}]}";
  File file = text_file(text + "]}");
  for (const int gone : {0, 2}) {
    Patch patch(file);
    write_clips(patch, file, {{{"", gone, {}}, {0}}});
    file = patched(patch, file);
    for (const json::Value& view : file.root()["bufferViews"].items()) {
      const auto begin = view["byteOffset"].integer().value_or(0);
      CHECK(begin + view["byteLength"].integer().value_or(0) <=
            file.root()["buffers"].items()[0]["byteLength"].integer().value_or(0));
    }
  }
  CHECK(read(file).clips[1].channels.size() == 1);
}

TEST_CASE("gltf clips: changing a clip leaves the other channels and their samplers alone") {
  const std::string last = R"("path": "rotation"}})";
  const File file = text_file(
      replaced(replaced(small_model(), last,
                        last + R"(, {"sampler": 1, "target": {"node": 0, "path": "rotation"}})"
                               R"(, {"sampler": 2, "target": {"node": 2, "path": "rotation"}})"),
               R"("interpolation": "LINEAR"})",
               R"("interpolation": "LINEAR"}, {"input": 1, "output": 2}, )"
               R"({"input": 1, "output": 2, "extras": {"mine": 1e0}})"));
  anim::Clip clip = make_clip(0);  // brings the rotation of node 0
  clip.source_animation = 0;
  Patch patch(file);
  write_clip(patch, file, clip, {0});
  const File changed = patched(patch, file);
  const json::Value animation = changed.root()["animations"].items()[0];
  CHECK(animation["name"].text() == "\"turn\"");
  const auto channels = animation["channels"].items();
  REQUIRE(channels.size() == 5);
  CHECK(channels[0].text() == R"({"sampler": 2, "target": {"node": 2, "path": "rotation"}})");
  const auto samplers = animation["samplers"].items();
  REQUIRE(samplers.size() == 5);
  CHECK(samplers[2].text() == R"({"input": 1, "output": 2, "extras": {"mine": 1e0}})");
  const ClipFile clips = read(changed);
  for (std::size_t i = 0; i < 4; ++i)
    CHECK(same(clips.clips[0].channels[i + 1].curve, clip.channels[i].curve));

  anim::Clip nothing;
  nothing.source_animation = 0;
  Patch drop(changed);
  write_clip(drop, changed, nothing, {1, 2, 3, 4});
  const File dropped = patched(drop, changed);
  const json::Value rest = dropped.root()["animations"].items()[0];
  CHECK(rest["channels"].text() ==
        R"([{"sampler": 2, "target": {"node": 2, "path": "rotation"}}])");
  CHECK(rest["samplers"].size() == 3);
  Patch all(dropped);
  write_clip(all, dropped, nothing, {0});
  CHECK(read(patched(all, dropped)).clips[0].channels.empty());
}
