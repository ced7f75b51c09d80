// SPDX-License-Identifier: MIT
// rigc plan: the ordered command list with resolved selectors. Test: tests/cli/cli_test.cpp
#include "pipeline/plan.h"

#include "cli/command.h"

namespace rigc::cli {
namespace {

class Plan final : public Command {
 public:
  std::string name() const override { return "plan"; }
  std::string summary() const override {
    return "Show the commands of a template in order, with what their selectors find";
  }
  std::vector<std::string> examples() const override {
    return {"rigc plan biped.yaml --only arm_l",
            "rigc plan biped.yaml --dot | dot -Tsvg -o plan.svg"};
  }
  void declare(Options& options) override {
    options.positional("TEMPLATE", request_.template_file, true,
                       "Template file, or the name of one that comes with rigc");
    options.text("--model", "FILE", request_.model, false,
                 "Fit the template to this character first");
    options.text("--map", "NAME|FILE", request_.map, false,
                 "Which bone is which joint (default: by detection)");
    options.text("--skeleton", "NODE", request_.skeleton, false,
                 "Skeleton of the model, by a node's name or number");
    options.list("--feature", "[GROUP/]NAME[:SWITCH]=on|off", request_.features,
                 "Turn a feature on or off");
    options.list("--group", "GROUP=on|off", request_.groups, "Turn a local group on or off");
    options.list("--only", "GROUP", request_.only, "Only the commands of this local group");
    options.text("--until", "JOINT/COMMAND", request_.until, false, "Stop after this command");
    options.flag("--dot", dot_, "Print a graph for Graphviz: which command uses what another made");
    declare_paths(options, request_.paths);
  }
  void run(Session& session) override {
    const auto form = dot_           ? pipeline::PlanForm::dot
                      : session.json ? pipeline::PlanForm::json
                                     : pipeline::PlanForm::text;
    const auto text = pipeline::plan(request_, form, session.diagnostics);
    if (text) session.out = *text;
  }

 private:
  pipeline::BuildRequest request_;
  bool dot_ = false;
};

}  // namespace

std::unique_ptr<Command> make_plan() { return std::make_unique<Plan>(); }

}  // namespace rigc::cli
