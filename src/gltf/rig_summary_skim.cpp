// SPDX-License-Identifier: MIT
// Leaves out of a glTF's JSON text, unparsed, what a summary of its rigs does not need.
// Test: tests/gltf/rig_summary_test.cpp
#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <string_view>
#include <utility>

#include "gltf/rig_summary.h"

namespace rigc::gltf {
namespace {

constexpr bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

/// The bytes at which skipping must look: quotes and brackets.
constexpr std::array<bool, 256> kStops = [] {
  std::array<bool, 256> stops{};
  for (const char c : {'"', '{', '}', '[', ']'}) stops[static_cast<unsigned char>(c)] = true;
  return stops;
}();

// What is copied of the root, of `extensions`, of RIGC_rig and of a rig.
constexpr std::string_view kRoot[] = {"extensions"};
constexpr std::string_view kExtensions[] = {"RIGC_rig"};
constexpr std::string_view kExtension[] = {"version", "rigs"};
constexpr std::string_view kRig[] = {"id",      "name",     "global", "templates",
                                     "modules", "settings", "orphans"};

/// Walks a text that may be anything; every function gives false where it is no JSON or has escapes
/// where keys are compared.
class Skimmer {
 public:
  explicit Skimmer(std::string_view text) : at_(text.data()), end_(at_ + text.size()) {}

  bool run(std::string& out) {
    if (!copy_object(kRoot, out, 0)) return false;
    skip_blanks();
    return at_ == end_;
  }

 private:
  using Keys = std::span<const std::string_view>;

  void skip_blanks() {
    while (at_ != end_ && is_blank(*at_)) ++at_;
  }

  bool take(char c) {
    skip_blanks();
    if (at_ == end_ || *at_ != c) return false;
    ++at_;
    return true;
  }

  /// From behind the opening quote to behind the closing one.
  bool skip_string() {
    while (true) {
      const auto* quote =
          static_cast<const char*>(std::memchr(at_, '"', static_cast<std::size_t>(end_ - at_)));
      if (!quote) return false;
      const char* slash = quote;
      while (slash != at_ && slash[-1] == '\\') --slash;
      at_ = quote + 1;
      if ((quote - slash) % 2 == 0) return true;
    }
  }

  bool skip_value() {
    skip_blanks();
    if (at_ == end_) return false;
    if (*at_ != '{' && *at_ != '[') return skip_scalar();
    std::size_t depth = 0;
    while (true) {
      while (at_ != end_ && !kStops[static_cast<unsigned char>(*at_)]) ++at_;
      if (at_ == end_) return false;
      const char c = *at_++;
      if (c == '"') {
        if (!skip_string()) return false;
      } else if (c == '{' || c == '[') {
        ++depth;
      } else if (--depth == 0) {
        return true;
      }
    }
  }

  bool skip_scalar() {
    if (*at_ == '"') return ++at_, skip_string();
    const char* const begin = at_;
    while (at_ != end_ && *at_ != ',' && *at_ != '}' && *at_ != ']' && !is_blank(*at_)) ++at_;
    return at_ != begin;
  }

  bool copy_value(std::string& out) {
    skip_blanks();
    const char* const begin = at_;
    if (!skip_value()) return false;
    out.append(begin, at_);
    return true;
  }

  /// A key without its quotes, and behind its colon.
  bool take_key(std::string_view& key) {
    if (!take('"')) return false;
    const char* const begin = at_;
    if (!skip_string()) return false;
    key = {begin, static_cast<std::size_t>(at_ - begin - 1)};
    return key.find('\\') == std::string_view::npos && take(':');
  }

  /// An object with the members of these keys alone.
  bool copy_object(Keys keys, std::string& out, int level) {
    if (!take('{')) return false;
    out += '{';
    if (take('}')) return out += '}', true;
    bool first = true;
    do {
      std::string_view key;
      if (!take_key(key)) return false;
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
        if (!skip_value()) return false;
        continue;
      }
      out += first ? "\"" : ",\"";
      out.append(key).append("\":");
      first = false;
      if (!copy_member(key, out, level)) return false;
    } while (take(','));
    out += '}';
    return take('}');
  }

  bool copy_member(std::string_view key, std::string& out, int level) {
    skip_blanks();
    const char first = at_ == end_ ? '\0' : *at_;
    if (level == 0 && first == '{') return copy_object(kExtensions, out, 1);
    if (level == 1 && first == '{') return copy_object(kExtension, out, 2);
    if (level == 2 && key == "rigs" && first == '[') return copy_rigs(out);
    return copy_value(out);
  }

  bool copy_rigs(std::string& out) {
    if (!take('[')) return false;
    out += '[';
    if (take(']')) return out += ']', true;
    bool first = true;
    do {
      if (!std::exchange(first, false)) out += ',';
      skip_blanks();
      const bool object = at_ != end_ && *at_ == '{';
      if (!(object ? copy_object(kRig, out, 3) : copy_value(out))) return false;
    } while (take(','));
    out += ']';
    return take(']');
  }

  const char* at_;
  const char* end_;
};

}  // namespace

std::optional<std::string> without_details(std::string_view json) {
  std::string out;
  if (!Skimmer(json).run(out)) return std::nullopt;
  return out;
}

}  // namespace rigc::gltf
