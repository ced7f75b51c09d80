// SPDX-License-Identifier: MIT
// The program of a rig, of its template and of its file, for people and for programs.
#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

#include "base/json.h"
#include "pipeline/plan.h"
#include "tests/pipeline/door_helpers.h"
#include "tests/pipeline/shot_helpers.h"

namespace rigc {
namespace {

using pipeline::PlanForm;

const std::string kBiped = std::string(RIGC_SOURCE_DIR) + "/templates/biped.yaml";

std::string program_of(const std::string& file, PlanForm form = PlanForm::text) {
  pipeline::BuildRequest request;
  request.template_file = file;
  Diagnostics diagnostics;
  const auto text = pipeline::plan_program(request, form, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(text);
  return *text;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

bool is_instruction(const std::string& line) {
  return line.starts_with("r") && line.find("  # ") != std::string::npos;
}

TEST_CASE("plan program: every instruction says its node and template line") {
  const std::string text = program_of(kBiped);
  int instructions = 0;
  for (const std::string& line : lines_of(text)) {
    if (!is_instruction(line)) continue;
    ++instructions;
    INFO(line);
    const std::size_t place = line.rfind(".yaml:");
    REQUIRE(place != std::string::npos);
    CHECK(std::stoi(line.substr(place + 6)) > 0);
  }
  CHECK(instructions > 200);
  CHECK(text.find("  # rotation of control body\n") != std::string::npos);
  CHECK(text.find("  # world of joint head_head\n") != std::string::npos);
  const std::string last = lines_of(text).back();
  CHECK(last.starts_with(std::to_string(instructions) + " instructions, "));
  CHECK(last.ends_with(" bytes a block of 8 frames"));
  CHECK(program_of(kBiped) == text);
}

TEST_CASE("plan program: the file of a rig has the program of its template") {
  const std::string path = test::door("plan_program");
  const std::string text = program_of(path);
  CHECK(std::ranges::any_of(lines_of(text), is_instruction));
  CHECK(text.find("output r") != std::string::npos);
  // What is locked is no input; what is keyable is.
  CHECK(text.find("# translate of control handle") != std::string::npos);
  CHECK(text.find("# stiff of") == std::string::npos);
}

TEST_CASE("plan program: as JSON") {
  const std::string text = program_of(kBiped, PlanForm::json);
  Diagnostics diagnostics;
  const auto document = json::parse(text, "program", json::kMostBytes, diagnostics);
  REQUIRE(document);
  const auto programs = document->root().items();
  REQUIRE(programs.size() == 1);
  const auto instructions = programs[0]["instructions"].items();
  CHECK(instructions.size() > 200);
  for (const json::Value& instruction : instructions) {
    CHECK(*instruction["line"].integer() > 0);
    CHECK(*instruction["result"]["row"].integer() < *programs[0]["rows"].integer());
  }
  CHECK(programs[0]["outputs"].size() == 80);
  CHECK(*programs[0]["bytes"].integer() == *programs[0]["rows"].integer() * 64);
}

// The text between a line of three backticks with `language` that follows `from`, and the next.
std::string block_of(const std::string& page, const std::string& language, std::size_t from = 0) {
  const std::string fence = "\n```";
  const std::size_t opened = page.find(fence + language + "\n", from);
  REQUIRE(opened != std::string::npos);
  const std::size_t begin = opened + fence.size() + language.size() + 1;
  return page.substr(begin, page.find(fence, begin) + 1 - begin);
}

TEST_CASE("plan program: docs/evaluation.md shows the program of its template") {
  std::ifstream in(std::string(RIGC_SOURCE_DIR) + "/docs/evaluation.md");
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  const std::string path = std::string(RIGC_TEST_OUT) + "/desk.yaml";
  test::write_text(path, block_of(page, "yaml"));
  std::string text = program_of(path);
  for (auto at = text.find(path); at != std::string::npos; at = text.find(path))
    text.replace(at, path.size(), "desk.yaml");
  std::size_t seen = 0;
  int lines = 0;
  for (const std::string& line : lines_of(block_of(page, "", page.find("\n```\n$ rigc plan")))) {
    if (line.starts_with("$") || line == "...") continue;
    INFO(line);
    seen = text.find(line + "\n", seen);
    REQUIRE(seen != std::string::npos);
    ++lines;
  }
  CHECK(lines > 15);
}

TEST_CASE("plan program: a file without a rig is refused") {
  pipeline::BuildRequest request;
  request.template_file = std::string(RIGC_TEST_OUT) + "/no_such.glb";
  Diagnostics diagnostics;
  CHECK(!pipeline::plan_program(request, PlanForm::text, diagnostics));
  CHECK(diagnostics.errors() == 1);
}

}  // namespace
}  // namespace rigc
