// SPDX-License-Identifier: MIT
// The table of commands, and options that several share. Test: tests/cli/cli_test.cpp
#include "cli/command.h"

namespace rigc::cli {

std::vector<std::unique_ptr<Command>> commands() {
  std::vector<std::unique_ptr<Command>> table;
  table.push_back(make_build());
  table.push_back(make_check());
  table.push_back(make_plan());
  table.push_back(make_inspect());
  table.push_back(make_query());
  table.push_back(make_bake());
  table.push_back(make_modules());
  table.push_back(make_schema());
  table.push_back(make_docs());
  return table;
}

void declare_paths(Options& options, pipeline::Paths& paths) {
  options.list("--templates", "DIR", paths.templates,
               "Look for templates and parts here first (then RIGC_TEMPLATES, then those that come "
               "with rigc)");
  options.list("--modules", "DIR", paths.modules,
               "Add module descriptors from here (also: RIGC_MODULES)");
}

}  // namespace rigc::cli
