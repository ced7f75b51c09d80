// SPDX-License-Identifier: MIT
// rigc bake: clips on controls become clips on joints. Test: tests/cli/cli_test.cpp
#include <fmt/format.h>

#include "base/text.h"
#include "cli/timing.h"
#include "pipeline/bake_file.h"

namespace rigc::cli {
namespace {

class Bake final : public Command {
 public:
  std::string name() const override { return "bake"; }
  std::string summary() const override {
    return "Put the animation of controls onto the joints, as plain glTF";
  }
  std::vector<std::string> examples() const override {
    return {"rigc bake shot.glb -o game.glb",
            "rigc bake shot.glb -o game.glb --fps source --tolerance 0.1"};
  }
  void declare(Options& options) override {
    options.positional("FILE", request_.file, true, "Rig file with clips on its controls");
    options.text("-o,--output", "OUT.glb", out_, true, "File to write (.glb or .gltf)");
    options.list("--clip", "NAME", request_.clips,
                 "Bake this clip, by name or number (default: all)");
    options.text("--fps", "N|source", request_.fps, false,
                 "Frames a second (default: 30), or source: at the keys' own times");
    options.number("--start", "SECONDS", request_.start,
                   "Where to begin (default: the clip's first key)");
    options.number("--end", "SECONDS", request_.end, "Where to end (default: the clip's last key)");
    options.number("--tolerance", "MM", tolerance_,
                   "Drop keys as long as no joint moves by more than this (default: 0)");
    options.flag("--keep-rig", request_.keep_rig,
                 "Keep the rig and the clips on its controls in the file");
    declare_timing(options, timing_);
  }
  void run(Session& session) override {
    run_timed(timing_, session, [&] { bake(session); });
  }

 private:
  void bake(Session& session) {
    request_.tolerance_mm = tolerance_.value_or(0);
    const auto baked = pipeline::bake_file(request_, out_, session.diagnostics);
    if (!baked) return;
    session.out = session.json ? as_json(*baked) : as_text(*baked);
  }

  std::string as_text(const pipeline::Baked& baked) const {
    std::string text;
    for (const pipeline::BakedClip& clip : baked.clips) {
      text += clip.passed_through
                  ? fmt::format("  \"{}\": as it was (nothing on controls)\n", printable(clip.name))
                  : fmt::format("  \"{}\": {} frames, {} channels, {} keys\n", printable(clip.name),
                                clip.report.frames, clip.report.channels, clip.report.keys);
    }
    return fmt::format("{}: {} clip{}, {} KB\n", printable(out_), baked.clips.size(),
                       baked.clips.size() == 1 ? "" : "s", (baked.bytes + 1023) / 1024) +
           text;
  }

  std::string as_json(const pipeline::Baked& baked) const {
    json::Writer w(2);
    w.begin_object()
        .member("file", out_)
        .member("bytes", static_cast<std::size_t>(baked.bytes))
        .key("clips")
        .begin_array();
    for (const pipeline::BakedClip& clip : baked.clips) {
      w.begin_object().member("name", clip.name).member("passed_through", clip.passed_through);
      w.member("frames", clip.report.frames)
          .member("channels", clip.report.channels)
          .member("keys", clip.report.keys);
      w.member("shear", clip.report.shear)
          .member("reduction_error", clip.report.reduction_error)
          .end_object();
    }
    w.end_array().end_object();
    return w.take() + "\n";
  }

  pipeline::BakeRequest request_;
  std::optional<double> tolerance_;
  std::string out_;
  Timing timing_;
};

}  // namespace

std::unique_ptr<Command> make_bake() { return std::make_unique<Bake>(); }

}  // namespace rigc::cli
