// SPDX-License-Identifier: MIT
// Laws of updates over random edits, about the files: what is not rigc's stays, files do not grow,
// rigs that are taken apart or out leave all else.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "pipeline/character_helpers.h"
#include "pipeline/foreign_helpers.h"
#include "pipeline/update_laws_helpers.h"

namespace rigc {
namespace {

using nlohmann::ordered_json;
using test::EditedShot;
using test::EditedTemplate;
using test::Foreign;
using test::is_clean;
using test::lost;
using test::number_difference;
using test::orphans_in;
using test::Random;
using test::Shot;
using test::turning;

}  // namespace

TEST_CASE("update laws: what others have put into the file stays, by index and to the letter") {
  std::size_t with_orphans = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    EditedShot s("foreign", seed, turning());
    Random random(seed);
    const Foreign foreign = test::add_foreign(s.shot, random);
    const Shot original = test::read_shot(s.shot);
    for (int step = 0; step < 4; ++step) {
      s.publish(2);
      s.update();
      CAPTURE(seed);
      CAPTURE(step);
      CAPTURE(s.edits);
      CHECK(test::changes(foreign, s.shot) == "");
      const Shot after = test::read_shot(s.shot);
      CHECK(lost(original, after, true) == "");
      CHECK(is_clean(s.shot));
      with_orphans += orphans_in(after) > 0;
    }
  }
  CHECK(with_orphans > 5);
}

TEST_CASE("update laws: a file does not grow while its rig goes back and forth") {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    EditedShot s("size", seed, turning());
    Random random(seed);
    const bool others = seed % 2 == 0;
    if (others) test::add_foreign(s.shot, random);
    const EditedTemplate a = s.now;
    EditedTemplate b = a;
    std::vector<std::size_t> sizes;
    for (int round = 0; round < 8; ++round) {
      if (round == 0) {
        s.publish(5);
        b = s.now;
      } else {
        s.go_to(round % 2 ? a : b);
      }
      s.update();
      sizes.push_back(test::bytes_of(s.shot).size());
    }
    CAPTURE(seed);
    CAPTURE(s.edits);
    // The third version is the first that says where the second had things.
    const std::size_t mark = *std::max_element(sizes.begin(), sizes.begin() + 3);
    for (std::size_t i = 3; i < sizes.size(); ++i) {
      CAPTURE(i);
      CHECK(sizes[i] <= mark);
      if (i > 3) CHECK(sizes[i] == sizes[i - 2]);
    }
    if (others) CHECK(is_clean(s.shot));
  }
}

TEST_CASE(
    "update laws: a rig that was taken apart, updated so, and built again has all of its keys") {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const bool turns = seed % 4 < 2;
    EditedShot s("apart", seed, turning(turns));
    Random random(seed);
    Foreign foreign;
    if (seed % 2) foreign = test::add_foreign(s.shot, random);
    const EditedTemplate first = s.now;
    const Shot original = test::read_shot(s.shot);
    test::unbuild(s.shot);
    CAPTURE(seed);
    const Shot apart = test::read_shot(s.shot);
    CHECK(apart.rigs.front().commands.empty());
    CHECK(lost(original, apart, false) == "");
    if (seed > 4) {
      s.publish(4);
      s.update();
      CHECK(lost(original, test::read_shot(s.shot), false) == "");
      test::rebuild(s.shot);
      CAPTURE(s.edits);
      CHECK(lost(original, test::read_shot(s.shot), turns) == "");
      s.go_to(first);
      s.update();
    } else {
      test::rebuild(s.shot);
    }
    CAPTURE(s.edits);
    const Shot after = test::read_shot(s.shot);
    CHECK(number_difference(original, after) <= 1e-6);
    CHECK(test::motion_difference(original, after, "") <= 1e-6);
    CHECK(test::changes(foreign, s.shot) == "");
    CHECK(is_clean(s.shot));
  }
}

TEST_CASE("update laws: taking a rig out leaves what others have put into the file") {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    EditedShot s("strip", seed, turning());
    Random random(seed);
    Foreign foreign = test::add_foreign(s.shot, random);
    s.publish(seed % 3);
    s.update();
    // What is written on a control goes with it, and channels move up in their clip.
    const Shot built = test::read_shot(s.shot);
    const gltf::Rig& rig = built.rigs.front();
    std::set<int> joints;
    for (const scene::NodeId id : rig.scene.nodes())
      if (rig.scene[id].is_skeleton()) joints.insert(rig.nodes[id.index]);
    std::string channel;
    std::size_t on_joints = 0;
    for (auto at = foreign.texts.begin(); at != foreign.texts.end();) {
      int node = -1;
      const bool of_node = std::sscanf(at->first.c_str(), "/nodes/%d/", &node) == 1 &&
                           std::count(at->first.begin(), at->first.end(), '/') > 2;
      const bool of_clip = at->first.starts_with("/animations/0/channels");
      if (of_clip) channel = at->second;
      on_joints += of_node && joints.count(node);
      at = of_clip || (of_node && !joints.count(node)) ? foreign.texts.erase(at) : std::next(at);
    }
    CHECK(on_joints > 0);
    Diagnostics diagnostics;
    REQUIRE(pipeline::strip({}, {s.shot, s.shot, ""}, diagnostics));
    CAPTURE(seed);
    CHECK(test::changes(foreign, s.shot) == "");
    CHECK(test::read_shot(s.shot).rigs.empty());
    const auto left = test::load_character(s.shot).json["animations"][0]["channels"];
    CHECK(std::any_of(left.begin(), left.end(),
                      [&](const ordered_json& one) { return one.dump() == channel; }));
    CHECK(is_clean(s.shot));
  }
}

}  // namespace rigc
