// SPDX-License-Identifier: MIT
// Follows the changes of a module from one of its versions to the present one.
// Test: tests/catalog/changes_test.cpp
#include "catalog/changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"

namespace rigc::catalog {
namespace {

using Member = std::string Change::*;

/// The changes of one parameter or attribute since a version, earliest first.
std::vector<const Change*> changes_since(const Descriptor& descriptor, Member what,
                                         std::string_view name, int version) {
  std::vector<const Change*> found;
  for (const Change& change : descriptor.changes)
    if (change.version > version && change.*what == name) found.push_back(&change);
  std::stable_sort(found.begin(), found.end(),
                   [](const Change* a, const Change* b) { return a->version < b->version; });
  return found;
}

/// The change since which it has another name; null: it is called what it is called now.
const Change* renaming(const std::vector<const Change*>& changes) {
  const auto found = std::find_if(changes.begin(), changes.end(),
                                  [](const Change* change) { return !change->was.empty(); });
  return found == changes.end() ? nullptr : *found;
}

template <class Conversion>
void each_number(Literal& value, Conversion& conversion) {
  if (value.kind == Literal::Kind::number) {
    value.number = conversion(value.number);
    value.text = number_text(value.number);
  }
  for (Literal& item : value.items) each_number(item, conversion);
}

void convert_expression(const Change& change, std::string& text) {
  if (change.factor != 1) text = fmt::format("({}) * {}", text, number_text(change.factor));
  if (change.offset != 0) text = fmt::format("({}) + {}", text, number_text(change.offset));
}

/// Counts that were converted by a factor may be off by what doubles cannot hold.
double nearest_whole(double value) {
  const double whole = std::round(value);
  return std::abs(value - whole) <= 1e-9 * std::max(1.0, std::abs(value)) ? whole : value;
}

/// Carries one number through the changes.
class NumberConversion {
 public:
  NumberConversion(const Parameter& parameter, const std::vector<const Change*>& changes)
      : parameter_(parameter), changes_(changes) {}

  double operator()(double value) {
    bool below = false, above = false;  // of today's range, as far as a change allows that
    bool allowed = true;
    for (const Change* change : changes_) {
      below = below || change->min_was;
      above = above || change->max_was;
      allowed = allowed && !(change->min_was && value < *change->min_was) &&
                !(change->max_was && value > *change->max_was);
      value = value * change->factor + change->offset;
    }
    if (!changes_.empty() && parameter_.type == ParameterType::integer)
      value = nearest_whole(value);
    if (!allowed) return value;
    if (below && parameter_.min && value < *parameter_.min) return clamp_to(*parameter_.min);
    if (above && parameter_.max && value > *parameter_.max) return clamp_to(*parameter_.max);
    return value;
  }
  bool clamped() const { return clamped_; }

 private:
  double clamp_to(double bound) {
    clamped_ = true;
    return bound;
  }

  const Parameter& parameter_;
  const std::vector<const Change*>& changes_;
  bool clamped_ = false;
};

}  // namespace

const Parameter* parameter_at(const Descriptor& descriptor, int version, std::string_view name) {
  const Parameter* found = nullptr;
  int until = 0;  // of two that have had the name one after the other, the first
  for (const Parameter& parameter : descriptor.parameters) {
    const Change* renamed =
        renaming(changes_since(descriptor, &Change::parameter, parameter.name, version));
    if (!renamed || renamed->was != name || (found && renamed->version >= until)) continue;
    found = &parameter;
    until = renamed->version;
  }
  return found ? found : descriptor.find(name);
}

bool convert(const Descriptor& descriptor, const Parameter& parameter, int version,
             Literal& value) {
  const auto changes = changes_since(descriptor, &Change::parameter, parameter.name, version);
  if (parameter.type == ParameterType::expression && value.kind == Literal::Kind::text) {
    for (const Change* change : changes) convert_expression(*change, value.text);
    return false;
  }
  NumberConversion conversion(parameter, changes);
  const bool converts = std::any_of(changes.begin(), changes.end(), [](const Change* change) {
    return change->factor != 1 || change->offset != 0 || change->min_was || change->max_was;
  });
  if (converts) each_number(value, conversion);
  return conversion.clamped();
}

std::optional<Literal> default_at(const Descriptor& descriptor, const Parameter& parameter,
                                  int version) {
  for (const Change* change :
       changes_since(descriptor, &Change::parameter, parameter.name, version)) {
    if (!change->default_was) continue;
    Literal value = *change->default_was;
    convert(descriptor, parameter, change->version - 1, value);
    return value;
  }
  return std::nullopt;
}

std::vector<AttributeChange> attribute_changes(const Descriptor& descriptor, int version) {
  std::vector<std::string_view> names;
  for (const Change& change : descriptor.changes)
    if (!change.attribute.empty() &&
        std::find(names.begin(), names.end(), change.attribute) == names.end())
      names.push_back(change.attribute);
  std::vector<AttributeChange> found;
  for (const std::string_view name : names) {
    const auto changes = changes_since(descriptor, &Change::attribute, name, version);
    const Change* renamed = renaming(changes);
    AttributeChange all{renamed ? renamed->was : std::string(name), std::string(name), 1, 0};
    for (const Change* change : changes) {
      all.factor *= change->factor;
      all.offset = all.offset * change->factor + change->offset;
    }
    if (all.was != name || all.factor != 1 || all.offset != 0) found.push_back(std::move(all));
  }
  return found;
}

std::optional<std::string> replaced_role(const Descriptor& descriptor, std::string_view module,
                                         std::string_view role) {
  for (const auto& [earlier, roles] : descriptor.replaces)
    for (const auto& [before, after] : roles)
      if (earlier == module && before == role) return after;
  return std::nullopt;
}

std::vector<AttributeValue> values_as(const Descriptor& descriptor, std::string_view module) {
  std::vector<AttributeValue> found;
  for (const auto& [earlier, roles] : descriptor.replaces) {
    if (earlier != module) continue;
    for (const auto& [key, text] : roles) {
      const std::size_t dot = key.find('.');
      const auto number = parse_number(text);
      if (dot != std::string::npos && number)
        found.push_back({key.substr(0, dot), key.substr(dot + 1), *number});
    }
  }
  return found;
}

std::string describe(const Change& change) {
  const std::string& name = change.attribute.empty() ? change.parameter : change.attribute;
  std::vector<std::string> facts;
  if (!change.was.empty()) facts.push_back("was called " + change.was);
  if (change.factor != 1) facts.push_back("values times " + number_text(change.factor));
  if (change.offset != 0) facts.push_back("values plus " + number_text(change.offset));
  if (change.default_was) {
    json::Writer writer;
    write(writer, *change.default_was);
    facts.push_back("had the default " + writer.take());
  }
  if (change.min_was) facts.push_back("went down to " + number_text(*change.min_was));
  if (change.max_was) facts.push_back("went up to " + number_text(*change.max_was));
  if (!change.note.empty()) facts.push_back(change.note);
  return fmt::format("version {}: {}{}{}{}", change.version,
                     change.attribute.empty() ? "" : "attribute ", name, name.empty() ? "" : " ",
                     join(facts, ", "));
}

}  // namespace rigc::catalog
