// SPDX-License-Identifier: MIT
// Bad inputs: every folder of tests/bad has a bad.yaml that gives exactly the diagnostics of
// `expected`, and its repaired twin good.yaml that builds. tests/bad/README.md tells what a folder
// may hold.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "cli/process_helpers.h"

namespace fs = std::filesystem;
using rigc::test::Outcome;

namespace {

std::vector<fs::path> bad_folders() {
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(rigc::test::source_folder() / "tests/bad")) {
    if (entry.is_directory()) folders.push_back(entry.path());
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

/// Arguments that a file of the folder gives, one a line; `$CORPUS` stands for the corpus' folder.
std::vector<std::string> arguments_of(const fs::path& file) {
  std::vector<std::string> arguments = rigc::test::lines_of(rigc::test::file_text(file));
  for (std::string& argument : arguments) {
    const auto at = argument.find("$CORPUS");
    if (at != std::string::npos) argument.replace(at, 7, rigc::test::corpus_folder().string());
  }
  return arguments;
}

bool needs_corpus(const fs::path& folder) {
  const std::string arguments =
      rigc::test::file_text(folder / "args") + rigc::test::file_text(folder / "bad_args");
  return arguments.find("$CORPUS") != std::string::npos;
}

Outcome run_in(const fs::path& folder, const std::string& command, const std::string& input,
               const fs::path& output) {
  std::vector<std::string> arguments = {command, input};
  if (command == "build") arguments.insert(arguments.end(), {"-o", output.string()});
  for (const std::string& extra : arguments_of(folder / "args")) arguments.push_back(extra);
  if (input == "bad.yaml") {
    for (const std::string& extra : arguments_of(folder / "bad_args")) arguments.push_back(extra);
  }
  return rigc::test::run_rigc(arguments, {folder, {}});
}

void check_bad(const fs::path& folder, const std::string& command, const fs::path& output) {
  const Outcome outcome = run_in(folder, command, "bad.yaml", output);
  std::vector<std::string> found;
  bool errors = false;
  for (const auto& diagnostic : rigc::test::printed_diagnostics(outcome.err, "bad.yaml")) {
    found.push_back(diagnostic.text);
    errors = errors || diagnostic.error;
  }
  std::vector<std::string> expected =
      rigc::test::lines_of(rigc::test::file_text(folder / "expected"));
  std::sort(found.begin(), found.end());
  std::sort(expected.begin(), expected.end());
  INFO(outcome.err);
  CHECK_FALSE(expected.empty());
  CHECK(joined(found) == joined(expected));
  CHECK(outcome.status == (errors ? 1 : 0));
  CHECK(fs::exists(output) == (command == "build" && !errors));
}

/// Notes for the validator from which model `output` was made: it may have that model's messages.
void note_model(const fs::path& folder, const fs::path& output) {
  const std::vector<std::string> arguments = arguments_of(folder / "args");
  const auto model = std::find(arguments.begin(), arguments.end(), "--model");
  if (model == arguments.end()) return;
  std::ofstream(output.string() + ".model") << (folder / model[1]).string() << "\n";
}

void check_good(const fs::path& folder, const fs::path& output) {
  const Outcome outcome = run_in(folder, "build", "good.yaml", output);
  note_model(folder, output);
  INFO(outcome.err);
  CHECK(outcome.status == 0);
  CHECK(fs::exists(output));
  const std::string expected = rigc::test::file_text(folder / "expected");
  for (const auto& diagnostic : rigc::test::printed_diagnostics(outcome.err, "good.yaml")) {
    const std::string code = diagnostic.text.substr(diagnostic.text.rfind(' ') + 1);
    INFO("the repaired twin gives " << code << " too");
    CHECK(expected.find(code) == std::string::npos);
  }
}

/// Codes as the folders of src/ declare them: `RIG0123` -> the constant's name.
std::map<std::string, std::string> declared_codes() {
  static const std::regex declaration(R"(Code (k\w+)\s*\{\s*(\d+),)");
  std::map<std::string, std::string> codes;
  for (const char* top : {"src", "cli"}) {
    for (const auto& entry : fs::recursive_directory_iterator(rigc::test::source_folder() / top)) {
      if (!entry.path().string().ends_with("codes.h")) continue;
      const std::string text = rigc::test::file_text(entry.path());
      for (std::sregex_iterator it(text.begin(), text.end(), declaration), end; it != end; ++it) {
        std::string digits = (*it)[2];
        const std::string code = "RIG" + std::string(4 - digits.size(), '0') + digits;
        INFO(code << " is " << codes[code] << " and " << (*it)[1].str());
        CHECK(codes[code].empty());
        codes[code] = (*it)[1];
      }
    }
  }
  return codes;
}

/// Codes of `text`, each line of which may begin with one or name one anywhere.
std::set<std::string> codes_in(const std::string& text) {
  static const std::regex code(R"(RIG\d{4})");
  std::set<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), code), end; it != end; ++it) {
    found.insert(it->str());
  }
  return found;
}

}  // namespace

TEST_CASE("cli bad: every bad input gives exactly its diagnostics and its repaired twin builds") {
  const fs::path out = rigc::test::fresh_folder("bad");
  const std::vector<fs::path> folders = bad_folders();
  CHECK_FALSE(folders.empty());
  for (const fs::path& folder : folders) {
    const std::string name = folder.filename().string();
    INFO("tests/bad/" << name);
    if (needs_corpus(folder) && rigc::test::corpus_folder().empty()) {
      MESSAGE("the corpus is not here: left out tests/bad/" << name);
      continue;
    }
    const auto commands = rigc::test::lines_of(rigc::test::file_text(folder / "command"));
    check_bad(folder, commands.empty() ? "check" : commands.front(), out / (name + "_bad.glb"));
    check_good(folder, out / (name + ".glb"));
  }
}

TEST_CASE("cli bad: every diagnostic code has a bad input or a test that provokes it") {
  const fs::path tests = rigc::test::source_folder() / "tests";
  std::set<std::string> provoked;
  for (const fs::path& folder : bad_folders()) {
    provoked.merge(codes_in(rigc::test::file_text(folder / "expected")));
  }
  const std::map<std::string, std::string> codes = declared_codes();
  CHECK(codes.size() > 50);

  // README.md lists the others with the test that provokes them.
  static const std::regex row(R"((RIG\d{4}) \| `(tests/\w+/\w+\.cpp)`)");
  const std::string listed = rigc::test::file_text(tests / "bad/README.md");
  for (std::sregex_iterator it(listed.begin(), listed.end(), row), end; it != end; ++it) {
    const std::string code = (*it)[1];
    INFO("tests/bad/README.md: " << code);
    const auto declared = codes.find(code);
    REQUIRE(declared != codes.end());
    // A test may also name the number: three digits, so that it cannot mean anything else.
    const std::regex mention("\\b(" + code + "|" + declared->second + "|" +
                             code.substr(code[3] == '0' && code[4] != '0' ? 4 : 0) + ")\\b");
    const std::string test = rigc::test::file_text(rigc::test::source_folder() / (*it)[2].str());
    CHECK(std::regex_search(test, mention));
    provoked.insert(code);
  }
  std::string missing;
  for (const auto& [code, name] : codes) {
    if (provoked.count(code) == 0) missing += code + " " + name + "\n";
  }
  INFO("no folder of tests/bad and no line of tests/bad/README.md provokes:\n" << missing);
  CHECK(missing.empty());
}

TEST_CASE("cli bad: the reference of diagnostics has every declared code and no other") {
  const std::set<std::string> documented =
      codes_in(rigc::test::file_text(rigc::test::source_folder() / "docs/diagnostics.md"));
  const std::map<std::string, std::string> codes = declared_codes();
  std::string difference;
  for (const auto& [code, name] : codes) {
    if (documented.count(code) == 0) difference += code + " " + name + " is declared only\n";
  }
  for (const std::string& code : documented) {
    if (codes.count(code) == 0) difference += code + " is documented only\n";
  }
  INFO(difference);
  CHECK(difference.empty());
}
