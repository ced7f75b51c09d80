// SPDX-License-Identifier: MIT
// rigc match: the pose of limbs from FK controls to IK controls, or back; controls to other spaces.
// Test: tests/cli/match_test.cpp
#include <fmt/format.h>

#include "base/text.h"
#include "cli/command.h"
#include "cli/off.h"
#include "cli/timing.h"
#include "pipeline/match.h"

namespace rigc::cli {
namespace {

class Match final : public Command {
 public:
  std::string name() const override { return "match"; }
  std::string summary() const override {
    return "Key a switch without moving: limbs from FK to IK controls or back, controls to another "
           "space";
  }
  std::vector<std::string> examples() const override {
    return {"rigc match shot.glb --limb arm_l --to ik -o shot.glb",
            "rigc match shot.glb --limb arm_l --limb arm_r --to fk --range 1.5:3 -o matched.glb",
            "rigc match shot.glb --limb all --to ik --fps 30 --clip walk -o matched.glb",
            "rigc match shot.glb --control arm_l_wrist_ik --space chest --range 2: -o shot.glb"};
  }
  void declare(Options& options) override {
    options.positional("FILE", request_.file, true, "Rig file with clips");
    options.list("--limb", "GROUP", request_.limbs,
                 "Limb to match, by its local group; all for every one");
    options.text("--to", "ik|fk", request_.to, false, "Which controls of limbs get the pose");
    options.list("--control", "NAME|SELECTOR", request_.controls,
                 "Control that follows another space and stays where it is");
    options.text("--space", "NAME", request_.space, false,
                 "The space that these controls follow, as `space_switch` calls it");
    options.text("-o,--output", "OUT.glb", out_, true, "File to write (.glb or .gltf)");
    options.text("--range", "START:END", request_.range, false,
                 "Seconds between which this is done (default: the whole clip). Outside of them "
                 "everything stays as it was");
    options.list("--clip", "NAME", request_.clips,
                 "Match in this clip, by name or number (default: all that key controls)");
    options.text("--fps", "N|source", request_.fps, false,
                 "Frames a second, or source: at the keys' own times (default)");
    options.number("--tolerance", "MM", tolerance_,
                   "With --fps source: add keys where a joint would be off by more than this "
                   "between two of the clip's own, in millimetres (default: 1; 0: none)");
    declare_timing(options, timing_);
  }
  void run(Session& session) override {
    run_timed(timing_, session, [&] { match(session); });
  }

 private:
  void match(Session& session) {
    const bool of_limbs = request_.space.empty() && request_.controls.empty();
    if (of_limbs && request_.limbs.empty()) request_.limbs.emplace_back("all");
    Threads threads;
    request_.threads = &threads;
    if (tolerance_) request_.tolerance_mm = *tolerance_;
    const auto done = pipeline::match_file(request_, out_, session.diagnostics);
    if (!done) return;
    session.out = session.json ? as_json(*done) : as_text(*done);
  }

  std::string as_text(const pipeline::MatchedFile& done) const {
    std::string text = fmt::format("{}: {} clip{}, {} KB\n", printable(out_), done.clips.size(),
                                   done.clips.size() == 1 ? "" : "s", (done.bytes + 1023) / 1024);
    for (const pipeline::MatchedClip& clip : done.clips) {
      text += fmt::format("  \"{}\"{}\n", printable(clip.name),
                          clip.passed_through ? ": as it was (it keys no control; `rigc transfer` "
                                                "gives its motion to the controls)"
                                              : "");
      for (const pipeline::MatchedLimb& limb : clip.limbs) {
        const bake::MatchReport& report = limb.report;
        text += fmt::format("    {} to {}: {}, {} channels, {} keys\n", printable(limb.limb),
                            target(), frames_as_text(report.frames, report.inserted),
                            report.channels, report.keys);
        text += off_as_text("      ", report.frames, limb.at_keys, limb.between);
      }
    }
    return text;
  }

  std::string as_json(const pipeline::MatchedFile& done) const {
    json::Writer w(2);
    w.begin_object()
        .member("file", out_)
        .member("bytes", static_cast<std::size_t>(done.bytes))
        .member("to", target())
        .key("clips")
        .begin_array();
    for (const pipeline::MatchedClip& clip : done.clips) {
      w.begin_object()
          .member("name", clip.name)
          .member("passed_through", clip.passed_through)
          .key("limbs")
          .begin_array();
      for (const pipeline::MatchedLimb& limb : clip.limbs) {
        w.begin_object()
            .member("limb", limb.limb)
            .member("frames", limb.report.frames)
            .member("frames_added", limb.report.inserted)
            .member("channels", limb.report.channels)
            .member("keys", limb.report.keys);
        write_off(w, limb.at_keys, limb.between);
        w.end_object();
      }
      w.end_array().end_object();
    }
    w.end_array().end_object();
    return w.take() + "\n";
  }

  /// What is said of limbs or controls alike.
  const std::string& target() const {
    return request_.space.empty() ? request_.to : request_.space;
  }

  pipeline::MatchRequest request_;
  std::optional<double> tolerance_;
  std::string out_;
  Timing timing_;
};

}  // namespace

std::unique_ptr<Command> make_match() { return std::make_unique<Match>(); }

}  // namespace rigc::cli
