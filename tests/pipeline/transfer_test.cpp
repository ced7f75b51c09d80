// SPDX-License-Identifier: MIT
// Clips of every humanoid of the corpus go from its joints to the biped's controls and, baked,
// back: to the same motion.
#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include "anim/clip.h"
#include "gltf/clips.h"
#include "pipeline/bake_file.h"
#include "pipeline/build.h"
#include "pipeline/door_helpers.h"
#include "pipeline/motion_helpers.h"
#include "pipeline/transfer.h"
#include "support/corpus.h"
#include "support/sanitizers.h"

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

/// The nodes that a model has, or the joints where the rig is its own model.
std::vector<std::size_t> nodes_of(const Rigged& rigged) {
  std::vector<std::size_t> nodes;
  if (rigged.model != rigged.path) {
    nodes.resize(test::load_character(rigged.model).json["nodes"].size());
    std::iota(nodes.begin(), nodes.end(), std::size_t{0});
    return nodes;
  }
  for (const scene::NodeId id : rigged.scene().nodes())
    if (rigged.scene()[id].is_skeleton())
      nodes.push_back(static_cast<std::size_t>(rigged.gltf_node(id)));
  return nodes;
}

/// Largest distance between where two files play these nodes, in heights of the character.
double farthest(const Rigged& rigged, const std::string& other, const anim::Clip& clip,
                const std::vector<double>& times) {
  const std::vector<std::size_t> nodes = nodes_of(rigged);
  const auto wanted = test::play(rigged.path, clip.name, times);
  const auto got = test::play(other, clip.name, times);
  double largest = 0;
  for (std::size_t f = 0; f < times.size(); ++f)
    for (const std::size_t n : nodes)
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

/// The times of all keys, and three between each two.
std::vector<double> keys_and_between(const anim::Clip& clip) {
  const std::vector<double> keys = anim::key_times(clip);
  std::vector<double> times{keys.front()};
  for (std::size_t i = 1; i < keys.size(); ++i)
    for (const double part : {0.25, 0.5, 0.75, 1.0})
      times.push_back(keys[i - 1] + (keys[i] - keys[i - 1]) * part);
  return times;
}

std::ptrdiff_t morphing(const anim::Clip& clip) {
  return std::count_if(clip.channels.begin(), clip.channels.end(),
                       [](const auto& channel) { return channel.path == anim::Path::weights; });
}

// Sanitizers see whether memory is used well, which more poses of the same clips do not tell.
constexpr bool kManyPoses = !RIGC_HAS_ADDRESS_SANITIZER;

struct Check {
  std::vector<std::string> limbs;
  std::string what;                        ///< names of files begin with it
  double allowed = 0;                      ///< the largest distance of each clip, in heights
  std::vector<std::string> files = {};     ///< of humanoids; none: all
  std::vector<std::string> features = {};  ///< on, beside those that are by default
  bool between = true;                     ///< also between the clip's keys
};

/// Every clip of every humanoid.
void check_corpus(const Check& check) {
  const auto& [limbs, what, allowed, files, features, between] = check;
  std::size_t clips = 0, characters = 0;
  double largest = 0;
  for (const test::Humanoid& humanoid : test::humanoids()) {
    const std::string model = test::corpus_file(humanoid.file);
    const bool meant =
        files.empty() || std::find(files.begin(), files.end(), humanoid.file) != files.end();
    if (model.empty() || !meant) continue;
    ++characters;
    CAPTURE(humanoid.file);
    const std::string name = what + "_" + std::to_string(characters);
    const Rigged rigged =
        test::rig_model(model, test::user_map(humanoid), name, "biped.yaml", "bind", features);
    const auto sources = clips_of(rigged.path);
    Diagnostics diagnostics;
    const Trip trip = there_and_back(rigged, limbs, name, diagnostics);
    CHECK(trip.report.clips.size() == sources.size());
    const auto keyed = clips_of(trip.keyed);
    REQUIRE(keyed.size() == sources.size());
    for (std::size_t i = 0; i < sources.size(); ++i) {
      CAPTURE(sources[i].name);
      CHECK_FALSE(trip.report.clips[i].passed_through);
      CHECK(morphing(keyed[i]) == morphing(sources[i]));
      const double off = farthest(
          rigged, trip.baked, sources[i],
          between && kManyPoses ? keys_and_between(sources[i]) : anim::key_times(sources[i]));
      CHECK(off < allowed);
      largest = std::max(largest, off);
      ++clips;
    }
  }
  if (characters == 0) {
    MESSAGE("no corpus here: nothing is checked");
    return;
  }
  MESSAGE(clips << " clips of " << characters << " humanoids of the corpus, off by up to "
                << largest << " of height");
}

}  // namespace

TEST_CASE("pipeline transfer: every clip of every humanoid goes to FK controls and back") {
  check_corpus({{}, "transfer_fk", 1e-5});
}

TEST_CASE("pipeline transfer: every clip of every humanoid goes to IK controls and back") {
  check_corpus({{"all=ik"}, "transfer_ik", 1e-4});
}

TEST_CASE("pipeline transfer: the same onto limbs that stretch, with gimbals and fingertips") {
  // Bones of the second and third have moving lengths, which attributes of the limbs say then; the
  // feet of the fourth hang elsewhere.
  const std::vector<std::string> files{
      "mixamo_Xbot_blender/Xbot.glb", "gdquest_mannequiny/mannequiny-0.3.0.glb",
      "godot_player/player.glb", "gltftransform_RobotExpressive_quant/RobotExpressive.glb"};
  const std::vector<std::string> features{"stretch=on", "gimbal=on", "fingertips=on"};
  check_corpus({{}, "transfer_features_fk", 1e-5, files, features, false});
  check_corpus({{"all=ik"}, "transfer_features_ik", 1e-4, files, features, false});
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

namespace {

/// The biped alone, and a clip of random turns of all its joints, and moves of its hips. `eyes`:
/// these too, although nothing rolls them.
Rigged biped_in_motion(const std::string& name, bool eyes = false) {
  Rigged biped = test::rig_model("", "", name);
  const scene::Scene& scene = biped.scene();
  const std::vector<float> seconds{0, 0.5f, 1, 1.5f};
  const auto times = std::make_shared<const std::vector<float>>(seconds);
  std::mt19937_64 random(17);
  const auto next = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
  anim::Clip clip{"walk", -1, {}};
  for (const scene::NodeId id : scene.nodes()) {
    if (!scene[id].is_skeleton() || !biped.is_driven(id)) continue;
    anim::Channel& turns = clip.channels.emplace_back();
    turns.node = biped.gltf_node(id);
    turns.path = anim::Path::rotation;
    turns.curve.width = 4;
    turns.curve.times = times;
    for (std::size_t i = 0; i < seconds.size(); ++i) {
      const double x = next(), y = next(), z = next(), angle = next();
      math::Quat turn = math::axis_angle(math::normalised(math::Vec3{x, y, z}), angle * 0.5);
      if (!eyes && scene[id].ids.local == "head_eyes") turn = {};
      const math::Quat q = math::normalised(scene.local(id).rotation * turn);
      for (const double n : {q.x, q.y, q.z, q.w})
        turns.curve.values.push_back(static_cast<float>(n));
    }
    if (scene[id].ids.label != "hips") continue;
    anim::Channel moves = turns;
    moves.path = anim::Path::translation;
    moves.curve.width = 3;
    moves.curve.values.clear();
    for (std::size_t i = 0; i < 3 * seconds.size(); ++i)
      moves.curve.values.push_back(static_cast<float>(next()));
    clip.channels.push_back(std::move(moves));
  }
  Diagnostics diagnostics;
  const auto file = gltf::open(biped.path, diagnostics);
  REQUIRE(file);
  gltf::Patch patch(*file);
  gltf::write_clip(patch, *file, clip, {});
  std::uint64_t bytes = 0;
  biped.path = biped.model = test::test_out(name + "_moving.glb");
  REQUIRE(pipeline::write_output(patch, *file, biped.path, bytes, diagnostics));
  return biped;
}

double value_of(const Rigged& rigged, const std::vector<anim::Clip>& clips,
                const std::string& group) {
  const int node = rigged.gltf_node(rigged.controls(group, "settings").front());
  for (const anim::Channel& channel : clips.front().channels)
    if (channel.node == node && channel.attribute == "ik_fk")
      return static_cast<double>(channel.curve.values.front());
  return -1;
}

}  // namespace

TEST_CASE("pipeline transfer: the biped of our own by FK, exactly") {
  const Rigged biped = biped_in_motion("transfer_biped_fk");
  Diagnostics diagnostics;
  const Trip trip = there_and_back(biped, {}, "transfer_biped_fk", diagnostics);
  CHECK_MESSAGE(diagnostics.all().empty(), render(diagnostics, false));
  CHECK(trip.report.clips.front().kept.empty());
  const anim::Clip clip = clips_of(biped.path).front();
  CHECK(farthest(biped, trip.baked, clip, {0, 0.5, 1, 1.5}) < 1e-6);
  const auto keyed = clips_of(trip.keyed);
  for (const char* limb : {"arm_l", "arm_r", "leg_l", "leg_r"})
    CHECK(value_of(biped, keyed, limb) == 0);
}

TEST_CASE("pipeline transfer: limbs that are named go to IK, and joints are where they were") {
  const Rigged biped = biped_in_motion("transfer_biped_ik");
  Diagnostics diagnostics;
  const Trip trip = there_and_back(biped, {"all=ik", "arm_r=fk"}, "transfer_biped_ik", diagnostics);
  CHECK_MESSAGE(diagnostics.all().empty(), render(diagnostics, false));
  const anim::Clip clip = clips_of(biped.path).front();
  CHECK(farthest(biped, trip.baked, clip, {0, 0.5, 1, 1.5}) < 1e-5);
  const auto keyed = clips_of(trip.keyed);
  CHECK(value_of(biped, keyed, "arm_l") == 1);
  CHECK(value_of(biped, keyed, "arm_r") == 0);
  CHECK(value_of(biped, keyed, "leg_l") == 1);
}

TEST_CASE("pipeline transfer: what no control says is told, and is an error where that is asked") {
  const Rigged biped = biped_in_motion("transfer_rolled", true);
  pipeline::TransferRequest request;
  request.file = biped.path;
  Diagnostics diagnostics;
  const std::string out = test::test_out("transfer_unrolled.glb");
  CHECK(pipeline::transfer_file(request, out, diagnostics));
  REQUIRE(diagnostics.all().size() == 1);
  CHECK(diagnostics.all()[0].code->number == 796);
  CHECK(diagnostics.all()[0].message.find("degrees") != std::string::npos);
  request.strict = true;
  Diagnostics strict;
  CHECK_FALSE(pipeline::transfer_file(request, out, strict));
  CHECK(strict.all()[0].code->number == 797);
}

TEST_CASE("pipeline transfer: a clip that is on controls already passes through") {
  const Rigged biped = biped_in_motion("transfer_twice");
  Diagnostics diagnostics;
  pipeline::TransferRequest request;
  request.file = biped.path;
  const std::string once = test::test_out("transfer_once.glb");
  const std::string twice = test::test_out("transfer_twice.glb");
  REQUIRE(pipeline::transfer_file(request, once, diagnostics));
  request.file = once;
  const auto again = pipeline::transfer_file(request, twice, diagnostics);
  REQUIRE(again);
  CHECK(again->clips.front().passed_through);
  CHECK(test::bytes_of(once) == test::bytes_of(twice));
}

TEST_CASE("pipeline transfer: keys are added where the rig would leave the joints' way between") {
  const Rigged biped = biped_in_motion("transfer_between");
  pipeline::TransferRequest request;
  request.file = biped.path;
  request.limbs = {"all=ik"};
  const std::string out = test::test_out("transfer_between_keyed.glb");
  std::size_t frames = 0;
  for (const double tolerance : {0.0, 10.0, 0.5}) {
    CAPTURE(tolerance);
    request.tolerance_mm = tolerance;
    Diagnostics diagnostics;
    const auto done = pipeline::transfer_file(request, out, diagnostics);
    REQUIRE_MESSAGE(done, render(diagnostics, false));
    const pipeline::TransferredClip& clip = done->clips.front();
    CHECK(clip.report.frames == 4 + clip.report.inserted);
    CHECK(clip.report.frames > frames);
    frames = clip.report.frames;
    if (tolerance > 0) CHECK(clip.between.mm < tolerance + clip.at_keys.mm);
    if (tolerance == 0) CHECK(clip.between.mm > 10);
  }
}

TEST_CASE("pipeline transfer: the same bytes for every number of threads") {
  const Rigged biped = biped_in_motion("transfer_threads");
  std::string first;
  for (const unsigned jobs : {1u, 2u, 5u}) {
    Threads threads(jobs);
    pipeline::TransferRequest request;
    request.file = biped.path;
    request.limbs = {"arm_l=ik", "leg_r=ik"};
    request.tolerance_mm = 0.05;
    request.threads = &threads;
    Diagnostics diagnostics;
    const std::string out = test::test_out("transfer_threads_keyed.glb");
    const auto done = pipeline::transfer_file(request, out, diagnostics);
    REQUIRE_MESSAGE(done, render(diagnostics, false));
    CHECK(done->clips.front().report.frames > 256);  // more than a thread takes at once
    if (first.empty()) first = test::bytes_of(out);
    CHECK(test::bytes_of(out) == first);
  }
}

TEST_CASE("pipeline transfer: limits and locks hold, and what they keep from the pose is told") {
  const std::string path = test::door("transfer_locks");
  const gltf::Rig rig = test::door_rig(path);
  int hinge = -1;
  for (const scene::NodeId id : rig.scene.nodes())
    if (rig.scene[id].is_skeleton() && rig.scene[id].ids.label == "hinge")
      hinge = rig.nodes[id.index];
  const auto codes = [&](std::vector<float> turns) {
    pipeline::TransferRequest request;
    request.file =
        test::with_clip(path, {test::keys(hinge, anim::Path::rotation, 4, std::move(turns))});
    Diagnostics diagnostics;
    const std::string out = test::test_out("transfer_locks_keyed.glb");
    REQUIRE(pipeline::transfer_file(request, out, diagnostics));
    std::string numbers;
    for (const Diagnostic& one : diagnostics.all())
      numbers += std::to_string(one.code->number) + " ";
    return numbers;
  };
  const float half = 0.70710678f;  // of a quarter turn
  CHECK(codes({0, 0, 0, 1, 0, half, 0, half}).empty());
  // The handle could be where it was if its control were not locked.
  CHECK(codes({0, 0, 0, 1, 0, -half, 0, half}) == "795 796 ");  // the wrong way
  CHECK(codes({0, 0, 0, 1, half, 0, 0, half}) == "795 796 ");   // about a locked axis
}

TEST_CASE("pipeline transfer: keys that controls had already are replaced, and that is told") {
  Rigged biped = biped_in_motion("transfer_mixed");
  const scene::NodeId head = biped.controls("head", "control").front();
  anim::Clip clip = clips_of(biped.path).front();
  anim::Channel own = clip.channels.front();
  own.node = biped.gltf_node(head);
  own.path = anim::Path::rotation;
  clip.channels.push_back(own);
  Diagnostics diagnostics;
  const auto file = gltf::open(biped.path, diagnostics);
  gltf::Patch patch(*file);
  gltf::write_clip(patch, *file, clip, {});
  std::uint64_t bytes = 0;
  const std::string mixed = test::test_out("transfer_mixed_keyed.glb");
  REQUIRE(pipeline::write_output(patch, *file, mixed, bytes, diagnostics));
  pipeline::TransferRequest request;
  request.file = mixed;
  REQUIRE(pipeline::transfer_file(request, test::test_out("transfer_mixed_out.glb"), diagnostics));
  REQUIRE(diagnostics.all().size() == 1);
  CHECK(diagnostics.all()[0].code->number == 798);
  CHECK(diagnostics.all()[0].message.find(biped.scene()[head].name) != std::string::npos);
}

TEST_CASE("pipeline transfer: a file without a rig, and a clip that is not there") {
  const Rigged biped = biped_in_motion("transfer_wrong");
  pipeline::TransferRequest request;
  request.file = biped.path;
  request.clips = {"wlak"};
  Diagnostics diagnostics;
  const std::string out = test::test_out("transfer_wrong.glb");
  CHECK_FALSE(pipeline::transfer_file(request, out, diagnostics));
  CHECK(diagnostics.all()[0].code->number == 755);
  CHECK(diagnostics.all()[0].hint.find("walk") != std::string::npos);
  request.clips.clear();
  request.fps = "fast";
  Diagnostics rate;
  CHECK_FALSE(pipeline::transfer_file(request, out, rate));
  CHECK(rate.all()[0].code->number == 757);
  pipeline::BakeRequest bake;
  bake.file = biped.path;
  Diagnostics of_bake;
  REQUIRE(pipeline::bake_file(bake, out, of_bake));
  request.file = out;
  request.fps = "source";
  Diagnostics no_rig;
  CHECK_FALSE(pipeline::transfer_file(request, test::test_out("transfer_none.glb"), no_rig));
  CHECK(no_rig.all()[0].code->number == 754);
}

TEST_CASE("pipeline transfer: a limb that is not there and a bad request are told") {
  const Rigged rigged = biped_in_motion("transfer_bad");
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
