// SPDX-License-Identifier: MIT
// rigc docs: writes the generated reference. For this repository, hence hidden. Test:
// tools/generate_docs
#include <fmt/format.h>

#include "base/files.h"
#include "cli/command.h"
#include "pipeline/reference.h"

namespace rigc::cli {
namespace {

/// Collects a command's arguments as rows of a table.
class DocumentOptions final : public Options {
 public:
  std::string rows;
  std::string usage;

  void positional(const std::string& name, std::string&, bool required,
                  const std::string& help) override {
    usage += required ? " " + name : " [" + name + "]";
    row(name, "", help);
  }
  void positionals(const std::string& name, std::vector<std::string>&,
                   const std::string& help) override {
    usage += " " + name + "...";
    row(name, "", help);
  }
  void text(const std::string& name, const std::string& value, std::string&, bool required,
            const std::string& help) override {
    if (required) usage += " " + name.substr(0, name.find(',')) + " " + value;
    row(name, value, help);
  }
  void list(const std::string& name, const std::string& value, std::vector<std::string>&,
            const std::string& help) override {
    row(name, value + "...", help);
  }
  void number(const std::string& name, const std::string& value, std::optional<double>&,
              const std::string& help) override {
    row(name, value, help);
  }
  void flag(const std::string& name, bool&, const std::string& help) override {
    row(name, "", help);
  }

 private:
  void row(const std::string& name, const std::string& value, const std::string& help) {
    std::string shown = value.empty() ? name : name + " " + value;
    for (std::size_t at = 0; (at = shown.find('|', at)) != std::string::npos; at += 2)
      shown.insert(at, "\\");
    rows += fmt::format("| `{}` | {} |\n", shown, help);
  }
};

std::string command_reference() {
  std::string out =
      "# Commands\n\nMade from the table of commands by `rigc docs`. Every command takes `--json` "
      "(one JSON document on "
      "stdout) and `--help`.\nExit status: 0 done, 1 the work has errors, 2 wrong usage, 3 the "
      "file system refused.\n";
  for (auto& command : commands()) {
    if (command->hidden()) continue;
    DocumentOptions options;
    command->declare(options);
    out += fmt::format(
        "\n## rigc {}\n\n{}.\n\n```\nrigc {}{}\n```\n\n| argument | what it does |\n| --- | --- "
        "|\n{}",
        command->name(), command->summary(), command->name(), options.usage, options.rows);
    if (command->examples().empty()) continue;
    out += "\n```\n";
    for (const std::string& example : command->examples()) out += example + "\n";
    out += "```\n";
  }
  return out;
}

class Docs final : public Command {
 public:
  std::string name() const override { return "docs"; }
  std::string summary() const override { return "Write the generated reference into a folder"; }
  bool hidden() const override { return true; }
  void declare(Options& options) override {
    options.positional("FOLDER", folder_, true, "Where to write");
  }
  void run(Session& session) override {
    const std::pair<const char*, std::string> files[] = {
        {"commands.md", command_reference()},
        {"modules.md", pipeline::module_reference()},
        {"diagnostics.md", pipeline::diagnostic_reference()}};
    for (const auto& [name, text] : files)
      write_file(join_path(folder_, name), {text}, session.diagnostics);
  }

 private:
  std::string folder_;
};

}  // namespace

std::unique_ptr<Command> make_docs() { return std::make_unique<Docs>(); }

}  // namespace rigc::cli
