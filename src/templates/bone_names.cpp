// SPDX-License-Identifier: MIT
// The comparison of bone names. Test: tests/templates/bone_names_test.cpp
#include "templates/bone_names.h"

#include <algorithm>
#include <set>

#include "base/text.h"

namespace rigc::templates {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_separator(char c) {
  return c == '.' || c == '_' || c == '-' || c == ':' || c == ' ' || c == '|' || c == '/';
}

/// How many characters at the begin of `text` the pattern stands for; nothing if it does not fit
/// there.
std::optional<std::size_t> fits_begin(std::string_view text, std::string_view pattern) {
  std::size_t at = 0;
  for (const char c : pattern) {
    if (c == '#') {
      while (at < text.size() && is_digit(text[at])) ++at;
    } else {
      if (at >= text.size() || text[at] != c) return std::nullopt;
      ++at;
    }
  }
  return at;
}

std::string reversed(std::string_view text) { return {text.rbegin(), text.rend()}; }

/// A bone's name without the first prefix and the first suffix that fit; never empty.
std::string stripped(const NameRules& rules, const std::string& name) {
  std::string out = name;
  for (const std::string& prefix : rules.prefixes) {
    const auto length = fits_begin(lower(out), lower(prefix));
    if (!length || *length >= out.size()) continue;
    out.erase(0, *length);
    break;
  }
  for (const std::string& suffix : rules.suffixes) {
    const auto length = fits_begin(lower(reversed(out)), lower(reversed(suffix)));
    if (!length || *length >= out.size()) continue;
    out.resize(out.size() - *length);
    break;
  }
  return out;
}

/// Where the `_12` at the end of a name begins; its size where there is none.
std::size_t serial_begin(std::string_view name) {
  std::size_t at = name.size();
  while (at > 0 && is_digit(name[at - 1])) --at;
  return at < name.size() && at > 1 && name[at - 1] == '_' ? at - 1 : name.size();
}

/// Some exporters end every name in a serial number (Hips_01, Spine_02, ...): numbers that never
/// repeat over nearly all bones count bones, not joints of a chain.
bool has_serials(const tags::ForeignSkeleton& skeleton) {
  std::set<std::string> serials;
  std::size_t with = 0, bones = 0;
  for (const tags::ForeignJoint& joint : skeleton.joints) {
    if (joint.name.empty()) continue;
    ++bones;
    const std::size_t at = serial_begin(joint.name);
    if (at == joint.name.size()) continue;
    ++with;
    serials.insert(joint.name.substr(at));
  }
  return with >= 8 && with * 10 >= bones * 9 && serials.size() == with;
}

/// Removes each place where `phrase` stands, unless nothing would be left.
void remove_phrase(std::vector<std::string>& words, const std::vector<std::string>& phrase) {
  if (phrase.empty()) return;
  for (auto at = words.begin(); words.size() > phrase.size();) {
    at = std::search(at, words.end(), phrase.begin(), phrase.end(),
                     [](const std::string& word, const std::string& unwanted) {
                       return normal_number(word) == unwanted;
                     });
    if (at == words.end()) return;
    at = words.erase(at, at + static_cast<std::ptrdiff_t>(phrase.size()));
  }
}

/// The side that a word of the name says; that word is removed.
std::string take_side(const NameRules& rules, std::vector<std::string>& words) {
  if (words.size() < 2) return {};
  for (auto word = words.begin(); word != words.end(); ++word)
    for (const MapSide& side : rules.sides)
      for (const std::string& says : side.words)
        if (lower(says) == *word) {
          words.erase(word);
          return side.key;
        }
  return {};
}

/// Words in one text; numbers that follow one another stay apart.
std::string joined(const std::string& side, const std::vector<std::string>& words) {
  std::string out = side + "/";
  for (const std::string& word : words) {
    if (is_digit(out.back()) && is_digit(word.front())) out += '.';
    out += word;
  }
  return out;
}

}  // namespace

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (is_upper(c)) c = static_cast<char>(c - 'A' + 'a');
  return out;
}

std::string normal_number(std::string_view word) {
  while (word.size() > 1 && word[0] == '0' && is_digit(word[1])) word.remove_prefix(1);
  return std::string(word);
}

std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words;
  std::string word;
  const auto end = [&] {
    if (!word.empty()) words.push_back(lower(word));
    word.clear();
  };
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (is_separator(c)) {
      end();
      continue;
    }
    if (!word.empty()) {
      const char before = word.back();
      const bool starts_lower = i + 1 < name.size() && name[i + 1] >= 'a' && name[i + 1] <= 'z';
      if (is_digit(c) != is_digit(before) || (is_upper(c) && (!is_upper(before) || starts_lower)))
        end();
    }
    word += c;
  }
  end();
  return words;
}

NameKey key_of(const NameRules& rules, std::string_view name) {
  NameKey key;
  std::vector<std::string> words = words_of(name);
  for (const std::vector<std::string>& phrase : rules.ignored) remove_phrase(words, phrase);
  key.side = take_side(rules, words);
  key.exact = joined(key.side, words);
  for (std::string& word : words) word = normal_number(word);
  key.text = joined(key.side, words);
  key.words = std::move(words);
  return key;
}

std::optional<int> node_reference(std::string_view bone) {
  if (!starts_with(bone, "/nodes/")) return std::nullopt;
  const auto number = parse_integer(bone.substr(7));
  if (!number || *number < 0 || *number > INT32_MAX) return std::nullopt;
  return static_cast<int>(*number);
}

bool fits_pattern(std::string_view name, std::string_view pattern) {
  return fits_begin(lower(name), lower(pattern)) == name.size();
}

BoneNames::BoneNames(const NameRules& rules, const tags::ForeignSkeleton& skeleton)
    : rules_(rules) {
  const bool words = rules.names == NameRules::Names::words;
  for (const tags::ForeignJoint& joint : skeleton.joints) nodes_.push_back(joint.node);
  const auto add = [&](const std::string& name, std::size_t joint) {
    if (name.empty()) return;
    Bone bone{lower(name), name, name, static_cast<int>(joint), skeleton.joints[joint].in_skin};
    if (words) {
      NameKey key = key_of(rules, name);
      bone.folded = std::move(key.text);
      bone.exact = std::move(key.exact);
    }
    sorted_.push_back(std::move(bone));
  };
  if (rules.names == NameRules::Names::humanoid) {
    for (const auto& [bone, joint] : skeleton.humanoid) add(bone, static_cast<std::size_t>(joint));
  } else {
    const bool serials = words && has_serials(skeleton);
    for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
      std::string name = stripped(rules, skeleton.joints[i].name);
      if (serials) name.resize(serial_begin(name));
      const std::size_t space = words ? name.find_last_of(":|") : std::string::npos;
      if (space != std::string::npos && space + 1 < name.size()) name.erase(0, space + 1);
      add(name, i);
    }
  }
  std::sort(sorted_.begin(), sorted_.end(), [](const Bone& a, const Bone& b) {
    if (a.folded != b.folded) return a.folded < b.folded;
    return a.in_skin != b.in_skin ? a.in_skin : a.joint < b.joint;
  });
}

int BoneNames::find(std::string_view bone) const {
  if (const auto node = node_reference(bone)) {
    const auto at = std::find(nodes_.begin(), nodes_.end(), *node);
    return at == nodes_.end() ? -1 : static_cast<int>(at - nodes_.begin());
  }
  Bone wanted{lower(bone), std::string(bone), {}, -1, false};
  if (rules_.names == NameRules::Names::words) {
    NameKey key = key_of(rules_, bone);
    wanted.folded = std::move(key.text);
    wanted.exact = std::move(key.exact);
  }
  const auto [first, last] =
      std::equal_range(sorted_.begin(), sorted_.end(), wanted,
                       [](const Bone& a, const Bone& b) { return a.folded < b.folded; });
  if (first == last) return -1;
  wanted.in_skin = first->in_skin;
  const auto same = std::find_if(first, last, [&](const Bone& found) {
    return found.exact == wanted.exact && found.in_skin == wanted.in_skin;
  });
  return (same != last ? same : first)->joint;
}

std::vector<std::string> BoneNames::names() const {
  std::vector<std::string> names;
  for (const Bone& bone : sorted_) names.push_back(bone.name);
  return names;
}

}  // namespace rigc::templates
