// SPDX-License-Identifier: MIT
// The order of the checks, their shared lookups, and the checks of small things.
// Test: tests/gltf/file_test.cpp
#include "gltf/check.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "gltf/codes.h"

namespace rigc::gltf {
namespace {

constexpr const char* kArrays[] = {"accessors", "animations", "bufferViews", "buffers", "cameras",
                                   "images",    "materials",  "meshes",      "nodes",   "samplers",
                                   "scenes",    "skins",      "textures"};

/// Memory that an element of an array takes while it is read, at least. Elements take 3 bytes in a
/// hostile file.
struct Cost {
  const char* array;
  std::uint64_t bytes;
};
constexpr Cost kCosts[] = {{"nodes", 400},     {"skins", 200},       {"animations", 250},
                           {"accessors", 250}, {"bufferViews", 100}, {"buffers", 200},
                           {"scenes", 50},     {"meshes", 50}};
/// Together with the program, text and values stay below 100 MB and four times the file.
constexpr std::uint64_t kFreeMemory = 56'000'000;

/// A pointer costs a step for each sibling; a hostile file has millions of errors among millions.
constexpr std::size_t kMostPointers = 200;

/// `2.1` as 2001; nothing for other texts.
std::optional<int> version_number(const json::Value& value) {
  const auto text = value.string();
  if (!text) return std::nullopt;
  const auto parts = split(*text, '.');
  if (parts.size() != 2) return std::nullopt;
  const auto major = parse_integer(parts[0]);
  const auto minor = parse_integer(parts[1]);
  if (!major || !minor || *major < 0 || *major > 99 || *minor < 0 || *minor > 99)
    return std::nullopt;
  return static_cast<int>(*major * 1000 + *minor);
}

bool check_counts(const File& file, Diagnostics& diagnostics) {
  const std::uint64_t most = kFreeMemory + 3 * file.json.text().size();
  const std::uint64_t values = 32 * file.json.size();
  std::uint64_t room = most - std::min(most, values);
  if (file.bin) room += 4 * file.bin->size();  // which is not in memory
  for (const Cost& cost : kCosts) {
    const std::uint64_t count = file.root()[cost.array].size();
    if (count > room / cost.bytes) {
      diagnostics.report(codes::kTooMany, Place(file.path, fmt::format("/{}", cost.array)),
                         fmt::format("{} elements of \"{}\"", count, cost.array));
      return false;
    }
    room -= count * cost.bytes;
  }
  return true;
}

void check_asset(const File& file, Check& check) {
  const json::Value asset = file.root()["asset"];
  const auto version = version_number(asset["version"]);
  if (!version || *version / 1000 != 2) {
    if (const json::Value at = asset["version"])
      check.report(codes::kAssetVersion, at,
                   fmt::format("asset.version is {}, not 2.0", printable(at.text(), 40)));
    else
      check.report(codes::kAssetVersion, Place(file.path, "/asset"),
                   "asset.version is missing: this is no glTF 2.0 file");
  }
  const json::Value least = asset["minVersion"];
  if (least && version_number(least).value_or(9999) > 2000)
    check.report(codes::kAssetVersion, least,
                 fmt::format("the file asks for glTF {}", printable(least.text(), 40)));
}

/// Members of the root that a rig is written into.
void check_extensions(const File& file, Check& check) {
  const json::Value extensions = file.root()["extensions"];
  if (extensions && !extensions.is_object())
    check.report(codes::kWrongType, extensions, "\"extensions\" is not an object");
  for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
    const json::Value names = file.root()[key];
    if (names && !names.is_array())
      check.report(codes::kWrongType, names, fmt::format("\"{}\" is not an array", key));
    for (const json::Value& name : names.items())
      if (!name.is_string())
        check.report(codes::kWrongType, name, "the name of an extension is not a string");
  }
}

/// The bones that VRM extensions name; -1 is how some writers say that there is none.
void check_humanoid(const File& file, Check& check) {
  const json::Value extensions = file.root()["extensions"];
  for (const char* extension : {"VRMC_vrm", "VRM", "VRMC_vrm_animation"}) {
    const json::Value table = extensions[extension]["humanoid"]["humanBones"];
    std::vector<json::Value> bones = table.items();
    for (const auto& [name, bone] : table.members()) bones.push_back(bone);
    for (const json::Value& bone : bones)
      if (const json::Value node = bone["node"]; node && node.integer() != -1)
        check.in_range(node, "nodes");
  }
}

void check_meshes(Check& check) {
  for (const json::Value& mesh : check.elements("meshes")) {
    for (const json::Value& primitive : check.objects(mesh, "primitives")) {
      check.index(primitive, "indices", "accessors");
      check.index(primitive, "material", "materials");
      for (const auto& [name, value] : primitive["attributes"].members())
        check.in_range(value, "accessors");
      for (const json::Value& target : check.objects(primitive, "targets"))
        for (const auto& [name, value] : target.members()) check.in_range(value, "accessors");
    }
  }
  for (const json::Value& image : check.elements("images"))
    check.index(image, "bufferView", "bufferViews");
}

}  // namespace

Check::Check(const File& file, Diagnostics& diagnostics) : file_(file), diagnostics_(diagnostics) {
  for (const char* name : kArrays) arrays_[name] = objects(file.root(), name);
  for (const json::Value& value : elements("accessors"))
    accessors_.push_back(
        {value["count"].integer().value_or(0), value["componentType"].integer().value_or(0),
         value["type"].string().value_or(""), value["normalized"].boolean().value_or(false)});
  for (const json::Value& value : elements("bufferViews"))
    views_.push_back(
        {value["byteLength"].integer().value_or(0), value["byteStride"].integer().value_or(0)});
}

const std::vector<json::Value>& Check::elements(std::string_view array) const {
  return arrays_.find(array)->second;
}

void Check::report(const Code& code, Place place, std::string message, std::string hint) {
  diagnostics_.report(code, std::move(place), std::move(message), std::move(hint));
}

void Check::report(const Code& code, const json::Value& at, std::string message, std::string hint) {
  Place place(file_.path);
  if (diagnostics_.errors() < kMostPointers) place.pointer = at.pointer();
  report(code, std::move(place), std::move(message), std::move(hint));
}

std::vector<json::Value> Check::objects(const json::Value& object, std::string_view key) {
  const json::Value value = object[key];
  if (!value) return {};
  if (!value.is_array()) {
    report(codes::kWrongType, value, fmt::format("\"{}\" is not an array", key));
    return {};
  }
  std::vector<json::Value> items = value.items();
  for (const json::Value& item : items)
    if (!item.is_object())
      report(codes::kWrongType, item, fmt::format("an element of \"{}\" is not an object", key));
  return items;
}

std::optional<std::int64_t> Check::whole(const json::Value& object, std::string_view key,
                                         std::int64_t least, bool required) {
  const json::Value value = object[key];
  if (!value) {
    if (required) report(codes::kMissing, object, fmt::format("\"{}\" is missing", key));
    return std::nullopt;
  }
  const auto number = value.integer();
  if (!number) {
    report(codes::kWrongType, value,
           fmt::format("\"{}\" is {}, not an integer", key, printable(value.text(), 40)));
  } else if (*number < least) {
    report(codes::kValue, value, fmt::format("\"{}\" is {}, below {}", key, *number, least));
    return std::nullopt;
  }
  return number;
}

std::optional<std::size_t> Check::in_range(const json::Value& value, std::string_view array) {
  const std::size_t count = elements(array).size();
  const auto number = value.integer();
  if (!number) {
    report(codes::kWrongType, value,
           fmt::format("{} is not an index into {}", printable(value.text(), 40), array));
    return std::nullopt;
  }
  if (*number < 0 || static_cast<std::uint64_t>(*number) >= count) {
    report(codes::kIndex, value,
           fmt::format("\"{}\" has no element {}: it has {}", array, *number, count));
    return std::nullopt;
  }
  return static_cast<std::size_t>(*number);
}

std::optional<std::size_t> Check::index(const json::Value& object, std::string_view key,
                                        std::string_view array, bool required) {
  const json::Value value = object[key];
  if (value) return in_range(value, array);
  if (required) report(codes::kMissing, object, fmt::format("\"{}\" is missing", key));
  return std::nullopt;
}

std::vector<std::size_t> Check::indices(const json::Value& object, std::string_view key,
                                        std::string_view array) {
  std::vector<std::size_t> result;
  const json::Value list = object[key];
  if (list && !list.is_array())
    report(codes::kWrongType, list, fmt::format("\"{}\" is not an array", key));
  for (const json::Value& item : list.items())
    if (const auto number = in_range(item, array)) result.push_back(*number);
  return result;
}

std::optional<std::string> Check::word(const json::Value& object, std::string_view key,
                                       std::initializer_list<std::string_view> allowed,
                                       bool required) {
  const json::Value value = object[key];
  if (!value) {
    if (required) report(codes::kMissing, object, fmt::format("\"{}\" is missing", key));
    return std::nullopt;
  }
  const auto text = value.string();
  for (const std::string_view candidate : allowed)
    if (text == candidate) return text;
  report(
      codes::kValue, value,
      fmt::format("\"{}\" is {}, which glTF 2.0 does not know", key, printable(value.text(), 40)),
      suggest(text.value_or(""), {allowed.begin(), allowed.end()}));
  return std::nullopt;
}

void check(const File& file, Diagnostics& diagnostics) {
  if (!file.root().is_object()) {
    // The root has no pointer to show. JSON begins behind two headers in a .glb.
    const std::size_t at = file.root().begin() + (file.binary ? 20 : 0);
    diagnostics.report(codes::kWrongType, Place::at_byte(file.path, at),
                       "the JSON is not an object");
    return;
  }
  if (!check_counts(file, diagnostics)) return;
  Check context(file, diagnostics);
  check_asset(file, context);
  check_extensions(file, context);
  context.index(file.root(), "scene", "scenes");
  check_nodes(context);
  check_skins(context);
  check_meshes(context);
  check_buffer_views(context);
  check_accessors(context);
  check_animations(context);
  check_humanoid(file, context);
}

}  // namespace rigc::gltf
