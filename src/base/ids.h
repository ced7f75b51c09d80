// SPDX-License-Identifier: MIT
// Identities: the uid of a joint, a joint's key, and the identity of a node in a built rig.
// Test: tests/base/ids_test.cpp
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace rigc {

/// XXH3-64 of bytes, seed 0: the same on every machine.
std::uint64_t hash64(std::string_view bytes);

/// Sixteen lower-case hex digits.
std::string hex16(std::uint64_t value);
/// Exactly sixteen hex digits of either case, else nothing.
std::optional<std::uint64_t> parse_hex16(std::string_view text);

/// A joint across versions of a template. A chain's joints share a uid and differ in `ordinal`.
struct JointKey {
  std::uint64_t uid = 0;
  std::uint32_t ordinal = 0;
  auto operator<=>(const JointKey&) const = default;
};

/// `0123456789abcdef` or, with an ordinal above 0, `0123456789abcdef+2`.
std::string to_text(const JointKey& key);
std::optional<JointKey> parse_joint_key(std::string_view text);

/// What a node is, across builds: no name and no position in a list takes part.
struct Identity {
  std::uint32_t rig = 0;  ///< the rig's number inside its file
  JointKey owner;         ///< joint that the node belongs to
  JointKey holder;        ///< joint that holds the command
  std::string command;    ///< command id
  std::string role;
  std::uint32_t counter = 0;  ///< 0 unless all of the above are equal
  auto operator<=>(const Identity&) const = default;
};

/// One short string: `rig:owner:holder:command:role:counter`; a joint of the skeleton itself is
/// `rig:key`.
std::string to_text(const Identity& identity);
std::optional<Identity> parse_identity(std::string_view text);

/// What a joint or node is called in selectors. Empty strings stand for absent tags.
struct Identifiers {
  std::string global;
  std::string local;
  std::string label;
  bool operator==(const Identifiers&) const = default;
};

}  // namespace rigc
