// SPDX-License-Identifier: MIT
// Laws of updates over random edits of random templates, with random animation: nothing is lost, a
// version can be taken back, names do not count, what is not rigc's stays, files do not grow.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "pipeline/character_helpers.h"
#include "pipeline/shot_helpers.h"
#include "support/random_edits.h"

namespace rigc {
namespace {

using nlohmann::ordered_json;
using test::EditedTemplate;
using test::EditOptions;
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

std::size_t orphans_in(const Shot& shot) {
  std::size_t count = 0;
  for (const gltf::Rig& rig : shot.rigs) count += rig.orphans.size();
  return count;
}

}  // namespace

TEST_CASE("update laws: whatever a template becomes, every key and value stays in the file") {
  std::size_t orphans = 0, converted = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
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
      CHECK(kept_in(original).size() == kept_in(after).size());
      CHECK(is_clean(s.shot));
      orphans += orphans_in(after);
    }
  }
  CHECK(orphans > 100);
  CHECK(converted > 5);
}

}  // namespace rigc
