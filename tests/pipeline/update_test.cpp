// SPDX-License-Identifier: MIT
// Update of one file: keys, values, identities, orphans.
#include "pipeline/update.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>

#include "base/files.h"
#include "pipeline/bake_file.h"
#include "pipeline/character_helpers.h"
#include "pipeline/codes.h"
#include "pipeline/named_edits_helpers.h"
#include "pipeline/shot_helpers.h"
#include "pipeline/update_codes.h"

namespace rigc {
namespace {

using test::differences;
using test::Shot;

/// A limb of three joints with FK controls; `body` are further tags of the first.
std::string limb(int version, const std::string& more = "") {
  return fmt::format(R"(rigc: 1
name: limb
version: {}
joints:
  - name: base
    at: [0, 0, 0]
    local: body
    label: base
    tags:
      - command: control
        with: {{size: 0.4}}
  - name: upper
    parent: base
    at: [0, 1, 0]
    local: arm
    label: shoulder
    tags:
      - command: fk_chain
        with: {{joints: "arm[*]", size: 0.2}}
  - name: lower
    parent: upper
    at: [0.5, 1, -0.1]
    local: arm
    label: elbow
  - name: hand
    parent: lower
    at: [1, 1, 0]
    local: arm
    label: wrist
{})",
                     version, more);
}

struct Scenario {
  std::string folder, shot;
  Shot before, after;
  pipeline::FileResult result;

  explicit Scenario(const std::string& name) : folder(test::fresh_folder("update/" + name)) {
    shot = folder + "/shot.glb";
  }
  void build(const std::string& text, const std::string& file = "limb.yaml") const {
    test::write_text(folder + "/" + file, text);
    test::build_rig(folder + "/" + file, shot);
  }
  void update(const std::string& text, pipeline::UpdateSettings settings = {},
              const std::string& file = "limb.yaml") {
    test::write_text(folder + "/" + file, text);
    before = test::read_shot(shot);
    result = test::update(shot, folder, std::move(settings));
    after = test::read_shot(shot);
  }
  std::size_t orphans() const {
    std::size_t count = 0;
    for (const gltf::Rig& rig : after.rigs) count += rig.orphans.size();
    return count;
  }
};

}  // namespace

TEST_CASE("update: a file whose template has not changed is not touched") {
  Scenario s("same");
  s.build(limb(1));
  test::animate(s.shot, 1);
  const std::string bytes = test::bytes_of(s.shot);
  s.update(limb(1));
  CHECK(s.result.outcome == pipeline::FileResult::Outcome::unchanged);
  CHECK(test::bytes_of(s.shot) == bytes);
}

TEST_CASE("update: a new version with the same content keeps every key and plays bit for bit") {
  Scenario s("version");
  s.build(limb(1));
  test::animate(s.shot, 2);
  s.update(limb(2));
  CHECK(s.result.outcome == pipeline::FileResult::Outcome::changed);
  CHECK(s.after.rigs.front().skeleton.templates.front().version == 2);
  CHECK(differences(test::keys_of(s.before), test::keys_of(s.after)) == "");
  bool exact = false;
  CHECK(test::motion_difference(s.before, s.after, "", &exact) == 0);
  CHECK(exact);
  CHECK(s.after.rigs.front().nodes == s.before.rigs.front().nodes);
}

TEST_CASE("update: keys of a removed control become orphans and come back with it") {
  Scenario s("orphans");
  s.build(limb(1));
  test::animate(s.shot, 3, {2, 1.0, 1.0, 5});
  const Shot original = test::read_shot(s.shot);
  std::string without = limb(2);
  const std::size_t from = without.find("    tags:\n      - command: fk_chain");
  without.erase(from, without.find("  - name: lower") - from);
  s.update(without);
  CHECK(s.orphans() == 3);
  CHECK(differences(test::keys_of(original), test::keys_of(s.after)) == "");
  s.update(limb(3));
  CHECK(s.orphans() == 0);
  CHECK(differences(test::keys_of(original), test::keys_of(s.after)) == "");
  bool exact = false;
  CHECK(test::motion_difference(original, s.after, "", &exact) == 0);
  CHECK(exact);
}

TEST_CASE("update: a file that needs nothing is passed on where another output is asked for") {
  Scenario s("passed_on");
  s.build(limb(1));
  pipeline::UpdateSettings settings;
  settings.paths.templates = {s.folder};
  Diagnostics diagnostics;
  const auto updater = pipeline::Updater::make(settings, diagnostics);
  REQUIRE(updater);
  const std::string other = s.folder + "/other.glb";
  const auto result = updater->update({s.shot, other, ""}, diagnostics);
  CHECK(result.outcome == pipeline::FileResult::Outcome::unchanged);
  CHECK(test::bytes_of(other) == test::bytes_of(s.shot));
  updater->update({s.shot, s.folder + "/other.txt", ""}, diagnostics);
  CHECK(diagnostics.all().back().code == &pipeline::codes::kUnknownFormat);
}

TEST_CASE("update: keys that a bake put on joints are said to be of the old rig") {
  Scenario s("baked");
  s.build(limb(1));
  test::animate(s.shot, 4);
  pipeline::BakeRequest bake;
  bake.file = s.shot;
  bake.keep_rig = true;
  Diagnostics diagnostics;
  REQUIRE(pipeline::bake_file(bake, s.shot, diagnostics));
  std::string moved = limb(2);
  const std::string at = "at: [0.5, 1, -0.1]";
  moved.replace(moved.find(at), at.size(), "at: [0.5, 1, -0.2]");
  test::write_text(s.folder + "/limb.yaml", moved);
  pipeline::UpdateSettings settings;
  settings.paths.templates = {s.folder};
  for (const bool take : {false, true}) {
    CAPTURE(take);
    settings.take_skeleton = take;
    settings.plan = true;
    Diagnostics said;
    const auto updater = pipeline::Updater::make(settings, said);
    REQUIRE(updater);
    updater->update({s.shot, s.shot, ""}, said);
    CHECK(said.ok());
    const bool stale = std::any_of(said.all().begin(), said.all().end(), [](const auto& one) {
      return one.code == &pipeline::codes::kStaleBake;
    });
    CHECK(stale == take);
  }
}

}  // namespace rigc
