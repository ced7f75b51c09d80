// SPDX-License-Identifier: MIT
// The table of commands, and options that several share. Test: tests/cli/cli_test.cpp
#include "cli/command.h"

namespace rigc::cli {

std::vector<std::unique_ptr<Command>> commands() {
  std::vector<std::unique_ptr<Command>> table;
  table.push_back(make_build());
  table.push_back(make_update());
  table.push_back(make_rebuild());
  table.push_back(make_unbuild());
  table.push_back(make_strip());
  table.push_back(make_prune());
  table.push_back(make_map());
  table.push_back(make_guides());
  table.push_back(make_check());
  table.push_back(make_plan());
  table.push_back(make_status());
  table.push_back(make_inspect());
  table.push_back(make_query());
  table.push_back(make_bake());
  table.push_back(make_transfer());
  table.push_back(make_match());
  table.push_back(make_merge());
  table.push_back(make_rename());
  table.push_back(make_extract());
  table.push_back(make_adopt());
  table.push_back(make_modules());
  table.push_back(make_schema());
  table.push_back(make_completions());
  table.push_back(make_docs());
  return table;
}

void declare_build(Options& options, pipeline::BuildRequest& request) {
  options.positional("TEMPLATE", request.template_file, true,
                     "Template file, or the name of one that comes with rigc");
  options.text("--model", "FILE", request.model, false,
               "Fit the template to this character and keep its mesh and clips");
  options.text("--map", "NAME|FILE", request.map, false,
               "Which bone is which joint (default: by detection)");
  options.text("--skeleton", "NODE", request.skeleton, false,
               "Skeleton of the model, by a node's name or number");
  options.text("--rest", "REST", request.rest, false,
               "Pose of the model to build in: bind (default), nodes, or CLIP@SECONDS");
  options.text("--global", "NAME", request.global, false,
               "Global group of the rig (default: the template's)");
  options.list("--feature", "[GROUP/]NAME[:SWITCH]=on|off", request.features,
               "Turn a feature on or off; of a group, in the groups beneath it too");
  options.list("--group", "GROUP=on|off", request.groups, "Turn a local group on or off");
  options.list("--only", "GROUP", request.only, "Run only the commands of this local group");
  options.text("--until", "JOINT/COMMAND", request.until, false, "Stop after this command");
}

void declare_paths(Options& options, pipeline::Paths& paths) {
  options.list("--templates", "DIR", paths.templates,
               "Look for templates and parts here first (then RIGC_TEMPLATES, then those that come "
               "with rigc)");
  declare_modules(options, paths);
}

void declare_modules(Options& options, pipeline::Paths& paths) {
  options.list("--modules", "DIR", paths.modules,
               "Add module descriptors from here (also: RIGC_MODULES)");
}

}  // namespace rigc::cli
