// SPDX-License-Identifier: MIT
// Real characters carry a rig through updates: what is theirs stays as it came, byte for byte, and
// the rig's motion goes on. Without the corpus there is nothing to test, and a message says so.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>

#include "base/text.h"
#include "gltf/rig.h"
#include "pipeline/build.h"
#include "pipeline/character_helpers.h"
#include "pipeline/named_edits_helpers.h"
#include "support/corpus.h"

namespace rigc {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using test::Shot;
using test::Story;

/// A node without what a rig may add to it.
ordered_json model_part(ordered_json node, const ordered_json& model) {
  if (!model.contains("extras") || !model["extras"].contains("rigc"))
    if (node.contains("extras")) node["extras"].erase("rigc");
  if (!model.contains("extras") && node.contains("extras") && node["extras"].empty())
    node.erase("extras");
  if (!node.contains("children")) return node;
  ordered_json& children = node["children"];
  const std::size_t count = model.contains("children") ? model["children"].size() : 0;
  while (children.size() > count) children.erase(children.size() - 1);
  if (count == 0 && !model.contains("children")) node.erase("children");
  return node;
}

bool is_shared(const std::string& key) {
  return key == "nodes" || key == "scenes" || key == "extensionsUsed" || key == "extensions" ||
         key == "buffers";
}

/// What a model has is in its shot, and in the updated one in the same letters: nodes apart, which
/// get children and an identity.
void check_elements(const ordered_json& model, const gltf::File& shot, const gltf::File& file) {
  for (auto at = model.begin(); at != model.end(); ++at) {
    const json::Value before = shot.root()[at.key()], after = file.root()[at.key()];
    if (is_shared(at.key())) continue;
    if (!at.value().is_array()) {
      CHECK(before.text() == after.text());
      CHECK(ordered_json::parse(after.text()) == at.value());
      continue;
    }
    INFO(at.key());
    const auto was = before.items(), is = after.items();
    REQUIRE(is.size() >= at.value().size());
    std::size_t different = 0;
    for (std::size_t i = 0; i < at.value().size(); ++i)
      if (was[i].text() != is[i].text() || ordered_json::parse(is[i].text()) != at.value()[i])
        ++different;
    CHECK(different == 0);
  }
  for (const auto& [name, value] : shot.root()["extensions"].members())
    if (name != "RIGC_rig") CHECK(value.text() == file.root()["extensions"][name].text());
}

void check_nodes(const test::Character& model, const test::Character& file) {
  const ordered_json &before = model.json["nodes"], &after = file.json["nodes"];
  REQUIRE(after.size() >= before.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    if (model_part(after[i], before[i]) != before[i]) ++different;
  CHECK(different == 0);
  const ordered_json &scenes = model.json["scenes"], &now = file.json["scenes"];
  REQUIRE(scenes.size() == now.size());
  for (std::size_t i = 0; i < scenes.size(); ++i)
    for (std::size_t k = 0; k < scenes[i]["nodes"].size(); ++k)
      CHECK(scenes[i]["nodes"][k] == now[i]["nodes"][k]);
}

void check_model(const std::string& model, const Shot& shot, const std::string& path) {
  Diagnostics diagnostics;
  const auto after = gltf::open(path, diagnostics);
  REQUIRE(after);
  const test::Character a = test::load_character(model), b = test::load_character(path);
  const auto text = gltf::open(model, diagnostics);
  REQUIRE(text);
  check_elements(ordered_json::parse(text->json.text()), *shot.file, *after);
  check_nodes(a, b);
  CHECK(b.bin.size() >= a.bin.size());
  CHECK(b.bin.compare(0, a.bin.size(), a.bin) == 0);
}

/// Bones and places of the joints that a rig was fitted to.
struct Bone {
  int node = -1;
  math::Trs rest;
  bool operator==(const Bone&) const = default;
};
std::map<JointKey, Bone> bones_of(const gltf::Rig& rig) {
  std::map<JointKey, Bone> out;
  for (const tags::TaggedJoint& joint : rig.skeleton.joints)
    out[joint.key] = {joint.foreign_node, joint.rest};
  return out;
}

/// A new version that a rigger would make: another control, wider controls of the arms.
std::vector<test::TextEdit> edits() {
  return {{"biped.yaml", "      - feature: proxy\n",
           "      - command: control\n        id: floor\n"
           "        with: {shape: square, size: 2, drive: off}\n      - feature: proxy\n"},
          {"biped.yaml", "root: root}, with: {fingers: 5}}",
           "root: root}, with: {fingers: 5, size: 0.2}}"}};
}

}  // namespace

TEST_CASE("carriers: every humanoid of the corpus keeps what is its own through updates") {
  std::size_t carried = 0, with_clips = 0;
  for (const test::Humanoid& humanoid : test::humanoids()) {
    const std::string model = test::corpus_file(humanoid.file);
    if (model.empty()) continue;
    INFO(humanoid.file);
    Story s("carrier_" + std::to_string(carried++));
    test::write_biped(s.folder, 1);
    pipeline::BuildRequest request;
    request.template_file = s.folder + "/biped.yaml";
    request.paths.templates = {test::templates_folder()};
    request.model = model;
    request.map = test::user_map(humanoid);
    Diagnostics diagnostics;
    REQUIRE_MESSAGE(pipeline::build(request, s.shot, diagnostics), render(diagnostics, false));
    with_clips += test::read_shot(s.shot).clips.empty() ? 0 : 1;
    test::animate(s.shot, static_cast<unsigned>(carried), {2, 0.4, 0.2, 5});
    test::made_from(s.shot, model);
    s.original = test::read_shot(s.shot);

    test::write_biped(s.folder, 2, edits());
    s.update();
    CHECK(s.orphans() == 0);
    CHECK(s.rules() == "");
    const gltf::Rig &before = s.before.rigs.front(), &after = s.after.rigs.front();
    CHECK(after.skeleton.templates.front().version == 2);
    const auto bones = bones_of(before);
    CHECK(bones == bones_of(after));
    CHECK(before.ancestor == after.ancestor);
    bool exact = false;
    CHECK(test::motion_difference(s.before, s.after, "", &exact) == 0);
    CHECK(exact);
    const auto report = nlohmann::json::parse(s.result.json)["rigs"][0];
    CHECK(report["controls_added"] == nlohmann::json::array({"root.root/control#floor.control"}));
    CHECK(report["largest_mm"] == 0);
    CHECK(report["clips"].size() >= 3);
    check_model(model, s.original, s.shot);

    const auto high_water = fs::file_size(s.shot);
    test::write_biped(s.folder, 3);
    s.update();
    CHECK(s.orphans() == 0);
    CHECK(bones == bones_of(s.after.rigs.front()));
    CHECK(test::differences(test::keys_of(s.original), test::keys_of(s.after)) == "");
    CHECK(test::motion_difference(s.original, s.after, "", &exact) == 0);
    CHECK(exact);
    check_model(model, s.original, s.shot);
    CHECK(fs::file_size(s.shot) <= high_water);
  }
  if (carried == 0) {
    MESSAGE("the corpus is absent: nothing was carried");
    return;
  }
  CHECK(carried == test::humanoids().size());
  CHECK(with_clips > 0);
}

}  // namespace rigc
