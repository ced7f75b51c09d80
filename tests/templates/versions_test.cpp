// SPDX-License-Identifier: MIT
// Versions of templates: heads as the reader reads them, the newest of a name, forks, what --to
// names.
#include "templates/versions.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>

#include "base/files.h"
#include "templates/codes.h"
#include "templates/library.h"
#include "templates/templates_helpers.h"

using namespace rigc;
using namespace rigc::templates;
using namespace rigc::templates::testing;

namespace {

std::string text_of(const std::string& name, int version, const std::string& more = {}) {
  return "rigc: 1\nname: " + name + "\nversion: " + std::to_string(version) + "\n" + more +
         "joints: [{name: a}]\n";
}

/// Name, version and earlier names in one line; `-` where the text is no template.
std::string head(const std::string& text) {
  const auto found = scan_head(text);
  if (!found) return "-";
  std::string out = found->name + " " + std::to_string(found->version);
  for (const std::string& was : found->was) out += " " + was;
  return out;
}

}  // namespace

TEST_CASE("templates versions: heads in every way of writing") {
  const char* const rest = "joints: [{name: a}]\n";
  for (const char* text :
       {"rigc: 1\nname: lamp\nversion: 7\nwas: [torch, candle]\n",
        "# A lamp\r\nrigc: 1\r\nname: lamp   # who\r\nversion: 7\r\nwas: [torch, candle]\r\n",
        "rigc: 1\nversion: 7\nwas:\n  - torch   # old\n  - candle\nname: \"lamp\"\n",
        "rigc: 1\nversion: 7\nwas:\n- torch\n- candle\nname: 'lamp'\n",
        "---\nrigc: 1\nname: lamp\nversion: 7\nwas: [torch,\n  candle]\n",
        "description: |\n  name: no\nrigc: 1\nname: lamp\nversion: 7\nwas: [torch, candle]\n",
        "description: \"a\n  name: no\"\nrigc: 1\nname: lamp\nversion: 7\nwas: [torch, candle]\n",
        "rigc: 1\nname:\n  lamp\nversion: +7\nwas: [\"torch\", candle]\n",
        "rigc: 1\nname: &n lamp\nglobal: *n\nversion: 7\nwas: [torch, candle]\n",
        "preview: {a: 1,\n  name: no}\nrigc: 1\nname: lamp\nversion: 7\nwas: [torch, candle]\n"}) {
    CAPTURE(text);
    CHECK(head(std::string(text) + rest) == "lamp 7 torch candle");
  }
  CHECK(head("{rigc: 1, name: lamp, version: 7, joints: [{name: a}]}") == "lamp 7");
  CHECK(head("  rigc: 1\n  name: lamp\n  version: 7\n  joints: [{name: a}]\n") == "lamp 7");
  CHECK(head("rigc: 1\nname: lamp\nversion: 7\nwas: torch\n") == "lamp 7 torch");
  CHECK(head("rigc: 1\nname: lamp\nversion: 7\nwas: []\n") == "lamp 7");
}

TEST_CASE("templates versions: what is no template has no head") {
  for (const char* text :
       {"", "\n", "- rigc: 1\n", "map: mixamo\njoints: {}\n", "rigc: 2\nname: a\nversion: 1\n",
        "rigc: 1\nversion: 1\n", "rigc: 1\nname: a\n", "rigc: 1\nname: 3d\nversion: 1\n",
        "rigc: 1\nname: a\nversion: 0\n", "rigc: 1\nname: a\nversion: 1.5\n",
        "rigc: 1\nname: a\nversion: '1'\n", "rigc: 1\nname: a\nversion: 99999999999\n",
        "rigc: 1\nname: ~\nversion: 1\n", "rigc: 1\nname: null\nversion: 1\n",
        "rigc: 1\nname: a\nname: b\nversion: 1\n", "rigc: 1\nname: a\nversion: 1\nwas: [b, b]\n",
        "rigc: 1\nname: [a]\nversion: 1\n", "rigc: 1\nname: a\nversion: 1\n\xff: 1\n",
        "rigc: 1\nname: a\nversion: 1\n...\n---\nrigc: 1\n"}) {
    CAPTURE(text);
    CHECK(head(text) == "-");
  }
}

TEST_CASE("templates versions: heads agree with the reader for all templates of this tree") {
  const std::string source = RIGC_SOURCE_DIR;
  std::size_t count = 0;
  for (const char* folder : {"/templates", "/tests"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(source + folder)) {
      if (entry.path().extension() != ".yaml" || !entry.is_regular_file()) continue;
      CAPTURE(entry.path().string());
      Diagnostics diagnostics;
      auto text = rigc::read_file(entry.path().string(), 4u << 20, diagnostics);
      if (!text) continue;
      const auto found = scan_head(*text);
      Library library({template_folder()}, catalogue());
      const Template* whole = library.open(entry.path().string(), diagnostics);
      if (!whole) continue;  // bad ones may have a good head
      REQUIRE(found);
      CHECK(found->name == whole->name);
      CHECK(found->version == whole->version);
      CHECK(found->was == whole->was);
      ++count;
    }
  }
  CHECK(count > 100);
}

TEST_CASE("templates versions: the highest version counts, then the earlier folder") {
  const Folder a("versions_a"), b("versions_b");
  a.write("lamp.yaml", text_of("lamp", 3));
  a.write("old/lamp.yaml", text_of("lamp", 1));
  a.write("maps/lamp.yaml", text_of("lamp", 9));
  a.write(".hidden.yaml", text_of("lamp", 9));
  a.write("lamp.txt", text_of("lamp", 9));
  a.write("broken.yaml", "rigc: 1\nname: lamp\nversion: [\n");
  b.write("lamp_3.yaml", text_of("lamp", 3, "global: other\n"));
  b.write("deep/er/lamp.yaml", text_of("lamp", 4));
  const Versions both({a.path(), b.path()});
  CHECK(both.all().size() == 4);
  REQUIRE(both.newest("lamp"));
  CHECK(both.newest("lamp")->path == b.path() + "/deep/er/lamp.yaml");
  REQUIRE(both.find("lamp", 3));
  CHECK(both.find("lamp", 3)->path == a.path() + "/lamp.yaml");
  CHECK(both.find("lamp", 3)->place == 0);
  CHECK_FALSE(both.find("lamp", 2));
  CHECK_FALSE(both.newest("lam"));
  const Versions turned({b.path(), a.path()});
  CHECK(turned.find("lamp", 3)->path == b.path() + "/lamp_3.yaml");
  Diagnostics diagnostics;
  both.report_twins(diagnostics);
  CHECK(diagnostics.all().empty());  // the earlier folder's counts: no chance in that
  Library library({}, catalogue());
  const Template* lamp = library.open(a.path() + "/lamp.yaml", diagnostics);
  REQUIRE(lamp);
  CHECK(lamp->digest == both.find("lamp", 3)->digest);
  CHECK_FALSE(Versions({a.path() + "/nothing"}).newest("lamp"));
}

TEST_CASE("templates versions: two files of one folder that claim one version are reported") {
  const Folder a("versions_twins");
  a.write("lamp.yaml", text_of("lamp", 3));
  a.write("same/lamp.yaml", text_of("lamp", 3));
  Diagnostics none;
  Versions({a.path()}).report_twins(none);
  CHECK(none.all().empty());
  a.write("lamp_copy.yaml", text_of("lamp", 3, "global: other\n"));
  Diagnostics diagnostics;
  Versions({a.path()}).report_twins(diagnostics);
  REQUIRE(!diagnostics.all().empty());
  CHECK(diagnostics.all()[0].code->number == codes::kVersionTwice.number);
}

TEST_CASE("templates versions: a part is nobody's newer version") {
  const Folder a("versions_parts");
  a.write("hand.yaml", text_of("hand", 1));
  a.write("parts/hand.yaml", text_of("hand", 5));
  a.write("parts/wing.yaml", text_of("wing", 2));
  const Versions versions({a.path()});
  CHECK(versions.newest("hand")->version == 1);
  CHECK(versions.newest("wing")->part);
  CHECK(versions.find("hand", 5)->part);
}

TEST_CASE("templates versions: forks, and links that lead in circles") {
  const Folder a("versions_forks");
  a.write("lamp.yaml", text_of("lamp", 3));
  a.write("led.yaml", text_of("led", 1, "was: [lamp]\n"));
  a.write("led2.yaml", text_of("led", 2, "was: [candle, lamp]\n"));
  a.write("neon.yaml", text_of("neon", 1, "was: [led]\n"));
  std::error_code ignored;
  std::filesystem::create_directory_symlink(".", a.path() + "/loop", ignored);
  const Versions versions({a.path(), a.path()});
  CHECK(versions.all().size() == 4);
  const auto forks = versions.forks("lamp");
  REQUIRE(forks.size() == 1);
  CHECK(forks[0]->name == "led");
  CHECK(forks[0]->version == 2);
  CHECK(versions.forks("neon").empty());
}

TEST_CASE("templates versions: what --to names") {
  const Folder a("versions_to");
  a.write("lamp.yaml", text_of("lamp", 3));
  a.write("lamp_2.yaml", text_of("lamp", 2));
  const Versions versions({a.path()});
  Diagnostics diagnostics;
  CHECK(versions.resolve("lamp", diagnostics) == a.path() + "/lamp.yaml");
  CHECK(versions.resolve("lamp@2", diagnostics) == a.path() + "/lamp_2.yaml");
  CHECK(versions.resolve("./any/lamp.yaml", diagnostics) == "./any/lamp.yaml");
  CHECK(diagnostics.all().empty());
  CHECK_FALSE(versions.resolve("lamp@7", diagnostics));
  CHECK_FALSE(versions.resolve("lamp@x", diagnostics));
  CHECK_FALSE(versions.resolve("lmap", diagnostics));
  CHECK(numbers(diagnostics) == std::vector<int>{290, 290, 290});
  CHECK(diagnostics.all()[2].hint == "did you mean \"lamp\"?");
}

TEST_CASE("templates versions: references to parts are found without reading the template") {
  using Names = std::vector<std::string>;
  CHECK(scan_parts("rigc: 1\nparts:\n  - {template: parts/arm, as: l}\n  - template: b  # b\n"
                   "    as: template\n  - { as: c,template: c}\n  - {as: d, template: d}\r\n"
                   "# - template: no\n  - my_template: no\n") == Names{"parts/arm", "b", "c", "d"});
  CHECK(scan_parts("template: a").empty());  // at the top level it is no part's
  CHECK(scan_parts("rigc: 1\nparts: [{template: 'a b'}, {template: b}]\n") == Names{"a b", "b"});
  CHECK(scan_parts("parts: [{\"template\": a}]\n") == Names{"a"});
  CHECK(scan_parts("description: &a arm\nparts:\n- template: *a\n- template:\n    b\n") ==
        Names{"arm", "b"});
  CHECK(scan_parts("parts: [{template: 'a}]\n").empty());
  Diagnostics diagnostics;
  Library library({template_folder()}, catalogue());
  const Versions versions({template_folder()});
  for (const TemplateVersion& file : versions.all()) {
    CAPTURE(file.path);
    const Template* whole = library.open(file.path, diagnostics);
    REQUIRE(whole);
    std::vector<std::string> references;
    for (const Part& part : whole->parts) references.push_back(part.reference);
    CHECK(scan_parts(diagnostics.sources().text(whole->file)) == references);
  }
}

TEST_CASE("templates versions: a folder that cannot be listed is not taken for an empty one") {
  const std::string folder = template_folder();
  Diagnostics diagnostics;
  // A path that is too long stands for a disk that fails: root may read everything.
  const Versions refused({folder + "/" + std::string(300, 'x')});
  CHECK(!refused.check_readable(diagnostics));
  CHECK(diagnostics.file_system_refused());
  Diagnostics none;
  CHECK(Versions({folder, folder + "/none"}).check_readable(none));
  CHECK(none.all().empty());
}
