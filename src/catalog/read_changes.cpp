// SPDX-License-Identifier: MIT
// Reads `changes:` of a descriptor. Test: tests/catalog/changes_test.cpp
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/text.h"
#include "catalog/changes.h"
#include "catalog/codes.h"
#include "catalog/format.h"
#include "catalog/reader.h"

namespace rigc::catalog {
namespace {

bool has_numbers(ParameterType type) {
  switch (type) {
    case ParameterType::number:
    case ParameterType::numbers:
    case ParameterType::integer:
    case ParameterType::angle:
    case ParameterType::length:
    case ParameterType::vec3:
    case ParameterType::expression:
    case ParameterType::value:
      return true;
    default:
      return false;
  }
}

class ChangeReader {
 public:
  ChangeReader(const yaml::Node& root, const yaml::Node& item, const Descriptor& descriptor,
               Diagnostics& diagnostics)
      : root_(root), item_(item), descriptor_(descriptor), diagnostics_(diagnostics) {}

  Change read() {
    read_version();
    change_.note = text_of(item_, "note", diagnostics_);
    change_.was = name("was");
    read_subject();
    read_numbers();
    return std::move(change_);
  }
  /// Its earlier default, once the other changes of the parameter are known.
  void check_default(const Change& change) const;

 private:
  std::string name(std::string_view key) {
    const yaml::Node* node = item_.find(key);
    return node ? yaml::as_name(*node, key, diagnostics_).value_or("") : "";
  }
  void bad(std::string_view key, std::string message, std::string hint = {}) {
    diagnostics_.report(codes::kBadChange, item_.find(key)->span, std::move(message),
                        std::move(hint));
  }
  void read_version();
  void read_subject();
  void read_numbers();
  /// Whether the file declares a parameter, be the declaration good or bad.
  bool declares(const std::string& parameter) const;

  const yaml::Node& root_;
  const yaml::Node& item_;
  const Descriptor& descriptor_;
  Diagnostics& diagnostics_;
  Change change_;
};

void ChangeReader::read_version() {
  const yaml::Node* version = need(item_, "version", "change", diagnostics_);
  const auto number = version ? yaml::as_integer(*version, "version", diagnostics_) : std::nullopt;
  if (number && (*number < 2 || *number > descriptor_.version))
    bad("version", fmt::format("version {} is not in 2..{}", *number, descriptor_.version));
  else if (number)
    change_.version = static_cast<int>(*number);
}

bool ChangeReader::declares(const std::string& parameter) const {
  const yaml::Node* items = root_.find("parameters");
  if (!items || !items->is_sequence()) return false;
  return std::any_of(items->items.begin(), items->items.end(), [&](const yaml::Node& item) {
    const yaml::Node* declared = item.is_map() ? item.find("name") : nullptr;
    return declared && declared->text == parameter;
  });
}

void ChangeReader::read_subject() {
  change_.parameter = name("parameter");
  change_.attribute = name("attribute");
  if (!change_.parameter.empty() && !declares(change_.parameter))
    bad("parameter", fmt::format("there is no parameter {}", change_.parameter),
        "give the name that the parameter has now");
  if (item_.find("parameter") && item_.find("attribute"))
    bad("attribute", "one change is of a parameter or of an attribute", "write two entries");
  const bool nothing = !item_.find("parameter") && !item_.find("attribute");
  for (const char* key : {"was", "factor", "offset", "default_was", "min_was", "max_was"})
    if (nothing && item_.find(key))
      bad(key, fmt::format("`{}` of what?", key), "name the `parameter` or the `attribute`");
  for (const char* key : {"default_was", "min_was", "max_was"})
    if (item_.find("attribute") && item_.find(key))
      bad(key, fmt::format("`{}` is for parameters", key),
          "keys on an attribute have no default, and keep what they are beyond a range");
  const std::string& now = change_.parameter.empty() ? change_.attribute : change_.parameter;
  if (!change_.was.empty() && change_.was == now) bad("was", "this is the name that it has now");
}

void ChangeReader::read_numbers() {
  const auto number = [&](std::string_view key) -> std::optional<double> {
    const yaml::Node* node = item_.find(key);
    return node ? yaml::as_number(*node, key, diagnostics_) : std::nullopt;
  };
  change_.factor = number("factor").value_or(1);
  change_.offset = number("offset").value_or(0);
  change_.min_was = number("min_was");
  change_.max_was = number("max_was");
  if (const yaml::Node* before = item_.find("default_was"))
    change_.default_was = literal_from(*before, diagnostics_);
  const auto wrong = [&](std::string_view key, std::string message) {
    diagnostics_.report(codes::kBadConversion, item_.find(key)->span, std::move(message));
  };
  if (change_.factor == 0) wrong("factor", "a factor of 0 leaves nothing of a value");
  if (change_.min_was && change_.max_was && *change_.min_was > *change_.max_was)
    wrong("min_was", "min_was is above max_was");
  const Parameter* parameter = descriptor_.find(change_.parameter);
  if (!parameter) return;
  for (const char* key : {"factor", "offset"})
    if (item_.find(key) && !has_numbers(parameter->type))
      wrong(key, fmt::format("{} takes no numbers", parameter->name));
  for (const char* key : {"min_was", "max_was"})
    if (item_.find(key) && !(std::string_view(key) == "min_was" ? parameter->min : parameter->max))
      wrong(key, fmt::format("{} has no `{}` now", parameter->name, std::string(key).substr(0, 3)));
}

void ChangeReader::check_default(const Change& change) const {
  const Parameter* parameter = descriptor_.find(change.parameter);
  if (!parameter || !change.default_was) return;
  Literal value = *change.default_was;
  convert(descriptor_, *parameter, change.version - 1, value);
  if (const auto found = mismatch(*parameter, value))
    diagnostics_.report(codes::kBadDefault, item_.find("default_was")->span,
                        "earlier default of " + found->message, found->hint);
}

/// Reports two parameters, or two attributes, of one name in one version.
void check_names(const Descriptor& descriptor, const std::vector<const yaml::Node*>& items,
                 std::string Change::*what, Diagnostics& diagnostics) {
  std::set<std::pair<int, std::string>> taken;
  for (std::size_t i = 0; i < descriptor.changes.size(); ++i) {
    const Change& change = descriptor.changes[i];
    if (change.was.empty() || (change.*what).empty()) continue;
    if (!taken.insert({change.version, change.was}).second)
      diagnostics.report(
          codes::kSameEarlierName, items[i]->find("was")->span,
          fmt::format("{} was the name of another until version {}", change.was, change.version));
  }
}

}  // namespace

void read_changes(const yaml::Node& map, Descriptor& descriptor, Diagnostics& diagnostics) {
  std::vector<const yaml::Node*> items;
  for (const yaml::Node& item : list_of(map, "changes", diagnostics)) {
    yaml::check_section(item, change_format(), diagnostics);
    if (!item.is_map()) continue;
    descriptor.changes.push_back(ChangeReader(map, item, descriptor, diagnostics).read());
    items.push_back(&item);
  }
  for (std::size_t i = 0; i < items.size(); ++i)
    ChangeReader(map, *items[i], descriptor, diagnostics).check_default(descriptor.changes[i]);
  check_names(descriptor, items, &Change::parameter, diagnostics);
  check_names(descriptor, items, &Change::attribute, diagnostics);
}

}  // namespace rigc::catalog
