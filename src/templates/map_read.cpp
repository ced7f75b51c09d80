// SPDX-License-Identifier: MIT
// Reading maps: YAML to Map, with two-sided lines written out.
// Test: tests/templates/map_test.cpp
#include <fmt/format.h>

#include "base/text.h"
#include "base/yaml.h"
#include "templates/codes.h"
#include "templates/format.h"
#include "templates/map.h"

namespace rigc::templates {
namespace {

constexpr std::string_view kKeySide = "{s}";
constexpr std::string_view kBoneSide = "{side}";

std::vector<std::string> read_texts(const yaml::Node& node, std::string_view what,
                                    Diagnostics& diagnostics) {
  std::vector<std::string> texts;
  const auto add = [&](const yaml::Node& item) {
    const auto text = yaml::as_text(item, what, diagnostics);
    if (text && !text->empty()) texts.push_back(*text);
  };
  if (node.is_sequence())
    for (const yaml::Node& item : node.items) add(item);
  else
    add(node);
  return texts;
}

std::string replaced(std::string text, std::string_view what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

class MapReader {
 public:
  MapReader(const yaml::Node& root, Diagnostics& diagnostics)
      : root_(root), diagnostics_(diagnostics) {}
  Map run();

 private:
  void read_head();
  void read_names();
  void read_sides();
  void read_joints();
  void read_entry(const yaml::Node::Entry& entry, const MapSide* side);
  bool check_sides(const yaml::Node::Entry& entry);
  void add(MapEntry entry, const std::string& key);
  std::vector<std::string> bones(const yaml::Node& node, const std::string& key,
                                 const MapSide* side);

  const yaml::Node& root_;
  Diagnostics& diagnostics_;
  Map map_;
};

void MapReader::read_names() {
  const yaml::Node* names = root_.find("names");
  if (!names) return;
  const auto text = yaml::as_text(*names, "names", diagnostics_);
  if (!text) return;
  if (*text == "humanoid")
    map_.names = Map::Names::humanoid;
  else if (*text == "words")
    map_.names = Map::Names::words;
  else if (*text != "bones")
    diagnostics_.report(codes::kUnknownWord, names->span,
                        fmt::format("names: \"{}\" is not known", printable(*text, 60)),
                        suggest(*text, map_format().words("names")));
}

void MapReader::read_sides() {
  const yaml::Node* sides = root_.find("sides");
  if (!sides) return;
  if (!sides->is_map() || sides->entries.size() < 2) {
    diagnostics_.report(codes::kBadSides, sides->span, "`sides` is a map of the sides' words",
                        "write `sides: {l: Left, r: Right}`");
    return;
  }
  for (const yaml::Node::Entry& entry : sides->entries) {
    MapSide side{entry.key, read_texts(entry.value, "sides", diagnostics_)};
    if (is_name(side.key) && !side.words.empty())
      map_.sides.push_back(std::move(side));
    else
      diagnostics_.report(codes::kBadSides, entry.key_span,
                          fmt::format("\"{}\" is no side with a word", printable(entry.key, 60)),
                          "write `sides: {l: Left, r: Right}`");
  }
}

void MapReader::read_head() {
  if (const yaml::Node* name = root_.find("map"))
    map_.name = yaml::as_name(*name, "map", diagnostics_).value_or("");
  else
    diagnostics_.report(codes::kMissingKey, root_.span, "a map needs `map: NAME`");
  if (const yaml::Node* title = root_.find("title"))
    map_.title = yaml::as_text(*title, "title", diagnostics_).value_or("");
  if (const yaml::Node* prefixes = root_.find("prefixes"))
    map_.prefixes = read_texts(*prefixes, "prefixes", diagnostics_);
  if (const yaml::Node* suffixes = root_.find("suffixes"))
    map_.suffixes = read_texts(*suffixes, "suffixes", diagnostics_);
  if (const yaml::Node* ignore = root_.find("ignore"))
    for (const std::string& phrase : read_texts(*ignore, "ignore", diagnostics_)) {
      map_.ignored.push_back(words_of(phrase));
      for (std::string& word : map_.ignored.back()) word = normal_number(word);
    }
  if (const yaml::Node* required = root_.find("requires"))
    for (const yaml::Node& item : required->items)
      map_.required.push_back(read_texts(item, "requires", diagnostics_));
}

/// Names of one bone, each for every word of the side.
std::vector<std::string> MapReader::bones(const yaml::Node& node, const std::string& key,
                                          const MapSide* side) {
  std::vector<std::string> out;
  for (const std::string& text : read_texts(node, key, diagnostics_)) {
    if (!side || !contains(text, kBoneSide)) {
      out.push_back(text);
      continue;
    }
    // Words are compared by what side they say, so one of them is enough.
    const std::size_t count = map_.names == Map::Names::words ? 1 : side->words.size();
    for (std::size_t i = 0; i < count; ++i)
      out.push_back(replaced(text, kBoneSide, side->words[i]));
  }
  return out;
}

/// A line for both sides says so in its key and in every name.
bool MapReader::check_sides(const yaml::Node::Entry& entry) {
  const bool two_sided = contains(entry.key, kKeySide);
  if (two_sided && map_.sides.empty()) {
    diagnostics_.report(codes::kBadSides, entry.key_span, "{s} stands in a map without `sides`",
                        "write `sides: {l: Left, r: Right}`");
    return false;
  }
  bool good = true;
  const auto check = [&](const yaml::Node& node) {
    if (!node.is_scalar() || contains(node.text, kBoneSide) == two_sided) return;
    good = false;
    diagnostics_.report(
        codes::kBadSides, node.span,
        two_sided ? fmt::format("\"{}\" would be the bone of both sides", printable(node.text, 60))
                  : "{side} stands in a line whose key has no {s}",
        "a line for both sides is `arm_{s}.elbow: \"{side}ForeArm\"`");
  };
  check(entry.value);
  for (const yaml::Node& item : entry.value.items) {
    check(item);
    for (const yaml::Node& inner : item.items) check(inner);
  }
  return good;
}

void MapReader::add(MapEntry entry, const std::string& key) {
  if (map_.find(entry.local, entry.label)) {
    diagnostics_.report(codes::kMapEntryTwice, entry.span,
                        fmt::format("the map has {} twice", printable(key, 60)),
                        "a line with {s} stands for one of each side");
    return;
  }
  map_.entries.push_back(std::move(entry));
}

void MapReader::read_entry(const yaml::Node::Entry& entry, const MapSide* side) {
  const std::string key = side ? replaced(entry.key, kKeySide, side->key) : entry.key;
  MapEntry read;
  read.span = entry.key_span;
  const std::size_t dot = key.find('.');
  read.local = key.substr(0, dot);
  if (dot != std::string::npos) read.label = key.substr(dot + 1);
  if (!is_name(read.local) || (dot != std::string::npos && !is_name(read.label))) {
    diagnostics_.report(codes::kBadMapEntry, entry.key_span,
                        fmt::format("\"{}\" is neither GROUP.LABEL nor GROUP", printable(key, 60)));
    return;
  }
  if (entry.value.is_null()) {
    read.absent = true;
  } else if (read.label.empty() && entry.value.is_sequence()) {
    for (const yaml::Node& item : entry.value.items) read.bones.push_back(bones(item, key, side));
  } else {
    read.bones.push_back(bones(entry.value, key, side));
  }
  add(std::move(read), key);
}

void MapReader::read_joints() {
  const yaml::Node* joints = root_.find("joints");
  if (!joints) {
    diagnostics_.report(codes::kMissingKey, root_.span, "a map needs `joints:`");
    return;
  }
  if (!joints->is_map()) {
    diagnostics_.report(codes::kBadMapEntry, joints->span, "`joints` is a map",
                        "write `group.label: Bone`");
    return;
  }
  for (const yaml::Node::Entry& entry : joints->entries) {
    if (!check_sides(entry)) continue;
    if (!contains(entry.key, kKeySide))
      read_entry(entry, nullptr);
    else
      for (const MapSide& side : map_.sides) read_entry(entry, &side);
  }
}

Map MapReader::run() {
  read_names();
  read_sides();
  read_head();
  read_joints();
  return std::move(map_);
}

}  // namespace

std::optional<Map> read_map(std::uint32_t file, Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.errors();
  const auto root = yaml::read(file, diagnostics);
  if (!root) return std::nullopt;
  if (!yaml::check_section(*root, map_format(), diagnostics) && !root->is_map())
    return std::nullopt;
  Map map = MapReader(*root, diagnostics).run();
  if (diagnostics.errors() != errors_before) return std::nullopt;
  return map;
}

}  // namespace rigc::templates
