// SPDX-License-Identifier: MIT
// rigc schema: JSON Schemas for editors and checks. Test: tests/cli/cli_test.cpp
#include "pipeline/schema.h"
#include "cli/command.h"

namespace rigc::cli {
namespace {

class Schema final : public Command {
 public:
  std::string name() const override { return "schema"; }
  std::string summary() const override { return "Print a JSON Schema, for editors and checks"; }
  std::vector<std::string> examples() const override {
    return {"rigc schema template > template.schema.json",
            "rigc schema template --modules my_modules", "rigc schema ik_fk_limb"};
  }
  void declare(Options& options) override {
    options.positional("NAME", name_, true,
                       "template, map, guides or module (a file that declares one) for files of "
                       "these; RIGC_rig for "
                       "the extension of rig files; a module's name for its `with:`");
    declare_modules(options, paths_);
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
