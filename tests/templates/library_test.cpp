// SPDX-License-Identifier: MIT
// The library: where templates are found, and that each file is read once.
#include "templates/library.h"

#include <doctest/doctest.h>

#include "templates/templates_helpers.h"

using namespace rigc;
using namespace rigc::templates;
using namespace rigc::templates::testing;

TEST_CASE("templates library: by path, by name in the folders, and an error that suggests") {
  const Folder a("library_a"), b("library_b");
  a.write("lamp.yaml", with_head("joints: [{name: a}]\n", "lamp"));
  b.write("lamp.yaml", with_head("joints: [{name: b}]\n", "lamp"));
  b.write("chair.yaml", with_head("joints: [{name: c}]\n", "chair"));
  Diagnostics diagnostics;
  Library library({a.path(), b.path()}, catalogue());
  REQUIRE(library.open("lamp", diagnostics));
  CHECK(library.open("lamp", diagnostics)->joints[0].name == "a");
  CHECK(library.open("chair", diagnostics)->joints[0].name == "c");
  CHECK(library.open(b.path() + "/lamp.yaml", diagnostics)->joints[0].name == "b");
  CHECK(library.open("lamp", diagnostics) == library.open("lamp", diagnostics));
  CHECK(diagnostics.ok());
  CHECK_FALSE(library.find("table"));
  CHECK_FALSE(library.open("lmap", diagnostics));
  REQUIRE(numbers(diagnostics) == std::vector<int>{290});
  CHECK(diagnostics.all()[0].hint == "did you mean \"lamp\"?");
}

TEST_CASE("templates library: parts beside the template come before the folders") {
  const Folder a("library_parts"), b("library_folder");
  a.write("parts/arm.yaml", with_head("joints: [{name: beside}]\n", "arm"));
  b.write("parts/arm.yaml", with_head("joints: [{name: folder}]\n", "arm"));
  b.write("parts/leg.yaml", with_head("joints: [{name: folder}]\n", "leg"));
  Diagnostics diagnostics;
  const auto expanded = expand_file(
      a.write("body.yaml",
              with_head("parts: [{template: parts/arm, as: x}, {template: parts/leg, as: y}, "
                        "{template: parts/arm.yaml, as: z}]\n",
                        "body")),
      diagnostics, {b.path()});
  REQUIRE_MESSAGE(expanded, render(diagnostics, false));
  CHECK(expanded->joints[0].tagged.name == "x_beside");
  CHECK(expanded->joints[1].tagged.name == "y_folder");
  CHECK(expanded->joints[2].tagged.name == "z_beside");
  CHECK(expanded->skeleton.templates.size() == 3);
}

TEST_CASE("templates library: parts never lie outside, and a bad part is reported once") {
  const Folder a("library_outside");
  a.write("secret.yaml", with_head("joints: [{name: a}]\n", "secret"));
  for (const char* reference : {"../secret", "/etc/passwd", "x/../../secret"}) {
    Diagnostics diagnostics;
    CHECK_FALSE(expand_file(
        a.write("in/body.yaml",
                with_head(std::string("parts: [{template: ") + reference + ", as: x}]\n", "body")),
        diagnostics));
    CHECK(numbers(diagnostics) == std::vector<int>{292});
  }
  Diagnostics diagnostics;
  a.write("in/bad.yaml", "rigc: 2\n");
  CHECK_FALSE(expand_file(
      a.write("in/body.yaml",
              with_head("parts: [{template: bad, as: x}, {template: bad, as: y}]\n", "body")),
      diagnostics));
  CHECK(numbers(diagnostics) == std::vector<int>{220});
}
