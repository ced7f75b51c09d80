// SPDX-License-Identifier: MIT
// rigc check: every diagnostic, nothing written but pins. Test: tests/cli/check_test.cpp
#include "pipeline/check.h"

#include "cli/command.h"

namespace rigc::cli {
namespace {

class Check final : public Command {
 public:
  std::string name() const override { return "check"; }
  std::string summary() const override {
    return "Report every error of templates, rig files and models; write nothing";
  }
  std::vector<std::string> examples() const override {
    return {"rigc check biped.yaml", "rigc check templates shots", "rigc check hero.glb --json",
            "rigc check --pin biped.yaml"};
  }
  void declare(Options& options) override {
    options.positionals("FILE", request_.paths_to_check,
                        "Templates, maps and module descriptors (.yaml), rigs and models (.glb, "
                        ".gltf, .vrm), folders of them, names of templates");
    options.flag("--pin", request_.pin,
                 "Write into templates without errors which version of each module they were "
                 "written for (`modules:`); pins that are there stay");
    declare_paths(options, request_.paths);
  }
  void run(Session& session) override {
    const auto files = pipeline::check(request_, session.diagnostics);
    session.out = session.json ? pipeline::check_json(files, session.diagnostics)
                               : pipeline::check_text(files);
  }

 private:
  pipeline::CheckRequest request_;
};

}  // namespace

std::unique_ptr<Command> make_check() { return std::make_unique<Check>(); }

}  // namespace rigc::cli
