// SPDX-License-Identifier: MIT
// Stories of a shot whose template is edited.
#include "pipeline/named_edits_helpers.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/text.h"
#include "pipeline/character_helpers.h"

namespace rigc::test {

namespace fs = std::filesystem;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE_MESSAGE(at != std::string::npos, from);
  return text.replace(at, from.size(), to);
}

void write_biped(const std::string& folder, int version, const std::vector<TextEdit>& edits) {
  const fs::path source = templates_folder();
  fs::create_directories(folder + "/parts");
  for (const auto& entry : fs::directory_iterator(source / "parts"))
    write_text(folder + "/parts/" + entry.path().filename().string(),
               bytes_of(entry.path().string()));
  write_text(folder + "/biped.yaml",
             replaced(bytes_of((source / "biped.yaml").string()), "\nversion: 1\n",
                      fmt::format("\nversion: {}\n", version)));
  for (const TextEdit& edit : edits) {
    const std::string path = folder + "/" + edit.file;
    write_text(path, replaced(bytes_of(path), edit.from, edit.to));
  }
}

std::string fk_arm(int version) {
  return fmt::format(R"(rigc: 1
name: story
version: {}
joints:
  - name: chest
    at: [0, 1.4, 0]
    local: body
    label: chest
    tags:
      - command: control
        with: {{size: 0.4}}
  - name: shoulder
    parent: chest
    at: [0.2, 1.4, 0]
    local: arm
    label: shoulder
    tags:
      - command: fk_chain
        with: {{joints: [arm.shoulder, arm.elbow, arm.wrist], size: 0.2}}
  - name: elbow
    parent: shoulder
    at: [0.5, 1.4, -0.04]
    local: arm
    label: elbow
  - name: wrist
    parent: elbow
    at: [0.8, 1.4, 0]
    local: arm
    label: wrist
)",
                     version);
}

std::string ik_fk_arm(int version) {
  return replaced(
      fk_arm(version),
      "fk_chain\n        with: {joints: [arm.shoulder, arm.elbow, arm.wrist], size: 0.2}",
      "ik_fk_limb\n        with: {start: arm.shoulder, middle: arm.elbow, end: "
      "arm.wrist, bend: backward}");
}

scene::NodeId control(const gltf::Rig& rig, const std::string& local, const std::string& label,
                      const std::string& role) {
  for (const scene::NodeId id : rig.scene.nodes()) {
    const scene::Node& node = rig.scene[id];
    if (node.kind == scene::Kind::control && node.ids.local == local && node.ids.label == label &&
        node.identity.role == role)
      return id;
  }
  FAIL("no control " << local << "." << label << " " << role);
  return {};
}

std::vector<TextEdit> without_clavicle() {
  const std::string arm = bytes_of(templates_folder() + "/parts/arm.yaml");
  const std::size_t from = arm.find("  - name: clavicle\n"), to = arm.find("  - name: shoulder\n");
  REQUIRE(from < to);
  return {{"parts/arm.yaml", arm.substr(from, to - from), ""},
          {"parts/arm.yaml", "    parent: clavicle\n", ""}};
}

Story::Story(const std::string& name) : folder(fresh_folder("named_edits/" + name)) {
  shot = folder + "/shot.glb";
}

void Story::build(const std::string& main, unsigned seed, const Animation& animation) {
  build_rig(folder + "/" + main, shot);
  animate(shot, seed, animation);
  original = read_shot(shot);
}

void Story::build_text(const std::string& text, unsigned seed, const Animation& animation) {
  write_text(folder + "/main.yaml", text);
  build("main.yaml", seed, animation);
}

void Story::update(pipeline::UpdateSettings settings) {
  before = read_shot(shot);
  result = test::update(shot, folder, std::move(settings));
  CHECK(result.outcome == pipeline::FileResult::Outcome::changed);
  after = read_shot(shot);
}

void Story::update_text(const std::string& text) {
  write_text(folder + "/main.yaml", text);
  update();
}

std::size_t Story::orphans() const {
  std::size_t count = 0;
  for (const gltf::Rig& rig : after.rigs) count += rig.orphans.size();
  return count;
}

std::string Story::rules() const {
  std::set<std::string> found;
  const auto report = nlohmann::json::parse(result.json);
  for (const auto& rig : report["rigs"])
    for (const auto& changed : rig["changed"])
      found.insert(changed["to"].is_null() ? "orphan" : changed["rule"].get<std::string>());
  return join({found.begin(), found.end()}, " ");
}

std::string differences(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  std::string out;
  std::vector<std::string> only;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(only));
  for (const std::string& line : only) out += "- " + line.substr(0, 160) + "\n";
  only.clear();
  std::set_difference(b.begin(), b.end(), a.begin(), a.end(), std::back_inserter(only));
  for (const std::string& line : only) out += "+ " + line.substr(0, 160) + "\n";
  return out;
}

}  // namespace rigc::test
