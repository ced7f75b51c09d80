// SPDX-License-Identifier: MIT
// rigc bake: clips on controls become clips on joints. Test: tests/cli/bake_test.cpp
#include <fmt/format.h>

#include "base/text.h"
#include "cli/batch.h"
#include "pipeline/bake_report.h"

namespace rigc::cli {
namespace {

/// The options that decide what becomes of a file, for --resume.
std::string settings_text(const pipeline::BakeRequest& request) {
  json::Writer w;
  w.begin_object().key("clips").begin_array();
  for (const std::string& clip : request.clips) w.value(clip);
  w.end_array().member("fps", request.fps);
  if (request.start) w.member("start", *request.start);
  if (request.end) w.member("end", *request.end);
  w.member("tolerance", request.tolerance_mm).member("keep_rig", request.keep_rig);
  return w.end_object().take();
}

class Bake final : public Command {
 public:
  std::string name() const override { return "bake"; }
  std::string summary() const override {
    return "Put the animation of controls onto the joints, as plain glTF";
  }
  std::vector<std::string> examples() const override {
    return {"rigc bake shot.glb -o game.glb",
            "rigc bake shot.glb -o game.glb --clip walk --fps 60 --tolerance 0.1",
            "rigc bake shot.glb -o game.glb --fps source --tolerance 0.5",
            "rigc bake shots/ --out-dir baked --jobs 8 --report report.json"};
  }
  void declare(Options& options) override {
    declare_batch(options, batch_, Target::elsewhere);
    options.list("--clip", "NAME", request_.clips,
                 "Bake this clip, by name or number (default: all)");
    options.text("--fps", "N|source", request_.fps, false,
                 "Frames a second (default: 30), or source: at the keys' own times, and between "
                 "them where --tolerance needs it");
    options.number("--start", "SECONDS", request_.start,
                   "Where to begin (default: the clip's first key)");
    options.number("--end", "SECONDS", request_.end, "Where to end (default: the clip's last key)");
    options.number("--tolerance", "MM", tolerance_,
                   "Drop keys as long as no joint is off by more than this at any time, in "
                   "millimetres of the world (default: 0, every frame is a key)");
    options.flag("--keep-rig", request_.keep_rig,
                 "Keep the rig and the clips on its controls in the file");
  }
  void run(Session& session) override {
    pipeline::BatchRequest& batch = batch_.request;
    if (batch.output.empty() && batch.out_dir.empty()) {
      session.notes = "rigc bake: -o or --out-dir says where the output goes\n";
      session.status = 2;
      return;
    }
    if (!read_jobs(batch_, session.diagnostics)) return;
    Threads threads(batch.jobs);
    request_.threads = &threads;
    request_.tolerance_mm = tolerance_.value_or(0);
    const bool many = batch.inputs.size() > 1 || !batch.out_dir.empty();
    const bool reports = !batch.report.empty() || !batch.resume.empty();
    run_timed(batch_, session, [&] {
      if (many || reports)
        bake_many(threads, session);
      else
        bake_one(session);
    });
  }

 private:
  void bake_one(Session& session) {
    request_.file = batch_.request.inputs[0];
    const std::string& out = batch_.request.output;
    const auto baked = pipeline::bake_file(request_, out, session.diagnostics);
    if (!baked) return;
    session.out = session.json ? as_json(*baked, out) : as_text(*baked, out);
  }

  void bake_many(Threads& threads, Session& session) {
    batch_.request.command = "bake";
    batch_.request.settings = settings_text(request_);
    batch_.request.threads = &threads;
    run_batch(
        batch_,
        [&](const pipeline::FileWork& work, Diagnostics& diagnostics) {
          return pipeline::bake_work(request_, work, diagnostics);
        },
        false, session);
  }

  static std::string as_text(const pipeline::Baked& baked, const std::string& out) {
    return fmt::format("{}: {} clip{}, {} KB\n", printable(out), baked.clips.size(),
                       baked.clips.size() == 1 ? "" : "s", (baked.bytes + 1023) / 1024) +
           pipeline::clips_text(baked);
  }

  static std::string as_json(const pipeline::Baked& baked, const std::string& out) {
    json::Writer w(2);
    w.begin_object().member("file", out).member("bytes", static_cast<std::size_t>(baked.bytes));
    w.key("clips");
    pipeline::write_clips(w, baked);
    return w.end_object().take() + "\n";
  }

  pipeline::BakeRequest request_;
  BatchOptions batch_;
  std::optional<double> tolerance_;
};

}  // namespace

std::unique_ptr<Command> make_bake() { return std::make_unique<Bake>(); }

}  // namespace rigc::cli
