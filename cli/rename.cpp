// SPDX-License-Identifier: MIT
// rigc rename: another global group for a rig of a file. Test: tests/pipeline/rename_test.cpp
#include <fmt/format.h>

#include "base/json.h"
#include "base/text.h"
#include "cli/command.h"
#include "pipeline/rename.h"

namespace rigc::cli {
namespace {

class Rename final : public Command {
 public:
  std::string name() const override { return "rename"; }
  std::string summary() const override { return "Give a rig of a file another global group"; }
  std::vector<std::string> examples() const override {
    return {"rigc rename shot.glb --global biped=hero",
            "rigc rename shot.glb --global left=right --global right=left -o swapped.glb"};
  }
  void declare(Options& options) override {
    options.positional("FILE", request_.file, true, "Rig file (.glb, .gltf)");
    options.list("--global", "OLD=NEW", request_.globals,
                 "Global group that a rig has, and the one that it gets; may be repeated");
    options.text("-o,--output", "OUT.glb", out_, false, "File to write (default: FILE itself)");
    declare_modules(options, request_.paths);
  }
  void run(Session& session) override {
    const auto renamed = pipeline::rename_rigs(request_, out_, session.diagnostics);
    if (!renamed) return;
    const std::string& file = out_.empty() ? request_.file : out_;
    if (session.json) {
      json::Writer w(2);
      w.begin_object().member("file", file).member("changed", renamed->changed);
      w.member("rigs", renamed->rigs).member("selectors", renamed->selectors).end_object();
      session.out = w.take() + "\n";
      return;
    }
    session.out = fmt::format("{}: {} rig{} renamed, {} selector{} followed\n", printable(file),
                              renamed->rigs, renamed->rigs == 1 ? "" : "s", renamed->selectors,
                              renamed->selectors == 1 ? "" : "s");
  }

 private:
  pipeline::RenameRequest request_;
  std::string out_;
};

}  // namespace

std::unique_ptr<Command> make_rename() { return std::make_unique<Rename>(); }

}  // namespace rigc::cli
