// SPDX-License-Identifier: MIT
// rigc modules: the catalogue of modules, or one of them with its example. Test:
// tests/cli/cli_test.cpp
#include "cli/command.h"
#include "pipeline/reference.h"

namespace rigc::cli {
namespace {

class Modules final : public Command {
 public:
  std::string name() const override { return "modules"; }
  std::string summary() const override {
    return "List the modules, or explain one with an example";
  }
  std::vector<std::string> examples() const override {
    return {"rigc modules", "rigc modules ik_fk_limb"};
  }
  void declare(Options& options) override {
    options.positional("NAME", module_, false, "Module to explain");
    declare_modules(options, paths_);
  }
  void run(Session& session) override {
    const auto text = pipeline::modules(module_, paths_, session.json, session.diagnostics);
    if (text) session.out = *text;
  }

 private:
  std::string module_;
  pipeline::Paths paths_;
};

}  // namespace

std::unique_ptr<Command> make_modules() { return std::make_unique<Modules>(); }

}  // namespace rigc::cli
