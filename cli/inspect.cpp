// SPDX-License-Identifier: MIT
// rigc inspect: what is in a rig file. Test: tests/cli/cli_test.cpp
#include "pipeline/inspect.h"

#include "cli/command.h"

namespace rigc::cli {
namespace {

class Inspect final : public Command {
 public:
  std::string name() const override { return "inspect"; }
  std::string summary() const override { return "Show what is in a rig file"; }
  std::vector<std::string> examples() const override {
    return {"rigc inspect biped.glb", "rigc inspect biped.glb --json"};
  }
  void declare(Options& options) override {
    options.positional("FILE", file_, true, "Rig file (.glb, .gltf)");
  }
  void run(Session& session) override {
    const auto text = pipeline::inspect(file_, session.json, session.diagnostics);
    if (text) session.out = *text;
  }

 private:
  std::string file_;
};

}  // namespace

std::unique_ptr<Command> make_inspect() { return std::make_unique<Inspect>(); }

}  // namespace rigc::cli
