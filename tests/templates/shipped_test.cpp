// SPDX-License-Identifier: MIT
// The templates that come with rigc: all read, expand and stand; tutorials open with words.
#include <doctest/doctest.h>

#include "base/files.h"
#include "base/text.h"
#include "templates/templates_helpers.h"

using namespace rigc;
using namespace rigc::templates;
using namespace rigc::templates::testing;

namespace {

std::vector<std::string> yaml_files(const std::string& folder) {
  std::vector<std::string> files;
  for (const std::string& file : list_folder(folder))
    if (ends_with(file, ".yaml")) files.push_back(join_path(folder, file));
  return files;
}

}  // namespace

TEST_CASE("templates shipped: characters, props and tutorials have no errors") {
  std::vector<std::string> files = yaml_files(template_folder());
  const std::vector<std::string> tutorials = yaml_files(template_folder() + "/tutorial");
  CHECK(files.size() >= 2);
  CHECK(tutorials.size() >= 10);
  files.insert(files.end(), tutorials.begin(), tutorials.end());
  for (const std::string& file : files) {
    Diagnostics diagnostics;
    const auto expanded = expand_file(file, diagnostics);
    const auto placed = expanded ? place(*expanded, diagnostics) : std::nullopt;
    CHECK_MESSAGE(placed, render(diagnostics, false));
    CHECK(diagnostics.all().empty());
  }
}

TEST_CASE("templates shipped: a tutorial opens with a comment that teaches") {
  for (const std::string& file : yaml_files(template_folder() + "/tutorial")) {
    Diagnostics diagnostics;
    const auto text = read_file(file, 1u << 20, diagnostics);
    REQUIRE(text);
    const std::size_t head = text->find("\nrigc: 1");
    REQUIRE(head != std::string::npos);
    CHECK_MESSAGE(head > 200, file);
    CHECK_MESSAGE((*text)[0] == '#', file);
  }
}

TEST_CASE("templates shipped: every joint of the biped that a model must have is in every map") {
  Diagnostics diagnostics;
  const auto expanded = expand_file(biped_path(), diagnostics);
  REQUIRE(expanded);
  for (const std::string& file : yaml_files(template_folder() + "/maps")) {
    const auto map = find_map(file, {}, diagnostics);
    REQUIRE_MESSAGE(map, render(diagnostics, false));
    CHECK(map->name == stem_of(file));
    for (const ExpandedJoint& joint : expanded->joints) {
      const Identifiers& ids = joint.tagged.ids;
      if (joint.tagged.optional || joint.helper) continue;
      CHECK_MESSAGE(map->find(ids.local, ids.label), file, ids.local, ids.label);
    }
  }
}
