// SPDX-License-Identifier: MIT
// Arguments against declarations. Descriptors check types and ranges (catalog::mismatch); here come
// names, selectors, versions and parameters. Test: tests/templates/arguments_test.cpp
#include "templates/arguments.h"

#include <fmt/format.h>

#include "base/text.h"
#include "catalog/changes.h"
#include "selector/selector.h"
#include "templates/codes.h"

namespace rigc::templates {
namespace {

using catalog::Parameter;
using catalog::ParameterType;

std::vector<std::string> parameter_names(const catalog::Descriptor& descriptor) {
  std::vector<std::string> names;
  for (const Parameter& parameter : descriptor.parameters) names.push_back(parameter.name);
  if (descriptor.makes_nodes())
    for (const Parameter& parameter : catalog::creation_parameters())
      names.push_back(parameter.name);
  return names;
}

bool contains_parameter(const Literal& value) {
  if (!parameter_name(value).empty()) return true;
  for (const Literal& item : value.items)
    if (contains_parameter(item)) return true;
  for (const auto& entry : value.entries)
    if (contains_parameter(entry.second)) return true;
  return false;
}

bool check_selector(const Parameter& parameter, const Literal& value, Diagnostics& diagnostics) {
  const auto selector = selector::parse(value.text, value.span, diagnostics);
  if (!selector) return false;
  const bool plug = parameter.type == ParameterType::plug || parameter.type == ParameterType::plugs;
  bool ok = true;
  for (const selector::Choice& choice : selector->choices) {
    if (plug && choice.attribute.empty()) {
      diagnostics.report(codes::kPlugNeedsAttribute, choice.span,
                         fmt::format("{} takes an attribute, not a node", parameter.name),
                         fmt::format("add @ and the attribute's name: {}@translate.x",
                                     printable(trim(value.text), 60)));
      ok = false;
    } else if (!plug && !choice.attribute.empty()) {
      diagnostics.report(codes::kNodeWithAttribute, choice.span,
                         fmt::format("{} takes a node, not an attribute", parameter.name),
                         fmt::format("remove @{}", choice.attribute));
      ok = false;
    }
  }
  return ok;
}

bool check_argument(const catalog::Descriptor& descriptor, const Template& owner, int pinned,
                    tags::Argument& argument, Diagnostics& diagnostics) {
  const Parameter* parameter = declaration(descriptor, argument.name);
  if (!parameter) {
    diagnostics.report(
        codes::kUnknownArgument, argument.span,
        fmt::format("{} has no parameter \"{}\"", descriptor.module, printable(argument.name, 60)),
        suggest(argument.name, parameter_names(descriptor)));
    return false;
  }
  if (contains_parameter(argument.value)) return check_declared(argument.value, owner, diagnostics);
  to_metres(*parameter, owner.metres_per_unit, argument.value);
  convert_value(descriptor, *parameter, pinned, argument.value, diagnostics);
  return check_value(*parameter, argument.value, diagnostics);
}

/// Arguments get the names that parameters have now.
void rename_arguments(const catalog::Descriptor& descriptor, int version, tags::CommandTag& command,
                      Diagnostics& diagnostics) {
  if (version >= descriptor.version) return;
  for (std::size_t i = 0; i < command.with.size(); ++i) {
    tags::Argument& argument = command.with[i];
    const Parameter* parameter = catalog::parameter_at(descriptor, version, argument.name);
    if (parameter) argument.name = parameter->name;
    for (std::size_t j = 0; parameter && j < i; ++j)
      if (command.with[j].name == argument.name)
        diagnostics.report(codes::kArgumentTwice, argument.span,
                           fmt::format("{} is given by two names", argument.name),
                           "remove one of them");
  }
}

void move_to(const Span& span, Literal& value) {
  value.span = span;
  for (Literal& item : value.items) move_to(span, item);
  for (auto& entry : value.entries) move_to(span, entry.second);
}

int compare(const Literal& a, const Literal& b) {
  if (a.kind == Literal::Kind::number && b.kind == Literal::Kind::number)
    return a.number < b.number ? -1 : a.number > b.number ? 1 : 0;
  return a == b ? 0 : 1;
}

}  // namespace

bool is_selector(ParameterType type) {
  return type == ParameterType::node || type == ParameterType::nodes ||
         type == ParameterType::plug || type == ParameterType::plugs;
}

std::string_view parameter_name(const Literal& value) {
  if (value.kind != Literal::Kind::text || value.text.size() < 2 || value.text[0] != '$') return {};
  const std::string_view name = std::string_view(value.text).substr(1);
  return is_name(name) ? name : std::string_view();
}

bool check_declared(const Literal& value, const Template& owner, Diagnostics& diagnostics) {
  bool ok = true;
  const std::string_view name = parameter_name(value);
  if (!name.empty() && !owner.find_parameter(name)) {
    std::vector<std::string> declared;
    for (const Parameter& parameter : owner.parameters) declared.push_back(parameter.name);
    diagnostics.report(codes::kUnknownParameter, value.span,
                       fmt::format("the template has no parameter \"{}\"", name),
                       suggest(name, declared));
    ok = false;
  }
  for (const Literal& item : value.items) ok &= check_declared(item, owner, diagnostics);
  for (const auto& entry : value.entries) ok &= check_declared(entry.second, owner, diagnostics);
  return ok;
}

bool substitute(Literal& value, const Environment& environment) {
  bool changed = false;
  if (const std::string_view name = parameter_name(value); !name.empty()) {
    const auto found = environment.find(name);
    if (found == environment.end()) return false;
    const Span span = value.span;
    value = found->second;
    value.span = span;
    return true;
  }
  for (Literal& item : value.items) changed |= substitute(item, environment);
  for (auto& entry : value.entries) changed |= substitute(entry.second, environment);
  return changed;
}

const Parameter* declaration(const catalog::Descriptor& descriptor, std::string_view argument) {
  if (const Parameter* parameter = descriptor.find(argument)) return parameter;
  if (descriptor.makes_nodes())
    for (const Parameter& parameter : catalog::creation_parameters())
      if (parameter.name == argument) return &parameter;
  return nullptr;
}

int pinned_version(const Template& owner, const catalog::Descriptor& descriptor) {
  for (const auto& [module, version] : owner.module_pins)
    if (module == descriptor.module) return version;
  return descriptor.version;
}

void check_arguments(const catalog::Descriptor& descriptor, const Template& owner,
                     tags::CommandTag& command, Diagnostics& diagnostics) {
  const int pinned = pinned_version(owner, descriptor);
  rename_arguments(descriptor, pinned, command, diagnostics);
  for (tags::Argument& argument : command.with)
    check_argument(descriptor, owner, pinned, argument, diagnostics);
  for (const Parameter& parameter : descriptor.parameters) {
    if (!parameter.required || command.find(parameter.name)) continue;
    if (catalog::default_at(descriptor, parameter, pinned)) continue;
    diagnostics.report(
        codes::kMissingArgument, command.span,
        fmt::format("{} needs the parameter \"{}\"", descriptor.module, parameter.name),
        parameter.help);
  }
}

void convert_value(const catalog::Descriptor& descriptor, const Parameter& parameter, int version,
                   Literal& value, Diagnostics& diagnostics) {
  if (version >= descriptor.version) return;
  if (!catalog::convert(descriptor, parameter, version, value)) return;
  diagnostics.report(codes::kClamped, value.span,
                     fmt::format("{}: version {} of {} allowed this value, version {} does not",
                                 parameter.name, version, descriptor.module, descriptor.version),
                     fmt::format("{} is used", value.kind == Literal::Kind::number
                                                   ? value.text
                                                   : "the nearest end of the range"));
}

void add_earlier_defaults(const catalog::Descriptor& descriptor, int version,
                          tags::CommandTag& command) {
  if (version >= descriptor.version) return;
  for (const Parameter& parameter : descriptor.parameters) {
    if (command.find(parameter.name)) continue;
    auto value = catalog::default_at(descriptor, parameter, version);
    if (!value) continue;
    move_to(command.span, *value);
    command.with.push_back({parameter.name, command.span, std::move(*value)});
  }
}

bool upgrade(const catalog::Descriptor& descriptor, int version, tags::CommandTag& command,
             Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.errors();
  rename_arguments(descriptor, version, command, diagnostics);
  std::erase_if(command.with, [&](const tags::Argument& argument) {
    if (declaration(descriptor, argument.name)) return false;
    diagnostics.report(codes::kArgumentGone, argument.span,
                       fmt::format("{} has no parameter \"{}\" any more", descriptor.module,
                                   printable(argument.name, 60)));
    return true;
  });
  for (tags::Argument& argument : command.with) {
    const Parameter& parameter = *declaration(descriptor, argument.name);
    convert_value(descriptor, parameter, version, argument.value, diagnostics);
    check_value(parameter, argument.value, diagnostics);
  }
  add_earlier_defaults(descriptor, version, command);
  return diagnostics.errors() == errors;
}

bool check_value(const Parameter& parameter, const Literal& value, Diagnostics& diagnostics) {
  const bool is_text = value.kind == Literal::Kind::text;
  if (is_selector(parameter.type) && is_text) return check_selector(parameter, value, diagnostics);
  if (parameter.type == ParameterType::expression && is_text)
    return selector::parse_expression(value.text, value.span, diagnostics).has_value();
  if (const auto mismatch = catalog::mismatch(parameter, value)) {
    diagnostics.report(codes::kArgumentValue, mismatch->span, mismatch->message, mismatch->hint);
    return false;
  }
  bool ok = true;
  if (is_selector(parameter.type))
    for (const Literal& item : value.items) ok &= check_selector(parameter, item, diagnostics);
  const bool names_identifier = parameter.name == "local" || parameter.name == "label";
  if (names_identifier && parameter.type == ParameterType::text && !is_name(value.text)) {
    diagnostics.report(
        codes::kArgumentValue, value.span,
        fmt::format("{}: \"{}\" is not a name", parameter.name, printable(value.text, 60)),
        "names have letters, digits, `_` and `-`, and do not start with a digit or `-`");
    return false;
  }
  return ok;
}

void to_metres(const Parameter& parameter, double metres_per_unit, Literal& value) {
  const bool length = parameter.type == ParameterType::length ||
                      (parameter.type == ParameterType::vec3 && parameter.unit == "metre");
  if (!length || metres_per_unit == 1) return;
  if (value.kind == Literal::Kind::number) {
    value.number *= metres_per_unit;
    value.text = number_text(value.number);
  }
  for (Literal& item : value.items) {
    if (item.kind != Literal::Kind::number) continue;
    item.number *= metres_per_unit;
    item.text = number_text(item.number);
  }
}

bool holds(const Condition& condition, const Environment& environment) {
  const auto found = environment.find(condition.parameter);
  if (found == environment.end()) return false;
  const Literal& value = found->second;
  using Operator = Condition::Operator;
  const bool truth = value.kind == Literal::Kind::boolean  ? value.flag
                     : value.kind == Literal::Kind::number ? value.number != 0
                                                           : !value.text.empty();
  switch (condition.op) {
    case Operator::is_true:
      return truth;
    case Operator::is_false:
      return !truth;
    case Operator::equal:
      return compare(value, condition.value) == 0;
    case Operator::not_equal:
      return compare(value, condition.value) != 0;
    case Operator::less:
      return compare(value, condition.value) < 0;
    case Operator::less_equal:
      return compare(value, condition.value) <= 0;
    case Operator::greater:
      return compare(value, condition.value) > 0;
    case Operator::greater_equal:
      return compare(value, condition.value) >= 0;
  }
  return false;
}

}  // namespace rigc::templates
