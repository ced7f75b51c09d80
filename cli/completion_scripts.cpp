// SPDX-License-Identifier: MIT
// The completion scripts, from what the commands take. Test: tests/cli/completions_test.cpp
#include <fmt/format.h>

#include "base/text.h"
#include "cli/completions.h"

namespace rigc::cli {
namespace {

/// `text` between single quotes.
std::string quoted(std::string_view text, std::string_view quote_inside) {
  std::string out = "'";
  for (char c : text) out += c == '\'' ? std::string(quote_inside) : std::string(1, c);
  return out + "'";
}

/// A call of one of the script's functions for what is expected: `_rigc_expect FILES WORDS NAMES`.
std::string bash_call(const Expected& expected) {
  std::string files = join(expected.suffixes, " ");
  if (expected.folders) files = "/";
  return fmt::format("_rigc_expect '{}' '{}' '{}'", files, join(expected.words, " "),
                     expected.names);
}

std::string all_spellings(const CompletedCommand& command) {
  std::vector<std::string> spellings;
  for (const CompletedOption& option : command.options)
    spellings.insert(spellings.end(), option.spellings.begin(), option.spellings.end());
  return join(spellings, " ");
}

std::string bash_command(const CompletedCommand& command) {
  std::string valued, choices;
  for (const CompletedOption& option : command.options) {
    if (!option.has_value) continue;
    const std::string pattern = join(option.spellings, "|");
    valued += (valued.empty() ? "" : "|") + pattern;
    choices += fmt::format("        {}) {}; return ;;\n", pattern, bash_call(option.value));
  }
  std::string places;
  for (std::size_t i = 0; i < command.positionals.size(); ++i) {
    const bool repeats = command.last_repeats && i + 1 == command.positionals.size();
    places += fmt::format("        {}) {} ;;\n", repeats ? "*" : std::to_string(i),
                          bash_call(command.positionals[i]));
  }
  return fmt::format(R"(    {})
      case $previous in
{}      esac
      if [[ $current == -* ]]; then COMPREPLY=($(compgen -W '{}' -- "$current")); return; fi
      _rigc_place '{}'
      case $place in
{}      esac ;;
)",
                     command.name, choices, all_spellings(command), valued, places);
}

constexpr const char* kBashHead =
    R"(# Completion of rigc's command line for bash, made by `rigc completions bash`.
# FILES: endings of file names, or `/` for folders alone; WORDS; NAMES: what rigc itself can list.
_rigc_expect() {
  local ending name
  while IFS= read -r name; do
    if [[ -d $name ]]; then
      [[ -n $1 ]] && COMPREPLY+=("$name/")
    else
      for ending in $1; do [[ $name == *"$ending" ]] && COMPREPLY+=("$name"); done
    fi
  done < <(compgen -f -- "$current")
  COMPREPLY+=($(compgen -W "$2 ${3:+$("${COMP_WORDS[0]}" completions --names "$3" 2>/dev/null)}" -- "$current"))
  [[ ${#COMPREPLY[@]} == 1 && $COMPREPLY == */ ]] && compopt -o nospace 2>/dev/null
  return 0
}

# How many words before the current one are no options and no values of the options in $1.
_rigc_place() {
  local i
  place=0
  for ((i = 2; i < COMP_CWORD; ++i)); do
    if [[ ${COMP_WORDS[i]} == -* ]]; then
      [[ "|$1|" == *"|${COMP_WORDS[i]}|"* ]] && ((++i))
    else
      ((++place))
    fi
  done
}

_rigc() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} place
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
)";

constexpr const char* kZshHead = R"(#compdef rigc
# Completion of rigc's command line for zsh, made by `rigc completions zsh`.
_rigc_names() {
  local -a found=($($_rigc_program completions --names $1 2>/dev/null))
  compadd -a found
}

_rigc() {
  local _rigc_program=$words[1] curcontext=$curcontext
  local -a commands
  commands=(
)";

/// Text inside of a specification of _arguments.
std::string zsh_text(std::string_view text) {
  std::string out;
  for (char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

std::string zsh_action(const Expected& expected) {
  std::vector<std::string> alternatives;
  if (!expected.suffixes.empty()) {
    std::vector<std::string> endings;
    for (const std::string& suffix : expected.suffixes) endings.push_back(suffix.substr(1));
    alternatives.push_back(
        fmt::format("\"files:file:_files -g \\\"*.({})\\\"\"", join(endings, "|")));
  }
  if (expected.folders) alternatives.push_back(R"("folders:folder:_files -/")");
  if (!expected.words.empty())
    alternatives.push_back(fmt::format("\"words:word:({})\"", join(expected.words, " ")));
  if (!expected.names.empty())
    alternatives.push_back(fmt::format(R"("names:name:_rigc_names {}")", expected.names));
  return alternatives.empty() ? " " : "_alternative " + join(alternatives, " ");
}

std::string zsh_command(const CompletedCommand& command) {
  std::string out = fmt::format("    {}) _arguments -s", command.name);
  for (const CompletedOption& option : command.options) {
    const std::string value = option.has_value ? fmt::format(":{}:{}", zsh_text(option.value.label),
                                                             zsh_action(option.value))
                                               : std::string();
    const std::string rest = fmt::format("[{}]{}", zsh_text(option.help), value);
    const std::string prefix =
        option.repeats ? "*" : fmt::format("({})", join(option.spellings, " "));
    for (const std::string& spelling : option.spellings)
      out += " \\\n      " + quoted(prefix + spelling + rest, R"('\'')");
  }
  for (std::size_t i = 0; i < command.positionals.size(); ++i) {
    const Expected& place = command.positionals[i];
    const bool repeats = command.last_repeats && i + 1 == command.positionals.size();
    out += " \\\n      " + quoted(fmt::format("{}:{}:{}", repeats ? "*" : std::to_string(i + 1),
                                              zsh_text(place.label), zsh_action(place)),
                                  R"('\'')");
  }
  return out + " ;;\n";
}

constexpr const char* kFishHead =
    R"(# Completion of rigc's command line for fish, made by `rigc completions fish`.
function __rigc_names
  set -l words (commandline -opc)
  $words[1] completions --names $argv[1] 2>/dev/null
end
function __rigc_files
  for ending in $argv
    __fish_complete_suffix $ending | string match -e -- $ending
  end
  __fish_complete_directories (commandline -ct)
end
complete -c rigc -f
)";

/// What `complete -a` takes.
std::string fish_choices(const Expected& expected) {
  std::vector<std::string> choices;
  if (!expected.suffixes.empty())
    choices.push_back(fmt::format("(__rigc_files {})", join(expected.suffixes, " ")));
  if (expected.folders) choices.push_back("(__fish_complete_directories (commandline -ct))");
  if (!expected.words.empty()) choices.push_back(join(expected.words, " "));
  if (!expected.names.empty()) choices.push_back(fmt::format("(__rigc_names {})", expected.names));
  return choices.empty() ? std::string() : " -a " + quoted(join(choices, " "), R"(\')");
}

std::string fish_command(const CompletedCommand& command) {
  std::string out = fmt::format("complete -c rigc -n __fish_use_subcommand -a {} -d {}\n",
                                command.name, quoted(command.summary, R"(\')"));
  const std::string when = fmt::format("-n '__fish_seen_subcommand_from {}'", command.name);
  for (const CompletedOption& option : command.options) {
    std::string names;
    for (const std::string& spelling : option.spellings)
      names += spelling.size() == 2 ? " -s " + spelling.substr(1) : " -l " + spelling.substr(2);
    out += fmt::format("complete -c rigc {}{}{} -d {}{}\n", when, names,
                       option.has_value ? " -x" : "", quoted(option.help, R"(\')"),
                       option.has_value ? fish_choices(option.value) : "");
  }
  for (const Expected& place : command.positionals)
    if (const std::string choices = fish_choices(place); !choices.empty())
      out += fmt::format("complete -c rigc {}{}\n", when, choices);
  return out;
}

}  // namespace

std::string bash_script(const std::vector<CompletedCommand>& commands) {
  std::vector<std::string> names;
  std::string cases;
  for (const CompletedCommand& command : commands) {
    names.push_back(command.name);
    cases += bash_command(command);
  }
  return fmt::format(R"({}    COMPREPLY=($(compgen -W '{} --help --version' -- "$current"))
    return
  fi
  case ${{COMP_WORDS[1]}} in
{}  esac
}}
complete -o filenames -F _rigc rigc
)",
                     kBashHead, join(names, " "), cases);
}

std::string zsh_script(const std::vector<CompletedCommand>& commands) {
  std::string names, cases;
  for (const CompletedCommand& command : commands) {
    std::string summary = command.summary;
    names += "    " + quoted(command.name + ":" + summary, R"('\'')") + "\n";
    cases += zsh_command(command);
  }
  return fmt::format(R"({}{}  )
  if ((CURRENT == 2)); then
    _describe command commands
    return
  fi
  shift words
  ((--CURRENT))
  case $words[1] in
{}  esac
}}

if [[ $funcstack[1] == _rigc ]]; then _rigc "$@"; else compdef _rigc rigc; fi
)",
                     kZshHead, names, cases);
}

std::string fish_script(const std::vector<CompletedCommand>& commands) {
  std::string out = kFishHead;
  for (const CompletedCommand& command : commands) out += fish_command(command);
  return out;
}

}  // namespace rigc::cli
