// SPDX-License-Identifier: MIT
// rigc rebuild, unbuild, strip and prune: what a rig's own file is enough for. Test:
// tests/cli/update_test.cpp
#include <fmt/format.h>

#include "cli/batch.h"
#include "pipeline/rebuild.h"

namespace rigc::cli {
namespace {

using pipeline::FileResult;
using pipeline::FileWork;

class Rebuild final : public Command {
 public:
  explicit Rebuild(bool unbuild) { request_.unbuild = unbuild; }

  std::string name() const override { return request_.unbuild ? "unbuild" : "rebuild"; }
  std::string summary() const override {
    return request_.unbuild ? "Take rigs apart: skeleton and tags stay, keys wait as orphans"
                            : "Build rigs again from their own tags, with other settings, keeping "
                              "every key";
  }
  std::vector<std::string> examples() const override {
    if (request_.unbuild) return {"rigc unbuild shot.glb", "rigc unbuild shot.glb -o bare.glb"};
    return {"rigc rebuild shot.glb --feature ikfk:arms=off",
            "rigc rebuild shot.glb --feature ribbons=on --split-weights on",
            "rigc rebuild shots/ --group face=off --plan"};
  }
  void declare(Options& options) override {
    declare_batch(options, batch_);
    options.list("--rig", "GLOBAL", request_.rigs,
                 "Only the rig with this global group (default: all)");
    if (!request_.unbuild) {
      options.list("--feature", "[GROUP/]NAME[:SWITCH]=on|off", request_.features,
                   "Turn a feature on or off; of a group, in the groups beneath it too");
      options.list("--group", "GROUP=on|off", request_.groups, "Turn a local group on or off");
      options.text("--split-weights", "on|off", request_.split_weights, false,
                   "Let the model's skins share their weights with joints that the rig makes "
                   "(default: as before)");
      options.text("--guides", "GUIDES.yaml", request_.guides, false,
                   "Joints that were moved and controls that were edited: see `rigc guides`");
      options.flag("--strict", request_.strict, "Fail a file whose keys would not all find a node");
      options.number("--tolerance", "MM", request_.tolerance_mm,
                     "Fail a file where a joint moves by more than this");
      options.flag("--keep-local", request_.keep_local,
                   "Keep keys as they are where a control's zero has turned");
    }
    options.flag("--plan", request_.plan, "Say what would happen and write nothing");
    options.flag("--verbose", verbose_, "List every control and property");
    declare_modules(options, paths_);
  }
  void run(Session& session) override {
    catalog::Catalogue catalogue;
    if (!pipeline::add_modules(paths_, catalogue, session.diagnostics)) return;
    batch_.request.command = name();
    batch_.request.settings = settings_text();
    batch_.request.writes = !request_.plan;
    const auto work = [&](const FileWork& file, Diagnostics& diagnostics) {
      return one(catalogue, file, diagnostics);
    };
    run_timed(batch_, session,
              [&] { run_batch(batch_, work, request_.plan || verbose_, session); });
  }

 private:
  std::string settings_text() const {
    json::Writer w;
    w.begin_object();
    for (const auto& [key, list] :
         {std::pair("rigs", &request_.rigs), std::pair("features", &request_.features),
          std::pair("groups", &request_.groups)}) {
      w.key(key).begin_array();
      for (const std::string& text : *list) w.value(text);
      w.end_array();
    }
    if (!request_.split_weights.empty()) w.member("split_weights", request_.split_weights);
    if (!request_.guides.empty()) w.member("guides", request_.guides);
    write_members(w, request_);
    return w.end_object().take();
  }

  FileResult one(const catalog::Catalogue& catalogue, const FileWork& work,
                 Diagnostics& diagnostics) const {
    FileResult result;
    const auto rebuilt = pipeline::rebuild(request_, catalogue, work, diagnostics);
    if (!rebuilt) return result;
    result.outcome = FileResult::Outcome::changed;
    result.bytes = rebuilt->bytes;
    result.summary = request_.plan      ? "would be changed"
                     : request_.unbuild ? "taken apart"
                                        : "built again";
    json::Writer w;
    w.begin_object().key("rigs").begin_array();
    for (const pipeline::RigReport& report : rebuilt->rigs) {
      result.summary += "\n" + as_text(report, verbose_);
      write_json(w, report);
    }
    result.json = w.end_array().end_object().take();
    return result;
  }

  pipeline::RebuildRequest request_;
  pipeline::Paths paths_;
  BatchOptions batch_;
  bool verbose_ = false;
};

/// strip and prune: something goes from the file.
class Remove final : public Command {
 public:
  explicit Remove(bool strip) : strip_(strip) {}

  std::string name() const override { return strip_ ? "strip" : "prune"; }
  std::string summary() const override {
    return strip_ ? "Take rigs and tags out of files: what remains is what was there before"
                  : "Let go of orphans: keys and values whose control is gone";
  }
  std::vector<std::string> examples() const override {
    return {strip_ ? "rigc strip shot.glb -o model.glb" : "rigc prune shot.glb"};
  }
  void declare(Options& options) override {
    declare_batch(options, batch_);
    options.list("--rig", "GLOBAL", rigs_, "Only the rig with this global group (default: all)");
  }
  void run(Session& session) override {
    batch_.request.command = name();
    json::Writer w;
    w.begin_object().key("rigs").begin_array();
    for (const std::string& rig : rigs_) w.value(rig);
    batch_.request.settings = w.end_array().end_object().take();
    const auto work = [&](const FileWork& file, Diagnostics& diagnostics) {
      return one(file, diagnostics);
    };
    run_timed(batch_, session, [&] { run_batch(batch_, work, false, session); });
  }

 private:
  static const char* plural(std::size_t count) { return count == 1 ? "" : "s"; }
  static std::string stripped_text(const pipeline::Removed& removed) {
    const std::size_t rigs = removed.rigs.size();
    return fmt::format("{} rig{} taken out, with {} channel{} on {} controls", rigs, plural(rigs),
                       removed.channels, plural(removed.channels), rigs == 1 ? "its" : "their");
  }
  FileResult one(const FileWork& work, Diagnostics& diagnostics) const {
    FileResult result;
    const auto removed = strip_ ? pipeline::strip(rigs_, work, diagnostics)
                                : pipeline::prune(rigs_, work, diagnostics);
    if (!removed) return result;
    const bool changed = strip_ || removed->orphans > 0;
    result.outcome = changed ? FileResult::Outcome::changed : FileResult::Outcome::unchanged;
    result.bytes = removed->bytes;
    result.summary = strip_    ? stripped_text(*removed)
                     : changed ? fmt::format("{} orphan{} gone, with {} channel{}",
                                             removed->orphans, plural(removed->orphans),
                                             removed->channels, plural(removed->channels))
                               : "has no orphans";
    json::Writer w;
    w.begin_object().key("rigs").begin_array();
    for (const std::string& rig : removed->rigs) w.value(rig);
    w.end_array().member("channels", removed->channels).member("orphans", removed->orphans);
    result.json = w.end_object().take();
    return result;
  }

  bool strip_;
  std::vector<std::string> rigs_;
  BatchOptions batch_;
};

}  // namespace

std::unique_ptr<Command> make_rebuild() { return std::make_unique<Rebuild>(false); }
std::unique_ptr<Command> make_unbuild() { return std::make_unique<Rebuild>(true); }
std::unique_ptr<Command> make_strip() { return std::make_unique<Remove>(true); }
std::unique_ptr<Command> make_prune() { return std::make_unique<Remove>(false); }

}  // namespace rigc::cli
