// SPDX-License-Identifier: MIT
// How far a rig is from what it shall play.
// Test: tests/cli/transfer_test.cpp, tests/cli/match_test.cpp
#include "cli/off.h"

#include <fmt/format.h>

#include "base/text.h"

namespace rigc::cli {
namespace {

std::string one_as_text(const pipeline::Off& off) {
  return fmt::format("{} mm ({} % of height; \"{}\" at {:.2f} s), {} degrees (\"{}\" at {:.2f} s)",
                     pipeline::short_number(off.mm), pipeline::short_number(off.percent),
                     printable(off.joint), off.seconds, pipeline::short_number(off.degrees),
                     printable(off.turned_joint), off.turned_seconds);
}

void write_one(json::Writer& w, const char* name, const pipeline::Off& off) {
  w.key(name)
      .begin_object()
      .member("mm", off.mm)
      .member("percent_of_height", off.percent)
      .member("joint", off.joint)
      .member("seconds", off.seconds)
      .member("degrees", off.degrees)
      .member("turned_joint", off.turned_joint)
      .member("turned_seconds", off.turned_seconds)
      .end_object();
}

}  // namespace

std::string off_as_text(const std::string& indent, std::size_t frames, const pipeline::Off& at_keys,
                        const pipeline::Off& between) {
  std::string text = indent + "off at keys by up to " + one_as_text(at_keys) + "\n";
  if (frames > 1) text += indent + "between keys by up to " + one_as_text(between) + "\n";
  return text;
}

std::string frames_as_text(std::size_t frames, std::size_t inserted) {
  return fmt::format("{} frames{}", frames,
                     inserted == 0 ? "" : fmt::format(" ({} added)", inserted));
}

void write_off(json::Writer& w, const pipeline::Off& at_keys, const pipeline::Off& between) {
  write_one(w, "at_keys", at_keys);
  write_one(w, "between_keys", between);
}

}  // namespace rigc::cli
