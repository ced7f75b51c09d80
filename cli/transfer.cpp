// SPDX-License-Identifier: MIT
// rigc transfer: clips on joints become clips on controls. Test: tests/cli/cli_test.cpp
#include <fmt/format.h>

#include "base/text.h"
#include "cli/command.h"
#include "cli/timing.h"
#include "pipeline/transfer.h"

namespace rigc::cli {
namespace {

class Transfer final : public Command {
 public:
  std::string name() const override { return "transfer"; }
  std::string summary() const override {
    return "Put the animation of joints onto the controls: the reverse of bake";
  }
  std::vector<std::string> examples() const override {
    return {"rigc transfer hero.glb -o shot.glb",
            "rigc transfer hero.glb -o shot.glb --clip walk --limb leg_l=ik --limb leg_r=ik"};
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
    const auto done = pipeline::transfer_file(request_, out_, session.diagnostics);
    if (!done) return;
    session.out = session.json ? as_json(*done) : as_text(*done);
  }

  static std::string off_as_text(const pipeline::Off& off) {
    return fmt::format("{:.2g} mm ({:.2g} % of height) at \"{}\", {:.2g} degrees at \"{}\"", off.mm,
                       off.percent, printable(off.joint), off.degrees, printable(off.turned_joint));
  }

  static std::string clip_as_text(const pipeline::TransferredClip& clip) {
    if (clip.passed_through)
      return fmt::format("  \"{}\": as it was (nothing on joints that controls move)\n",
                         printable(clip.name));
    std::string text = fmt::format("  \"{}\": {} frames, {} controls, {} channels, {} keys\n",
                                   printable(clip.name), clip.report.frames, clip.report.controls,
                                   clip.report.channels, clip.report.keys);
    text += "    off by up to " + off_as_text(clip.at_keys) + "\n";
    if (clip.report.frames > 1) text += "    between keys " + off_as_text(clip.between) + "\n";
    for (const std::string& joint : clip.kept)
      text += fmt::format("    joint \"{}\" keeps channels of its own\n", printable(joint));
    return text;
  }

  std::string as_text(const pipeline::TransferredFile& done) const {
    std::string text = fmt::format("{}: {} clip{}, {} KB\n", printable(out_), done.clips.size(),
                                   done.clips.size() == 1 ? "" : "s", (done.bytes + 1023) / 1024);
    for (const pipeline::TransferredClip& clip : done.clips) text += clip_as_text(clip);
    return text;
  }

  static void write_off(json::Writer& w, const char* name, const pipeline::Off& off) {
    w.key(name)
        .begin_object()
        .member("mm", off.mm)
        .member("percent_of_height", off.percent)
        .member("joint", off.joint)
        .member("degrees", off.degrees)
        .member("turned_joint", off.turned_joint)
        .end_object();
  }

  std::string as_json(const pipeline::TransferredFile& done) const {
    json::Writer w(2);
    w.begin_object()
        .member("file", out_)
        .member("bytes", static_cast<std::size_t>(done.bytes))
        .key("clips")
        .begin_array();
    for (const pipeline::TransferredClip& clip : done.clips) {
      w.begin_object().member("name", clip.name).member("passed_through", clip.passed_through);
      w.member("frames", clip.report.frames)
          .member("controls", clip.report.controls)
          .member("channels", clip.report.channels)
          .member("keys", clip.report.keys);
      write_off(w, "at_keys", clip.at_keys);
      write_off(w, "between_keys", clip.between);
      w.key("kept_joints").begin_array();
      for (const std::string& joint : clip.kept) w.value(joint);
      w.end_array().end_object();
    }
    w.end_array().end_object();
    return w.take() + "\n";
  }

  pipeline::TransferRequest request_;
  std::string out_;
  Timing timing_;
};

}  // namespace

std::unique_ptr<Command> make_transfer() { return std::make_unique<Transfer>(); }

}  // namespace rigc::cli
