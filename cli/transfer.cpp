// SPDX-License-Identifier: MIT
// rigc transfer: clips on joints become clips on controls. Test: tests/cli/transfer_test.cpp
#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "cli/command.h"
#include "cli/off.h"
#include "cli/timing.h"
#include "pipeline/transfer.h"

namespace rigc::cli {
namespace {

/// Joints that the text names.
constexpr std::size_t kNamed = 4;

class Transfer final : public Command {
 public:
  std::string name() const override { return "transfer"; }
  std::string summary() const override {
    return "Put the animation of joints onto the controls: the reverse of bake";
  }
  std::vector<std::string> examples() const override {
    return {"rigc transfer hero.glb -o shot.glb",
            "rigc transfer hero.glb -o shot.glb --clip walk --limb leg_l=ik --limb leg_r=ik",
            "rigc transfer hero.glb -o shot.glb --limb all=ik --tolerance 0.1"};
  }
  void declare(Options& options) override {
    options.positional("FILE", request_.file, true, "Rig file with clips on its joints");
    options.text("-o,--output", "OUT.glb", out_, true, "File to write (.glb or .gltf)");
    options.list("--clip", "NAME", request_.clips,
                 "Transfer this clip, by name or number (default: all)");
    options.list("--limb", "GROUP=ik|fk", request_.limbs,
                 "Whether this limb is keyed by IK or FK; all=ik for every one (default: FK)");
    options.text("--fps", "N|source", request_.fps, false,
                 "Frames a second, or source: at the keys' own times (default)");
    options.number("--tolerance", "MM", tolerance_,
                   "With --fps source: add keys where a joint would be off by more than this "
                   "between two of its own, in millimetres (default: 1; 0: none)");
    options.number("--start", "SECONDS", request_.start,
                   "Where to begin (default: the joints' first key)");
    options.number("--end", "SECONDS", request_.end,
                   "Where to end (default: the joints' last key)");
    options.flag("--strict", request_.strict, "A pose that the controls cannot reach is an error");
    declare_timing(options, timing_);
  }
  void run(Session& session) override {
    run_timed(timing_, session, [&] { transfer(session); });
  }

 private:
  void transfer(Session& session) {
    Threads threads;
    request_.threads = &threads;
    if (tolerance_) request_.tolerance_mm = *tolerance_;
    const auto done = pipeline::transfer_file(request_, out_, session.diagnostics);
    if (!done) return;
    session.out = session.json ? as_json(*done) : as_text(*done);
  }

  /// The first few names, and how many more there are.
  static std::string names_as_text(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), kNamed); ++i)
      text += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", printable(names[i]));
    if (names.size() > kNamed) text += fmt::format(" and {} more", names.size() - kNamed);
    return text;
  }

  static std::string limbs_as_text(const std::vector<pipeline::TransferredLimb>& limbs) {
    std::string by_ik, by_fk;
    for (const pipeline::TransferredLimb& limb : limbs)
      (limb.ik ? by_ik : by_fk) += " " + printable(limb.group);
    std::string text;
    if (!by_ik.empty()) text += "  keyed by IK:" + by_ik + "\n";
    if (!by_fk.empty()) text += "  keyed by FK:" + by_fk + "\n";
    return text;
  }

  static std::string clip_as_text(const pipeline::TransferredClip& clip) {
    if (clip.passed_through)
      return fmt::format("  \"{}\": as it was (nothing on joints that controls move)\n",
                         printable(clip.name));
    const bake::TransferReport& report = clip.report;
    std::string text =
        fmt::format("  \"{}\": {}, {} controls, {} channels, {} keys\n", printable(clip.name),
                    frames_as_text(report.frames, report.inserted), report.controls,
                    report.channels, report.keys);
    text += off_as_text("    ", report.frames, clip.at_keys, clip.between);
    if (!clip.kept.empty())
      text +=
          "    channels stay for what controls do not say of " + names_as_text(clip.kept) + "\n";
    if (!clip.untouched.empty())
      text += "    no control moves " + names_as_text(clip.untouched) + ": as they were\n";
    return text;
  }

  std::string as_text(const pipeline::TransferredFile& done) const {
    std::string text = fmt::format("{}: {} clip{}, {} KB\n", printable(out_), done.clips.size(),
                                   done.clips.size() == 1 ? "" : "s", (done.bytes + 1023) / 1024);
    text += limbs_as_text(done.limbs);
    for (const pipeline::TransferredClip& clip : done.clips) text += clip_as_text(clip);
    return text;
  }

  static void write_names(json::Writer& w, const char* key, const std::vector<std::string>& names) {
    w.key(key).begin_array();
    for (const std::string& name : names) w.value(name);
    w.end_array();
  }

  static void write_clip(json::Writer& w, const pipeline::TransferredClip& clip) {
    w.begin_object().member("name", clip.name).member("passed_through", clip.passed_through);
    w.member("frames", clip.report.frames)
        .member("frames_added", clip.report.inserted)
        .member("controls", clip.report.controls)
        .member("channels", clip.report.channels)
        .member("keys", clip.report.keys);
    write_off(w, clip.at_keys, clip.between);
    write_names(w, "kept_joints", clip.kept);
    write_names(w, "untouched_joints", clip.untouched);
    w.end_object();
  }

  std::string as_json(const pipeline::TransferredFile& done) const {
    json::Writer w(2);
    w.begin_object()
        .member("file", out_)
        .member("bytes", static_cast<std::size_t>(done.bytes))
        .key("limbs")
        .begin_object();
    for (const pipeline::TransferredLimb& limb : done.limbs)
      w.member(limb.group, limb.ik ? "ik" : "fk");
    w.end_object().key("clips").begin_array();
    for (const pipeline::TransferredClip& clip : done.clips) write_clip(w, clip);
    w.end_array().end_object();
    return w.take() + "\n";
  }

  pipeline::TransferRequest request_;
  std::optional<double> tolerance_;
  std::string out_;
  Timing timing_;
};

}  // namespace

std::unique_ptr<Command> make_transfer() { return std::make_unique<Transfer>(); }

}  // namespace rigc::cli
