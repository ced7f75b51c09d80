// SPDX-License-Identifier: MIT
// rigc adopt: edits of another program come back into a rig. Test: tests/pipeline/adopt_test.cpp
#include "pipeline/adopt.h"

#include <fmt/format.h>

#include "base/text.h"
#include "cli/command.h"

namespace rigc::cli {
namespace {

class Adopt final : public Command {
 public:
  std::string name() const override { return "adopt"; }
  std::string summary() const override {
    return "Bring what was edited in a program that drops rigs back into the rig";
  }
  std::vector<std::string> examples() const override {
    return {"rigc adopt from_blender.glb --rig shot.glb -o shot_2.glb",
            "rigc adopt from_blender.glb --rig shot.glb -o shot_2.glb --skeleton --clip walk"};
  }
  void declare(Options& options) override {
    options.positional("EDITED", request_.edited, true,
                       "File from the other program, exported with custom properties");
    options.text("--rig", "ORIGINAL", request_.original, true,
                 "The rig file that the other program imported");
    options.text("-o,--output", "OUT.glb", out_, true, "File to write (.glb or .gltf)");
    options.flag("--skeleton", request_.skeleton,
                 "Take placements of joints too, and build the rig on them");
    options.list("--clip", "NAME", request_.clips, "Take this clip (default: all)");
    declare_modules(options, request_.paths);
  }
  void run(Session& session) override {
    const auto adopted = pipeline::adopt(request_, out_, session.diagnostics);
    if (!adopted) return;
    session.out = session.json ? as_json(*adopted) : as_text(*adopted);
  }

 private:
  std::string as_text(const pipeline::Adopted& adopted) const {
    std::string text = fmt::format("{}: {} controls moved, {} attributes set without a key",
                                   printable(out_), adopted.transforms, adopted.attributes);
    if (request_.skeleton) text += fmt::format(", {} joints placed", adopted.joints);
    text += "\n";
    for (const pipeline::AdoptedClip& clip : adopted.clips) {
      text += fmt::format("  \"{}\"{}: {} channels changed, {} added, {} as they were\n",
                          printable(clip.name), clip.fresh ? " (new)" : "", clip.changed,
                          clip.added, clip.same + clip.kept);
      if (clip.not_controls > 0)
        text += fmt::format("    {} channels on nodes that are no controls: not taken\n",
                            clip.not_controls);
    }
    return text;
  }

  std::string as_json(const pipeline::Adopted& adopted) const {
    json::Writer w(2);
    w.begin_object().member("file", out_).member("bytes", static_cast<std::size_t>(adopted.bytes));
    w.member("transforms", adopted.transforms).member("attributes", adopted.attributes);
    w.member("joints", adopted.joints).member("unknown", adopted.unknown);
    w.key("clips").begin_array();
    for (const pipeline::AdoptedClip& clip : adopted.clips) {
      w.begin_object().member("name", clip.name).member("new", clip.fresh);
      w.member("changed", clip.changed).member("added", clip.added).member("same", clip.same);
      w.member("at_rest", clip.at_rest).member("kept", clip.kept);
      w.member("not_controls", clip.not_controls).end_object();
    }
    return w.end_array().end_object().take() + "\n";
  }

  pipeline::AdoptRequest request_;
  std::string out_;
};

}  // namespace

std::unique_ptr<Command> make_adopt() { return std::make_unique<Adopt>(); }

}  // namespace rigc::cli
