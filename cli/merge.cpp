// SPDX-License-Identifier: MIT
// rigc merge: several files in one. Test: tests/pipeline/merge_test.cpp
#include <fmt/format.h>

#include "base/json.h"
#include "base/text.h"
#include "cli/command.h"
#include "pipeline/merge.h"

namespace rigc::cli {
namespace {

class Merge final : public Command {
 public:
  std::string name() const override { return "merge"; }
  std::string summary() const override {
    return "Put rigs, meshes and clips of several files into one";
  }
  std::vector<std::string> examples() const override {
    return {"rigc merge hero.glb prop.glb -o shot.glb",
            "rigc merge walk.glb run.glb -o clips.glb --join-clips",
            "rigc merge hero.glb arm.glb --into hero --attach arm_l=torso.chest -o hero2.glb"};
  }
  void declare(Options& options) override {
    options.positionals("FILE", request_.files,
                        "Files (.glb, .gltf, .vrm); the first keeps every index, what the others "
                        "have comes behind it");
    options.text("-o,--output", "OUT.glb", out_, true, "File to write (.glb or .gltf)");
    options.flag("--join-clips", request_.join_clips,
                 "Make one clip of clips that have the same name in several files");
    options.text("--into", "GROUP", request_.into, false,
                 "Join rigs to the one with this global group: they become one rig");
    options.list("--attach", "LOCAL=LOCAL.LABEL", request_.attach,
                 "Hang the root of a rig with this local group under that joint; [GLOBAL:]LOCAL "
                 "where several rigs have the group");
    declare_modules(options, request_.paths);
  }
  void run(Session& session) override {
    const auto result = pipeline::merge_files(request_, out_, session.diagnostics);
    if (!result) return;
    const gltf::Merged& merged = result->merged;
    if (session.json) {
      json::Writer w(2);
      w.begin_object().member("file", out_);
      w.member("bytes", static_cast<std::size_t>(result->bytes)).member("rigs", merged.rigs);
      w.key("joined").begin_array();
      for (const std::string& rig : result->joined.rigs) w.value(rig);
      w.end_array().member("nodes", merged.nodes).member("meshes", merged.meshes);
      session.out = w.member("clips", merged.clips).end_object().take() + "\n";
      return;
    }
    const auto counted = [](std::size_t count, std::string_view what) {
      return fmt::format("{} {}{}", count, what, count == 1 ? "" : what == "mesh" ? "es" : "s");
    };
    session.out = fmt::format("{}: {}, {}, {}, {} KB\n", printable(out_),
                              counted(merged.rigs, "rig"), counted(merged.meshes, "mesh"),
                              counted(merged.clips, "clip"), (result->bytes + 1023) / 1024);
    if (!result->joined.rigs.empty())
      session.out +=
          fmt::format("  joined {} to {}: {} joints\n", printable(join(result->joined.rigs, ", ")),
                      printable(request_.into), result->joined.joints);
  }

 private:
  pipeline::MergeRequest request_;
  std::string out_;
};

}  // namespace

std::unique_ptr<Command> make_merge() { return std::make_unique<Merge>(); }

}  // namespace rigc::cli
