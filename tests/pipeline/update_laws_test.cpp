// SPDX-License-Identifier: MIT
// Laws of updates over random edits of random templates, with random animation: nothing is lost, a
// version can be taken back, names do not count, what is not rigc's stays, files do not grow.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "pipeline/character_helpers.h"
#include "pipeline/foreign_helpers.h"
#include "pipeline/rebuild.h"
#include "pipeline/shot_helpers.h"
#include "support/random_edits.h"

namespace rigc {
namespace {

using nlohmann::ordered_json;
using test::EditedTemplate;
using test::EditOptions;
using test::Foreign;
using test::Random;
using test::Shot;
using Outcome = pipeline::FileResult::Outcome;

/// A shot whose template is edited.
struct Session {
  std::string folder, shot;
  EditedTemplate now;
  Random random;
  std::string edits;  ///< what was done, for messages

  Session(const std::string& name, std::uint64_t seed, const EditOptions& options = {})
      : folder(test::fresh_folder("laws/" + name)), now(seed, options), random(seed + 1000) {
    shot = folder + "/shot.glb";
    test::write_text(folder + "/edited_part.yaml", EditedTemplate::part_text());
    test::write_text(folder + "/edited.yaml", now.text());
    test::build_rig(folder + "/edited.yaml", shot);
  }

  /// A version with some edits.
  void publish(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) edits += now.edit(random) + "\n";
    ++now.version;
  }
  pipeline::FileResult update(pipeline::UpdateSettings settings = {}) {
    test::write_text(folder + "/edited.yaml", now.text());
    return test::update(shot, folder, std::move(settings));
  }
  void go_to(const EditedTemplate& other) { now = other.returning_from(now); }
};

/// Takes the rigs of a file apart, or builds them again from its tags.
void rebuild(const std::string& path, bool unbuild) {
  pipeline::RebuildRequest request;
  request.unbuild = unbuild;
  Diagnostics diagnostics;
  const auto rebuilt = pipeline::rebuild(request, {path, path, ""}, diagnostics);
  REQUIRE_MESSAGE(rebuilt, render(diagnostics, false));
}

/// A channel's keys, or a value without keys: what it is and its numbers, without whose it is.
struct Kept {
  std::string what;
  std::vector<double> numbers;
};

std::vector<Kept> kept_in(const Shot& shot) {
  std::vector<Kept> out;
  for (const std::string& line : test::keys_of(shot)) {
    const std::size_t owner = line.find(' ', line.find(' ') + 1);
    std::string rest = line.substr(owner + 1);
    std::size_t values = rest.find(": ");
    values = values == std::string::npos ? rest.find(' ', rest.find(' ') + 1) : values + 1;
    Kept one{rest.substr(0, values), {}};
    std::istringstream numbers(rest.substr(values));
    for (double number = 0; numbers >> number;) one.numbers.push_back(number);
    out.push_back(std::move(one));
  }
  return out;
}

/// How much a shot keeps, without the switches of limbs: where a limb takes a chain's place, rigc
/// sets its switch, and keeps how it stood.
std::size_t count_of(const Shot& shot) {
  const std::vector<Kept> kept = kept_in(shot);
  return static_cast<std::size_t>(std::count_if(
      kept.begin(), kept.end(), [](const Kept& one) { return one.what != "value ik_fk"; }));
}

double length_at(const std::vector<double>& n, std::size_t at) {
  return std::sqrt(n[at] * n[at] + n[at + 1] * n[at + 1] + n[at + 2] * n[at + 2]);
}

/// Whether axes were turned and nothing else was done: lengths of vectors and angles of rotations
/// stay.
bool turned(const Kept& a, const Kept& b) {
  if (a.numbers.size() != b.numbers.size()) return false;
  const bool rotation = a.what.find("rotation") != std::string::npos;
  const bool vector =
      a.what.find("translation") != std::string::npos || a.what.find("scale") != std::string::npos;
  if (!rotation && !vector) return false;
  const std::size_t width = rotation ? 4 : 3;
  for (std::size_t i = 0; i + width <= a.numbers.size(); i += width) {
    if (std::abs(length_at(a.numbers, i) - length_at(b.numbers, i)) > 1e-5) return false;
    if (rotation && std::abs(a.numbers[i + 3] - b.numbers[i + 3]) > 1e-5) return false;
  }
  return true;
}

/// What of a shot another one does not have; with `turns` its axes may differ.
std::string lost(const Shot& before, const Shot& after, bool turns) {
  std::vector<Kept> found = kept_in(after);
  std::string out;
  std::vector<Kept> open;
  for (const Kept& one : kept_in(before)) {
    const auto same = std::find_if(found.begin(), found.end(), [&](const Kept& other) {
      return other.what == one.what && other.numbers == one.numbers;
    });
    if (same != found.end())
      found.erase(same);
    else
      open.push_back(one);
  }
  for (const Kept& one : open) {
    const auto same = std::find_if(found.begin(), found.end(), [&](const Kept& other) {
      return turns && other.what == one.what && turned(one, other);
    });
    if (same != found.end())
      found.erase(same);
    else
      out += one.what.substr(0, 100) + "\n";
  }
  return out;
}

/// Whether a file reads without a word.
bool is_clean(const std::string& path) {
  Diagnostics diagnostics;
  const auto file = gltf::open(path, diagnostics);
  if (file) gltf::read_rigs(*file, diagnostics);
  if (!diagnostics.all().empty()) MESSAGE(render(diagnostics, false));
  return diagnostics.all().empty();
}

std::string orphans_of(const Shot& shot) {
  std::string out;
  for (const gltf::Rig& rig : shot.rigs)
    for (const gltf::Orphan& orphan : rig.orphans)
      out += fmt::format("{} {} {}.{}\n", to_text(orphan.identity), orphan.module, orphan.ids.local,
                         orphan.ids.label);
  return out;
}

std::size_t orphans_in(const Shot& shot) {
  std::size_t count = 0;
  for (const gltf::Rig& rig : shot.rigs) count += rig.orphans.size();
  return count;
}

/// Largest difference of the numbers of keys and values that belong to the same nodes.
double number_difference(const Shot& a, const Shot& b) {
  const auto split = [](const Shot& shot) {
    std::map<std::string, std::vector<double>> out;
    for (const std::string& line : test::keys_of(shot)) {
      const std::size_t head = line.substr(0, line.find(" value ")).size() < line.size()
                                   ? line.find(' ', line.find(" value ") + 7)
                                   : line.find(": ") + 1;
      std::istringstream numbers(line.substr(head));
      std::vector<double>& list = out[line.substr(0, head)];
      for (double number = 0; numbers >> number;) list.push_back(number);
    }
    return out;
  };
  const auto p = split(a), q = split(b);
  double largest = p.size() == q.size() ? 0 : 1e9;
  for (const auto& [head, numbers] : p) {
    const auto found = q.find(head);
    if (found == q.end() || found->second.size() != numbers.size()) {
      MESSAGE("not there: " << head);
      return 1e9;
    }
    for (std::size_t i = 0; i < numbers.size(); ++i)
      largest = std::max(largest, std::abs(numbers[i] - found->second[i]));
  }
  return largest;
}

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
    EditOptions options;
    options.turns = turns;
    Session s("lost", seed, options);
    test::animate(s.shot, static_cast<unsigned>(seed));
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
    EditOptions options;
    options.turns = turns;
    Session s("back", seed, options);
    test::animate(s.shot, static_cast<unsigned>(seed));
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
    EditOptions options;
    options.turns = true;
    Session s("nothing", seed, options);
    test::animate(s.shot, static_cast<unsigned>(seed));
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
    EditOptions options;
    options.turns = true;
    Session s("names", seed, options);
    test::animate(s.shot, static_cast<unsigned>(seed));
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

TEST_CASE("update laws: what others have put into the file stays, by index and to the letter") {
  std::size_t with_orphans = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    EditOptions options;
    options.turns = true;
    Session s("foreign", seed, options);
    test::animate(s.shot, static_cast<unsigned>(seed));
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
    EditOptions options;
    options.turns = true;
    Session s("size", seed, options);
    test::animate(s.shot, static_cast<unsigned>(seed));
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
    }
    if (others) CHECK(is_clean(s.shot));
  }
}

TEST_CASE("update laws: after a hundred versions every key is there and the file is no larger") {
  int back = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    EditOptions options;
    options.turns = seed % 2 == 0;
    options.groups = 2;
    Session s("hundred", seed, options);
    test::animate(s.shot, static_cast<unsigned>(seed), {2, 0.6, 0.3, 4});
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

TEST_CASE(
    "update laws: a rig that was taken apart, updated so, and built again has all of its keys") {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    EditOptions options;
    options.turns = seed % 4 < 2;
    Session s("apart", seed, options);
    test::animate(s.shot, static_cast<unsigned>(seed));
    Random random(seed);
    Foreign foreign;
    if (seed % 2) foreign = test::add_foreign(s.shot, random);
    const EditedTemplate first = s.now;
    const Shot original = test::read_shot(s.shot);
    rebuild(s.shot, true);
    CAPTURE(seed);
    const Shot apart = test::read_shot(s.shot);
    CHECK(apart.rigs.front().commands.empty());
    CHECK(lost(original, apart, false) == "");
    if (seed > 4) {
      s.publish(4);
      s.update();
      CHECK(lost(original, test::read_shot(s.shot), false) == "");
      rebuild(s.shot, false);
      CAPTURE(s.edits);
      CHECK(lost(original, test::read_shot(s.shot), options.turns) == "");
      s.go_to(first);
      s.update();
    } else {
      rebuild(s.shot, false);
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
    EditOptions options;
    options.turns = true;
    Session s("strip", seed, options);
    test::animate(s.shot, static_cast<unsigned>(seed));
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
