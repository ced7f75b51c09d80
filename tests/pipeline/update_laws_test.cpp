// SPDX-License-Identifier: MIT
// Laws of updates over random edits of random templates, with random animation: nothing is lost, a
// version can be taken back, names do not count.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "pipeline/character_helpers.h"
#include "pipeline/update_laws_helpers.h"

namespace rigc {
namespace {

using nlohmann::ordered_json;
using test::count_of;
using test::EditedShot;
using test::EditedTemplate;
using test::EditOptions;
using test::is_clean;
using test::lost;
using test::number_difference;
using test::orphans_in;
using test::orphans_of;
using test::Random;
using test::Shot;
using test::turning;
using Outcome = pipeline::FileResult::Outcome;

/// Gives everything that has a name for people another one.
void rename_all(ordered_json& json, Random& random) {
  const auto rename = [&](ordered_json& list) {
    for (auto& item : list)
      if (item.contains("name")) item["name"] = fmt::format("n.{}", random.below(300));
  };
  for (const char* list : {"nodes", "animations", "meshes", "materials", "skins"})
    if (json.contains(list)) rename(json[list]);
  for (auto& rig : json["extensions"]["RIGC_rig"]["rigs"]) {
    for (const char* list : {"joints", "nodes", "orphans"})
      if (rig.contains(list)) rename(rig[list]);
    for (auto& command : rig["commands"]) command["joint"] = "renamed";
  }
}

ordered_json without_names(ordered_json json) {
  const auto forget = [&](ordered_json& list) {
    for (auto& item : list)
      if (item.is_object()) item.erase("name");
  };
  for (const char* list : {"nodes", "animations", "meshes", "materials", "skins"})
    if (json.contains(list)) forget(json[list]);
  for (auto& rig : json["extensions"]["RIGC_rig"]["rigs"]) {
    for (const char* list : {"joints", "nodes", "orphans"})
      if (rig.contains(list)) forget(rig[list]);
    for (auto& command : rig["commands"]) command.erase("joint");
  }
  return json;
}

}  // namespace

TEST_CASE("update laws: whatever a template becomes, every key and value stays in the file") {
  std::size_t orphans = 0, converted = 0;
  for (std::uint64_t seed = 1; seed <= 14; ++seed) {
    const bool turns = seed % 2 == 0;
    EditedShot s("lost", seed, turning(turns));
    const Shot original = test::read_shot(s.shot);
    REQUIRE(test::keys_of(original).size() > 20);
    for (int step = 0; step < 8; ++step) {
      s.publish(1 + s.random.below(4));
      CAPTURE(seed);
      CAPTURE(step);
      CAPTURE(s.edits);
      const auto result = s.update();
      CHECK(result.outcome == Outcome::changed);
      converted +=
          ordered_json::parse(result.json).dump().find("\"converted\":true") != std::string::npos;
      const Shot after = test::read_shot(s.shot);
      CHECK(lost(original, after, turns) == "");
      CHECK(count_of(original) == count_of(after));
      CHECK(is_clean(s.shot));
      orphans += orphans_in(after);
    }
  }
  CHECK(orphans > 100);
  CHECK(converted >= 5);
}

TEST_CASE("update laws: there and back again plays the same motion with the same keys") {
  double largest = 0;
  std::size_t exact_ones = 0, away = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const bool turns = seed % 2 == 0;
    EditedShot s("back", seed, turning(turns));
    const EditedTemplate first = s.now;
    const Shot original = test::read_shot(s.shot);
    s.publish(2 + seed / 3);
    // Joints that move and turn with the template do so both ways.
    pipeline::UpdateSettings settings;
    settings.take_skeleton = seed % 3 == 0;
    s.update(settings);
    away += test::keys_of(test::read_shot(s.shot)) != test::keys_of(original);
    s.go_to(first);
    s.update(settings);
    CAPTURE(seed);
    CAPTURE(s.edits);
    const Shot after = test::read_shot(s.shot);
    CHECK(orphans_of(after) == "");
    bool exact = false;
    const double difference = test::motion_difference(original, after, "", &exact);
    largest = std::max(largest, difference);
    CHECK(difference <= 1e-6);
    exact_ones += exact;
    if (turns) {
      CHECK(number_difference(original, after) <= 1e-6);
    } else {
      CHECK(exact);
      CHECK(test::keys_of(original) == test::keys_of(after));
    }
    CHECK(is_clean(s.shot));
  }
  MESSAGE("largest difference in heights: " << largest << ", exact: " << exact_ones << " of 30");
  CHECK(away > 10);
}

TEST_CASE(
    "update laws: an unchanged rig differs by exactly nothing, and a second update does nothing") {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    CAPTURE(seed);
    EditedShot s("nothing", seed, turning());
    s.publish(4);
    s.update();
    const Shot before = test::read_shot(s.shot);
    s.publish(0);
    const auto result = s.update();
    REQUIRE(result.outcome == Outcome::changed);
    const auto rig = ordered_json::parse(result.json)["rigs"][0];
    CHECK(rig["largest_mm"] == 0.0);
    CHECK(rig["largest_degrees"] == 0.0);
    CHECK(rig["clips"].size() == 3);  // what stands without a clip, and both clips
    for (const auto& clip : rig["clips"]) {
      CHECK(clip["times"] >= 1);
      CHECK(clip["joints"].empty());
    }
    CHECK(rig["new_orphans"] == 0);
    const Shot after = test::read_shot(s.shot);
    CHECK(test::keys_of(before) == test::keys_of(after));
    bool exact = false;
    test::motion_difference(before, after, "", &exact);
    CHECK(exact);

    const std::string bytes = test::bytes_of(s.shot);
    struct stat was {
    }, is{};
    REQUIRE(stat(s.shot.c_str(), &was) == 0);
    const auto again = s.update();
    REQUIRE(stat(s.shot.c_str(), &is) == 0);
    CHECK(again.outcome == Outcome::unchanged);
    CHECK(test::bytes_of(s.shot) == bytes);
    CHECK(was.st_ino == is.st_ino);
    CHECK(was.st_mtim.tv_sec == is.st_mtim.tv_sec);
    CHECK(was.st_mtim.tv_nsec == is.st_mtim.tv_nsec);
    CHECK(was.st_ctim.tv_nsec == is.st_ctim.tv_nsec);
  }
}

TEST_CASE("update laws: names of nodes, joints and clips change nothing but names") {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    EditedShot s("names", seed, turning());
    s.publish(3);
    s.update();
    const std::string plain = s.shot, other = s.folder + "/renamed.glb";
    test::Character character = test::load_character(plain);
    Random random(seed);
    rename_all(character.json, random);
    test::save_glb(character, other);
    s.publish(3);
    CAPTURE(seed);
    CAPTURE(s.edits);
    s.update();
    s.shot = other;
    s.update();
    test::Character a = test::load_character(plain), b = test::load_character(other);
    CHECK(a.bin == b.bin);
    const auto differences = ordered_json::diff(without_names(a.json), without_names(b.json));
    CHECK(differences.dump().substr(0, 500) == "[]");
  }
}

TEST_CASE("update laws: after a hundred versions every key is there and the file is no larger") {
  int back = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    EditOptions options;
    options.turns = seed % 2 == 0;
    options.groups = 2;
    EditedShot s("hundred", seed, options, {2, 0.6, 0.3, 4});
    const Shot original = test::read_shot(s.shot);
    const EditedTemplate first = s.now;
    const std::size_t begin = test::bytes_of(s.shot).size();
    std::size_t mark = begin;
    for (int step = 0; step < 100; ++step) {
      s.publish(1);
      const auto result = s.update();
      REQUIRE(result.outcome == Outcome::changed);
      mark = std::max(mark, test::bytes_of(s.shot).size());
      if (step % 10 != 9) continue;
      CAPTURE(seed);
      CAPTURE(step);
      CHECK(lost(original, test::read_shot(s.shot), options.turns) == "");
      CHECK(is_clean(s.shot));
    }
    s.go_to(first);
    // Joints that came back on the way hang where the version of that time had them.
    pipeline::UpdateSettings settings;
    settings.take_skeleton = true;
    s.update(settings);
    const Shot after = test::read_shot(s.shot);
    CAPTURE(seed);
    CAPTURE(s.edits);
    CHECK(lost(original, after, options.turns) == "");
    // What the label alone has led to other controls on the way may remain there.
    if (orphans_in(after) == 0) {
      CHECK(test::motion_difference(original, after, "") <= 1e-6);
      CHECK(number_difference(original, after) <= 1e-6);
      ++back;
    }
    const std::size_t end = test::bytes_of(s.shot).size();
    INFO("a hundred versions: " << begin << " bytes, at most " << mark << ", then " << end);
    CHECK(end <= mark);
  }
  CHECK(back >= 1);
}

}  // namespace rigc
