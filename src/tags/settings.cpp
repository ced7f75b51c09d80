// SPDX-License-Identifier: MIT
// Settings: parsing the command line's texts, and laying them over tags. Test:
// tests/tags/settings_test.cpp
#include "tags/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/text.h"
#include "tags/codes.h"

namespace rigc::tags {
namespace {

std::optional<bool> on_or_off(std::string_view text) {
  if (text != "on" && text != "off" && text != "true" && text != "false") return std::nullopt;
  return text == "on" || text == "true";
}

/// Splits `NAME=on` into its name and its value.
std::optional<std::pair<std::string_view, bool>> split_setting(std::string_view text) {
  const std::size_t equals = text.rfind('=');
  if (equals == std::string_view::npos) return std::nullopt;
  const auto on = on_or_off(text.substr(equals + 1));
  if (!on) return std::nullopt;
  return std::pair(text.substr(0, equals), *on);
}

std::vector<std::string> sorted(const std::set<std::string>& names) {
  return {names.begin(), names.end()};
}

/// Which groups were made beneath which.
class Groups {
 public:
  explicit Groups(const TaggedSkeleton& skeleton)
      : above_(skeleton.groups.begin(), skeleton.groups.end()) {}
  /// The group itself, the one that it was made beneath, the one that that was, ...
  std::vector<std::string> upwards(const std::string& group) const {
    std::vector<std::string> out{group};
    for (auto at = above_.find(group); at != above_.end() && out.size() <= above_.size();
         at = above_.find(at->second))
      out.push_back(at->second);
    return out;
  }

 private:
  std::map<std::string, std::string> above_;
};

/// Checks the names of one feature setting against all tags of the skeleton.
void check_feature(const TaggedSkeleton& skeleton, const Groups& tree,
                   const Settings::Feature& setting, Diagnostics& diagnostics) {
  std::set<std::string> groups, names, switches;
  for (const TaggedJoint& joint : skeleton.joints) {
    const std::vector<std::string> around = tree.upwards(joint.ids.local);
    groups.insert(around.begin(), around.end());
    if (!setting.group.empty() &&
        std::find(around.begin(), around.end(), setting.group) == around.end())
      continue;
    for (const FeatureTag& feature : joint.features) {
      if (!feature.name.empty()) names.insert(feature.name);
      if (feature.name == setting.name && !feature.switch_name.empty())
        switches.insert(feature.switch_name);
    }
  }
  groups.erase("");
  if (setting.group.empty()) {
    // Declared features may have lost all their tags, for instance with an optional joint.
    for (const FeatureDeclaration& feature : skeleton.features) {
      names.insert(feature.name);
      if (feature.name == setting.name)
        switches.insert(feature.switches.begin(), feature.switches.end());
    }
  }
  const std::string in =
      setting.group.empty() ? "" : fmt::format(" in the group {}", setting.group);
  if (!setting.group.empty() && !groups.contains(setting.group))
    diagnostics.report(codes::kUnknownGroup, Place(),
                       fmt::format("there is no group \"{}\"", printable(setting.group, 60)),
                       suggest(setting.group, sorted(groups)));
  else if (!names.contains(setting.name))
    diagnostics.report(codes::kUnknownFeature, Place(),
                       fmt::format("there is no feature \"{}\"{}", printable(setting.name, 60), in),
                       suggest(setting.name, sorted(names)));
  else if (!setting.switch_name.empty() && !switches.contains(setting.switch_name))
    diagnostics.report(codes::kUnknownSwitch, Place(),
                       fmt::format("the feature {} has no switch \"{}\"{}", setting.name,
                                   printable(setting.switch_name, 60), in),
                       suggest(setting.switch_name, sorted(switches)));
}

/// The last setting that names what a tag says, of those for the nearest group that has one; those
/// for all come last. `around`: the tag's group and those that it was made beneath.
std::optional<bool> find_setting(const std::vector<Settings::Feature>& settings,
                                 const std::vector<std::string>& around, const FeatureTag& feature,
                                 const std::string& switch_name) {
  std::optional<bool> out;
  std::size_t nearest = around.size();
  for (const Settings::Feature& setting : settings) {
    if (setting.name != feature.name || setting.switch_name != switch_name) continue;
    const auto group = std::find(around.begin(), around.end(), setting.group);
    const auto distance = static_cast<std::size_t>(group - around.begin());
    if ((distance == around.size() && !setting.group.empty()) || distance > nearest) continue;
    nearest = distance;
    out = setting.on;
  }
  return out;
}

void apply_to(TaggedJoint& joint, const Groups& groups,
              const std::vector<Settings::Feature>& settings) {
  if (joint.features.empty()) return;
  const std::vector<std::string> around = groups.upwards(joint.ids.local);
  for (FeatureTag& feature : joint.features) {
    if (feature.name.empty()) continue;
    const auto whole = find_setting(settings, around, feature, "");
    const auto part = feature.switch_name.empty()
                          ? std::nullopt
                          : find_setting(settings, around, feature, feature.switch_name);
    if (whole) feature.on = *whole;
    if (part) feature.on = whole ? *whole && *part : *part;
  }
}

}  // namespace

std::optional<Settings::Feature> parse_feature_setting(std::string_view text,
                                                       Diagnostics& diagnostics) {
  Settings::Feature setting;
  const auto parts = split_setting(text);
  if (parts) {
    std::string_view name = parts->first;
    setting.on = parts->second;
    const std::size_t slash = name.find('/');
    if (slash != std::string_view::npos) {
      setting.group = name.substr(0, slash);
      name.remove_prefix(slash + 1);
    }
    const std::size_t colon = name.find(':');
    setting.name = name.substr(0, colon);
    if (colon != std::string_view::npos) setting.switch_name = name.substr(colon + 1);
    const bool named = is_name(setting.name) &&
                       (slash == std::string_view::npos || is_name(setting.group)) &&
                       (colon == std::string_view::npos || is_name(setting.switch_name));
    if (named) return setting;
  }
  diagnostics.report(codes::kBadSetting, Place(),
                     fmt::format("\"{}\" is not a feature setting", printable(text, 100)),
                     "write [GROUP/]NAME[:SWITCH]=on or =off");
  return std::nullopt;
}

std::optional<std::pair<std::string, bool>> parse_group_setting(std::string_view text,
                                                                Diagnostics& diagnostics) {
  const auto parts = split_setting(text);
  if (parts && is_name(parts->first)) return std::pair(std::string(parts->first), parts->second);
  diagnostics.report(codes::kBadSetting, Place(),
                     fmt::format("\"{}\" is not a group setting", printable(text, 100)),
                     "write GROUP=on or GROUP=off");
  return std::nullopt;
}

std::optional<bool> parse_switch(std::string_view option, std::string_view text,
                                 Diagnostics& diagnostics) {
  const auto on = on_or_off(text);
  if (!on)
    diagnostics.report(codes::kBadSetting, Place(),
                       fmt::format("{} does not take \"{}\"", option, printable(text, 100)),
                       fmt::format("write {} on or {} off", option, option));
  return on;
}

bool apply(TaggedSkeleton& skeleton, const Settings& settings, Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.errors();
  const Groups tree(skeleton);
  std::set<std::string> groups;
  for (const TaggedJoint& joint : skeleton.joints)
    if (!joint.ids.local.empty()) groups.insert(joint.ids.local);
  for (const Settings::Feature& setting : settings.features)
    check_feature(skeleton, tree, setting, diagnostics);
  for (const auto& [group, on] : settings.groups)
    if (!groups.contains(group))
      diagnostics.report(codes::kUnknownGroup, Place(),
                         fmt::format("there is no group \"{}\"", printable(group, 60)),
                         suggest(group, sorted(groups)));
  if (diagnostics.errors() != errors_before) return false;

  std::set<std::string> off;
  for (const auto& [group, on] : settings.groups) {
    if (on)
      off.erase(group);
    else
      off.insert(group);
  }
  for (TaggedJoint& joint : skeleton.joints) {
    apply_to(joint, tree, settings.features);
    if (off.contains(joint.ids.local))
      for (CommandTag& command : joint.commands) command.on = false;
  }
  return true;
}

void set_global(TaggedSkeleton& skeleton, const std::string& global) {
  for (TaggedJoint& joint : skeleton.joints)
    if (joint.ids.global == skeleton.global) joint.ids.global = global;
  skeleton.global = global;
}

}  // namespace rigc::tags
