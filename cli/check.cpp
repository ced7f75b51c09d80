// SPDX-License-Identifier: MIT
// rigc check: every diagnostic, nothing written. Test: tests/cli/cli_test.cpp
#include "pipeline/check.h"

#include <fmt/format.h>

#include "cli/command.h"

namespace rigc::cli {
namespace {

class Check final : public Command {
 public:
  std::string name() const override { return "check"; }
  std::string summary() const override {
    return "Report every error of templates and rig files, write nothing";
  }
  std::vector<std::string> examples() const override {
    return {"rigc check biped.yaml", "rigc check shots/*.glb"};
  }
  void declare(Options& options) override {
    options.positionals("FILE", files_, "Templates (.yaml) and rig files (.glb, .gltf)");
    declare_paths(options, paths_);
  }
  void run(Session& session) override {
    std::size_t good = 0;
    json::Writer w(2);
    w.begin_array();
    for (const std::string& file : files_) {
      const bool ok = pipeline::check(file, paths_, session.diagnostics);
      good += ok ? 1 : 0;
      w.begin_object().member("file", file).member("ok", ok).end_object();
    }
    w.end_array();
    if (session.json) {
      session.out = w.take() + "\n";
    } else if (good == files_.size()) {
      session.out = fmt::format("{} {} checked, no errors\n", good, good == 1 ? "file" : "files");
    } else {
      session.out =
          fmt::format("{} of {} files have errors\n", files_.size() - good, files_.size());
    }
  }

 private:
  std::vector<std::string> files_;
  pipeline::Paths paths_;
};

}  // namespace

std::unique_ptr<Command> make_check() { return std::make_unique<Check>(); }

}  // namespace rigc::cli
