// SPDX-License-Identifier: MIT
// rigc query: what a selector resolves to in a rig file. Test: tests/cli/cli_test.cpp
#include "cli/command.h"
#include "pipeline/inspect.h"

namespace rigc::cli {
namespace {

class Query final : public Command {
 public:
  std::string name() const override { return "query"; }
  std::string summary() const override { return "Show what a selector finds in a rig file"; }
  std::vector<std::string> examples() const override {
    return {"rigc query biped.glb 'arm_l::control'",
            "rigc query biped.glb 'arm_l.wrist/ik_fk_limb.settings@ik_fk'"};
  }
  void declare(Options& options) override {
    options.positional("FILE", file_, true, "Rig file (.glb, .gltf)");
    options.positional("SELECTOR", selector_, true,
                       "Selector, as in templates (docs/selectors.md)");
  }
  void run(Session& session) override {
    const auto text = pipeline::query(file_, selector_, session.json, session.diagnostics);
    if (text) session.out = *text;
  }

 private:
  std::string file_;
  std::string selector_;
};

}  // namespace

std::unique_ptr<Command> make_query() { return std::make_unique<Query>(); }

}  // namespace rigc::cli
