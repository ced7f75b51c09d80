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
            "rigc plan biped.yaml --dot | dot -Tsvg -o plan.svg", "rigc plan biped.yaml --program"};
  }
  void declare(Options& options) override {
    declare_build(options, request_);
    options.flag("--dot", dot_, "Print a graph for Graphviz: which command uses what another made");
    options.flag("--program", program_,
                 "Print the program that plays the rig, each instruction with its template line; "
                 "TEMPLATE may be a rig file too");
    declare_paths(options, request_.paths);
  }
  void run(Session& session) override {
    const auto form = dot_           ? pipeline::PlanForm::dot
                      : session.json ? pipeline::PlanForm::json
                                     : pipeline::PlanForm::text;
    const auto text = program_ ? pipeline::plan_program(request_, form, session.diagnostics)
                               : pipeline::plan(request_, form, session.diagnostics);
    if (text) session.out = *text;
  }

 private:
  pipeline::BuildRequest request_;
  bool dot_ = false;
  bool program_ = false;
};

}  // namespace

std::unique_ptr<Command> make_plan() { return std::make_unique<Plan>(); }

}  // namespace rigc::cli
