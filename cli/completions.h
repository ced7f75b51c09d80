// SPDX-License-Identifier: MIT
// The command line as the shells complete it: what each command takes, and the scripts for bash,
// zsh and fish that say so. Test: tests/cli/completions_test.cpp
#pragma once

#include <string>
#include <vector>

namespace rigc::cli {

/// What may stand in one place of a command line.
struct Expected {
  std::string label;                  ///< "FILE", for people
  bool any_file = false;              ///< files of all kinds
  std::vector<std::string> suffixes;  ///< files that end so: ".glb"
  bool folders = false;
  std::vector<std::string> words;  ///< these words
  std::string names;               ///< what `rigc completions --names` lists; empty: nothing
};

struct CompletedOption {
  std::vector<std::string> spellings;  ///< "-o", "--output"
  std::string help;
  bool has_value = false;
  bool repeats = false;
  Expected value;
};

struct CompletedCommand {
  std::string name, summary;
  std::vector<CompletedOption> options;
  std::vector<Expected> positionals;
  bool last_repeats = false;  ///< the last positional may come again
};

std::string bash_script(const std::vector<CompletedCommand>& commands);
std::string zsh_script(const std::vector<CompletedCommand>& commands);
std::string fish_script(const std::vector<CompletedCommand>& commands);

}  // namespace rigc::cli
