// SPDX-License-Identifier: MIT
// Rename: another global group for a rig of a file, at the places of RIGC_rig's text that have it.
// Test: tests/pipeline/rename_test.cpp
#include "pipeline/rename.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/files.h"
#include "base/text.h"
#include "gltf/merge_edits.h"
#include "gltf/rig.h"
#include "pipeline/build.h"
#include "pipeline/codes.h"
#include "pipeline/merge_codes.h"
#include "selector/selector.h"

namespace rigc::pipeline {
namespace {

using json::Value;
using Names = std::map<std::string, std::string>;

std::optional<Names> read_pairs(const RenameRequest& request, Diagnostics& diagnostics) {
  Names names;
  for (const std::string& pair : request.globals) {
    const auto words = split(pair, '=');
    const bool good = words.size() == 2 && is_name(words[1]) && !words[0].empty() &&
                      names.emplace(words[0], words[1]).second;
    if (good) continue;
    diagnostics.report(codes::kBadPair, Place(request.file),
                       fmt::format("--global \"{}\"", printable(pair, 80)),
                       "for example --global biped=hero");
    return std::nullopt;
  }
  return names;
}

/// Every old name is there, and no two rigs that had different names have one afterwards.
bool check_names(const RenameRequest& request, const std::vector<gltf::Rig>& rigs,
                 const Names& names, Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.errors();
  std::set<std::string> before;
  for (const gltf::Rig& rig : rigs) before.insert(rig.skeleton.global);
  for (const auto& [old, now] : names)
    if (before.count(old) == 0)
      diagnostics.report(codes::kNoSuchRig, Place(request.file),
                         fmt::format("the file has no rig \"{}\"", printable(old, 60)),
                         suggest(old, {before.begin(), before.end()}));
  std::map<std::string, std::string> after;
  for (const std::string& old : before) {
    const auto found = names.find(old);
    const std::string& now = found == names.end() ? old : found->second;
    const auto [other, is_new] = after.emplace(now, old);
    if (!is_new)
      diagnostics.report(codes::kGlobalTaken, Place(request.file),
                         fmt::format("\"{}\" and \"{}\" would both be \"{}\"",
                                     printable(other->second, 60), printable(old, 60), now));
  }
  return diagnostics.errors() == errors;
}

/// Edits of the rigs' texts.
class Renaming {
 public:
  Renaming(const Names& names, const catalog::Catalogue& catalogue)
      : names_(names), catalogue_(catalogue) {}

  void run(const Value& rig, Renamed& counts) {
    if (set_name(rig["global"])) ++counts.rigs;
    for (const char* list : {"nodes", "joints", "orphans"})
      for (const Value& item : rig[list].items()) set_name(item["global"]);
    rename_arguments(rig, counts);
  }

  void rename_arguments(const Value& rig, Renamed& counts) {
    for (const Value& joint : rig["joints"].items()) {
      for (const Value& command : joint["commands"].items()) {
        const auto* descriptor = catalogue_.find(command["module"].string().value_or(""));
        for (const auto& [name, value] : command["with"].members())
          set_argument(descriptor ? descriptor->find(name) : nullptr, !descriptor, value, counts);
      }
    }
  }

  gltf::Edits edits;

 private:
  bool set_name(const Value& value) {
    const auto name = value.string();
    const auto found = name ? names_.find(*name) : names_.end();
    if (found == names_.end()) return false;
    edits.replace(value, json::quote(found->second));
    return true;
  }

  /// Arguments of modules that are not there are selectors where they can be read as such.
  void set_argument(const catalog::Parameter* parameter, bool unknown, const Value& value,
                    Renamed& counts) {
    for (const Value& item : value.items()) set_argument(parameter, unknown, item, counts);
    const auto text = value.string();
    if (!text || text->find(':') == std::string::npos || (!parameter && !unknown)) return;
    using Type = catalog::ParameterType;
    const bool expression = parameter && parameter->type == Type::expression;
    const bool selector =
        unknown || (parameter && (parameter->type == Type::node || parameter->type == Type::nodes ||
                                  parameter->type == Type::plug || parameter->type == Type::plugs));
    std::optional<std::string> now;
    if (expression || unknown) now = renamed_expression(*text);
    if (!now && selector) now = renamed_selector(*text);
    if (!now) return;
    edits.replace(value, json::quote(*now));
    ++counts.selectors;
  }

  bool rename(selector::Selector& selector) const {
    bool renamed = false;
    for (selector::Choice& choice : selector.choices) {
      const auto found = names_.find(choice.global);
      if (found == names_.end()) continue;
      choice.global = found->second;
      renamed = true;
    }
    return renamed;
  }

  /// Nothing where the text names none of the rigs.
  std::optional<std::string> renamed_selector(const std::string& text) const {
    Diagnostics ignored;
    auto selector = selector::parse(text, {}, ignored);
    if (!selector || !rename(*selector)) return std::nullopt;
    return selector::print(*selector);
  }

  std::optional<std::string> renamed_expression(const std::string& text) const {
    Diagnostics ignored;
    auto expression = selector::parse_expression(text, {}, ignored);
    bool renamed = false;
    if (expression)
      for (selector::Selector& selector : expression->selectors)
        renamed = rename(selector) || renamed;
    if (!renamed) return std::nullopt;
    return selector::print(*expression);
  }

  const Names& names_;
  const catalog::Catalogue& catalogue_;
};

}  // namespace

std::size_t rename_selectors(gltf::Patch& patch, const std::map<std::string, std::string>& names,
                             const catalog::Catalogue& catalogue) {
  Diagnostics none;
  const auto document = json::parse(patch.root_extension("RIGC_rig"), "", 0, none);
  if (!document) return 0;
  Renamed counts;
  Renaming renaming(names, catalogue);
  for (const Value& rig : document->root()["rigs"].items()) renaming.rename_arguments(rig, counts);
  renaming.edits.sort();
  if (!renaming.edits.empty())
    patch.set_root_extension("RIGC_rig", renaming.edits.text(document->root()));
  return counts.selectors;
}

std::optional<Renamed> rename_rigs(const RenameRequest& request, const std::string& out,
                                   Diagnostics& diagnostics) {
  const std::string& target = out.empty() ? request.file : out;
  const auto names = read_pairs(request, diagnostics);
  if (!names || !check_output_name(target, diagnostics)) return std::nullopt;
  const auto lock = FileLock::take(target, diagnostics);
  if (!lock) return std::nullopt;
  const auto file = gltf::open(request.file, diagnostics);
  if (!file) return std::nullopt;
  const auto rigs = gltf::read_rigs(*file, diagnostics);
  if (!rigs) return std::nullopt;
  if (rigs->empty()) {
    diagnostics.report(codes::kNoRig, Place(request.file), "the file has no rig to rename");
    return std::nullopt;
  }
  catalog::Catalogue catalogue;
  if (!check_names(request, *rigs, *names, diagnostics)) return std::nullopt;
  if (!add_modules(request.paths, catalogue, diagnostics)) return std::nullopt;

  Renamed result;
  Renaming renaming(*names, catalogue);
  const Value extension = file->root()["extensions"]["RIGC_rig"];
  for (const Value& rig : extension["rigs"].items()) renaming.run(rig, result);
  renaming.edits.sort();
  const std::string text = renaming.edits.text(extension);
  result.changed = text != extension.text();
  if (!result.changed && out.empty()) return result;
  gltf::Patch patch(*file);
  if (result.changed) patch.set_root_extension("RIGC_rig", text);
  std::uint64_t bytes = 0;
  if (!write_output(patch, *file, target, bytes, diagnostics)) return std::nullopt;
  return result;
}

}  // namespace rigc::pipeline
