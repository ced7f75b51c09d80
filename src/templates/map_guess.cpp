// SPDX-License-Identifier: MIT
// Guessing: names where maps know them, then the alignment of both trees decides.
// Test: tests/templates/map_guess_test.cpp
#include "templates/map_guess.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "base/text.h"
#include "templates/codes.h"
#include "templates/map_guess_align.h"
#include "templates/map_guess_words.h"

namespace rigc::templates {
namespace {

using math::Vec3;

constexpr std::size_t kMostPairs = 4'000'000;
constexpr double kRequired = 0.5;  // what a bone for a required joint is worth
constexpr double kOptional = 0.03;
constexpr double kBeside = -0.2;     // where another joint may be meant
constexpr double kOnePlace = 0.01;   // of the height
constexpr double kSureName = 2;      // what the name in a map that fits is worth
constexpr double kLikelyName = 0.5;  // ... in one that does not
constexpr double kOtherSide = 1.5;   // what the word of the wrong side costs

class Guesser {
 public:
  Guesser(const Expanded& expanded, const tags::TaggedSkeleton& placed,
          const tags::ForeignSkeleton& skeleton, const Map& words, const MapTrial* trial);
  Guess run();

 private:
  double name_score(std::size_t joint, std::size_t bone) const;
  void weigh_neighbours();
  void take_names(const MapTrial& trial);
  Vec3 left_by_names() const;
  void swap_sides();
  double facing() const;
  void fill_lines();
  void fill_chain(std::size_t joint, std::vector<int>& bones) const;
  void explain(std::size_t joint, GuessLine& line) const;
  void find_candidates(std::size_t joint, GuessLine& line) const;
  void fill_notes();
  int bone_above(std::size_t own) const;
  int only_below(int bone) const;
  Vec3 position(int bone) const { return input_.bones[static_cast<std::size_t>(bone)].at; }
  std::string name(int bone) const {
    return printable(references_[static_cast<std::size_t>(bone)], 60);
  }

  const Expanded& expanded_;
  const tags::TaggedSkeleton& placed_;
  const tags::ForeignSkeleton& skeleton_;
  std::vector<std::string> references_;
  GuessWords words_;
  const MapTrial* trial_;
  bool strong_ = false;                   ///< the nearest map fits, or goes by whole names
  bool swapped_ = false;                  ///< names say left where the body says right
  double height_ = 1;                     ///< of the template
  std::vector<std::size_t> expanded_of_;  ///< by placed joint
  std::vector<std::vector<int>> own_of_;  ///< by expanded joint: placed joints
  std::vector<bool>
      beside_;  ///< by placed joint: another lies where it does, as an eye by its lids
  std::vector<std::vector<int>> by_name_;  ///< by expanded joint: bones
  std::vector<int> named_;                 ///< by bone: expanded joint; -1
  std::vector<bool> used_;                 ///< by bone
  AlignInput input_;
  Alignment alignment_;
  Guess guess_;
};

Guesser::Guesser(const Expanded& expanded, const tags::TaggedSkeleton& placed,
                 const tags::ForeignSkeleton& skeleton, const Map& words, const MapTrial* trial)
    : expanded_(expanded),
      placed_(placed),
      skeleton_(skeleton),
      references_(bone_references(skeleton)),
      words_(words, expanded, skeleton),
      trial_(trial),
      own_of_(expanded.joints.size()),
      by_name_(expanded.joints.size()),
      named_(skeleton.joints.size(), -1),
      used_(skeleton.joints.size(), false) {
  std::unordered_map<std::uint64_t, std::size_t> by_uid;
  for (std::size_t i = 0; i < expanded.joints.size(); ++i)
    by_uid[expanded.joints[i].tagged.key.uid] = i;
  double low = 0, high = 0;
  for (std::size_t i = 0; i < placed.joints.size(); ++i) {
    const std::size_t of = by_uid.at(placed.joints[i].key.uid);
    const ExpandedJoint& joint = expanded.joints[of];
    expanded_of_.push_back(of);
    own_of_[of].push_back(static_cast<int>(i));
    const bool needed =
        !joint.tagged.optional && !joint.helper && placed.joints[i].key.ordinal == 0;
    input_.joints.push_back(
        {placed.joints[i].parent, placed.world(i).origin, needed ? kRequired : kOptional});
    low = std::min(low, input_.joints.back().at.y);
    high = std::max(high, input_.joints.back().at.y);
  }
  height_ = std::max(high - low, 1e-9);
  weigh_neighbours();
  for (const tags::ForeignJoint& joint : skeleton.joints)
    input_.bones.push_back({joint.parent, skeleton.ancestor_world * joint.rest.origin, 0});
  input_.left = left_by_names();
  input_.names = [this](std::size_t joint, std::size_t bone) { return name_score(joint, bone); };
}

/// Of leaves that hang nearly in one place, as an eye and its lids, a bone is rather the first.
void Guesser::weigh_neighbours() {
  std::vector<AlignNode>& joints = input_.joints;
  std::vector<bool> leaf(joints.size(), true);
  for (const AlignNode& joint : joints)
    if (joint.parent >= 0) leaf[static_cast<std::size_t>(joint.parent)] = false;
  for (std::size_t i = 0; i < joints.size(); ++i)
    for (std::size_t k = 0; k < i && leaf[i] && joints[i].weight < kRequired; ++k)
      if (leaf[k] && joints[k].parent == joints[i].parent &&
          length(joints[k].at - joints[i].at) < kOnePlace * height_)
        joints[i].weight = kBeside;
}

void Guesser::take_names(const MapTrial& trial) {
  std::unordered_map<std::string, std::size_t> joints;
  for (std::size_t i = 0; i < expanded_.joints.size(); ++i)
    joints[expanded_.joints[i].tagged.name] = i;
  std::unordered_map<int, int> bones;
  for (std::size_t i = 0; i < skeleton_.joints.size(); ++i)
    bones[skeleton_.joints[i].node] = static_cast<int>(i);
  for (const auto& [joint, node] : trial.matched) {
    by_name_[joints.at(joint)].push_back(bones.at(node));
    named_[static_cast<std::size_t>(bones.at(node))] = static_cast<int>(joints.at(joint));
  }
}

double Guesser::name_score(std::size_t own, std::size_t bone) const {
  const std::size_t joint = expanded_of_[own];
  double score = words_.score(joint, bone);
  const std::vector<int>& named = by_name_[joint];
  const auto at = std::find(named.begin(), named.end(), static_cast<int>(bone));
  if (at != named.end()) {
    // Of a chain the first bone by name is its first joint; the rest follows from there.
    const bool in_place =
        static_cast<std::size_t>(at - named.begin()) == placed_.joints[own].key.ordinal;
    score += (strong_ ? kSureName : kLikelyName) * (in_place ? 1 : 0.5);
  } else if (strong_ && (named_[bone] >= 0 || !named.empty())) {
    score -= kSureName;
  }
  const double x = input_.joints[own].at.x;
  const bool left = x > 0.01 * height_, right = x < -0.01 * height_;
  const std::string& side = words_.side(bone);
  if (side.empty() || swapped_) return score;
  if (!left && !right) return score - 0.5;
  return (side == "l") == left ? score + 0.1 : score - kOtherSide;
}

/// How far limbs bend and feet point to where they do in the template; below 0: the other way.
double Guesser::facing() const {
  const auto& bone_of = alignment_.bone_of;
  double sum = 0;
  for (std::size_t i = 0; i < input_.joints.size(); ++i) {
    const int above = input_.joints[i].parent;
    if (above < 0 || bone_of[i] < 0 || bone_of[static_cast<std::size_t>(above)] < 0) continue;
    const Vec3 own = input_.joints[i].at - input_.joints[static_cast<std::size_t>(above)].at;
    const Vec3 other = transposed(alignment_.axes) *
                       (position(bone_of[i]) - position(bone_of[static_cast<std::size_t>(above)]));
    if (std::abs(own.z) > 0.6 * length(own) && length(other) > 0)
      sum += (own.z > 0 ? 1 : -1) * other.z / length(other) * 0.2;
    const int top = input_.joints[static_cast<std::size_t>(above)].parent;
    const std::string& group = placed_.joints[i].ids.local;
    if (top < 0 || bone_of[static_cast<std::size_t>(top)] < 0 || group.empty() ||
        placed_.joints[static_cast<std::size_t>(top)].ids.local != group)
      continue;
    const auto bend = [](Vec3 a, Vec3 b, Vec3 c) {
      const Vec3 line = c - a;
      const double reach = dot(line, line);
      if (!(reach > 0)) return 0.0;
      return ((b - a) - line * (dot(b - a, line) / reach)).z / math::sqrt(reach);
    };
    const auto t = static_cast<std::size_t>(top), a = static_cast<std::size_t>(above);
    const double wanted = bend(input_.joints[t].at, input_.joints[a].at, input_.joints[i].at);
    const math::Mat3 back = transposed(alignment_.axes);
    const double found =
        bend(back * position(bone_of[t]), back * position(bone_of[a]), back * position(bone_of[i]));
    if (std::abs(wanted) > 0.01) sum += wanted > 0 ? found : -found;
  }
  return sum;
}

/// From where bones of the right side lie to where those of the left do, by their names.
Vec3 Guesser::left_by_names() const {
  Vec3 sum[2];
  double count[2] = {0, 0};
  for (std::size_t i = 0; i < input_.bones.size(); ++i) {
    if (words_.side(i).empty()) continue;
    const std::size_t side = words_.side(i) == "l" ? 0 : 1;
    sum[side] = sum[side] + input_.bones[i].at;
    count[side] += 1;
  }
  if (count[0] < 2 || count[1] < 2) return {};
  const Vec3 across = sum[0] * (1 / count[0]) - sum[1] * (1 / count[1]);
  return length(across) > 0 ? normalised(across) : Vec3{};
}

/// Takes what names say about sides the other way round.
void Guesser::swap_sides() {
  swapped_ = true;
  input_.left = -input_.left;
  std::vector<std::vector<int>> swapped(by_name_.size());
  for (std::size_t i = 0; i < by_name_.size(); ++i) {
    const int opposite = expanded_.joints[i].opposite;
    swapped[opposite < 0 ? i : static_cast<std::size_t>(opposite)] = by_name_[i];
  }
  by_name_ = std::move(swapped);
  for (std::size_t i = 0; i < by_name_.size(); ++i)
    for (const int bone : by_name_[i]) named_[static_cast<std::size_t>(bone)] = static_cast<int>(i);
}

/// The bone of the nearest joint above that has one; -1.
int Guesser::bone_above(std::size_t own) const {
  int above = input_.joints[own].parent;
  while (above >= 0 && alignment_.bone_of[static_cast<std::size_t>(above)] < 0)
    above = input_.joints[static_cast<std::size_t>(above)].parent;
  return above < 0 ? -1 : alignment_.bone_of[static_cast<std::size_t>(above)];
}

/// The only bone below another, if it is free; -1.
int Guesser::only_below(int bone) const {
  int next = -1;
  for (std::size_t i = 0; i < skeleton_.joints.size(); ++i) {
    if (skeleton_.joints[i].parent != bone) continue;
    if (next >= 0 || used_[i]) return -1;
    next = static_cast<int>(i);
  }
  return next;
}

/// A chain takes all bones between the joint above it and the one below it, or down to the end.
void Guesser::fill_chain(std::size_t joint, std::vector<int>& bones) const {
  const auto parent = [&](int bone) {
    return skeleton_.joints[static_cast<std::size_t>(bone)].parent;
  };
  const int top = bone_above(static_cast<std::size_t>(own_of_[joint].front()));
  int below = -1;  // the bone of the joint below
  for (std::size_t i = 0; i < input_.joints.size(); ++i)
    if (input_.joints[i].parent == own_of_[joint].back() && below < 0)
      below = alignment_.bone_of[i];
  if (top < 0 || (below < 0 && bones.empty())) return;
  std::vector<int> path;
  for (int at = below < 0 ? bones.back() : parent(below); at >= 0 && at != top; at = parent(at))
    path.push_back(at);
  const auto in = [](const std::vector<int>& list, int bone) {
    return std::find(list.begin(), list.end(), bone) != list.end();
  };
  const bool connected = !path.empty() && parent(path.back()) == top;
  if (!connected ||
      !std::all_of(bones.begin(), bones.end(), [&](int bone) { return in(path, bone); }))
    return;
  std::reverse(path.begin(), path.end());
  std::erase_if(path, [&](int bone) {
    if (in(bones, bone)) return false;
    // A bone in the same place as the one below is no joint of its own.
    const bool same =
        below >= 0 && length(position(bone) - position(below)) < 0.01 * height_ * alignment_.scale;
    return same || used_[static_cast<std::size_t>(bone)];
  });
  for (int at = path.empty() || below >= 0 ? -1 : only_below(path.back()); at >= 0;
       at = only_below(at))
    path.push_back(at);
  bones = std::move(path);
}

void Guesser::explain(std::size_t joint, GuessLine& line) const {
  const auto own = static_cast<std::size_t>(own_of_[joint].front());
  const int bone = line.bones.front();
  const std::vector<int>& named = by_name_[joint];
  const std::string word = words_.speaking(joint, static_cast<std::size_t>(bone));
  const bool by_name = std::find(named.begin(), named.end(), bone) != named.end();
  const int above = bone_above(own);
  std::string place;
  if (alignment_.detached[own] && above >= 0)
    place = fmt::format("its place; it does not hang below {}", name(above));
  else if (above >= 0)
    place = fmt::format("its place below {}", name(above));
  else
    place = "its place";
  if (by_name && strong_) {
    line.sure = GuessLine::Sure::name;
    line.why = "sure: its name";
  } else if (by_name) {
    line.sure = GuessLine::Sure::name;
    line.why =
        swapped_ ? "sure: its name (not the side) and " + place : "sure: its name and " + place;
  } else if (!word.empty()) {
    line.sure = GuessLine::Sure::word;
    line.why = fmt::format("likely: \"{}\" in its name, and {}", word, place);
  } else {
    line.sure = GuessLine::Sure::place;
    line.why = "guess: " + place;
  }
}

/// Bones near to where a required joint should be that have no better use.
void Guesser::find_candidates(std::size_t joint, GuessLine& line) const {
  constexpr std::size_t kMost = 4;
  const auto own = static_cast<std::size_t>(own_of_[joint].front());
  int above = input_.joints[own].parent;
  while (above >= 0 && alignment_.bone_of[static_cast<std::size_t>(above)] < 0)
    above = input_.joints[static_cast<std::size_t>(above)].parent;
  if (above < 0) return;
  const auto anchor = static_cast<std::size_t>(above);
  const Vec3 expected =
      position(alignment_.bone_of[anchor]) +
      alignment_.axes * (input_.joints[own].at - input_.joints[anchor].at) * alignment_.scale;
  std::vector<bool> needed(used_.size(), false);
  for (const GuessLine& other : guess_.lines)
    for (const int bone : other.bones)
      if (other.required || other.sure == GuessLine::Sure::name)
        needed[static_cast<std::size_t>(bone)] = true;
  std::vector<std::pair<double, int>> near;
  for (std::size_t i = 0; i < skeleton_.joints.size(); ++i) {
    const double distance = length(position(static_cast<int>(i)) - expected);
    if (!needed[i] && distance < 0.2 * height_ * alignment_.scale)
      near.emplace_back(distance, static_cast<int>(i));
  }
  std::sort(near.begin(), near.end());
  for (std::size_t i = 0; i < near.size() && i < kMost; ++i)
    line.candidates.push_back(near[i].second);
}

void Guesser::fill_lines() {
  for (const int bone : alignment_.bone_of)
    if (bone >= 0) used_[static_cast<std::size_t>(bone)] = true;
  std::vector<std::size_t> joints;
  for (std::size_t i = 0; i < expanded_.joints.size(); ++i) {
    const ExpandedJoint& joint = expanded_.joints[i];
    const Identifiers& ids = joint.tagged.ids;
    if (ids.local.empty() || (ids.label.empty() && !joint.chain)) continue;
    GuessLine line;
    line.local = ids.local;
    line.label = ids.label;
    line.joint = joint.tagged.name;
    line.helper = joint.helper;
    line.required = !joint.tagged.optional && !joint.helper;
    line.chain = joint.chain.has_value();
    for (const int own : own_of_[i])
      if (const int bone = alignment_.bone_of[static_cast<std::size_t>(own)]; bone >= 0)
        line.bones.push_back(bone);
    if (line.chain) fill_chain(i, line.bones);
    for (const int bone : line.bones) used_[static_cast<std::size_t>(bone)] = true;
    joints.push_back(i);
    guess_.lines.push_back(std::move(line));
  }
  for (std::size_t i = 0; i < joints.size(); ++i)
    if (!guess_.lines[i].bones.empty()) explain(joints[i], guess_.lines[i]);
  for (std::size_t i = 0; i < joints.size(); ++i)
    if (guess_.lines[i].bones.empty() && guess_.lines[i].required)
      find_candidates(joints[i], guess_.lines[i]);
  for (std::size_t i = 0; i < used_.size(); ++i)
    if (!used_[i]) guess_.unmapped.push_back(static_cast<int>(i));
}

void Guesser::fill_notes() {
  if (guess_.fits) {
    guess_.notes.push_back(
        fmt::format("the map {} fits this model: rigc finds it without --map", guess_.nearest));
    return;
  }
  const auto axis = [](Vec3 v) {
    const char* names[3] = {"X", "Y", "Z"};
    std::size_t most = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (std::abs(v[i]) > std::abs(v[most])) most = i;
    return fmt::format("{}{}", v[most] < 0 ? '-' : '+', names[most]);
  };
  guess_.notes.push_back(fmt::format("taken to stand along {} and to face {}: its left is {}",
                                     axis(alignment_.axes.y), axis(alignment_.axes.z),
                                     axis(alignment_.axes.x)));
  if (swapped_)
    guess_.notes.push_back(
        "names say left and right the other way round, as seen from the front: limbs bend and feet "
        "point so that the sides here are right");
}

Guess Guesser::run() {
  if (trial_) {
    guess_.nearest = trial_->map->name;
    guess_.fits = trial_->missing.empty();
    strong_ = guess_.fits || (trial_->map->names != Map::Names::words &&
                              trial_->missing.size() * 2 < trial_->required);
    take_names(*trial_);
  }
  alignment_ = align(input_);
  if (!guess_.fits && facing() < -0.02) {
    swap_sides();
    const Alignment before = alignment_;
    alignment_ = align(input_);
    if (facing() <= 0) alignment_ = before;
  }
  fill_lines();
  fill_notes();
  return std::move(guess_);
}

}  // namespace

std::size_t Guess::count(GuessLine::Sure sure) const {
  return static_cast<std::size_t>(std::count_if(
      lines.begin(), lines.end(), [&](const GuessLine& line) { return line.sure == sure; }));
}

std::size_t Guess::missing_required() const {
  return static_cast<std::size_t>(
      std::count_if(lines.begin(), lines.end(),
                    [](const GuessLine& line) { return line.required && line.bones.empty(); }));
}

std::optional<Guess> guess_map(const Expanded& expanded, const tags::ForeignSkeleton& skeleton,
                               const std::vector<std::string>& template_folders,
                               Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.errors();
  const auto placed = place(expanded, diagnostics);
  const std::vector<Map> maps = all_maps(template_folders, diagnostics);
  if (!placed || diagnostics.errors() != errors_before) return std::nullopt;
  if (placed->joints.size() * skeleton.joints.size() > kMostPairs) {
    diagnostics.report(codes::kTooMuchToGuess, Place(),
                       fmt::format("{} joints and {} bones are too many to compare",
                                   placed->joints.size(), skeleton.joints.size()));
    return std::nullopt;
  }
  const std::vector<MapTrial> trials = try_maps(maps, expanded, skeleton);
  Map words;
  words.names = Map::Names::words;
  words.sides = {{"l", {"left", "l"}}, {"r", {"right", "r"}}};
  for (const Map& map : maps)
    if (map.names == Map::Names::words) words = map;
  return Guesser(expanded, *placed, skeleton, words, trials.empty() ? nullptr : &trials.front())
      .run();
}

}  // namespace rigc::templates
