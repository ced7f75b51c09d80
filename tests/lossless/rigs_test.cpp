// SPDX-License-Identifier: MIT
// Law 8: a rig written into any file changes what it may and nothing else, and taken out of it
// again leaves the very bytes.
#include <doctest/doctest.h>

#include <filesystem>

#include "gltf/file_helpers.h"
#include "gltf/rig_helpers.h"
#include "lossless_helpers.h"
#include "pipeline/build.h"
#include "support/corpus.h"

using namespace rigc;
using namespace rigc::test::lossless;

namespace {

/// A rig into the file and out again.
Sample in_and_out(const Sample& sample, std::mt19937_64& random) {
  CAPTURE(sample.name);
  int ancestor = -1;
  const bool helpers = below(random, 3) == 0;
  gltf::Rig rig = rig_for(opened(sample), random, 0, helpers, ancestor);
  Sample with_rig = rigged(sample, rig, ancestor);
  CHECK(with_rig.bytes != sample.bytes);
  CHECK(stripped(with_rig).bytes == sample.bytes);
  return with_rig;
}

std::vector<Sample> all_samples(const std::string& name) {
  const std::string place = folder(name);
  std::vector<Sample> samples = made_samples(place);
  for (Sample& sample : corpus_samples(place)) samples.push_back(std::move(sample));
  return samples;
}

std::vector<int> numbers_of(const json::Value& list) {
  std::vector<int> out;
  for (const json::Value& item : list.items()) out.push_back(static_cast<int>(*item.integer()));
  return out;
}

/// A rig with one control whose joints are these nodes.
gltf::Rig rig_on(const std::vector<int>& nodes) {
  gltf::test::RigMaker maker;
  for (const int node : nodes) maker.joint("j" + std::to_string(node), -1, {}, node);
  if (nodes.empty()) maker.joint("alone", -1, {});
  maker.command("main", "control");
  maker.node(scene::Kind::control, "control");
  return maker.take();
}

}  // namespace

TEST_CASE("lossless rigs: a rig in and out of every file gives the same bytes") {
  std::mt19937_64 random(1);
  for (const Sample& sample : all_samples("rigs")) {
    const std::string copy = folder_of(sample.path) + "/rigged_" +
                             std::filesystem::path(sample.path).filename().string();
    // Made files have messages of their own and serve as models.
    show(sample, sample.path, sample.path);
    for (int i = 0; i < 3; ++i) show(in_and_out(sample, random), copy, sample.path);
  }
}

TEST_CASE("lossless rigs: a rig in and out of random mutations of every file") {
  std::mt19937_64 random(2);
  for (const Sample& sample : all_samples("broken/mutations"))
    for (int i = 0; i < 4; ++i) in_and_out(mutated(sample, random), random);
}

TEST_CASE("lossless rigs: the biped onto every humanoid and off again") {
  const std::vector<Sample> samples = corpus_samples(folder("humanoids"));
  for (const rigc::test::Humanoid& humanoid : rigc::test::humanoids()) {
    for (const Sample& sample : samples) {
      if (!humanoid.file.starts_with(sample.name + "/")) continue;
      CAPTURE(humanoid.file);
      Diagnostics diagnostics;
      pipeline::BuildRequest request;
      request.template_file = std::string(RIGC_SOURCE_DIR) + "/templates/biped.yaml";
      request.paths.templates = {std::string(RIGC_SOURCE_DIR) + "/templates"};
      request.model = sample.path;
      request.map = rigc::test::user_map(humanoid);
      const bool text = sample.path.ends_with(".gltf");
      const std::string out = folder_of(sample.path) + (text ? "/rigged.gltf" : "/rigged.glb");
      const auto built = pipeline::build(request, out, diagnostics);
      REQUIRE_MESSAGE(built, render(diagnostics, false));
      gltf::test::allow_messages_of(out, sample.path);
      const auto file = gltf::open(out, diagnostics);
      REQUIRE(file);
      expect_kept(opened(sample), *file, built->rig);
      CHECK(stripped({sample.name, out, gltf::test::text(file->whole)}).bytes == sample.bytes);
    }
  }
}

TEST_CASE("lossless rigs: several rigs in one file go in any order") {
  std::mt19937_64 random(3);
  for (const Sample& sample : made_samples(folder("broken/several"))) {
    CAPTURE(sample.name);
    const std::size_t nodes = opened(sample).root()["nodes"].size();
    if (nodes < 2) continue;
    for (int round = 0; round < 4; ++round) {
      Sample now = sample;
      for (std::uint32_t id = 0; id < 2; ++id) {
        gltf::Rig rig = rig_on({static_cast<int>(id)});
        rig.id = id;
        now = rigged(now, rig, -1);
      }
      const std::size_t first = below(random, 2);
      for (const std::size_t number : {first, std::size_t{0}}) {
        const gltf::File file = opened(now);
        Diagnostics diagnostics;
        const auto rigs = gltf::read_rigs(file, diagnostics);
        REQUIRE(rigs);
        REQUIRE(number < rigs->size());
        gltf::Patch patch(file);
        gltf::strip_rig(patch, file, (*rigs)[number], gltf::Strip::nothing);
        now = finished(patch, now, file.binary);
      }
      // Placeholders of the one that went first, if it was the first, are gone with the other.
      if (first == 1) CHECK(now.bytes == sample.bytes);
    }
  }
}

TEST_CASE("lossless rigs: a rig is in the scenes of its joints") {
  const std::vector<Sample> made = made_samples(folder("broken/scenes"));
  const auto sample = [&](std::string_view name) {
    for (const Sample& candidate : made)
      if (candidate.name == name) return candidate;
    FAIL("no such sample");
    return Sample();
  };
  const auto scenes_of = [&](std::string_view name, const std::vector<int>& joints) {
    gltf::Rig rig = rig_on(joints);
    const gltf::File after = opened(rigged(sample(name), rig, -1));
    const int control = rig.nodes[gltf::test::with_role(rig, "control").index];
    std::vector<int> found;
    const auto scenes = after.root()["scenes"].items();
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      const std::vector<int> roots = numbers_of(scenes[i]["nodes"]);
      const auto mentions = std::count(roots.begin(), roots.end(), control);
      CHECK(mentions <= 1);
      if (mentions == 1) found.push_back(static_cast<int>(i));
    }
    return found;
  };
  using List = std::vector<int>;
  CHECK(scenes_of("scenes.gltf", {2}) == List{1});        // under a root of the second scene
  CHECK(scenes_of("scenes.gltf", {3}) == List{0, 1});     // a root of two scenes
  CHECK(scenes_of("scenes.gltf", {4}) == List{2});        // not in the default scene
  CHECK(scenes_of("scenes.gltf", {2, 4}) == List{1, 2});  // joints in different scenes
  CHECK(scenes_of("scenes.gltf", {}) == List{1});         // no joint: the default scene
  CHECK(scenes_of("no_default_scene.glb", {}) == List{0});
  CHECK(scenes_of("no_default_scene.glb", {1}) == List{0});
  CHECK(scenes_of("no_scenes.gltf", {0, 1}).empty());  // what is in no scene stays in none
  CHECK(scenes_of("no_scenes.gltf", {}) == List{0});   // a scene is made
}
