// SPDX-License-Identifier: MIT
// rigc schema: JSON Schemas for editors and checks. Test: tests/cli/cli_test.cpp
#include "cli/command.h"
#include "pipeline/reference.h"

namespace rigc::cli {
namespace {

class Schema final : public Command {
 public:
  std::string name() const override { return "schema"; }
  std::string summary() const override {
    return "Print a JSON Schema: RIGC_rig, or the parameters of a module";
  }
  std::vector<std::string> examples() const override {
    return {"rigc schema RIGC_rig", "rigc schema control"};
  }
  void declare(Options& options) override {
    options.positional("NAME", name_, true, "RIGC_rig or a module's name");
    declare_paths(options, paths_);
  }
  void run(Session& session) override {
    const auto text = pipeline::schema(name_, paths_, session.diagnostics);
    if (text) session.out = *text;
  }

 private:
  std::string name_;
  pipeline::Paths paths_;
};

}  // namespace

std::unique_ptr<Command> make_schema() { return std::make_unique<Schema>(); }

}  // namespace rigc::cli
