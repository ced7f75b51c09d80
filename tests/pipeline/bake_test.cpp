// SPDX-License-Identifier: MIT
// Bakes of the biped and of every humanoid of the corpus: how far joints are from where the rig has
// them, at every frame and, where keys were dropped, between them; the same bytes for any number of
// threads.
#include <doctest/doctest.h>

#include <algorithm>
#include <functional>

#include "pipeline/wiggle_helpers.h"
#include "support/corpus.h"

namespace rigc {
namespace {

using test::Rigged;
using test::Wiggle;
using Worlds = std::vector<std::vector<math::Affine>>;

constexpr double kHeight = 1750;  // mm, of the character that millimetres are said of

/// The biped without a model, and onto each character.
void for_each_character(const std::string& name,
                        const std::function<void(const Wiggle&, const std::string&)>& check) {
  std::uint64_t seed = 1;
  const auto one = [&](const std::string& model, const std::string& map) {
    const std::string own = name + std::to_string(seed);
    CAPTURE(model);
    check(test::wiggle(test::rig_model(model, map, own), own, seed), own);
    ++seed;
  };
  one("", "");
  for (const test::Humanoid& humanoid : test::humanoids()) {
    const std::string model = test::corpus_file(humanoid.file);
    if (!model.empty()) one(model, test::user_map(humanoid));
  }
}

/// Largest distance of any driven joint, and of points `limb` away, from where the rig has it; all
/// in heights.
double rig_error(const Wiggle& wiggle, const std::string& baked, const std::vector<double>& seconds,
                 double limb = 0) {
  const Worlds played = test::play(baked, wiggle.name, seconds);
  double largest = 0;
  std::string where;
  for (const test::DrivenJoint& joint :
       test::evaluate_joints(wiggle, seconds, test::spaces_of(wiggle, played))) {
    for (std::size_t t = 0; t < seconds.size(); ++t) {
      const double height = wiggle.rigged.height;
      const double off =
          test::apart(played[t][joint.node], joint.worlds[t], limb * height) / height;
      if (off > largest) where = joint.name;
      largest = std::max(largest, off);
    }
  }
  CAPTURE(where);
  CHECK(largest > 0);  // it was looked at, and floats are not exact
  return largest;
}

/// Largest distance of any node of two files at these times, world units.
double difference(const std::string& a, const std::string& b, const std::string& clip,
                  const std::vector<double>& seconds) {
  const Worlds one = test::play(a, clip, seconds), other = test::play(b, clip, seconds);
  double largest = 0;
  for (std::size_t t = 0; t < seconds.size(); ++t)
    for (std::size_t n = 0; n < one[t].size(); ++n)
      largest = std::max(largest, math::length(one[t][n].origin - other[t][n].origin));
  return largest;
}

}  // namespace

TEST_CASE("pipeline bake: joints are within a hundredth of a millimetre of the rig at all frames") {
  for_each_character("bake_exact", [](const Wiggle& wiggle, const std::string& name) {
    const std::string out = test::test_out(name + "_baked.glb");
    const auto baked = test::bake_wiggle(wiggle, out);
    CHECK(baked.clips[0].frames == 31);
    const double error = rig_error(wiggle, out, test::times_at(30), 0.1);
    MESSAGE(name, ": ", error * kHeight, " mm");
    CHECK(error * kHeight < 0.01);
  });
}

TEST_CASE("pipeline bake: dropped keys move no joint by more than the tolerance, at any time") {
  for_each_character("bake_reduced", [](const Wiggle& wiggle, const std::string& name) {
    const std::string full = test::test_out(name + "_full.glb");
    const std::string reduced = test::test_out(name + "_reduced.glb");
    const std::size_t all = test::bake_wiggle(wiggle, full).clips[0].keys;
    pipeline::BakeRequest request;
    request.tolerance_mm = 1;
    const auto baked = test::bake_wiggle(wiggle, reduced, request);
    CHECK(baked.clips[0].keys < all);
    CHECK(baked.clips[0].reduction_mm <= 1);
    const tags::Character& character = wiggle.rigged.rig->skeleton.character;
    const double mm = 0.001 * character.unit * wiggle.rigged.height / character.height;
    const double error = difference(full, reduced, wiggle.name, test::times_at(120)) / mm;
    MESSAGE(name, ": ", error, " mm, ", baked.clips[0].keys, " of ", all, " keys");
    CHECK(error <= 1);
    CHECK(error > 0.05);  // it is made use of
  });
}

TEST_CASE("pipeline bake: every number of threads gives the same bytes") {
  const Wiggle wiggle = test::wiggle(test::rig_model("", "", "bake_threads"), "bake_threads", 7);
  for (const char* fps : {"1000", "source"}) {
    for (const double tolerance : {0.0, 0.5}) {
      std::string first;
      for (const unsigned jobs : {1u, 2u, 3u, 8u}) {
        CAPTURE(jobs);
        Threads threads(jobs);
        pipeline::BakeRequest request;
        request.fps = fps;
        request.tolerance_mm = tolerance;
        request.threads = &threads;
        const std::string out = test::test_out("bake_threads_out.glb");
        test::bake_wiggle(wiggle, out, request);
        const std::string bytes = test::bytes_of(out);
        if (jobs == 1) first = bytes;
        CHECK(bytes == first);
      }
    }
  }
}

TEST_CASE("pipeline bake: at the keys' own times, as many frames between as the tolerance needs") {
  const Wiggle wiggle = test::wiggle(test::rig_model("", "", "bake_source"), "bake_source", 3);
  const std::string out = test::test_out("bake_source_out.glb");
  pipeline::BakeRequest request;
  request.fps = "source";
  CHECK(test::bake_wiggle(wiggle, out, request).clips[0].frames == 9);
  CHECK(rig_error(wiggle, out, test::times_at(8)) * kHeight < 0.01);
  CHECK(rig_error(wiggle, out, test::times_at(100)) * kHeight > 2);
  request.tolerance_mm = 2;
  CHECK(test::bake_wiggle(wiggle, out, request).clips[0].frames > 9);
  CHECK(rig_error(wiggle, out, test::times_at(100)) * kHeight < 2);
}

}  // namespace rigc
