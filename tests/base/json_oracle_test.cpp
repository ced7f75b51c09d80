// SPDX-License-Identifier: MIT
// The JSON parser against nlohmann::json, an independent one, over random and randomly broken
// texts.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <string_view>

#include "base/codes.h"
#include "base/json.h"

using namespace rigc;

namespace {

using Random = std::mt19937;

std::size_t below(Random& random, std::size_t limit) { return random() % limit; }

std::string random_string(Random& random) {
  static const char* const kPieces[] = {
      "a",      "name", "\\n",     "\\u00e9",        "\xc3\xa9",
      "\\\\",   "/",    "\\\"",    "\\ud83d\\ude00", "\xf0\x9f\x98\x80",
      "joint ", "0",    "\\u0000", "\x7f",           "{"};
  std::string text = "\"";
  for (std::size_t i = below(random, 5); i-- > 0;)
    text += kPieces[below(random, std::size(kPieces))];
  return text + '"';
}

std::string random_number(Random& random) {
  static const char* const kNumbers[] = {"0",
                                         "-0",
                                         "1",
                                         "-12.5",
                                         "1e3",
                                         "2E-7",
                                         "0.1",
                                         "1e22",
                                         "1e308",
                                         "5e-324",
                                         "123456789012345678901234567890"};
  return kNumbers[below(random, std::size(kNumbers))];
}

std::string random_json(Random& random, int depth) {
  static const char* const kBlanks[] = {"", "", "", " ", "\n\t", "\r"};
  const auto blank = [&] { return std::string(kBlanks[below(random, std::size(kBlanks))]); };
  std::string text = blank();
  switch (below(random, depth > 0 ? 8 : 4)) {
    case 0:
      text += random_number(random);
      break;
    case 1:
      text += random_string(random);
      break;
    case 2:
      text += "true";
      break;
    case 3:
      text += "null";
      break;
    case 4:
    case 5: {
      text += '[';
      const std::size_t count = below(random, 5);
      for (std::size_t i = 0; i < count; ++i) {
        if (i != 0) text += ',';
        text += random_json(random, depth - 1);
      }
      text += blank() + ']';
      break;
    }
    default: {
      text += '{';
      const std::size_t count = below(random, 12);
      for (std::size_t i = 0; i < count; ++i) {
        if (i != 0) text += ',';
        text += blank() + random_string(random) + blank() + ':';
        text += random_json(random, depth - 1);
      }
      text += blank() + '}';
    }
  }
  return text + blank();
}

void break_it(Random& random, std::string& text) {
  using namespace std::string_view_literals;
  constexpr auto kBytes =
      "{}[]:,\"\\u0dD8.eE+-19 \n\t/nt\x00\x1f\x7f\x80\xc3\xa9\xed\xa0\xf0\xff"sv;
  for (std::size_t edits = 1 + below(random, 3); edits-- > 0 && !text.empty();) {
    const std::size_t place = below(random, text.size());
    const char byte = kBytes[below(random, kBytes.size())];
    switch (below(random, 4)) {
      case 0:
        text.erase(place, 1 + below(random, 3));
        break;
      case 1:
        text.insert(place, 1, byte);
        break;
      case 2:
        text[place] = byte;
        break;
      default:
        text.resize(place);
    }
  }
}

/// Whether both say the same of a value, all the way down. nlohmann keeps the last of equal keys,
/// so it can only be compared with texts without any.
void compare(const json::Value& ours, const nlohmann::json& theirs) {
  if (theirs.is_object()) {
    const auto members = ours.members();
    REQUIRE(members.size() == theirs.size());
    for (const auto& [key, value] : members) {
      REQUIRE(theirs.contains(key));
      REQUIRE(ours[key].begin() == value.begin());
      compare(value, theirs[key]);
    }
  } else if (theirs.is_array()) {
    const auto items = ours.items();
    REQUIRE(items.size() == theirs.size());
    for (std::size_t i = 0; i < items.size(); ++i) compare(items[i], theirs[i]);
  } else if (theirs.is_string()) {
    REQUIRE(ours.string() == theirs.get<std::string>());
  } else if (theirs.is_number()) {
    REQUIRE(ours.number() == theirs.get<double>());
  } else if (theirs.is_boolean()) {
    REQUIRE(ours.boolean() == theirs.get<bool>());
  } else {
    REQUIRE(ours.kind() == json::ValueKind::null);
  }
}

/// Whether nlohmann finds two equal keys in one object.
bool has_duplicates(const std::string& text) {
  struct Finder : nlohmann::json_sax<nlohmann::json> {
    std::vector<std::set<std::string>> open;
    bool found = false;
    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t) override { return true; }
    bool number_unsigned(number_unsigned_t) override { return true; }
    bool number_float(number_float_t, const string_t&) override { return true; }
    bool string(string_t&) override { return true; }
    bool binary(binary_t&) override { return true; }
    bool start_object(std::size_t) override { return open.emplace_back(), true; }
    bool key(string_t& name) override {
      found = found || !open.back().insert(name).second;
      return true;
    }
    bool end_object() override { return open.pop_back(), true; }
    bool start_array(std::size_t) override { return true; }
    bool end_array() override { return true; }
    bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override {
      return false;
    }
  } finder;
  nlohmann::json::sax_parse(text, &finder);
  return finder.found;
}

void check_text(const std::string& text, int& accepted) {
  Diagnostics diagnostics;
  const auto document = json::parse(text, "x", 0, diagnostics);
  // It skips a byte order mark and takes a zero byte for the end.
  const bool is_odd = text.starts_with("\xef\xbb\xbf") || text.find('\0') != std::string::npos;
  const bool is_valid = nlohmann::json::accept(text) && !is_odd;
  const bool is_expected = is_valid && !has_duplicates(text);
  INFO(text);
  INFO(render(diagnostics, false));
  REQUIRE(document.has_value() == is_expected);
  if (!document) return;
  ++accepted;
  compare(document->root(), nlohmann::json::parse(text));
}

}  // namespace

TEST_CASE("base json: agrees with nlohmann on random texts") {
  Random random(20240229);
  int accepted = 0;
  for (int i = 0; i < 3000; ++i) check_text(random_json(random, 5), accepted);
  CHECK(accepted > 1000);
}

TEST_CASE("base json: agrees with nlohmann on randomly broken texts") {
  Random random(4711);
  int accepted = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text = random_json(random, 3);
    break_it(random, text);
    check_text(text, accepted);
  }
  CHECK(accepted > 500);
}
