// SPDX-License-Identifier: MIT
// rigc: parses the command line, runs one command, prints what it reports. Exit status: 0 done, 1
// the work has errors, 2 wrong usage, 3 the file system refused. Test: tests/cli/cli_test.cpp
#include <CLI/CLI.hpp>
#include <cstdio>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "base/text.h"
#include "cli/command.h"
#include "cli/terminal.h"
#include "pipeline/instruction_set.h"

namespace {

using rigc::cli::Command;
using rigc::cli::Options;
using rigc::cli::Session;

constexpr const char* kVersion = "rigc 0.1.0";

/// Hands a command's arguments to the parser.
class ParserOptions final : public Options {
 public:
  explicit ParserOptions(CLI::App& app) : app_(app) {}

  void positional(const std::string& name, std::string& target, bool required,
                  const std::string& help) override {
    auto* option = app_.add_option(name, target, help)->type_name("");
    if (required) option->required();
  }
  void positionals(const std::string& name, std::vector<std::string>& target,
                   const std::string& help) override {
    app_.add_option(name, target, help)->type_name("")->required();
  }
  void text(const std::string& name, const std::string& value, std::string& target, bool required,
            const std::string& help) override {
    auto* option = app_.add_option(name, target, help)->type_name(value);
    if (required) option->required();
  }
  void list(const std::string& name, const std::string& value, std::vector<std::string>& target,
            const std::string& help) override {
    app_.add_option(name, target, help)
        ->type_name(value)
        ->expected(1)
        ->take_all()
        ->allow_extra_args(false);
  }
  void number(const std::string& name, const std::string& value, std::optional<double>& target,
              const std::string& help) override {
    app_.add_option(name, target, help)->type_name(value);
  }
  void flag(const std::string& name, bool& target, const std::string& help) override {
    app_.add_flag(name, target, help);
  }

 private:
  CLI::App& app_;
};

void print(std::FILE* to, const std::string& text) { std::fwrite(text.data(), 1, text.size(), to); }

int finish(const Session& session) {
  print(stderr, rigc::render(session.diagnostics, rigc::cli::wants_colour()));
  print(stderr, session.notes);
  print(stdout, session.out);
  const bool written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (session.diagnostics.file_system_refused() || !written) return 3;
  return session.diagnostics.ok() ? session.status : 1;
}

/// A first word that is no command: said so, with the nearest one, before the parser speaks of
/// sub-commands.
bool unknown_command(int argc, char** argv, const std::vector<std::unique_ptr<Command>>& table) {
  if (argc < 2 || argv[1][0] == '-') return false;
  std::vector<std::string> names;
  for (const auto& command : table) {
    if (command->name() == argv[1]) return false;
    if (!command->hidden()) names.push_back(command->name());
  }
  print(stderr, "rigc: there is no command \"" + rigc::printable(argv[1]) + "\"; " +
                    rigc::suggest(argv[1], names) + "\n");
  return true;
}

/// An instruction set was asked for that cannot be used: said so.
bool refused_isa() {
  const std::string problem = rigc::pipeline::instruction_set_problem();
  if (!problem.empty()) print(stderr, "rigc: " + problem + "\n");
  return !problem.empty();
}

}  // namespace

int main(int argc, char** argv) {
#ifdef __GLIBC__
  // Texts and buffers of a few megabytes come and go all the time: giving each back to the system
  // costs more than the work on it.
  mallopt(M_MMAP_THRESHOLD, 64 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
  mallopt(M_TOP_PAD, 16 << 20);
#endif
  CLI::App app{"rigc compiles character rigs from YAML templates into glTF files.", "rigc"};
  app.set_version_flag("--version", kVersion, "Print the version");
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  Session session;
  auto table = rigc::cli::commands();
  if (refused_isa() || unknown_command(argc, argv, table)) return 2;
  for (auto& command : table) {
    CLI::App* sub = app.add_subcommand(command->name(), command->summary());
    ParserOptions options(*sub);
    command->declare(options);
    sub->add_flag("--json", session.json, "Print one JSON document on stdout");
    std::string footer;
    for (const std::string& example : command->examples()) footer += "  " + example + "\n";
    if (!footer.empty()) sub->footer("Examples:\n" + footer);
    if (command->hidden()) sub->group("");
    Command* runs = command.get();
    sub->callback([runs, &session] { runs->run(session); });
  }
  app.footer(
      "`rigc COMMAND --help` explains a command. Exit status: 0 done, 1 errors in the work, 2 "
      "wrong usage, "
      "3 the file system refused. The environment's RIGC_ISA=baseline or avx2 forces the "
      "instruction set of evaluation; results do not depend on it.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  return finish(session);
}
