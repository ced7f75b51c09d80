// SPDX-License-Identifier: MIT
// How the names of a model's bones are compared with those of a map. The one step of rigc that goes
// by names. Test: tests/templates/bone_names_test.cpp
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tags/tags.h"

namespace rigc::templates {

/// What `{s}` in a key of a map and `{side}` in a bone's name stand for.
struct MapSide {
  std::string key;                 ///< in the template's groups: `l`
  std::vector<std::string> words;  ///< in the model's names: `Left`
};

/// How a map compares the names of bones.
struct NameRules {
  enum class Names {
    bones,     ///< without case, prefix and suffix
    words,     ///< word by word
    humanoid,  ///< the names of the VRM humanoid table; those of nodes are never read
  };
  Names names = Names::bones;
  std::vector<std::string> prefixes;  ///< cut from bone names; `#` stands for any digits, or none
  std::vector<std::string> suffixes;
  std::vector<std::vector<std::string>> ignored;  ///< phrases that say nothing, as words_of()
  std::vector<MapSide> sides;
};

/// ASCII letters in lower case.
std::string lower(std::string_view text);

/// A name's words: split at separators, case changes and borders of letters and digits; lower case.
std::vector<std::string> words_of(std::string_view name);

/// A number without leading zeros; other words as they are.
std::string normal_number(std::string_view word);

/// What a map's `names: words` compares: words without case, without those that say nothing, the
/// side in front, numbers without leading zeros.
struct NameKey {
  std::string side;                ///< key of the map's `sides`; empty: none
  std::vector<std::string> words;  ///< numbers normalised
  std::string text;                ///< side and words, as compared
  std::string exact;  ///< the same with numbers as written: decides between Finger1 and Finger01
};
NameKey key_of(const NameRules& rules, std::string_view name);

/// A reference to a bone by its glTF node, `/nodes/12`: for bones without a usable name.
std::optional<int> node_reference(std::string_view bone);

/// Whether a whole name fits a pattern, without case; `#` stands for any digits, or none.
bool fits_pattern(std::string_view name, std::string_view pattern);

/// Bones of a skeleton by the names that a map uses.
class BoneNames {
 public:
  BoneNames(const NameRules& rules, const tags::ForeignSkeleton& skeleton);
  /// Index into ForeignSkeleton::joints; -1: none. Of several: those in a skin, of these the one
  /// written exactly so, else the first.
  int find(std::string_view bone) const;
  /// All names without what the map cuts off, sorted: for suggestions.
  std::vector<std::string> names() const;

 private:
  struct Bone {
    std::string folded;  ///< as compared
    std::string exact;   ///< the same with case, or numbers, as written
    std::string name;
    int joint;
    bool in_skin;
  };
  NameRules rules_;
  std::vector<Bone> sorted_;
  std::vector<int> nodes_;  ///< glTF nodes of the joints
};

}  // namespace rigc::templates
