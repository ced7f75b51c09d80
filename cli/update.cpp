// SPDX-License-Identifier: MIT
// rigc update: rigs move to newer template versions and keep their keys. Test:
// tests/cli/update_test.cpp
#include "pipeline/update.h"
#include "cli/batch.h"

namespace rigc::cli {
namespace {

/// The options that decide what becomes of a file, for --resume.
std::string settings_text(const pipeline::UpdateSettings& settings) {
  json::Writer w;
  w.begin_object().member("to", settings.to).key("rigs").begin_array();
  for (const std::string& rig : settings.rigs) w.value(rig);
  w.end_array().member("take_skeleton", settings.take_skeleton);
  write_members(w, settings);
  return w.end_object().take();
}

class Update final : public Command {
 public:
  std::string name() const override { return "update"; }
  std::string summary() const override {
    return "Move animated rigs to the newest version of their template, keeping every key";
  }
  std::vector<std::string> examples() const override {
    return {"rigc update shot.glb --plan", "rigc update shots/ --jobs 8 --report report.json",
            "rigc update shot.glb --to biped@6 -o old.glb",
            "rigc update 'shots/**/*.glb' --strict --tolerance 0.1 --backup originals"};
  }
  void declare(Options& options) override {
    declare_batch(options, batch_);
    options.text("--to", "TEMPLATE", settings_.to, false,
                 "Follow this template: a file, NAME or NAME@VERSION (default: the newest of the "
                 "name that the file has)");
    options.list("--rig", "GLOBAL", settings_.rigs,
                 "Update only the rig with this global group (default: all)");
    options.flag("--plan", settings_.plan, "Say what would happen and write nothing");
    options.flag("--verbose", settings_.verbose, "List every control and property");
    options.flag("--strict", settings_.strict, "Fail a file whose keys would not all find a node");
    options.number("--tolerance", "MM", settings_.tolerance_mm,
                   "Fail a file where a joint moves by more than this");
    options.flag("--take-skeleton", settings_.take_skeleton,
                 "Put joints where the new version has them (default: they stay)");
    options.flag("--keep-local", settings_.keep_local,
                 "Keep keys as they are where a control's zero has turned");
    declare_paths(options, settings_.paths);
  }
  void run(Session& session) override {
    run_timed(batch_, session, [&] { update(session); });
  }

 private:
  void update(Session& session) {
    const auto updater = pipeline::Updater::make(settings_, session.diagnostics);
    if (!updater) return;
    batch_.request.command = "update";
    batch_.request.settings = settings_text(settings_);
    batch_.request.writes = !settings_.plan;
    run_batch(
        batch_,
        [&](const pipeline::FileWork& work, Diagnostics& diagnostics) {
          return updater->update(work, diagnostics);
        },
        settings_.plan || settings_.verbose, session);
  }

  pipeline::UpdateSettings settings_;
  BatchOptions batch_;
};

}  // namespace

std::unique_ptr<Command> make_update() { return std::make_unique<Update>(); }

}  // namespace rigc::cli
