// SPDX-License-Identifier: MIT
// rigc guides: where a template's joints are and what controls look like, as a file to edit.
// Test: tests/cli/guides_test.cpp
#include "pipeline/guides.h"

#include <fmt/format.h>

#include "base/files.h"
#include "base/text.h"
#include "cli/command.h"

namespace rigc::cli {
namespace {

class Guides final : public Command {
 public:
  std::string name() const override { return "guides"; }
  std::string summary() const override {
    return "Write where joints are and what controls look like, as a file to edit and to build "
           "with";
  }
  std::vector<std::string> examples() const override {
    return {"rigc guides biped -o guides.yaml",
            "rigc guides biped --model hero.glb -o hero_guides.yaml",
            "rigc build biped --guides guides.yaml -o biped.glb",
            "rigc guides biped --from adopted.glb -o guides.yaml"};
  }
  void declare(Options& options) override {
    declare_build(options, request_.build);
    options.text("--from", "RIG.glb", request_.from, false,
                 "Take over joints that were moved and controls that were edited in this rig file");
    options.text("-o,--output", "GUIDES.yaml", out_, false,
                 "File to write (default: print it); what was moved or edited in it stays");
    declare_paths(options, request_.build.paths);
  }
  void run(Session& session) override {
    if (!out_.empty() && file_exists(out_)) request_.before = out_;
    const auto guides = pipeline::write_guides(request_, session.diagnostics);
    if (!guides) return;
    if (!out_.empty() && !write_file(out_, {guides->yaml}, session.diagnostics)) return;
    if (session.json)
      session.out = summary_json(*guides);
    else
      session.out = out_.empty() ? guides->yaml : summary(*guides);
  }

 private:
  std::string summary(const pipeline::GuidesFile& guides) const {
    std::string text = fmt::format("{}: {} joints to move, {} moved, {} controls edited\n",
                                   printable(out_), guides.joints, guides.moved, guides.edited);
    if (guides.of_model > 0)
      text += fmt::format("  {} joints are the model's own and stay where it has them\n",
                          guides.of_model);
    return text;
  }
  std::string summary_json(const pipeline::GuidesFile& guides) const {
    json::Writer w(2);
    w.begin_object().member("file", out_).member("template", guides.template_name);
    w.member("joints", guides.joints).member("moved", guides.moved);
    w.member("edited", guides.edited).member("of_model", guides.of_model);
    if (out_.empty()) w.member("yaml", guides.yaml);
    return w.end_object().take() + "\n";
  }

  pipeline::GuidesRequest request_;
  std::string out_;
};

}  // namespace

std::unique_ptr<Command> make_guides() { return std::make_unique<Guides>(); }

}  // namespace rigc::cli
