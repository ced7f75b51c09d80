// SPDX-License-Identifier: MIT
// rigc completions: scripts for the shells, made from the table of commands; and the names that
// those scripts ask for. Test: tests/cli/completions_test.cpp
#include "cli/completions.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/codes.h"
#include "base/text.h"
#include "cli/command.h"
#include "pipeline/names.h"

namespace rigc::cli {
namespace {

/// What a value is, by the word that stands for it in the help.
Expected expected_of(const std::string& command, const std::string& label) {
  static const std::vector<std::string> kModels = {".glb", ".gltf", ".vrm"};
  Expected expected;
  expected.label = label;
  if (label == "TEMPLATE") {
    expected.suffixes = {".yaml"};
    expected.names = "templates";
  } else if (label == "NAME|FILE") {
    expected.suffixes = {".yaml"};
    expected.names = "maps";
  } else if (label == "NAME" && (command == "modules" || command == "schema")) {
    expected.names = "modules";
    if (command == "schema") expected.words = {"RIGC_rig", "template"};
  } else if (label == "FILE" || label == "MODEL" || label == "OUT.glb") {
    expected.suffixes = kModels;
    if (command == "check") expected.suffixes.push_back(".yaml");
  } else if (ends_with(label, ".yaml")) {
    expected.suffixes = {".yaml"};
  } else if (label == "DIR" || label == "FOLDER") {
    expected.folders = true;
  } else if (label == "REST") {
    expected.words = {"bind", "nodes"};
  } else if (label == "N|source") {
    expected.words = {"source", "24", "25", "30", "60"};
  } else if (label == "SHELL") {
    expected.words = {"bash", "zsh", "fish"};
  } else if (label == "templates|maps|modules") {
    expected.words = {"templates", "maps", "modules"};
  }
  return expected;
}

/// Takes what a command declares.
class Collector final : public Options {
 public:
  explicit Collector(CompletedCommand& command) : command_(command) {}

  void positional(const std::string& name, std::string&, bool, const std::string&) override {
    command_.positionals.push_back(expected_of(command_.name, name));
  }
  void positionals(const std::string& name, std::vector<std::string>&,
                   const std::string&) override {
    command_.positionals.push_back(expected_of(command_.name, name));
    command_.last_repeats = true;
  }
  void text(const std::string& name, const std::string& value, std::string&, bool,
            const std::string& help) override {
    add(name, help).value = expected_of(command_.name, value);
  }
  void list(const std::string& name, const std::string& value, std::vector<std::string>&,
            const std::string& help) override {
    CompletedOption& option = add(name, help);
    option.value = expected_of(command_.name, value);
    option.repeats = true;
  }
  void number(const std::string& name, const std::string& value, std::optional<double>&,
              const std::string& help) override {
    add(name, help).value = expected_of(command_.name, value);
  }
  void flag(const std::string& name, bool&, const std::string& help) override {
    add(name, help).has_value = false;
  }

 private:
  CompletedOption& add(const std::string& name, const std::string& help) {
    CompletedOption& option = command_.options.emplace_back();
    for (const std::string_view spelling : split(name, ','))
      option.spellings.emplace_back(spelling);
    option.help = help;
    option.has_value = true;
    return option;
  }

  CompletedCommand& command_;
};

std::vector<CompletedCommand> completed_commands() {
  std::vector<CompletedCommand> completed;
  for (const auto& command : commands()) {
    if (command->hidden()) continue;
    CompletedCommand& entry = completed.emplace_back();
    entry.name = command->name();
    entry.summary = command->summary();
    Collector collector(entry);
    command->declare(collector);
    bool json = false;
    collector.flag("--json", json, "Print one JSON document on stdout");
    collector.flag("-h,--help", json, "Explain the command");
  }
  return completed;
}

bool is_one_of(const std::string& word, const std::vector<std::string>& allowed,
               Diagnostics& diagnostics) {
  if (std::find(allowed.begin(), allowed.end(), word) != allowed.end()) return true;
  diagnostics.report(codes::kUnknownChoice, Place(),
                     word.empty() ? "a shell is needed"
                                  : fmt::format("\"{}\" is none of the words", printable(word)),
                     suggest(word, allowed));
  return false;
}

class Completions final : public Command {
 public:
  std::string name() const override { return "completions"; }
  std::string summary() const override {
    return "Print what makes a shell complete rigc's command line";
  }
  std::vector<std::string> examples() const override {
    return {"source <(rigc completions bash)", "rigc completions zsh >~/.zfunc/_rigc",
            "rigc completions fish >~/.config/fish/completions/rigc.fish"};
  }
  void declare(Options& options) override {
    options.positional("SHELL", shell_, false, "bash, zsh or fish");
    options.text("--names", "templates|maps|modules", names_, false,
                 "List names instead, one a line, as the scripts do");
    declare_paths(options, paths_);
  }
  void run(Session& session) override {
    if (!names_.empty()) {
      if (!is_one_of(names_, {"templates", "maps", "modules"}, session.diagnostics)) return;
      for (const std::string& name : pipeline::names(names_, paths_, session.diagnostics))
        session.out += name + "\n";
      return;
    }
    if (!is_one_of(shell_, {"bash", "zsh", "fish"}, session.diagnostics)) return;
    const auto table = completed_commands();
    session.out = shell_ == "bash"  ? bash_script(table)
                  : shell_ == "zsh" ? zsh_script(table)
                                    : fish_script(table);
  }

 private:
  std::string shell_, names_;
  pipeline::Paths paths_;
};

}  // namespace

std::unique_ptr<Command> make_completions() { return std::make_unique<Completions>(); }

}  // namespace rigc::cli
