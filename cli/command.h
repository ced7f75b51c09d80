// SPDX-License-Identifier: MIT
// One command of the command line: what it declares and what it does. The library that parses
// arguments is known to main.cpp alone. Test: tests/cli/cli_test.cpp
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "pipeline/build.h"

namespace rigc::cli {

/// Receives the arguments that a command takes. `value` names the argument in help ("FILE").
class Options {
 public:
  virtual ~Options() = default;
  virtual void positional(const std::string& name, std::string& target, bool required,
                          const std::string& help) = 0;
  virtual void positionals(const std::string& name, std::vector<std::string>& target,
                           const std::string& help) = 0;
  virtual void text(const std::string& name, const std::string& value, std::string& target,
                    bool required, const std::string& help) = 0;
  virtual void list(const std::string& name, const std::string& value,
                    std::vector<std::string>& target, const std::string& help) = 0;
  virtual void number(const std::string& name, const std::string& value,
                      std::optional<double>& target, const std::string& help) = 0;
  virtual void flag(const std::string& name, bool& target, const std::string& help) = 0;
};

/// What a command prints and reports. Text for people goes to stdout with the summary; diagnostics
/// to stderr.
struct Session {
  Diagnostics diagnostics;
  bool json = false;
  std::string out;    ///< for stdout, printed when the command ends
  int status = 0;     ///< exit status where no error was reported
  std::string notes;  ///< for stderr after the diagnostics: timings
};

class Command {
 public:
  virtual ~Command() = default;
  virtual std::string name() const = 0;
  virtual std::string summary() const = 0;
  /// One or more command lines to show under the help.
  virtual std::vector<std::string> examples() const { return {}; }
  virtual bool hidden() const { return false; }
  virtual void declare(Options& options) = 0;
  virtual void run(Session& session) = 0;
};

/// --templates and --modules, which most commands take.
void declare_paths(Options& options, pipeline::Paths& paths);
/// --modules alone.
void declare_modules(Options& options, pipeline::Paths& paths);

/// What `build` and `plan` share: template, model, features, groups, how far to run.
void declare_build(Options& options, pipeline::BuildRequest& request);

std::unique_ptr<Command> make_adopt();
std::unique_ptr<Command> make_bake();
std::unique_ptr<Command> make_build();
std::unique_ptr<Command> make_check();
std::unique_ptr<Command> make_completions();
std::unique_ptr<Command> make_docs();
std::unique_ptr<Command> make_extract();
std::unique_ptr<Command> make_guides();
std::unique_ptr<Command> make_inspect();
std::unique_ptr<Command> make_map();
std::unique_ptr<Command> make_match();
std::unique_ptr<Command> make_merge();
std::unique_ptr<Command> make_modules();
std::unique_ptr<Command> make_plan();
std::unique_ptr<Command> make_prune();
std::unique_ptr<Command> make_query();
std::unique_ptr<Command> make_rebuild();
std::unique_ptr<Command> make_rename();
std::unique_ptr<Command> make_schema();
std::unique_ptr<Command> make_status();
std::unique_ptr<Command> make_strip();
std::unique_ptr<Command> make_transfer();
std::unique_ptr<Command> make_unbuild();
std::unique_ptr<Command> make_update();

/// The table of commands, in the order of the help.
std::vector<std::unique_ptr<Command>> commands();

}  // namespace rigc::cli
