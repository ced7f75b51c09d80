// SPDX-License-Identifier: MIT
// What became of a rig, for people and for scripts. Test: tests/pipeline/update_test.cpp
#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "pipeline/recompile.h"

namespace rigc::pipeline {
namespace {

constexpr std::size_t kFew = 8;
/// Millimetres and degrees that no eye sees and that doubles lose.
constexpr double kRounding = 1e-6;

std::string plural(std::size_t count, const char* word) {
  const bool many = count != 1;
  std::string text(word);
  if (many && text.ends_with("y"))
    text = text.substr(0, text.size() - 1) + "ies";
  else if (many)
    text += "s";
  return fmt::format("{} {}", count, text);
}

/// `2 controls added: a, b`, with as many names as people read.
void add_names(std::string& text, const std::vector<std::string>& names, const char* word,
               const char* what, bool verbose) {
  if (names.empty()) return;
  const std::size_t shown = verbose ? names.size() : std::min(names.size(), kFew);
  std::vector<std::string> some;
  for (std::size_t i = 0; i < shown; ++i) some.push_back(printable(names[i], 80));
  text += fmt::format("    {} {}: {}{}\n", plural(names.size(), word), what, join(some, ", "),
                      shown < names.size() ? ", ..." : "");
}

void add_property(std::string& text, const CarriedProperty& property) {
  const std::string keys =
      property.channels > 0 ? plural(property.channels, "channel") : "value without keys";
  if (property.to.empty()) {
    text += fmt::format("    orphan: {} ({})\n", printable(property.from, 120), keys);
    return;
  }
  text += fmt::format("    {}: {} -> {} ({}{})\n", property.returned ? "back" : property.rule,
                      printable(property.from, 120), printable(property.to, 120), keys,
                      property.converted ? ", converted" : "");
}

/// What changed; the same from and to is told in one line with what it stands for.
void add_properties(std::string& text, const RigReport& report, bool verbose) {
  const auto& changed = report.carry.changed;
  const std::size_t most = verbose ? changed.size() : 3 * kFew;
  // Losses first: they are what people look for.
  std::size_t shown = 0;
  for (const bool lost : {true, false}) {
    for (const CarriedProperty& property : changed) {
      if (property.to.empty() != lost || shown >= most) continue;
      add_property(text, property);
      ++shown;
    }
  }
  if (shown < changed.size())
    text += fmt::format("    and {} more (--verbose lists them)\n", changed.size() - shown);
}

/// `compared at 40 of 80 times of 2 clips`.
std::string compared(const RigReport& report) {
  std::size_t times = 0, all = 0, clips = 0;
  for (const ClipComparison& clip : report.clips) {
    if (clip.clip.empty() && clip.comparison.all_times == 1) continue;  // as it stands
    ++clips;
    times += clip.comparison.times;
    all += clip.comparison.all_times;
  }
  if (clips == 0) return "compared as it stands";
  const std::string thinned = times < all ? fmt::format("{} of ", times) : "";
  return fmt::format("compared at {}{} of {}", thinned, plural(all, "time"), plural(clips, "clip"));
}

void add_differences(std::string& text, const RigReport& report) {
  if (report.clips.empty()) {
    text += "    motion: not compared, because a rig that is taken apart plays nothing\n";
    return;
  }
  const Largest largest = largest_difference(report);
  const std::string how = compared(report);
  if (largest.mm == 0 && largest.degrees == 0) {
    text += fmt::format("    motion: the same, bit for bit ({})\n", how);
  } else if (largest.mm < kRounding && largest.degrees < kRounding) {
    text += fmt::format("    motion: the same but for rounding ({})\n", how);
  } else {
    std::string where;
    if (!largest.joint.empty()) where = " at " + printable(largest.joint, 60);
    if (!largest.clip.empty()) where += fmt::format(" in clip \"{}\"", printable(largest.clip, 60));
    text +=
        fmt::format("    motion: differs by up to {:.4g} mm{}, and by up to {:.4g} degrees ({})\n",
                    largest.mm, where, largest.degrees, how);
  }
}

/// What became of the template: `biped 1 -> 2`.
std::string versions(const RigReport& report) {
  const std::string before = printable(report.template_before, 60);
  const std::string now = printable(report.template_name, 60);
  if (before != now)
    return fmt::format("{} {} -> {} {}", before, report.version_before, now, report.version);
  if (report.version_before != report.version)
    return fmt::format("{} {} -> {}", before, report.version_before, report.version);
  return fmt::format("{} {}{}", before, report.version,
                     report.why.empty() ? "" : " (" + report.why + ")");
}

/// Keys and values that nothing happened to.
std::string kept(const CarryReport& carry) {
  if (carry.kept_channels + carry.kept_values == 0)
    return carry.changed.empty() ? "nothing was keyed or set" : "";
  std::vector<std::string> parts;
  if (carry.kept_channels > 0) parts.push_back(plural(carry.kept_channels, "channel"));
  if (carry.kept_values > 0) parts.push_back(plural(carry.kept_values, "value") + " without keys");
  return join(parts, " and ") + " kept as they are";
}

void write_names(json::Writer& writer, const char* key, const std::vector<std::string>& names) {
  writer.key(key).begin_array();
  for (const std::string& name : names) writer.value(name);
  writer.end_array();
}

void write_comparison(json::Writer& writer, const ClipComparison& clip) {
  writer.begin_object();
  if (clip.clip.empty())
    writer.key("clip").null();
  else
    writer.member("clip", clip.clip);
  writer.member("times", clip.comparison.times).member("of", clip.comparison.all_times);
  writer.key("joints").begin_array();
  for (const update::Difference& joint : clip.comparison.joints) {
    if (joint.largest_mm == 0 && joint.largest_degrees == 0) continue;
    writer.begin_object().member("joint", joint.joint).member("largest_mm", joint.largest_mm);
    writer.member("mean_mm", joint.mean_mm).member("largest_degrees", joint.largest_degrees);
    writer.member("mean_degrees", joint.mean_degrees).end_object();
  }
  writer.end_array().end_object();
}

}  // namespace

void write_members(json::Writer& writer, const CarryOptions& options) {
  writer.member("keep_local", options.keep_local).member("strict", options.strict);
  if (options.tolerance_mm) writer.member("tolerance", *options.tolerance_mm);
  writer.member("plan", options.plan);
}

std::string as_text(const RigReport& report, bool verbose) {
  std::string text = fmt::format("  {}: {}\n", printable(report.global, 60), versions(report));
  const CarryReport& carry = report.carry;
  add_names(text, carry.joints_added, "joint", "added", verbose);
  add_names(text, carry.joints_removed, "joint", "removed", verbose);
  add_names(text, report.put_back, "edit", "set back by the guides", verbose);
  add_names(text, report.skinned_joints, "joint", "kept, because a skin uses them", verbose);
  add_names(text, carry.controls_added, "control", "added", verbose);
  add_names(text, carry.controls_removed, "control", "removed", verbose);
  add_names(text, carry.controls_moved, "control", "moved", verbose);
  if (const std::string same = kept(carry); !same.empty()) text += "    " + same + "\n";
  add_properties(text, report, verbose);
  add_names(text, carry.inexact, "property", "cannot be said exactly and stays as it is", verbose);
  add_names(text, carry.set, "value", "set, so that what was keyed plays on", verbose);
  add_differences(text, report);
  text.pop_back();
  return text;
}

void write_json(json::Writer& writer, const RigReport& report) {
  const CarryReport& carry = report.carry;
  writer.begin_object().member("global", report.global).member("why", report.why);
  writer.key("from").begin_object().member("template", report.template_before);
  writer.member("version", report.version_before).end_object();
  writer.key("to").begin_object().member("template", report.template_name);
  writer.member("version", report.version).end_object();
  write_names(writer, "joints_added", carry.joints_added);
  write_names(writer, "joints_removed", carry.joints_removed);
  write_names(writer, "joints_kept_for_skins", report.skinned_joints);
  write_names(writer, "controls_added", carry.controls_added);
  write_names(writer, "controls_removed", carry.controls_removed);
  write_names(writer, "controls_moved", carry.controls_moved);
  write_names(writer, "set_back", report.put_back);
  write_names(writer, "settings_dropped", report.dropped_settings);
  writer.member("kept_channels", carry.kept_channels).member("kept_values", carry.kept_values);
  writer.member("orphans", carry.orphans).member("new_orphans", carry.new_orphans);
  writer.key("changed").begin_array();
  for (const CarriedProperty& property : carry.changed) {
    writer.begin_object().member("from", property.from);
    if (property.to.empty())
      writer.key("to").null();
    else
      writer.member("to", property.to).member("rule", property.rule);
    writer.member("channels", property.channels).member("converted", property.converted);
    writer.member("returned", property.returned).end_object();
  }
  writer.end_array();
  write_names(writer, "inexact", carry.inexact);
  write_names(writer, "set", carry.set);
  const Largest largest = largest_difference(report);
  writer.member("largest_mm", largest.mm).member("largest_degrees", largest.degrees);
  writer.key("clips").begin_array();
  for (const ClipComparison& clip : report.clips) write_comparison(writer, clip);
  writer.end_array().end_object();
}

}  // namespace rigc::pipeline
