// SPDX-License-Identifier: MIT
// Hashes, hex digits and the text forms of identities. The one place that knows xxhash.
// Test: tests/base/ids_test.cpp
#include "base/ids.h"

#include <charconv>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "base/text.h"

namespace rigc {
namespace {

std::optional<std::uint32_t> parse_u32(std::string_view text) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

bool is_word(std::string_view text) { return text.size() <= 255 && is_utf8(text); }

}  // namespace

std::uint64_t hash64(std::string_view bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

std::string hex16(std::uint64_t value) {
  std::string text(16, '0');
  for (std::size_t i = 16; i-- > 0; value >>= 4) text[i] = "0123456789abcdef"[value & 15];
  return text;
}

std::optional<std::uint64_t> parse_hex16(std::string_view text) {
  if (text.size() != 16) return std::nullopt;
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + 16, value, 16);
  if (error != std::errc() || end != text.data() + 16) return std::nullopt;
  return value;
}

std::string to_text(const JointKey& key) {
  std::string text = hex16(key.uid);
  if (key.ordinal != 0) text += '+' + std::to_string(key.ordinal);
  return text;
}

std::optional<JointKey> parse_joint_key(std::string_view text) {
  const auto uid = parse_hex16(text.substr(0, 16));
  if (!uid) return std::nullopt;
  if (text.size() == 16) return JointKey{*uid, 0};
  if (text[16] != '+') return std::nullopt;
  const std::string_view digits = text.substr(17);
  const auto ordinal = parse_u32(digits);
  if (!ordinal || digits.front() == '0') return std::nullopt;
  return JointKey{*uid, *ordinal};
}

std::string to_text(const Identity& identity) {
  std::string text = std::to_string(identity.rig) + ':' + to_text(identity.owner);
  if (identity.holder == JointKey{} && identity.command.empty() && identity.role.empty() &&
      identity.counter == 0)
    return text;
  text += ':' + to_text(identity.holder);
  text += ':' + identity.command;
  text += ':' + identity.role;
  text += ':' + std::to_string(identity.counter);
  return text;
}

std::optional<Identity> parse_identity(std::string_view text) {
  if (text.size() > 1000) return std::nullopt;
  const std::vector<std::string_view> parts = split(text, ':');
  if (parts.size() != 2 && parts.size() != 6) return std::nullopt;
  const auto rig = parse_u32(parts[0]);
  const auto owner = parse_joint_key(parts[1]);
  if (!rig || !owner) return std::nullopt;
  Identity identity{*rig, *owner, {}, {}, {}, 0};
  if (parts.size() == 6) {
    const auto holder = parse_joint_key(parts[2]);
    const auto counter = parse_u32(parts[5]);
    if (!holder || !counter || !is_word(parts[3]) || !is_word(parts[4])) return std::nullopt;
    identity.holder = *holder;
    identity.command = parts[3];
    identity.role = parts[4];
    identity.counter = *counter;
  }
  // One identity has one text: what another program rewrote is not taken for ours.
  if (to_text(identity) != text) return std::nullopt;
  return identity;
}

}  // namespace rigc
