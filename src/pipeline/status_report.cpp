// SPDX-License-Identifier: MIT
// Status as a table for people and as one JSON document. Test: tests/cli/status_test.cpp
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/json.h"
#include "base/text.h"
#include "pipeline/status.h"

namespace rigc::pipeline {
namespace {

constexpr std::size_t kMostOrphansShown = 10;
constexpr std::size_t kColumns = 5;
using Row = std::array<std::string, kColumns>;

struct Counts {
  std::size_t files = 0, without = 0, unread = 0, rigs = 0, orphans = 0;
  std::array<std::size_t, 4> actions{};  ///< by Action
};

Counts count(const std::vector<FileStatus>& files) {
  Counts counts;
  counts.files = files.size();
  for (const FileStatus& file : files) {
    if (!file.read) ++counts.unread;
    if (file.read && file.rigs.empty()) ++counts.without;
    counts.rigs += file.rigs.size();
    for (const RigStatus& rig : file.rigs) {
      ++counts.actions[static_cast<std::size_t>(rig.assessment.action)];
      counts.orphans += rig.rig.orphans.size();
    }
  }
  return counts;
}

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string name_of_template(const RigStatus& status) {
  const auto& templates = status.assessment.templates;
  return printable(templates.empty() ? status.rig.name : templates.front().name, 60);
}

std::string version_text(const Assessment& assessment) {
  if (assessment.templates.empty()) return "?";
  const TemplateStatus& main = assessment.templates.front();
  const bool differs = main.found != main.version && main.found > 0;
  return differs ? fmt::format("{} -> {}", main.version, main.found) : std::to_string(main.version);
}

std::string verdict(const RigStatus& status) {
  const Assessment& assessment = status.assessment;
  std::string text(name_of(assessment.action));
  if (!assessment.reason.empty()) text += ": " + assessment.reason;
  std::vector<std::string> more;
  if (!status.rig.orphans.empty()) more.push_back(counted(status.rig.orphans.size(), "orphan"));
  for (const Fork& fork : assessment.forks)
    more.push_back(fmt::format("fork {} {}: --to {}", fork.name, fork.version, fork.name));
  for (const std::string& one : more) text += " (" + one + ")";
  return text;
}

std::string orphan_lines(const gltf::RigSummary& rig) {
  std::string out;
  const std::size_t shown = std::min(rig.orphans.size(), kMostOrphansShown);
  for (std::size_t i = 0; i < shown; ++i) {
    const gltf::OrphanSummary& orphan = rig.orphans[i];
    const std::string dot = orphan.label.empty() ? "" : "." + printable(orphan.label, 60);
    out += fmt::format("    orphan  {}{}  \"{}\"{}{}\n", printable(orphan.local, 60), dot,
                       printable(orphan.name, 60), orphan.attributes.empty() ? "" : "  ",
                       printable(join(orphan.attributes, " "), 200));
  }
  if (rig.orphans.size() > shown)
    out += fmt::format("    and {} more, in --json\n", rig.orphans.size() - shown);
  return out;
}

std::string summary(const Counts& counts) {
  std::string out =
      fmt::format("{}, {}", counted(counts.files, "file"), counted(counts.rigs, "rig"));
  constexpr std::pair<Action, std::string_view> kWords[] = {{Action::update, "would be updated"},
                                                            {Action::rebuild, "would be rebuilt"},
                                                            {Action::nothing, "need nothing"},
                                                            {Action::cannot, "cannot be updated"}};
  for (const auto& [action, words] : kWords)
    if (const std::size_t n = counts.actions[static_cast<std::size_t>(action)])
      out += fmt::format(", {} {}", n, words);
  if (counts.orphans > 0) out += ", " + counted(counts.orphans, "orphan");
  if (counts.without > 0) out += fmt::format(", {} without a rig", counted(counts.without, "file"));
  if (counts.unread > 0) out += fmt::format(", {} with errors", counted(counts.unread, "file"));
  return out + "\n";
}

void write_templates(json::Writer& w, const Assessment& assessment) {
  w.key("templates").begin_array();
  for (const TemplateStatus& made : assessment.templates) {
    w.begin_object().member("name", made.name).member("version", made.version);
    w.member("file", made.file).member("state", name_of(made.state));
    if (made.found > 0) w.member("found", made.found);
    w.end_object();
  }
  w.end_array();
}

void write_modules(json::Writer& w, const Assessment& assessment) {
  w.key("modules").begin_array();
  for (const ModuleStatus& module : assessment.modules) {
    w.begin_object().member("name", module.name).member("version", module.version);
    w.member("state", name_of(module.state));
    if (module.found > 0) w.member("found", module.found);
    w.end_object();
  }
  w.end_array();
}

void write_orphans(json::Writer& w, const gltf::RigSummary& rig) {
  w.key("orphans").begin_array();
  for (const gltf::OrphanSummary& orphan : rig.orphans) {
    w.begin_object().member("identity", orphan.identity).member("name", orphan.name);
    w.member("local", orphan.local).member("label", orphan.label);
    w.key("attributes").begin_array();
    for (const std::string& name : orphan.attributes) w.value(name);
    w.end_array().end_object();
  }
  w.end_array();
}

void write_rig(json::Writer& w, const RigStatus& status) {
  const Assessment& assessment = status.assessment;
  w.begin_object().member("id", status.rig.id).member("global", status.rig.global);
  w.member("template",
           assessment.templates.empty() ? status.rig.name : assessment.templates.front().name);
  w.member("action", name_of(assessment.action)).member("reason", assessment.reason);
  write_templates(w, assessment);
  write_modules(w, assessment);
  w.key("forks").begin_array();
  for (const Fork& fork : assessment.forks)
    w.begin_object().member("name", fork.name).member("version", fork.version).end_object();
  w.end_array();
  write_orphans(w, status.rig);
  w.end_object();
}

}  // namespace

std::string status_text(const std::vector<FileStatus>& files) {
  Row width = {"FILE", "RIG", "TEMPLATE", "VERSION", "UPDATE WOULD"};
  std::vector<std::pair<Row, std::string>> rows = {{width, ""}};
  for (const FileStatus& file : files)
    for (const RigStatus& rig : file.rigs)
      rows.push_back({{printable(file.file), printable(rig.rig.global, 60), name_of_template(rig),
                       version_text(rig.assessment), verdict(rig)},
                      orphan_lines(rig.rig)});
  std::array<std::size_t, kColumns> widths{};
  for (const auto& [row, orphans] : rows)
    for (std::size_t i = 0; i < kColumns; ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string out;
  for (const auto& [row, orphans] : rows) {
    if (rows.size() == 1) break;
    for (std::size_t i = 0; i + 1 < kColumns; ++i)
      out += fmt::format("{:<{}}  ", row[i], widths[i]);
    out += row.back() + "\n" + orphans;
  }
  return out + summary(count(files));
}

std::string status_json(const std::vector<FileStatus>& files) {
  const Counts counts = count(files);
  json::Writer w(2);
  w.begin_object().key("files").begin_array();
  for (const FileStatus& file : files) {
    w.begin_object().member("file", file.file).member("read", file.read);
    w.key("rigs").begin_array();
    for (const RigStatus& rig : file.rigs) write_rig(w, rig);
    w.end_array().end_object();
  }
  w.end_array().key("summary").begin_object();
  w.member("files", counts.files).member("rigs", counts.rigs);
  for (const Action action : {Action::nothing, Action::update, Action::rebuild, Action::cannot})
    w.member(name_of(action), counts.actions[static_cast<std::size_t>(action)]);
  w.member("orphans", counts.orphans).member("without_rig", counts.without);
  w.member("errors", counts.unread).end_object().end_object();
  return w.take() + "\n";
}

}  // namespace rigc::pipeline
