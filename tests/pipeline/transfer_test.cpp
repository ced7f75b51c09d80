// SPDX-License-Identifier: MIT
// Clips of every humanoid of the corpus go from its joints to the biped's controls and, baked,
// back: to the same motion.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "anim/clip.h"
#include "gltf/clips.h"
#include "pipeline/bake_file.h"
#include "pipeline/motion_helpers.h"
#include "pipeline/transfer.h"
#include "support/corpus.h"

namespace rigc {
namespace {

using math::Affine;
using test::Rigged;

std::vector<anim::Clip> clips_of(const std::string& path) {
  Diagnostics diagnostics;
  const auto file = gltf::open(path, diagnostics);
  REQUIRE(file);
  auto clips = gltf::read_clips(*file, diagnostics);
  REQUIRE_MESSAGE(clips, render(diagnostics, false));
  return std::move(clips->clips);
}

struct Trip {
  std::string keyed, baked;
  pipeline::TransferredFile report;
};

/// To controls, and back with a key wherever the controls have one.
Trip there_and_back(const Rigged& rigged, const std::vector<std::string>& limbs,
                    const std::string& name, Diagnostics& diagnostics) {
  Trip trip{test::test_out(name + "_keyed.glb"), test::test_out(name + "_baked.glb"), {}};
  pipeline::TransferRequest there;
  there.file = rigged.path;
  there.limbs = limbs;
  auto done = pipeline::transfer_file(there, trip.keyed, diagnostics);
  REQUIRE_MESSAGE(done, render(diagnostics, false));
  trip.report = std::move(*done);
  pipeline::BakeRequest back;
  back.file = trip.keyed;
  back.fps = "source";
  Diagnostics of_bake;
  REQUIRE_MESSAGE(pipeline::bake_file(back, trip.baked, of_bake), render(of_bake, false));
  test::made_from(trip.keyed, rigged.model);
  test::made_from(trip.baked, rigged.model);
  return trip;
}

/// Largest distance between where two files play the nodes of a model, in heights of the character.
double farthest(const Rigged& rigged, const std::string& other, const anim::Clip& clip,
                const std::vector<double>& times) {
  const std::size_t count = test::load_character(rigged.model).json["nodes"].size();
  const auto wanted = test::play(rigged.path, clip.name, times);
  const auto got = test::play(other, clip.name, times);
  double largest = 0;
  for (std::size_t f = 0; f < times.size(); ++f)
    for (std::size_t n = 0; n < count; ++n)
      largest = std::max(largest, math::length(wanted[f][n].origin - got[f][n].origin));
  return largest / rigged.height;
}

std::set<int> driven_nodes(const Rigged& rigged) {
  std::set<int> nodes;
  for (const scene::NodeId id : rigged.scene().nodes())
    if (rigged.scene()[id].is_skeleton() && rigged.is_driven(id))
      nodes.insert(rigged.gltf_node(id));
  return nodes;
}

/// Every clip of every humanoid; the largest distance of each is below `allowed`.
void check_corpus(const std::vector<std::string>& limbs, const std::string& what, double allowed) {
  std::size_t clips = 0, characters = 0;
  for (const test::Humanoid& humanoid : test::humanoids()) {
    const std::string model = test::corpus_file(humanoid.file);
    if (model.empty()) continue;
    ++characters;
    CAPTURE(humanoid.file);
    const std::string name = what + "_" + std::to_string(characters);
    const Rigged rigged = test::rig_model(model, test::user_map(humanoid), name);
    const auto sources = clips_of(rigged.path);
    Diagnostics diagnostics;
    const Trip trip = there_and_back(rigged, limbs, name, diagnostics);
    CHECK(trip.report.clips.size() == sources.size());
    for (std::size_t i = 0; i < sources.size(); ++i) {
      CAPTURE(sources[i].name);
      CHECK_FALSE(trip.report.clips[i].passed_through);
      const double off = farthest(rigged, trip.baked, sources[i], anim::key_times(sources[i]));
      CHECK(off < allowed);
      ++clips;
    }
  }
  MESSAGE(clips << " clips of " << characters << " humanoids of the corpus");
}

}  // namespace

TEST_CASE("pipeline transfer: every clip of every humanoid goes to FK controls and back") {
  check_corpus({}, "transfer_fk", 1e-5);
}

TEST_CASE("pipeline transfer: nothing but scale and length stays on driven joints") {
  const std::string model = test::corpus_file("max_RiggedElf/RiggedElf.gltf");
  if (model.empty()) return;
  const Rigged rigged = test::rig_model(model, "", "transfer_clean");
  Diagnostics diagnostics;
  const Trip trip = there_and_back(rigged, {}, "transfer_clean", diagnostics);
  CHECK(diagnostics.all().empty());
  const std::set<int> driven = driven_nodes(rigged);
  for (const anim::Clip& clip : clips_of(trip.keyed)) {
    CAPTURE(clip.name);
    for (const anim::Channel& channel : clip.channels) CHECK(driven.count(channel.node) == 0);
    CHECK(clip.channels.size() > 20);
  }
}

TEST_CASE("pipeline transfer: a limb that is not there and a bad request are told") {
  const std::string model = test::corpus_file("max_RiggedElf/RiggedElf.gltf");
  if (model.empty()) return;
  const Rigged rigged = test::rig_model(model, "", "transfer_bad");
  const std::pair<std::string, std::string> bad[] = {
      {"arm_k=ik", "arm_l"}, {"arm_l=maybe", ""}, {"arm_l", ""}};
  for (const auto& one : bad) {
    CAPTURE(one.first);
    pipeline::TransferRequest request;
    request.file = rigged.path;
    request.limbs = {one.first};
    Diagnostics diagnostics;
    const std::string out = test::test_out("transfer_never.glb");
    CHECK_FALSE(pipeline::transfer_file(request, out, diagnostics));
    REQUIRE(diagnostics.all().size() == 1);
    CHECK(diagnostics.all()[0].code->number == 784);
    CHECK(diagnostics.all()[0].hint.find(one.second) != std::string::npos);
  }
}

}  // namespace rigc
