// SPDX-License-Identifier: MIT
// rigc extract: a template from a built rig. Test: tests/pipeline/extract_test.cpp
#include "pipeline/extract.h"

#include <fmt/format.h>

#include "base/files.h"
#include "base/text.h"
#include "cli/command.h"

namespace rigc::cli {
namespace {

class Extract final : public Command {
 public:
  std::string name() const override { return "extract"; }
  std::string summary() const override {
    return "Write the template that a built rig could come from";
  }
  std::vector<std::string> examples() const override {
    return {"rigc extract hero.glb -o hero.yaml",
            "rigc extract shot.glb --rig hero -o hero.yaml --name hero --version 2"};
  }
  void declare(Options& options) override {
    options.positional("FILE", request_.file, true, "Rig file (.glb or .gltf)");
    options.text("-o,--output", "TEMPLATE.yaml", out_, false, "File to write (default: print it)");
    options.text("--rig", "GLOBAL", request_.rig, false,
                 "Which rig, by its global group, where the file has several");
    options.text(
        "--name", "NAME", request_.name, false,
        "Name of the template; joints keep their identities (default: the rig's template)");
    options.text("--version", "N", request_.version, false,
                 "Version of the template (default: that of the rig's template)");
    declare_modules(options, request_.paths);
  }
  void run(Session& session) override {
    const auto extracted = pipeline::extract(request_, session.diagnostics);
    if (!extracted) return;
    if (!out_.empty() && !write_file(out_, {extracted->yaml}, session.diagnostics)) return;
    if (session.json)
      session.out = as_json(*extracted);
    else
      session.out = out_.empty() ? extracted->yaml : as_text(*extracted);
  }

 private:
  std::string as_text(const pipeline::Extracted& extracted) const {
    return fmt::format("{}: template {}, version {}: {} joints, {} commands{}\n", printable(out_),
                       extracted.name, extracted.version, extracted.joints, extracted.commands,
                       extracted.fitted ? ", places of the model" : "");
  }

  std::string as_json(const pipeline::Extracted& extracted) const {
    json::Writer w(2);
    w.begin_object().member("file", out_).member("name", extracted.name);
    w.member("version", extracted.version).member("joints", extracted.joints);
    w.member("commands", extracted.commands).member("fitted", extracted.fitted);
    if (out_.empty()) w.member("yaml", extracted.yaml);
    return w.end_object().take() + "\n";
  }

  pipeline::ExtractRequest request_;
  std::string out_;
};

}  // namespace

std::unique_ptr<Command> make_extract() { return std::make_unique<Extract>(); }

}  // namespace rigc::cli
