// SPDX-License-Identifier: MIT
// What the tests of src/templates share.
#include "templates/templates_helpers.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "base/files.h"
#include "base/json.h"

namespace rigc::templates::testing {

const catalog::Catalogue& catalogue() {
  static const catalog::Catalogue kCatalogue;
  return kCatalogue;
}

Folder::Folder(const std::string& name) : path_(std::string(RIGC_TEST_OUT) + "/templates_" + name) {
  std::filesystem::remove_all(path_);
  std::filesystem::create_directories(path_);
}

std::string Folder::write(const std::string& name, const std::string& text) const {
  const std::filesystem::path path = std::filesystem::path(path_) / name;
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
  return path.string();
}

std::string with_head(const std::string& rest, const std::string& name) {
  return "rigc: 1\nname: " + name + "\nversion: 1\n" + rest;
}

std::optional<Template> read_text(const std::string& text, Diagnostics& diagnostics) {
  return read(diagnostics.sources().add("case.yaml", text), catalogue(), diagnostics);
}

std::optional<Expanded> expand_file(const std::string& path, Diagnostics& diagnostics,
                                    const std::vector<std::string>& folders) {
  Library library(folders, catalogue());
  const Template* main = library.open(path, diagnostics);
  if (!main) return std::nullopt;
  return expand(*main, library, catalogue(), diagnostics);
}

std::optional<Expanded> expand_text(const std::string& text, Diagnostics& diagnostics) {
  const auto main = read_text(text, diagnostics);
  if (!main) return std::nullopt;
  Library library({}, catalogue());
  return expand(*main, library, catalogue(), diagnostics);
}

std::optional<tags::TaggedSkeleton> place_text(const std::string& text, Diagnostics& diagnostics) {
  const auto expanded = expand_text(text, diagnostics);
  if (!expanded) return std::nullopt;
  return place(*expanded, diagnostics);
}

std::vector<int> numbers(const Diagnostics& diagnostics) {
  std::vector<int> found;
  for (const Diagnostic& diagnostic : diagnostics.all()) found.push_back(diagnostic.code->number);
  return found;
}

std::size_t joint_named(const tags::TaggedSkeleton& skeleton, const std::string& name) {
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i)
    if (skeleton.joints[i].name == name) return i;
  FAIL("no joint ", name);
  return 0;
}

std::string template_folder() { return std::string(RIGC_SOURCE_DIR) + "/templates"; }
std::string biped_path() { return template_folder() + "/biped.yaml"; }

namespace {

std::string corpus() {
  if (const char* folder = std::getenv("RIGC_CORPUS")) return folder;
  return std::string(RIGC_SOURCE_DIR) + "/../shared/corpus";
}

std::uint32_t little_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  return value;
}

/// A 4 x 4 float matrix in columns.
math::Affine affine_at(const std::string& bytes, std::size_t at) {
  double m[16];
  for (std::size_t i = 0; i < 16; ++i) {
    const std::uint32_t bits = little_endian(bytes, at + 4 * i);
    float value = 0;
    std::memcpy(&value, &bits, 4);
    m[i] = static_cast<double>(value);
  }
  return {{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}}, {m[12], m[13], m[14]}};
}

}  // namespace

std::optional<tags::ForeignSkeleton> read_xbot() {
  std::ifstream file(corpus() + "/mixamo_Xbot_blender/Xbot.glb", std::ios::binary);
  if (!file) return std::nullopt;
  const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const std::size_t length = little_endian(bytes, 12);
  Diagnostics diagnostics;
  const auto document = json::parse(bytes.substr(20, length), "Xbot.glb", 20, diagnostics);
  REQUIRE(document);
  const json::Value root = document->root();
  const auto nodes = root["nodes"].items();
  const json::Value skin = root["skins"].items()[0];
  const auto number = [](const json::Value& v) {
    return static_cast<std::size_t>(v.integer().value_or(0));
  };
  const json::Value accessor = root["accessors"].items()[number(skin["inverseBindMatrices"])];
  const json::Value view = root["bufferViews"].items()[number(accessor["bufferView"])];
  const std::size_t start =
      20 + length + 8 + number(view["byteOffset"]) + number(accessor["byteOffset"]);

  tags::ForeignSkeleton model;
  std::map<std::size_t, int> joint_of;
  const auto joints = skin["joints"].items();
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const std::size_t node = number(joints[i]);
    tags::ForeignJoint joint;
    joint.node = static_cast<int>(node);
    joint.name = nodes[node]["name"].string().value_or("");
    joint.in_skin = true;
    joint.rest = inverse(affine_at(bytes, start + 64 * i));
    joint_of[node] = static_cast<int>(i);
    model.joints.push_back(joint);
  }
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const json::Value& child : nodes[i]["children"].items())
      if (joint_of.contains(i) && joint_of.contains(number(child)))
        model.joints[static_cast<std::size_t>(joint_of[number(child)])].parent = joint_of[i];
  return model;
}

}  // namespace rigc::templates::testing
