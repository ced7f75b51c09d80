// SPDX-License-Identifier: MIT
// Commands that replace files, run again and again in a fresh folder while something goes wrong.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "cli/process_helpers.h"

namespace rigc::test {

/// Names below a folder and what is in the files.
using Files = std::map<std::string, std::string>;
using Environment = std::vector<std::pair<std::string, std::string>>;

/// A command that changes files: where `@` stands in its arguments the folder's path is put.
struct Command {
  std::string name;
  std::string binary;
  std::vector<std::string> arguments;
  std::string target;  ///< the file whose name messages must give; empty: one of several
  Files before;        ///< what lies in the folder when it begins
  Files after;         ///< and when nothing went wrong
};

/// The folder that a command runs in. One of a process at a time.
class Stage {
 public:
  explicit Stage(const Command& command);
  /// Puts everything back to how it is before the command.
  void reset() const;
  /// The command in the folder as it is.
  Outcome run(const Environment& environment = {}) const;
  /// Starts the command and kills it so many microseconds later; false: it was done before.
  bool run_and_kill(unsigned microseconds) const;
  Files files() const;
  std::filesystem::path path() const { return folder_; }
  /// Arguments with the folder put in.
  std::vector<std::string> arguments() const;
  const Command& command() const { return command_; }

 private:
  const Command& command_;
  std::filesystem::path folder_;
};

/// Where the folders of commands are.
std::filesystem::path faults_folder();

/// All commands that faults are tried on, each run once without any: so that `after` is known.
const std::vector<Command>& commands();

/// What is wrong with a folder in which every file must be the old one or the new one, and nothing
/// else may lie (with `leftovers`: but temporary files); empty: nothing.
std::string damage(const Command& command, const Files& files, bool leftovers);

/// The environment that preloads the shim for a folder; `at` is the number of the call.
Environment faulty(const std::filesystem::path& folder, int at, const std::string& kind);

/// The calls that a command makes for its folder, "open /the/path".
std::vector<std::string> calls_of(const Stage& stage);

/// From the environment; else `otherwise`.
int count_from_environment(const char* name, int otherwise);

}  // namespace rigc::test
