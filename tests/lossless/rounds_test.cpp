// SPDX-License-Identifier: MIT
// Files do not grow: what is free is used again, at the end it is cut, and what somebody appended
// behind a rig stays where it is.
#include <doctest/doctest.h>

#include "gltf/clips.h"
#include "gltf/file_helpers.h"
#include "lossless_helpers.h"

using namespace rigc;
using namespace rigc::test::lossless;

namespace {

const std::string kTheirs = gltf::test::floats({1, 2, 3});

/// Somebody else's element of every kind, behind all others.
Sample with_more_of_others(const Sample& sample, int number) {
  const gltf::File file = opened(sample);
  gltf::Patch patch(file);
  gltf::NewAccessor accessor;
  accessor.name = "theirs " + std::to_string(number);
  accessor.data = kTheirs;
  accessor.type = "VEC3";
  accessor.count = 1;
  accessor.min = accessor.max = {1, 2, 3};
  const int position = patch.append(std::move(accessor));
  const int mesh = patch.append(
      "meshes", R"({"name":"theirs","primitives":[{"mode":0,"attributes":{"POSITION":)" +
                    std::to_string(position) + "}}]}");
  patch.append("materials", R"({"name":"theirs"})");
  const int node =
      patch.append("nodes", R"({"name":"theirs","mesh":)" + std::to_string(mesh) + "}");
  patch.add_child(-1, node);
  return finished(patch, sample, file.binary);
}

std::string data_named(const gltf::File& file, const std::string& name) {
  const auto accessors = file.root()["accessors"].items();
  for (const json::Value& accessor : accessors) {
    if (accessor["name"].string() != name) continue;
    const auto views = file.root()["bufferViews"].items();
    const json::Value view = views[static_cast<std::size_t>(*accessor["bufferView"].integer())];
    const auto& buffer = file.buffers[static_cast<std::size_t>(*view["buffer"].integer())];
    return gltf::test::text(
        buffer.bytes.part(static_cast<std::uint64_t>(view["byteOffset"].integer().value_or(0)),
                          static_cast<std::uint64_t>(*view["byteLength"].integer())));
  }
  return {};
}

Sample with_rig(const Sample& sample, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  int ancestor = -1;
  gltf::Rig rig = rig_for(opened(sample), random, 0, false, ancestor);
  return rigged(sample, rig, ancestor);
}

std::vector<Sample> samples(const std::string& name) {
  std::vector<Sample> out;
  for (Sample& sample : made_samples(folder(name)))
    if (opened(sample).root()["nodes"].size() > 1) out.push_back(std::move(sample));
  return out;
}

}  // namespace

TEST_CASE("lossless rounds: build and strip, ten times") {
  for (const Sample& sample : samples("broken/strip")) {
    CAPTURE(sample.name);
    Sample now = sample;
    std::string first;
    for (int round = 0; round < 10; ++round) {
      const Sample built = with_rig(now, 5);
      if (round == 0) first = built.bytes;
      CHECK(built.bytes == first);
      now = stripped(built);
      CHECK(now.bytes == sample.bytes);
    }
  }
}

TEST_CASE("lossless rounds: with others' data behind the rig, the file keeps its size") {
  for (const Sample& sample : samples("behind")) {
    CAPTURE(sample.name);
    Sample now = with_more_of_others(with_rig(sample, 6), 0);
    std::size_t size = 0, built_size = 0;
    for (int round = 0; round < 10; ++round) {
      now = stripped(now);
      const gltf::File file = opened(now);
      CHECK(data_named(file, "theirs 0") == kTheirs);
      CHECK(file.json.text().find("RIGC_rig") == std::string_view::npos);
      if (round > 0) CHECK(now.bytes.size() == size);
      size = now.bytes.size();
      now = with_rig(now, 6);
      if (round > 0) CHECK(now.bytes.size() == built_size);
      built_size = now.bytes.size();
      CHECK(data_named(opened(now), "theirs 0") == kTheirs);
    }
    show(sample, sample.path, sample.path);
    show(now, folder_of(sample.path) + "/built_" + sample.name, sample.path);
    show(stripped(now), folder_of(sample.path) + "/stripped_" + sample.name, sample.path);
  }
}

TEST_CASE("lossless rounds: rigs of random sizes stay below the largest") {
  for (const Sample& sample : samples("broken/random")) {
    CAPTURE(sample.name);
    std::size_t largest = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed)
      largest = std::max(largest, with_rig(sample, seed).bytes.size());
    Sample now = with_more_of_others(with_rig(sample, 0), 0);
    const std::size_t theirs = now.bytes.size() - with_rig(sample, 0).bytes.size();
    for (std::uint64_t seed = 1; seed < 12; ++seed) {
      now = with_rig(stripped(now), seed);
      // What does not fit into holes goes behind, once; placeholders cost some text.
      CHECK(now.bytes.size() <= 2 * largest + theirs);
      CHECK(data_named(opened(now), "theirs 0") == kTheirs);
    }
  }
}
