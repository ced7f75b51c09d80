// SPDX-License-Identifier: MIT
// Identity while expanding: uids from names, and who stands opposite whom.
// Test: tests/templates/expand_test.cpp
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/text.h"
#include "templates/codes.h"
#include "templates/expander.h"

namespace rigc::templates {
namespace {

constexpr std::size_t kMostEarlierKeys = 64;

/// Earlier names first, then today's: the earliest gives the key, so that a rename keeps it.
std::vector<std::string> with_earlier(const std::vector<std::string>& was,
                                      const std::string& name) {
  std::vector<std::string> names = was;
  names.push_back(name);
  return names;
}

/// An explicit uid as it stands, or, in a part, hashed with the part's path: the part may be used
/// twice.
std::uint64_t uid_of(std::uint64_t written, const std::string& path) {
  if (path.empty()) return written;
  std::string bytes = path;
  bytes.push_back('\0');
  bytes += hex16(written);
  return hash64(bytes);
}

void add_key(tags::TaggedJoint& joint, std::uint64_t uid, bool first) {
  const JointKey key{uid, 0};
  if (first) {
    joint.key = key;
    return;
  }
  const bool known =
      key == joint.key || std::find(joint.was.begin(), joint.was.end(), key) != joint.was.end();
  if (!known && joint.was.size() < kMostEarlierKeys) joint.was.push_back(key);
}

}  // namespace

std::uint64_t uid_of(const std::string& template_name, const std::string& path,
                     const std::string& joint) {
  std::string bytes = template_name;
  bytes.push_back('\0');
  bytes += path;
  bytes.push_back('\0');
  bytes += joint;
  return hash64(bytes);
}

std::string Expander::path(const Use& use) const {
  if (!use.part) return {};
  const std::string outer = path(uses_[static_cast<std::size_t>(use.outer)]);
  return outer.empty() ? use.part->as : outer + "/" + use.part->as;
}

/// All paths that the parts' `was` allow, the earliest first and today's last.
std::vector<std::string> Expander::earlier_paths(const Use& use) const {
  if (!use.part) return {""};
  std::vector<std::string> paths;
  for (const std::string& outer : earlier_paths(uses_[static_cast<std::size_t>(use.outer)]))
    for (const std::string& as : with_earlier(use.part->was, use.part->as))
      if (paths.size() < kMostEarlierKeys) paths.push_back(outer.empty() ? as : outer + "/" + as);
  return paths;
}

void Expander::assign_keys() {
  const std::vector<std::string> template_names = with_earlier(main_.was, main_.name);
  std::vector<std::vector<std::string>> paths;
  for (const Use& use : uses_) paths.push_back(earlier_paths(use));
  std::map<std::uint64_t, const RawJoint*> taken;
  for (RawJoint& joint : joints_) {
    if (joint.parent == kAbsent) continue;
    const Joint& source = *joint.source;
    tags::TaggedJoint& tagged = joint.result.tagged;
    const std::vector<std::string>& own_paths = paths[static_cast<std::size_t>(joint.use)];
    bool first = true;
    const auto add = [&](std::uint64_t uid) {
      add_key(tagged, uid, first);
      first = false;
    };
    if (source.uid)
      for (const std::string& own_path : own_paths) add(uid_of(*source.uid, own_path));
    for (const std::uint64_t earlier : source.earlier_uids)
      for (const std::string& own_path : own_paths) add(uid_of(earlier, own_path));
    const auto names = source.uid ? source.was : with_earlier(source.was, source.name);
    for (const std::string& template_name : template_names)
      for (const std::string& own_path : own_paths)
        for (const std::string& name : names) add(uid_of(template_name, own_path, name));
    const auto [other, fresh] = taken.emplace(tagged.key.uid, &joint);
    if (!fresh)
      diagnostics_.report(
          codes::kUidTwice, source.span,
          fmt::format("the joints {} and {} have the same uid {}",
                      other->second->result.tagged.name, tagged.name, hex16(tagged.key.uid)),
          "write a `uid:` of 16 hexadecimal digits for the newer one");
  }
}

/// `joint/command` as `<joint key>/command`. The joint may be gone from the template by now; one
/// that no name leads to is written by its uid.
std::string Expander::earlier_holder(const RawJoint& joint, const std::string& was) const {
  const std::size_t slash = was.find('/');
  const std::string name = was.substr(0, slash);
  const Use& use = uses_[static_cast<std::size_t>(joint.use)];
  const std::string path_then = earlier_paths(use).front();
  const std::string template_then = main_.was.empty() ? main_.name : main_.was.front();
  const auto written = parse_hex16(name);
  std::uint64_t uid =
      written ? uid_of(*written, path_then) : uid_of(template_then, path_then, name);
  for (const Joint& candidate : use.source->joints) {
    const bool same =
        candidate.name == name ||
        std::find(candidate.was.begin(), candidate.was.end(), name) != candidate.was.end();
    if (!same) continue;
    uid = candidate.uid ? uid_of(*candidate.uid, path_then)
                        : uid_of(template_then, path_then,
                                 candidate.was.empty() ? candidate.name : candidate.was.front());
    break;
  }
  return hex16(uid) + was.substr(slash);
}

std::string other_side(std::string_view name) {
  static constexpr std::pair<std::string_view, std::string_view> kSides[] = {
      {"l", "r"}, {"r", "l"}, {"left", "right"}, {"right", "left"}};
  std::vector<std::string> words;
  for (const std::string_view word : split(name, '_')) words.emplace_back(word);
  for (std::size_t i = words.size(); i-- > 0;) {
    for (const auto& [side, other] : kSides) {
      if (words[i] != side) continue;
      words[i] = other;
      return join(words, "_");
    }
  }
  return {};
}

void Expander::pair_uses(int a, int b) {
  const auto& left = uses_[static_cast<std::size_t>(a)];
  const auto& right = uses_[static_cast<std::size_t>(b)];
  for (std::size_t i = 0; i < left.joints.size() && i < right.joints.size(); ++i) {
    if (left.joints[i] < 0 || right.joints[i] < 0) continue;
    joints_[static_cast<std::size_t>(left.joints[i])].result.opposite = right.joints[i];
    joints_[static_cast<std::size_t>(right.joints[i])].result.opposite = left.joints[i];
  }
  for (std::size_t i = 0; i < left.parts.size() && i < right.parts.size(); ++i)
    if (left.parts[i] >= 0 && right.parts[i] >= 0) pair_uses(left.parts[i], right.parts[i]);
}

/// Opposite are the joints of two uses of a part, one of them mirrored, and joints whose names
/// differ by a side.
void Expander::pair_sides() {
  for (const Use& outer : uses_) {
    std::vector<bool> paired(outer.parts.size(), false);
    const auto pair_up = [&](bool by_name) {
      for (std::size_t a = 0; a < outer.parts.size(); ++a) {
        for (std::size_t b = a + 1; b < outer.parts.size() && !paired[a]; ++b) {
          if (paired[b] || outer.parts[a] < 0 || outer.parts[b] < 0) continue;
          const Use& left = uses_[static_cast<std::size_t>(outer.parts[a])];
          const Use& right = uses_[static_cast<std::size_t>(outer.parts[b])];
          if (left.source != right.source) continue;
          if (left.part->mirror.has_value() == right.part->mirror.has_value()) continue;
          if (by_name && other_side(left.part->as) != right.part->as) continue;
          paired[a] = paired[b] = true;
          pair_uses(outer.parts[a], outer.parts[b]);
        }
      }
    };
    pair_up(true);
    pair_up(false);
  }
  pair_written();
  const auto& names = uses_.front().handles.names;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    ExpandedJoint& joint = joints_[i].result;
    if (joint.opposite >= 0 || joints_[i].source->opposite) continue;
    const auto found = names.find(other_side(joint.tagged.name));
    if (found == names.end() || found->second < 0) continue;
    const RawJoint& raw = joints_[static_cast<std::size_t>(found->second)];
    ExpandedJoint& other = joints_[static_cast<std::size_t>(found->second)].result;
    if (raw.source->opposite || other.opposite >= 0 || found->second == static_cast<int>(i))
      continue;
    joint.opposite = found->second;
    other.opposite = static_cast<int>(i);
  }
}

/// What joints say by `opposite:`, unless a mirrored use of their part says more.
void Expander::pair_written() {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    RawJoint& joint = joints_[i];
    const auto& opposite = joint.source->opposite;
    if (!opposite || opposite->empty() || joint.parent == kAbsent) continue;
    const int other = resolve(joint.use, *opposite, joint.source->opposite_span, "opposite");
    if (joint.result.opposite < 0 && other >= 0 && other != static_cast<int>(i))
      joint.result.opposite = other;
  }
}

}  // namespace rigc::templates
