// SPDX-License-Identifier: MIT
// rigc status: which rigs have updates. Test: tests/cli/status_test.cpp
#include "pipeline/status.h"

#include <algorithm>

#include "cli/command.h"

namespace rigc::cli {
namespace {

class Status final : public Command {
 public:
  std::string name() const override { return "status"; }
  std::string summary() const override {
    return "Show which templates and modules made the rigs of files, and what is newer now";
  }
  std::vector<std::string> examples() const override {
    return {"rigc status shots/", "rigc status a.glb b.glb --json",
            "rigc status shots/ --templates studio/templates --exit-code || echo 'updates wait'"};
  }
  void declare(Options& options) override {
    options.positionals("FILE|DIR|'PATTERN'|@LIST", request_.inputs,
                        "Rig files, folders of them, patterns, lists of paths");
    declare_paths(options, request_.paths);
    options.number("--jobs", "N", jobs_, "Files at a time (default: one for each processor)");
    options.flag("--exit-code", exit_code_, "Exit with 1 if an update would change any rig");
  }
  void run(Session& session) override {
    request_.jobs = jobs_ && *jobs_ >= 1 ? static_cast<std::size_t>(std::min(*jobs_, 64.0)) : 0;
    const auto files = pipeline::status(request_, session.diagnostics);
    if (!files) return;
    session.out = session.json ? pipeline::status_json(*files) : pipeline::status_text(*files);
    if (exit_code_ && pipeline::any_changes(*files)) session.status = 1;
  }

 private:
  pipeline::StatusRequest request_;
  std::optional<double> jobs_;
  bool exit_code_ = false;
};

}  // namespace

std::unique_ptr<Command> make_status() { return std::make_unique<Status>(); }

}  // namespace rigc::cli
