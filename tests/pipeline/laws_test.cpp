// SPDX-License-Identifier: MIT
// Law 9 on templates: whatever is done to a template's text, a build either succeeds or gives
// diagnostics and writes nothing. Law 1: the same input gives the same bytes.
#include <doctest/doctest.h>

#include <cstdio>
#include <fstream>
#include <random>
#include <sstream>

#include "base/files.h"
#include "gltf/rig.h"
#include "pipeline/build.h"
#include "pipeline/character_helpers.h"
#include "support/random_template.h"

namespace rigc {
namespace {

void write_text(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// A slip or an attack: bytes changed, lines gone, doubled or swapped, words of another line put
/// in.
std::string mutated(std::string text, std::mt19937_64& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  std::vector<std::string> lines;
  std::stringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  const std::size_t changes = 1 + below(3);
  for (std::size_t i = 0; i < changes; ++i) {
    const std::size_t at = below(lines.size());
    std::string& line = lines[at];
    switch (below(7)) {
      case 0:
        lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at));
        break;
      case 1:
        lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(at), lines[below(lines.size())]);
        break;
      case 2:
        std::swap(lines[at], lines[below(lines.size())]);
        break;
      case 3:
        if (!line.empty()) line[below(line.size())] = static_cast<char>(below(256));
        break;
      case 4:
        if (!line.empty()) {
          const std::size_t from = below(line.size());  // one draw a statement
          line.erase(from, 1 + below(4));
        }
        break;
      case 5: {
        const std::size_t where = below(line.size() + 1);
        line.insert(where, std::string(1, "[]{}:,-#&*!|>'\"%@`.\t/?0"[below(23)]));
        break;
      }
      default: {
        const std::string& other = lines[below(lines.size())];
        const std::size_t from = below(other.size() + 1);
        const std::string words = other.substr(from, below(20));
        lines[at].insert(below(lines[at].size() + 1), words);
      }
    }
    if (lines.empty()) break;
  }
  std::string out;
  for (const std::string& line : lines) out += line + "\n";
  return out;
}

std::optional<pipeline::Built> build(const std::string& path, const std::string& out,
                                     Diagnostics& diagnostics) {
  pipeline::BuildRequest request;
  request.template_file = path;
  request.paths.templates = {test::templates_folder()};
  return pipeline::build(request, out, diagnostics);
}

}  // namespace

TEST_CASE("pipeline laws: a mutated template builds, or gives diagnostics and writes nothing") {
  const std::string folder = std::string(RIGC_TEST_OUT) + "/broken";
  std::remove((folder + "/mutant.yaml").c_str());
  if (!folder_exists(folder)) REQUIRE(std::system(("mkdir -p '" + folder + "'").c_str()) == 0);
  const std::string path = folder + "/mutant.yaml", out = folder + "/mutant.glb";
  std::vector<std::string> names = {"prop.yaml", "biped.yaml", "parts/arm.yaml", "parts/leg.yaml"};
  for (const std::string& name : list_folder(test::templates_folder() + "/tutorial")) {
    if (name.ends_with(".yaml")) names.push_back("tutorial/" + name);
  }
  std::mt19937_64 random(9);
  std::size_t built = 0, refused = 0;
  for (const std::string& name : names) {
    const std::string original = test::bytes_of(test::templates_folder() + "/" + name);
    for (int i = 0; i < 25; ++i) {
      std::remove(out.c_str());
      const std::string text = mutated(original, random);
      write_text(path, text);
      Diagnostics diagnostics;
      const bool done = build(path, out, diagnostics).has_value();
      CAPTURE(name);
      CAPTURE(text);
      CHECK(done == diagnostics.ok());
      CHECK(file_exists(out) == done);
      (done ? built : refused) += 1;
    }
  }
  CHECK(built > 20);
  CHECK(refused > 100);
}

TEST_CASE(
    "pipeline laws: random templates give the same bytes twice, and a rig reads back as it was "
    "built") {
  const std::string folder = std::string(RIGC_TEST_OUT);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    const std::string path = folder + "/random.yaml";
    write_text(path, test::random_template(seed));
    const std::string first = folder + "/random_first.glb", second = folder + "/random_second.glb";
    Diagnostics diagnostics;
    const auto built = build(path, first, diagnostics);
    REQUIRE_MESSAGE(built, render(diagnostics, false));
    REQUIRE(build(path, second, diagnostics));
    CHECK(test::bytes_of(first) == test::bytes_of(second));

    const auto file = gltf::open(first, diagnostics);
    REQUIRE(file);
    const auto rigs = gltf::read_rigs(*file, diagnostics);
    REQUIRE_MESSAGE(rigs, render(diagnostics, false));
    REQUIRE(rigs->size() == 1);
    CHECK(rigs->front().scene.dump() == built->rig.scene.dump());
  }
}

}  // namespace rigc
