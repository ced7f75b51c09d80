// SPDX-License-Identifier: MIT
// Orphans in a file: what holds them, how they are found again, what is wrong with those that lie.
#include <doctest/doctest.h>

#include <algorithm>

#include "file_helpers.h"
#include "gltf/rig.h"
#include "gltf/rig_codes.h"
#include "rig_helpers.h"

using namespace rigc;
using namespace rigc::gltf;
using namespace rigc::gltf::test;

namespace {

Orphan make_orphan(const std::string& role) {
  Orphan orphan;
  orphan.identity = {0, {hash64("base"), 0}, {hash64("tip"), 2}, "gone", role, 0};
  orphan.name = "gone_" + role;
  orphan.ids = {"lamp", "arm", "elbow"};
  orphan.module = "fk_chain";
  orphan.space = {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}};
  orphan.rest = {{0.1, 0, 0}, {}, {1, 1, 1}};
  orphan.local = {{0.1, 0.25, -3}, math::axis_angle({0, 1, 0}, 0.5), {1, 2, 1}};
  using Flavour = scene::UserAttribute::Flavour;
  orphan.attributes.push_back({"bend", Flavour::angle, 12.5, 3, {}, {}, true});
  orphan.attributes.push_back({"count", Flavour::integer, 4, 1, {}, {}, true});
  return orphan;
}

File orphan_file(const std::string& name) {
  Diagnostics diagnostics;
  Rig rig = sample_rig(diagnostics);
  rig.orphans = {make_orphan("fk"), make_orphan("pole")};
  return written(empty_file(), rig, name);
}

/// The file with other JSON, in a folder where the validator does not look.
File with_json(const File& file, const std::string& json, const std::string& name) {
  const std::string bytes = text(file.whole);
  const auto byte = [&](std::size_t at) {
    return static_cast<std::size_t>(static_cast<unsigned char>(bytes[at]));
  };
  const std::size_t size = byte(12) | byte(13) << 8u | byte(14) << 16u;
  const std::string path = make_folder("broken/" + name) + "/rig.glb";
  write_bytes(path, glb(json, bytes.substr(28 + size)));
  Diagnostics diagnostics;
  auto opened = gltf::open(path, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(opened);
  return *std::move(opened);
}

std::vector<Orphan> read_orphans_of(const File& file, std::vector<int>* said = nullptr) {
  Diagnostics diagnostics;
  const auto rigs = read_rigs(file, diagnostics);
  if (said) *said = numbers(diagnostics);
  if (!said) {
    INFO(render(diagnostics, false));
    REQUIRE(rigs);
    CHECK(diagnostics.all().empty());
  }
  return rigs ? rigs->front().orphans : std::vector<Orphan>();
}

}  // namespace

TEST_CASE("gltf rig_orphans: what is written is read") {
  const File file = orphan_file("orphans");
  const std::vector<Orphan> orphans = read_orphans_of(file);
  REQUIRE(orphans.size() == 2);
  const Orphan expected = make_orphan("fk");
  const Orphan& orphan = orphans.front();
  CHECK(orphan.identity == expected.identity);
  CHECK(orphan.name == expected.name);
  CHECK(orphan.ids.local == "arm");
  CHECK(orphan.ids.label == "elbow");
  CHECK(orphan.ids.global == "lamp");
  CHECK(orphan.kind == scene::Kind::control);
  CHECK(orphan.module == "fk_chain");
  CHECK(orphan.space == expected.space);
  CHECK(orphan.rest == expected.rest);
  // What is held is the file's: bit for bit, so that it may go to and fro for ever.
  CHECK(orphan.local == expected.local);
  REQUIRE(orphan.attributes.size() == 2);
  CHECK(orphan.attributes[0].value == 12.5);
  CHECK(orphan.attributes[0].initial == 3);
  CHECK(orphan.attributes[0].flavour == scene::UserAttribute::Flavour::angle);
  CHECK(orphan.attributes[1].value == 4);
}

TEST_CASE("gltf rig_orphans: the holder is a plain node that says what it holds") {
  const File file = orphan_file("orphans_node");
  const Orphan orphan = read_orphans_of(file).front();
  const json::Value node = file.root()["nodes"].items()[static_cast<std::size_t>(orphan.node)];
  CHECK(node["name"].string() == "gone_fk");
  CHECK(node["extras"]["rigc"].string() == "orphan:" + to_text(orphan.identity));
  CHECK(node["extras"]["bend"].text() == "12.5");
  CHECK(node["extras"]["count"].text() == "4");
  CHECK_FALSE(node["mesh"]);
  CHECK_FALSE(node["children"]);
  bool root = false;
  for (const json::Value& index : file.root()["scenes"].items()[0]["nodes"].items())
    root = root || index.integer() == orphan.node;
  CHECK(root);
}

TEST_CASE(
    "gltf rig_orphans: a mark counts more than an index, and what is set more than what was") {
  const File file = orphan_file("orphans_moved");
  const std::vector<Orphan> orphans = read_orphans_of(file);
  // Another program gave the nodes other numbers: here the two holders change places.
  std::string json(file.json.text());
  const auto nodes = file.root()["nodes"].items();
  const std::string a(nodes[static_cast<std::size_t>(orphans[0].node)].text());
  const std::string b(nodes[static_cast<std::size_t>(orphans[1].node)].text());
  json = test::replaced(json, a, "<first>");
  json = test::replaced(json, b, a);
  json = test::replaced(json, "<first>", test::replaced(b, "\"bend\":12.5", "\"bend\":-7"));
  const std::vector<Orphan> moved = read_orphans_of(with_json(file, json, "orphans_moved"));
  REQUIRE(moved.size() == 2);
  CHECK(moved[0].identity == orphans[0].identity);
  CHECK(moved[0].node == orphans[1].node);
  CHECK(moved[1].node == orphans[0].node);
  CHECK(moved[0].attributes[0].value == 12.5);
  CHECK(moved[1].attributes[0].value == -7);
}

TEST_CASE("gltf rig_orphans: a holder that somebody deleted is said and forgotten") {
  const File file = orphan_file("orphans_lost");
  std::string json(file.json.text());
  json = test::replaced(json, ":gone:pole:0\",\"bend\"", ":other:pole:0\",\"bend\"");
  std::vector<int> said;
  const std::vector<Orphan> orphans = read_orphans_of(with_json(file, json, "orphans_lost"), &said);
  CHECK(orphans.size() == 1);
  CHECK(said == std::vector<int>{codes::kNodeLost.number});
}

TEST_CASE("gltf rig_orphans: orphans that lie are errors") {
  const File file = orphan_file("orphans_lie");
  const std::string json(file.json.text());
  // The second orphan is the last: what is wrong there was not hidden by the first.
  const std::string orphans(
      file.root()["extensions"]["RIGC_rig"]["rigs"].items()[0]["orphans"].text());
  struct Lie {
    const char *from, *to;
    int code;
  };
  for (const Lie& lie : {
           Lie{"\"kind\":\"control\",\"module\"", "\"kind\":\"mesh\",\"module\"",
               codes::kRigWord.number},
           Lie{"\"kind\":\"control\",\"module\"", "\"kind\":\"cloud\",\"module\"",
               codes::kRigWord.number},
           Lie{"\"space\":[0,1,0,", "\"space\":[0,1,0,0,", codes::kRigType.number},
           Lie{"\"name\":\"bend\"", "\"name\":\"rigc\"", codes::kRigText.number},
           Lie{"\"flavour\":\"angle\"", "\"flavour\":\"colour\"", codes::kRigText.number},
           Lie{"\"identity\":\"0:", "\"identity\":\"1:", codes::kRigText.number},
       }) {
    INFO(lie.to);
    const std::size_t at = orphans.rfind(lie.from);
    REQUIRE(at != std::string::npos);
    std::string changed = orphans;
    changed.replace(at, std::string(lie.from).size(), lie.to);
    std::vector<int> said;
    const auto read = read_orphans_of(
        with_json(file, test::replaced(json, orphans, changed), "orphans_lie"), &said);
    CHECK(read.empty());
    REQUIRE(!said.empty());
    CHECK(said.front() == lie.code);
  }
}
