// SPDX-License-Identifier: MIT
// rigc update, rebuild, unbuild, strip and prune as people and scripts meet them: exit status, what
// is printed, what is written.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "cli/json_helpers.h"
#include "cli/process_helpers.h"

namespace fs = std::filesystem;
using rigc::test::file_text;
using rigc::test::json_at;
using rigc::test::Outcome;
using rigc::test::run_rigc;

namespace {

/// Two controls; the second belongs to a feature with a switch.
std::string lamp(int version, bool with_tip = true) {
  const std::string tip = R"(    tags:
      - feature: tips
        switch: lamps
        commands:
          - command: control
)";
  return "rigc: 1\nname: lamp\nversion: " + std::to_string(version) + R"(
features:
  tips: {kind: limb, title: Tips, switches: [lamps]}
  more: {kind: limb, title: More}
joints:
  - name: base
    at: [0, 1, 0]
    local: lamp
    label: base
    tags:
      - command: control
  - name: tip
    parent: base
    at: [0, 2, 0]
    local: lamp
    label: tip
)" + (with_tip ? tip : "");
}

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE_MESSAGE(at != std::string::npos, from);
  return text.replace(at, from.size(), to);
}

/// A folder with `studio/lamp.yaml` at version 1 and `shot.gltf`, whose tip was turned by hand.
struct Studio {
  fs::path folder;

  explicit Studio(const std::string& name, const std::vector<std::string>& options = {})
      : folder(rigc::test::fresh_folder(name)) {
    write(folder / "studio/lamp.yaml", lamp(1));
    std::vector<std::string> arguments = {"build", "studio/lamp.yaml", "-o", "shot.gltf"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome built = run_rigc(arguments, {folder, {}});
    REQUIRE_MESSAGE(built.status == 0, built.err);
  }
  Outcome run(std::vector<std::string> arguments) const {
    if (arguments.front() == "update") {
      arguments.emplace_back("--templates");
      arguments.emplace_back("studio");
    }
    return run_rigc(arguments, {folder, {}});
  }
  std::string shot() const { return file_text(folder / "shot.gltf"); }
  void turn_tip() const {
    write(folder / "shot.gltf", replaced(shot(), "\"name\":\"tip_control\"",
                                         "\"name\":\"tip_control\",\"rotation\":[0,0,0.6,0.8]"));
  }
};

const std::string kSkins = R"(,"skins":[{"joints":[0,1]}])";

/// A folder with `studio/lamp.yaml` at version 1 and `shot.gltf`: fitted to a model of two bones.
fs::path fitted_lamp(const std::string& name) {
  const fs::path folder = rigc::test::fresh_folder(name);
  write(folder / "studio/lamp.yaml", lamp(1));
  write(folder / "model.gltf",
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"name":"base",)"
        R"("translation":[0,1,0],"children":[1]},{"name":"tip","translation":[0,1,0]}])" +
            kSkins + "}");
  write(folder / "map.yaml", "map: mine\ntitle: Mine\njoints: {lamp.base: base, lamp.tip: tip}\n");
  const Outcome built = run_rigc({"build", "studio/lamp.yaml", "--model", "model.gltf", "--map",
                                  "map.yaml", "-o", "shot.gltf"},
                                 {folder, {}});
  REQUIRE_MESSAGE(built.status == 0, built.err);
  return folder;
}

}  // namespace

TEST_CASE("cli update: a shot moves to the new version and is then up to date") {
  const Studio s("update_shot");
  s.turn_tip();
  const Outcome same = s.run({"update", "shot.gltf"});
  CHECK(same.status == 0);
  CHECK(same.out == "shot.gltf: is up to date\n");
  CHECK(same.err.empty());

  write(s.folder / "studio/lamp.yaml", lamp(2));
  const std::string before = s.shot();
  const Outcome plan = s.run({"update", "shot.gltf", "--plan"});
  CHECK(plan.status == 0);
  CHECK(plan.out ==
        "shot.gltf: would be updated\n"
        "  lamp: lamp 1 -> 2\n"
        "    1 value without keys kept as they are\n"
        "    motion: the same, bit for bit (compared as it stands)\n");
  CHECK(s.shot() == before);

  const Outcome done = s.run({"update", "shot.gltf"});
  CHECK(done.status == 0);
  CHECK(done.out == replaced(plan.out, "would be updated", "updated"));
  CHECK(done.err.empty());
  CHECK(s.shot() != before);
  CHECK(s.run({"update", "shot.gltf"}).out == "shot.gltf: is up to date\n");
}

TEST_CASE("cli update: scripts get JSON, and the report on disk is the same") {
  const Studio s("update_json");
  s.turn_tip();
  write(s.folder / "studio/lamp.yaml", lamp(2, false));
  const Outcome done = s.run({"update", "shot.gltf", "--json", "--report", "report.json"});
  CHECK(done.status == 0);
  CHECK(rigc::test::is_json(done.out));
  CHECK(file_text(s.folder / "report.json") == done.out);
  CHECK(json_at(done.out, "/command") == "\"update\"");
  CHECK(json_at(done.out, "/files/0/outcome") == "\"changed\"");
  const std::string rig = "/files/0/rigs/0";
  CHECK(json_at(done.out, rig + "/from/version") == "1");
  CHECK(json_at(done.out, rig + "/to/version") == "2");
  CHECK(json_at(done.out, rig + "/controls_removed") == "[\"lamp.tip/control.control\"]");
  CHECK(json_at(done.out, rig + "/new_orphans") == "1");
  CHECK(json_at(done.out, rig + "/changed/0/from") == "\"lamp.tip/control.control@rotation\"");
  CHECK(json_at(done.out, rig + "/changed/0/to") == "null");
  CHECK(json_at(done.out, "/totals/changed") == "1");
}

TEST_CASE("cli update: what would be lost or moved can be refused") {
  const Studio s("update_refused");
  s.turn_tip();
  write(s.folder / "studio/lamp.yaml", lamp(2, false));
  const std::string before = s.shot();
  const Outcome strict = s.run({"update", "shot.gltf", "--strict"});
  CHECK(strict.status == 1);
  CHECK(strict.out.empty());
  CHECK(has(strict.err,
            "shot.gltf: error[RIG0881]: 1 property of rig \"lamp\" would lose the node that it "
            "keys or sets\n"));
  CHECK(has(strict.err, "lamp.tip/control.control@rotation"));
  CHECK(s.shot() == before);
  const Outcome moves = s.run({"update", "shot.gltf", "--tolerance", "0.5"});
  CHECK(moves.status == 0);  // the tip turns on the spot

  const Studio t("update_moves");
  write(t.folder / "shot.gltf", replaced(t.shot(), "\"name\":\"tip_control\"",
                                         "\"name\":\"tip_control\",\"translation\":[0,0.25,0]"));
  write(t.folder / "studio/lamp.yaml", lamp(2, false));
  const Outcome far = t.run({"update", "shot.gltf", "--tolerance", "0.5"});
  CHECK(far.status == 1);
  CHECK(has(far.err, "error[RIG0882]: tip of rig \"lamp\" moves by 250 mm without a clip\n"));
  CHECK(has(far.err, "--tolerance allows 0.5 mm"));
}

TEST_CASE("cli update: templates that are not there, or only older") {
  const Studio s("update_templates");
  fs::rename(s.folder / "studio/lamp.yaml", s.folder / "lamp.txt");
  const std::string before = s.shot();
  const Outcome lost = s.run({"update", "shot.gltf"});
  CHECK(lost.status == 1);
  CHECK(has(lost.err,
            "error[RIG0884]: rig \"lamp\" was made by template \"lamp\" version 1, which "
            "is in none of the template folders\n"));

  write(s.folder / "studio/lamp.yaml", lamp(3));
  CHECK(s.run({"update", "shot.gltf"}).status == 0);
  write(s.folder / "studio/lamp.yaml", lamp(2));
  const Outcome older = s.run({"update", "shot.gltf"});
  CHECK(older.status == 0);
  CHECK(has(older.err,
            "warning[RIG0885]: rig \"lamp\" was made by version 3 of template \"lamp\"; "
            "the newest found is 2\n"));
  CHECK(has(older.err, "--to lamp@2 goes back"));
  const Outcome back = s.run({"update", "shot.gltf", "--to", "lamp@2"});
  CHECK(back.status == 0);
  CHECK(has(back.out, "lamp 3 -> 2\n"));
}

TEST_CASE("cli update: parts that are not there, or only older") {
  const auto part = [](int version) {
    return "rigc: 1\nname: flag\nversion: " + std::to_string(version) +
           "\njoints: [{name: pole, at: [0, 0, 0], label: pole, tags: [{command: control}]}]\n";
  };
  const fs::path folder = rigc::test::fresh_folder("update_parts");
  const std::string main =
      "rigc: 1\nname: ship\nversion: 1\njoints: [{name: hull, at: [0, 0, 0], label: hull}]\n";
  const std::string with_flag = main + "parts: [{template: flag, as: flag, attach: hull}]\n";
  write(folder / "studio/ship.yaml", with_flag);
  write(folder / "studio/flag.yaml", part(3));
  const Outcome built = run_rigc({"build", "studio/ship.yaml", "-o", "shot.gltf"}, {folder, {}});
  REQUIRE_MESSAGE(built.status == 0, built.err);
  const std::string before = file_text(folder / "shot.gltf");
  const std::vector<std::string> update = {"update", "shot.gltf", "--templates", "studio"};
  CHECK(run_rigc(update, {folder, {}}).out == "shot.gltf: is up to date\n");

  write(folder / "studio/flag.yaml", part(2));
  const Outcome older = run_rigc(update, {folder, {}});
  CHECK(older.status == 0);
  CHECK(older.out == "shot.gltf: is left as it is\n");
  CHECK(has(older.err,
            "warning[RIG0885]: rig \"ship\" cannot be updated: made with part flag 3, but 2 is "
            "found\n"));
  CHECK(has(older.err, "--to ship@1 builds it with what there is"));

  fs::remove(folder / "studio/flag.yaml");
  const Outcome lost = run_rigc(update, {folder, {}});
  CHECK(lost.status == 1);
  CHECK(has(lost.err, "error[RIG0884]: rig \"ship\" cannot be updated: part flag is not found\n"));
  CHECK(file_text(folder / "shot.gltf") == before);

  // A part that somebody took out of the template is not missed.
  write(folder / "studio/ship.yaml", main);
  CHECK(has(run_rigc(update, {folder, {}}).out, "1 joint removed: flag_pole\n"));
}

TEST_CASE("cli update: modules that are not there, or only older") {
  const Studio s("update_modules");
  const std::string before = s.shot(), made = "\"modules\":[{\"name\":\"control\",\"version\":";
  write(s.folder / "shot.gltf", replaced(before, made, made + "99"));
  const Outcome older = s.run({"update", "shot.gltf"});
  CHECK(older.status == 0);
  CHECK(older.out == "shot.gltf: is left as it is\n");
  CHECK(has(older.err,
            "warning[RIG0885]: rig \"lamp\" cannot be updated: made by module control 99"));
  // A new version of the template does not help: keys are of the newer module.
  write(s.folder / "studio/lamp.yaml", lamp(2));
  CHECK(s.run({"update", "shot.gltf"}).out == "shot.gltf: is left as it is\n");
  CHECK(has(s.run({"update", "shot.gltf", "--to", "lamp@2"}).out, "shot.gltf: updated\n"));

  write(s.folder / "studio/lamp.yaml", lamp(1));
  write(s.folder / "shot.gltf", replaced(before, made, replaced(made, "control", "knob")));
  const Outcome lost = s.run({"update", "shot.gltf"});
  CHECK(lost.status == 1);
  CHECK(has(lost.err, "error[RIG0884]: rig \"lamp\" cannot be updated: there is no module knob\n"));
  write(s.folder / "studio/lamp.yaml", lamp(2));
  CHECK(has(s.run({"update", "shot.gltf"}).out, "shot.gltf: updated\n"));
}

TEST_CASE("cli update: a setting that the new version does not know is said") {
  const Studio s("update_setting", {"--feature", "more=off", "--feature", "tips:lamps=off"});
  write(s.folder / "studio/lamp.yaml",
        replaced(lamp(2), "  more: {kind: limb, title: More}\n", ""));
  const Outcome done = s.run({"update", "shot.gltf"});
  CHECK(done.status == 0);
  CHECK(has(done.err,
            "warning[RIG0886]: the new version has no \"more\", which rig \"lamp\" was "
            "built with a setting for\n"));
  CHECK_FALSE(has(s.shot(), "tip_control"));  // the other setting stays
}

TEST_CASE("cli update: a fitted rig whose skeleton is gone from the file") {
  const fs::path folder = fitted_lamp("broken/update_model_gone");
  write(folder / "shot.gltf", replaced(file_text(folder / "shot.gltf"), kSkins, ""));
  write(folder / "studio/lamp.yaml", lamp(2));
  const Outcome gone = run_rigc({"update", "shot.gltf", "--templates", "studio"}, {folder, {}});
  CHECK(gone.status == 1);
  CHECK(has(gone.err, "error[RIG0887]: no skeleton of the file has the joints of rig \"lamp\"\n"));
}

TEST_CASE("cli update: maps with mistakes are told where new joints need maps") {
  const fs::path folder = fitted_lamp("update_maps");
  write(folder / "studio/maps/mine.yaml", "map: mine\ntitle: [1]\n");
  write(folder / "studio/lamp.yaml", lamp(2));
  const std::vector<std::string> update = {"update", "shot.gltf", "--templates", "studio"};
  const Outcome same = run_rigc(update, {folder, {}});
  CHECK(same.status == 0);
  CHECK(same.err.empty());

  const std::string shade =
      "  - {name: shade, parent: tip, at: [0, 2.5, 0], local: lamp, label: shade}\n";
  write(folder / "studio/lamp.yaml", lamp(3) + shade);
  const Outcome wrong = run_rigc(update, {folder, {}});
  CHECK(wrong.status == 1);
  CHECK(has(wrong.err, "studio/maps/mine.yaml:2:"));
  // Two joints for one bone: the line of the map is told, not one of the template.
  write(folder / "studio/maps/mine.yaml",
        "map: mine\ntitle: Mine\n# comments\n# and\n# more\n"
        "joints:\n  lamp.base: base\n  lamp.tip: tip\n  lamp.shade: tip\n");
  const Outcome twice = run_rigc(update, {folder, {}});
  CHECK(twice.status == 1);
  CHECK(has(twice.err, "studio/maps/mine.yaml:9:3: error[RIG0345]"));
  write(folder / "studio/maps/mine.yaml",
        "map: mine\ntitle: Mine\njoints: {lamp.base: base, lamp.tip: tip, lamp.shade: ~}\n");
  CHECK(run_rigc(update, {folder, {}}).status == 0);
}

TEST_CASE("cli update: one of many files fails, the others are done") {
  const Studio s("broken/update_many");
  for (const char* name : {"a.gltf", "c.gltf"}) write(s.folder / "shots" / name, s.shot());
  for (const auto& entry : fs::directory_iterator(s.folder))
    if (entry.path().extension() == ".bin")
      fs::copy(entry.path(), s.folder / "shots" / entry.path().filename());
  write(s.folder / "shots/b.gltf", "{");
  write(s.folder / "shots/d.gltf", R"({"asset":{"version":"2.0"}})");
  write(s.folder / "studio/lamp.yaml", lamp(2));
  const Outcome done = s.run({"update", "shots", "--rig", "lamp", "--backup", "originals"});
  CHECK(done.status == 1);
  CHECK(has(done.out, "shots/a.gltf: updated\n"));
  CHECK(has(done.out, "shots/c.gltf: updated\n"));
  CHECK(has(done.out, "shots/d.gltf: has no rig\n"));
  CHECK(has(done.err, "b.gltf"));
  // Originals of those that changed, and of no other.
  std::size_t kept = 0;
  for (const auto& entry : fs::recursive_directory_iterator(s.folder / "originals")) {
    if (!entry.is_regular_file()) continue;
    ++kept;
    CHECK(file_text(entry.path()) == s.shot());
  }
  CHECK(kept == 2);
}

TEST_CASE("cli update: a rig is named") {
  const Studio s("update_rig");
  write(s.folder / "studio/lamp.yaml", lamp(2));
  const std::string before = s.shot();
  CHECK(s.run({"update", "shot.gltf", "--rig", "desk"}).out ==
        "shot.gltf: has no rig of that name\n");
  CHECK(s.shot() == before);
  CHECK(s.run({"update", "shot.gltf", "--rig", "lamp", "-o", "new.gltf"}).status == 0);
  CHECK(s.shot() == before);
  CHECK(fs::exists(s.folder / "new.gltf"));
}

TEST_CASE("cli update: wrong usage") {
  const Studio s("update_usage");
  CHECK(s.run({"update"}).status != 0);
  CHECK(s.run({"update", "shot.gltf", "--tolerance", "far"}).status == 2);
  CHECK(s.run({"update", "shot.gltf", "--nothing"}).status == 2);
  const Outcome absent = s.run({"update", "nowhere.glb"});
  CHECK(absent.status != 0);
  CHECK(has(absent.err, "nowhere.glb"));
  const Outcome no_template = s.run({"update", "shot.gltf", "--to", "torch"});
  CHECK(no_template.status == 1);
  CHECK(has(no_template.err, "torch"));
}

TEST_CASE("cli rebuild: there and back, with what waits in between") {
  const Studio s("rebuild");
  s.turn_tip();
  const std::string before = s.shot();
  const Outcome plan = s.run({"rebuild", "shot.gltf", "--feature", "tips=off", "--plan"});
  CHECK(plan.status == 0);
  CHECK(has(plan.out,
            "shot.gltf: would be changed\n  lamp: lamp 1 (built again)\n"
            "    1 control removed: lamp.tip/control.control\n"
            "    orphan: lamp.tip/control.control@rotation (value without keys)\n"));
  CHECK(s.shot() == before);
  const Outcome off = s.run({"rebuild", "shot.gltf", "--feature", "tips=off"});
  CHECK(off.status == 0);
  CHECK(off.out == replaced(plan.out, "would be changed", "built again"));
  CHECK(has(s.run({"inspect", "shot.gltf"}).out,
            "  orphan    lamp.tip/control.control: 0 channels, and without keys rotation\n"));
  const Outcome on = s.run({"rebuild", "shot.gltf", "--feature", "tips=on"});
  CHECK(on.status == 0);
  CHECK(
      has(on.out, "back: lamp.tip/control.control@rotation -> lamp.tip/control.control@rotation"));
  CHECK(has(s.shot(), "\"rotation\":[0,0,0.6,0.8]"));

  CHECK(s.run({"rebuild", "shot.gltf", "--report", "r.json"}).status == 0);
  CHECK(s.run({"rebuild", "shot.gltf", "--resume", "r.json"}).status == 0);
  const Outcome other = s.run({"rebuild", "shot.gltf", "--resume", "r.json", "--strict"});
  CHECK(has(other.err, "the report is of a run with other options"));
  CHECK(s.run({"rebuild", "shot.gltf", "--feature", "knobs=off"}).status == 1);
  CHECK(s.run({"rebuild", "shot.gltf", "--rig", "desk"}).status == 1);
}

TEST_CASE("cli unbuild, prune, strip: less and less") {
  const Studio s("unbuild");
  s.turn_tip();
  const Outcome apart = s.run({"unbuild", "shot.gltf"});
  CHECK(apart.status == 0);
  CHECK(has(apart.out,
            "shot.gltf: taken apart\n  lamp: lamp 1 (taken apart)\n"
            "    2 controls removed: "));
  CHECK(s.run({"unbuild", "shot.gltf", "--json"}).status == 0);
  const Outcome pruned = s.run({"prune", "shot.gltf"});
  CHECK(pruned.status == 0);
  CHECK(pruned.out == "shot.gltf: 1 orphan gone, with 0 channels\n");
  CHECK(s.run({"prune", "shot.gltf"}).out == "shot.gltf: has no orphans\n");
  const Outcome stripped = s.run({"strip", "shot.gltf", "-o", "model.gltf"});
  CHECK(stripped.status == 0);
  CHECK(stripped.out == "model.gltf: 1 rig taken out, with 0 channels on its controls\n");
  CHECK_FALSE(has(file_text(s.folder / "model.gltf"), "RIGC_rig"));
  CHECK(has(file_text(s.folder / "model.gltf"), "\"tip\""));
  const Outcome none = s.run({"strip", "model.gltf"});
  CHECK(none.status == 1);
  CHECK(has(none.err, "model.gltf: error[RIG0880]: the file has no rig\n"));
}
