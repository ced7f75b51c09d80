// SPDX-License-Identifier: MIT
// Updates of files and templates that lie: diagnostics with a code, and the file as it was; or a
// file that reads. tests/hostile has what every reader of a file refuses.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "gltf/clips.h"
#include "pipeline/character_helpers.h"
#include "pipeline/shot_helpers.h"
#include "support/random_edits.h"

namespace rigc {
namespace {

using nlohmann::ordered_json;
using test::EditedTemplate;
using test::Random;
using test::Shot;

const std::string kRig = "/extensions/RIGC_rig/rigs/0";
const std::string kOrphan = kRig + "/orphans/0";

/// A shot whose rig has lost a part with keys and with an attribute, and a template that brings the
/// part back.
struct Victim {
  std::string folder, shot;
  test::Character character;

  explicit Victim(const std::string& name) : folder(test::fresh_folder("broken/update/" + name)) {
    shot = folder + "/shot.glb";
    EditedTemplate edited(5, {});
    test::write_text(folder + "/edited_part.yaml", EditedTemplate::part_text());
    test::write_text(folder + "/edited.yaml", edited.text());
    test::build_rig(folder + "/edited.yaml", shot);
    test::animate(shot, 1, {2, 1.0, 1.0, 3});
    const std::string with_part = edited.text();
    test::write_text(folder + "/edited.yaml",
                     version(101, with_part.substr(0, with_part.find("parts:"))));
    test::update(shot, folder);
    character = test::load_character(shot);
    test::write_text(folder + "/edited.yaml", version(102, with_part));
    const Shot read = test::read_shot(shot);
    REQUIRE(read.rigs.front().orphans.size() >= 2);
  }
  static std::string version(int number, std::string text) {
    const std::string was = "version: 100\n";
    return text.replace(text.find(was), was.size(), fmt::format("version: {}\n", number));
  }
  void write(const ordered_json& json) const { test::save_glb({json, character.bin}, shot); }
};

/// Numbers of the errors of an update.
std::vector<int> errors_of(const Victim& victim) {
  pipeline::UpdateSettings settings;
  settings.paths.templates = {victim.folder};
  Diagnostics diagnostics;
  const auto updater = pipeline::Updater::make(settings, diagnostics);
  REQUIRE(updater);
  updater->update({victim.shot, victim.shot, ""}, diagnostics);
  std::vector<int> out;
  for (const Diagnostic& diagnostic : diagnostics.all())
    if (diagnostic.code->severity == Severity::error) out.push_back(diagnostic.code->number);
  return out;
}

/// What is wrong with a file that an update wrote; empty: nothing.
std::string faults(const std::string& path) {
  Diagnostics diagnostics;
  const auto file = gltf::open(path, diagnostics);
  if (!file || !gltf::read_rigs(*file, diagnostics)) return render(diagnostics, false);
  const auto clips = gltf::read_clips(*file, diagnostics);
  if (!clips) return render(diagnostics, false);
  std::string out;
  for (const anim::Clip& clip : clips->clips) {
    std::set<std::tuple<int, int, std::string>> targets;
    for (const anim::Channel& channel : clip.channels)
      if (!targets.insert({channel.node, static_cast<int>(channel.path), channel.attribute}).second)
        out += fmt::format("{} is driven twice at node {}\n", clip.name, channel.node);
  }
  return out;
}

std::size_t channels_in(const std::string& path) {
  std::size_t count = 0;
  test::Character character = test::load_character(path);
  for (const auto& clip : character.json["animations"]) count += clip["channels"].size();
  return count;
}

ordered_json changed(const Victim& victim, const std::string& pointer, const std::string& value) {
  ordered_json json = victim.character.json;
  json[ordered_json::json_pointer(pointer)] = ordered_json::parse(value);
  return json;
}

std::string repeated(const std::string& item, std::size_t count) {
  std::string out = "[";
  for (std::size_t i = 0; i < count; ++i) out += (i ? "," : "") + item;
  return out + "]";
}

struct Row {
  const char* pointer;
  std::string value;
  int code;
};

void expect(const Victim& victim, const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    const std::string pointer = kRig + row.pointer, value = row.value.substr(0, 60);
    CAPTURE(pointer);
    CAPTURE(value);
    victim.write(changed(victim, pointer, row.value));
    const std::string bytes = test::bytes_of(victim.shot);
    const auto codes = errors_of(victim);
    CHECK(!codes.empty());
    if (!codes.empty()) CHECK(codes.front() == row.code);
    CHECK(test::bytes_of(victim.shot) == bytes);
  }
}

}  // namespace

TEST_CASE("update hostile: orphans that cannot be") {
  const Victim victim("orphans");
  expect(victim,
         {{"/orphans", "{}", 701},
          {"/orphans", "7", 701},
          {"/orphans/0", "[]", 701},
          {"/orphans", repeated("{}", 40'000), 709},
          {"/orphans/0/node", "-1", 702},
          {"/orphans/0/node", "1e30", 701},
          {"/orphans/0/node", "\"3\"", 701},
          {"/orphans/0/identity", "7", 701},
          {"/orphans/0/identity", "\"0:1:2\"", 704},
          {"/orphans/0/identity", "\"9:00000000000000aa:00000000000000aa:a:b:0\"", 704},
          {"/orphans/0/kind", "\"teapot\"", 703},
          {"/orphans/0/kind", "\"expression\"", 703},
          {"/orphans/0/kind", "4", 701},
          {"/orphans/0/space", "[1, 0, 0]", 701},
          {"/orphans/0/space", "[1, 0, 0, 0, 1, 0, 0, 0, \"1\"]", 701},
          {"/orphans/0/space", "[1e300, 0, 0, 0, 1e300, 0, 0, 0, 1e300]", 708},
          {"/orphans/0/translation", "[1, 2]", 708},
          {"/orphans/0/translation", "[1e300, 0, 0]", 708},
          {"/orphans/0/rotation", "[0, 0, 0, 0]", 708},
          {"/orphans/0/attributes", "7", 701},
          {"/orphans/0/attributes", "[7]", 701},
          {"/orphans/0/attributes", repeated(R"({"name": "a", "flavour": "number"})", 1000), 709},
          {"/orphans/0/attributes", R"([{"name": "rigc", "flavour": "number"}])", 704},
          {"/orphans/0/attributes", R"([{"name": "a b", "flavour": "number"}])", 704},
          {"/orphans/0/attributes", R"([{"name": "a", "flavour": "odd"}])", 704},
          {"/orphans/0/attributes", R"([{"name": "a"}])", 701},
          {"/orphans/0/attributes",
           R"([{"name": "a", "flavour": "number"}, {"name": "a", "flavour": "number"}])", 705},
          {"/orphans/0/attributes", R"([{"name": "a", "flavour": "number", "initial": 1e300}])",
           708}});
}

TEST_CASE("update hostile: orphans that name nodes that are not theirs") {
  const Victim victim("holders");
  const ordered_json& rig = victim.character.json.at(ordered_json::json_pointer(kRig));
  std::string control, joint;
  for (const auto& node : rig["nodes"]) {
    if (node["kind"] == "control") control = node["node"].dump();
    if (node["kind"] == "joint") joint = node["node"].dump();
  }
  const std::size_t channels = channels_in(victim.shot);
  for (const std::string& node : {std::string("1999999999"), control, joint, std::string("0")}) {
    CAPTURE(node);
    // Extras count, and they say where the holder is.
    victim.write(changed(victim, kOrphan + "/node", node));
    CHECK(errors_of(victim).empty());
    CHECK(faults(victim.shot) == "");
    CHECK(channels_in(victim.shot) == channels);
    CHECK(test::read_shot(victim.shot).rigs.front().orphans.empty());
  }
  // The holder has lost its mark: its channels are somebody's, and stay.
  ordered_json json = victim.character.json;
  const std::size_t holder = rig["orphans"][0]["node"];
  for (const bool lies : {false, true}) {
    json["nodes"][holder]["extras"].erase("rigc");
    if (lies) json.at(ordered_json::json_pointer(kOrphan))["node"] = std::stoi(control);
    victim.write(json);
    errors_of(victim);
    CHECK(faults(victim.shot) == "");
    CHECK(channels_in(victim.shot) == channels);
  }
}

TEST_CASE("update hostile: one orphan twice, and orphans of what is there") {
  const Victim victim("twice");
  const ordered_json& rig = victim.character.json.at(ordered_json::json_pointer(kRig));
  const std::size_t channels = channels_in(victim.shot);
  ordered_json json = victim.character.json;
  SUBCASE("listed twice") {
    auto& orphans = json.at(ordered_json::json_pointer(kRig + "/orphans"));
    orphans.push_back(orphans[0]);
  }
  SUBCASE("two nodes hold one identity, each with keys") {
    const std::size_t a = rig["orphans"][0]["node"], b = rig["orphans"][1]["node"];
    json["nodes"][b]["extras"]["rigc"] = json["nodes"][a]["extras"]["rigc"];
    json.at(ordered_json::json_pointer(kRig + "/orphans/1"))["identity"] =
        rig["orphans"][0]["identity"];
  }
  SUBCASE("an orphan says that it is a control that has keys") {
    for (const auto& node : rig["nodes"]) {
      if (node["kind"] != "control") continue;
      const std::string identity = node["identity"];
      const std::size_t holder = rig["orphans"][0]["node"];
      json["nodes"][holder]["extras"]["rigc"] = "orphan:" + identity;
      json.at(ordered_json::json_pointer(kOrphan))["identity"] = identity;
      break;
    }
  }
  SUBCASE("an orphan says that it is a joint") {
    const std::string identity = rig["nodes"][0]["identity"];
    const std::size_t holder = rig["orphans"][0]["node"];
    json["nodes"][holder]["extras"]["rigc"] = "orphan:" + identity;
    json.at(ordered_json::json_pointer(kOrphan))["identity"] = identity;
  }
  victim.write(json);
  const std::size_t keys = test::keys_of(test::read_shot(victim.shot)).size();
  const std::string bytes = test::bytes_of(victim.shot);
  const auto codes = errors_of(victim);
  if (codes.empty()) {
    CHECK(faults(victim.shot) == "");
    CHECK(channels_in(victim.shot) == channels);
    CHECK(test::keys_of(test::read_shot(victim.shot)).size() == keys);
  } else {
    CHECK(test::bytes_of(victim.shot) == bytes);
  }
}

TEST_CASE("update hostile: nodes that say they are the same control") {
  const Victim victim("duplicates");
  ordered_json json = victim.character.json;
  std::vector<std::size_t> controls;
  for (const auto& node : json.at(ordered_json::json_pointer(kRig))["nodes"])
    if (node["kind"] == "control") controls.push_back(node["node"]);
  REQUIRE(controls.size() > 2);
  json["nodes"][controls[1]]["extras"]["rigc"] = json["nodes"][controls[0]]["extras"]["rigc"];
  victim.write(json);
  const std::string bytes = test::bytes_of(victim.shot);
  CHECK(!errors_of(victim).empty());
  CHECK(test::bytes_of(victim.shot) == bytes);
}

TEST_CASE("update hostile: joints of the rig that say they were each other") {
  const Victim victim("was");
  ordered_json json = victim.character.json;
  auto& joints = json.at(ordered_json::json_pointer(kRig))["joints"];
  for (std::size_t i = 0; i < joints.size(); ++i) {
    ordered_json was = ordered_json::array();
    for (std::size_t k = 1; k < joints.size(); ++k)
      was.push_back(joints[(i + k) % joints.size()]["key"]);
    joints[i]["was"] = was;
  }
  victim.write(json);
  const std::size_t channels = channels_in(victim.shot);
  CHECK(errors_of(victim).empty());
  CHECK(faults(victim.shot) == "");
  CHECK(channels_in(victim.shot) == channels);
}

TEST_CASE("update hostile: templates that are bombs") {
  const Victim victim("bombs");
  victim.write(victim.character.json);
  const std::string bytes = test::bytes_of(victim.shot);
  const std::string head = "rigc: 1\nname: edited\nversion: 200\n";
  std::string aliases = head + "a0: &a0 [x, x]\n";
  for (int i = 1; i < 40; ++i)
    aliases += fmt::format("a{0}: &a{0} [*a{1}, *a{1}, *a{1}]\n", i, i - 1);
  std::string deep = head + "joints: ";
  for (int i = 0; i < 5000; ++i) deep += "[";
  std::string many = head + "joints:\n";
  for (int i = 0; i < 70'000; ++i) many += fmt::format("  - {{name: j{}}}\n", i);
  const std::pair<const char*, std::string> bombs[] = {
      {"aliases", aliases},
      {"deep", deep},
      {"many joints", many},
      {"large", head + "joints: [{name: a}]\n#" + std::string(5'000'000, 'x')},
      {"cycle", head + "joints: &x [{name: a, tags: *x}]\n"},
      {"chain", head + "joints: [{name: a, chain: {count: 2000000000, to: [0, 1, 0]}}]\n"},
      {"itself", head + "joints: [{name: a}]\nparts: [{template: edited, as: b, attach: a}]\n"},
      {"no parent", head + "joints: [{name: a, parent: nobody}]\n"},
      {"no yaml", head + "joints: [{name: a\n"},
      {"bytes", head + std::string("joints: \xff\xfe\x00\x01", 13)},
      {"a selector of all", head +
                                "joints:\n  - name: a\n    local: g\n    tags:\n      - {command: "
                                "fk_chain, with: {joints: \"g[0..2000000000]\"}}\n"}};
  for (const auto& bomb : bombs) {
    CAPTURE(std::string(bomb.first));
    test::write_text(victim.folder + "/edited.yaml", bomb.second);
    const auto codes = errors_of(victim);
    // A file that is not recognised as a template is none of the versions.
    CHECK(!codes.empty());
    CHECK(test::bytes_of(victim.shot) == bytes);
  }
}

TEST_CASE("update hostile: random damage of a rig is refused, or gives a file that reads") {
  const Victim victim("random");
  Random random(7);
  const char* const values[] = {"null", "0",     "-1",        "1e30",   "1e300",       "\"\"",
                                "[]",   "{}",    "true",      "[0]",    "99999",       "\"x\"",
                                "0.5",  "-0.25", "[0, 0, 0]", "[[[]]]", "[1, 1, 1, 1]"};
  std::size_t refused = 0, accepted = 0;
  for (int round = 0; round < 400; ++round) {
    ordered_json json = victim.character.json;
    // A walk down from the rig to something.
    ordered_json* at =
        &json.at(ordered_json::json_pointer(random.chance(0.5) ? kRig + "/orphans" : kRig));
    std::string path;
    while (at->is_structured() && !at->empty() && (path.empty() || random.chance(0.85))) {
      auto item = at->begin();
      std::advance(item, static_cast<std::ptrdiff_t>(random.below(at->size())));
      path += "/" + (at->is_object() ? item.key() : std::to_string(item - at->begin()));
      at = &*item;
    }
    const std::string value = values[random.below(std::size(values))];
    *at = ordered_json::parse(value);
    CAPTURE(round);
    CAPTURE(path);
    CAPTURE(value);
    victim.write(json);
    const std::string bytes = test::bytes_of(victim.shot);
    const auto codes = errors_of(victim);
    ++(codes.empty() ? accepted : refused);
    if (codes.empty())
      CHECK(faults(victim.shot) == "");
    else
      CHECK(test::bytes_of(victim.shot) == bytes);
  }
  CHECK(refused > 100);
  CHECK(accepted > 20);
}

}  // namespace rigc
