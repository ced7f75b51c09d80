// SPDX-License-Identifier: MIT
// What a bake did. Test: tests/cli/bake_test.cpp
#include "pipeline/bake_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"

namespace rigc::pipeline {
namespace {

std::string text_of(const BakedClip& clip) {
  if (clip.passed_through) return "as it was (nothing on controls)";
  std::string text =
      fmt::format("{} frames, {} channels, {} keys", clip.frames, clip.channels, clip.keys);
  if (clip.reduction_mm > 0) text += fmt::format(", off by at most {:.2g} mm", clip.reduction_mm);
  if (clip.shear.mm >= 0.01)
    text += fmt::format(", sheared by up to {:.2g} mm (\"{}\" at {:.3f} s)", clip.shear.mm,
                        printable(clip.shear.joint), clip.shear.seconds);
  return text;
}

void write(json::Writer& w, const BakedClip& clip) {
  w.begin_object().member("name", clip.name).member("passed_through", clip.passed_through);
  w.member("frames", clip.frames).member("channels", clip.channels).member("keys", clip.keys);
  w.member("reduction_mm", clip.reduction_mm).member("shear", clip.shear.relative);
  w.member("shear_mm", clip.shear.mm);
  if (clip.shear.mm > 0)
    w.member("shear_joint", clip.shear.joint).member("shear_seconds", clip.shear.seconds);
  w.end_object();
}

/// "3 clips, 5024 keys, off by at most 0.09 mm"
std::string summary(const Baked& baked) {
  std::size_t keys = 0;
  double reduction = 0;
  for (const BakedClip& clip : baked.clips) {
    keys += clip.keys;
    reduction = std::max(reduction, clip.reduction_mm);
  }
  std::string text = fmt::format("{} clip{}, {} keys", baked.clips.size(),
                                 baked.clips.size() == 1 ? "" : "s", keys);
  if (reduction > 0) text += fmt::format(", off by at most {:.2g} mm", reduction);
  return text;
}

}  // namespace

std::string clips_text(const Baked& baked) {
  std::string text;
  for (const BakedClip& clip : baked.clips)
    text += fmt::format("  \"{}\": {}\n", printable(clip.name), text_of(clip));
  return text;
}

void write_clips(json::Writer& w, const Baked& baked) {
  w.begin_array();
  for (const BakedClip& clip : baked.clips) write(w, clip);
  w.end_array();
}

FileResult bake_work(BakeRequest request, const FileWork& work, Diagnostics& diagnostics) {
  request.file = work.input;
  request.skip_without_rig = true;
  FileResult result;
  const auto baked = bake_file(request, work.output, diagnostics);
  if (!baked) return result;
  result.outcome = baked->has_rig ? FileResult::Outcome::changed : FileResult::Outcome::skipped;
  result.summary = baked->has_rig ? summary(*baked) : "no rig";
  json::Writer w;
  w.begin_object().key("clips");
  write_clips(w, *baked);
  result.json = w.end_object().take();
  result.bytes = baked->bytes;
  return result;
}

}  // namespace rigc::pipeline
