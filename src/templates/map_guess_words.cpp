// SPDX-License-Identifier: MIT
// The vocabulary of a template's joints. Test: tests/templates/map_guess_test.cpp
#include "templates/map_guess_words.h"

#include "base/text.h"

namespace rigc::templates {
namespace {

/// A word of more limbs than this (upper, end, hand) says nothing about the limb.
constexpr std::size_t kMostLimbs = 2;

bool is_number(const std::string& word) { return word[0] >= '0' && word[0] <= '9'; }

}  // namespace

GuessWords::GuessWords(const Map& map, const Expanded& expanded,
                       const tags::ForeignSkeleton& skeleton) {
  for (const ExpandedJoint& joint : expanded.joints) {
    const Identifiers& ids = joint.tagged.ids;
    std::set<std::string> words;
    const auto add = [&](std::string_view text) {
      for (const std::string& word : key_of(map, text).words)
        if (!is_number(word) && word.size() > 1) words.insert(word);
    };
    // Of arm_l_hand_thumb only the last word is the joint's own.
    const std::vector<std::string> group = key_of(map, ids.local).words;
    add(group.empty() ? ids.local : group.back());
    add(ids.label);
    if (const MapEntry* entry = map.find(ids.local, ids.label))
      for (const std::vector<std::string>& one_of : entry->bones)
        for (const std::string& name : one_of) add(name);
    limbs_.push_back(join(group, " "));
    for (const std::string& word : words) limbs_of_[word].insert(limbs_.back());
    joint_words_.push_back(std::move(words));
  }
  for (const tags::ForeignJoint& joint : skeleton.joints) {
    NameKey key = key_of(map, joint.name);
    bone_words_.push_back(std::move(key.words));
    sides_.push_back(std::move(key.side));
  }
}

std::string GuessWords::speaking(std::size_t joint, std::size_t bone) const {
  std::string of_limb;
  for (const std::string& word : bone_words_[bone]) {
    const auto known = limbs_of_.find(word);
    if (known == limbs_of_.end() || known->second.size() > kMostLimbs) continue;
    if (joint_words_[joint].count(word)) return word;
    if (known->second.count(limbs_[joint])) of_limb = word;
  }
  return of_limb;
}

double GuessWords::score(std::size_t joint, std::size_t bone) const {
  bool others = false;
  double best = 0;
  for (const std::string& word : bone_words_[bone]) {
    const auto known = limbs_of_.find(word);
    if (known == limbs_of_.end() || known->second.size() > kMostLimbs) continue;
    if (joint_words_[joint].count(word))
      best = 0.25;
    else if (known->second.count(limbs_[joint]))
      best = best > 0.15 ? best : 0.15;
    else
      others = true;
  }
  return best > 0 ? best : others ? -0.25 : 0;
}

}  // namespace rigc::templates
