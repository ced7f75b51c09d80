// SPDX-License-Identifier: MIT
// Files that mean the same and are written otherwise: order, spelling, white space, escapes, and
// things that nobody knows.
#include <doctest/doctest.h>

#include <fmt/format.h>
#include <algorithm>

#include "lossless_helpers.h"

namespace rigc::test::lossless {
namespace {

using json::Value;

constexpr const char* kOdd[] = {"null",
                                "{}",
                                "[]",
                                "[ null , {} , [ ] , null ]",
                                "12345678901234567890123",
                                "-0",
                                "-0.0",
                                "1e-7",
                                "1E+2",
                                "1.0",
                                "0.1e0",
                                "\"\\u00e9\\/\\ud83d\\ude00 \"",
                                "{ \"rigc\": { \"mine\" : true } }",
                                "{\"\":[{\"a\":{}}],\"b\" : null}",
                                "true"};

class Mutator {
 public:
  explicit Mutator(std::mt19937_64& random) : random_(random) {}

  std::string text(const Value& value, int depth, bool known) {
    if (value.is_object()) return object(value, depth, known);
    if (value.is_array()) return array(value, depth, known);
    if (value.is_number()) return number(std::string(value.text()));
    return std::string(value.text());
  }

  std::string space() {
    static constexpr const char* kSpaces[] = {"", "", "", "", " ", "\n", "\t", " \r\n  "};
    return kSpaces[below(random_, std::size(kSpaces))];
  }

 private:
  bool chance(std::size_t one_in) { return below(random_, one_in) == 0; }

  std::string odd() { return kOdd[below(random_, std::size(kOdd))]; }

  std::string number(std::string text) {
    if (!chance(12) || text.find_first_of(".eE") != std::string::npos) return text;
    return text == "0" ? "0E+0" : text + (chance(2) ? ".0" : "e0");
  }

  std::string key(const std::string& name) {
    const std::string quoted = json::quote(name);
    if (!chance(20) || name.empty() || name[0] < 'a' || name[0] > 'z') return quoted;
    return fmt::format("\"\\u{:04x}{}", static_cast<unsigned>(name[0]), quoted.substr(2));
  }

  std::string array(const Value& value, int depth, bool known) {
    std::string out = "[";
    const auto items = value.items();
    for (std::size_t i = 0; i < items.size(); ++i) {
      out += (i == 0 ? "" : ",") + space();
      out += text(items[i], depth + 1, known);
    }
    return out + space() + "]";
  }

  /// `known`: an object of glTF itself, which takes unknown members, extensions and extras.
  std::string object(const Value& value, int depth, bool known) {
    std::vector<std::string> members;
    bool has_extras = false, has_extensions = false;
    for (const auto& [name, member] : value.members()) {
      has_extras |= name == "extras";
      has_extensions |= name == "extensions";
      const bool inside = known && depth < 2 && name != "extensions" && name != "extras";
      std::string spelled = key(name);
      spelled += space();
      spelled += ":" + space();
      members.push_back(spelled + text(member, depth + 1, inside));
    }
    if (known && chance(depth == 0 ? 1 : 6)) members.push_back("\"x_unknown\":" + odd());
    if (known && !has_extras && chance(4)) members.push_back("\"extras\" : " + odd());
    if (known && !has_extensions && chance(6))
      members.push_back(chance(2) ? "\"extensions\": { }" : "\"extensions\":{\"X_unknown\":{}}");
    if (chance(3))
      for (std::size_t i = members.size(); i > 1; --i)
        std::swap(members[i - 1], members[below(random_, i)]);
    std::string out = "{";
    for (std::size_t i = 0; i < members.size(); ++i)
      out += (i == 0 ? "" : ",") + space() + members[i];
    return out + space() + "}";
  }

  std::mt19937_64& random_;
};

void append_uint32(std::string& out, std::size_t value) {
  for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(value >> shift & 255);
}

std::string chunk(const char* type, const std::string& bytes) {
  std::string out;
  append_uint32(out, bytes.size());
  return out.append(type, 4) + bytes;
}

}  // namespace

Sample mutated(const Sample& sample, std::mt19937_64& random) {
  const gltf::File file = opened(sample);
  Mutator mutator(random);
  std::string text = mutator.space();
  text += mutator.text(file.root(), 0, true);
  text += mutator.space();
  Sample out{sample.name + " mutated", sample.path, std::move(text)};
  if (!file.binary) return out;
  out.bytes.resize((out.bytes.size() + 3) / 4 * 4 + 4 * below(random, 3), ' ');
  std::string chunks = chunk("JSON", out.bytes);
  Diagnostics diagnostics;
  if (file.bin) {
    std::string bin = *file.bin->text(diagnostics);
    bin.append(4 * below(random, 3), '\7');
    chunks += chunk("BIN\0", bin);
  }
  for (const Bytes& other : file.other_chunks) chunks += *other.text(diagnostics);
  for (std::size_t i = below(random, 3); i > 0; --i)
    chunks += chunk("XTRA", std::string(4 * i, 'x'));
  out.bytes = "glTF";
  append_uint32(out.bytes, 2);
  append_uint32(out.bytes, 12 + chunks.size());
  out.bytes += chunks;
  return out;
}

}  // namespace rigc::test::lossless
