// SPDX-License-Identifier: MIT
// Shots of the laws of updates.
#include "pipeline/update_laws_helpers.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace rigc::test {
namespace {

/// A channel's keys, or a value without keys: what it is and its numbers, without whose it is.
struct Kept {
  std::string what;
  std::vector<double> numbers;
};

std::vector<Kept> kept_in(const Shot& shot) {
  std::vector<Kept> out;
  for (const std::string& line : keys_of(shot)) {
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

}  // namespace

EditOptions turning(bool turns) {
  EditOptions options;
  options.turns = turns;
  return options;
}

EditedShot::EditedShot(const std::string& name, std::uint64_t seed, const EditOptions& options,
                       const Animation& animation)
    : folder(fresh_folder("laws/" + name)), now(seed, options), random(seed + 1000) {
  shot = folder + "/shot.glb";
  write_text(folder + "/edited_part.yaml", EditedTemplate::part_text());
  write_text(folder + "/edited.yaml", now.text());
  build_rig(folder + "/edited.yaml", shot);
  animate(shot, static_cast<unsigned>(seed), animation);
}

void EditedShot::publish(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) edits += now.edit(random) + "\n";
  ++now.version;
}

pipeline::FileResult EditedShot::update(pipeline::UpdateSettings settings) {
  write_text(folder + "/edited.yaml", now.text());
  return test::update(shot, folder, std::move(settings));
}

std::size_t count_of(const Shot& shot) {
  const std::vector<Kept> kept = kept_in(shot);
  return static_cast<std::size_t>(std::count_if(
      kept.begin(), kept.end(), [](const Kept& one) { return one.what != "value ik_fk"; }));
}

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

double number_difference(const Shot& a, const Shot& b) {
  const auto split = [](const Shot& shot) {
    std::map<std::string, std::vector<double>> out;
    for (const std::string& line : keys_of(shot)) {
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

}  // namespace rigc::test
