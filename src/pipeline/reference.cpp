// SPDX-License-Identifier: MIT
// The reference of modules, for the terminal and for docs/modules.md. Test:
// tests/cli/cli_test.cpp
#include "pipeline/reference.h"

#include <fmt/format.h>

#include "base/text.h"
#include "catalog/catalogue.h"
#include "catalog/changes.h"
#include "pipeline/codes.h"

namespace rigc::pipeline {
namespace {

using catalog::Catalogue;
using catalog::Descriptor;
using catalog::Parameter;
using catalog::ParameterType;

std::string literal_text(const Literal& literal) {
  if (literal.kind == Literal::Kind::text) return literal.text;
  if (literal.kind == Literal::Kind::boolean) return literal.flag ? "on" : "off";
  json::Writer w;
  write(w, literal);
  return w.take();
}

std::string explain(const Descriptor& d) {
  std::string out = fmt::format("{} (version {}, {}, stage {})\n{}\n", d.module, d.version,
                                d.category, catalog::name_of(d.stage), d.summary);
  if (!d.help.empty()) out += "\n" + d.help + (ends_with(d.help, "\n") ? "" : "\n");
  std::string frame;
  for (const Parameter& parameter : d.parameters) {
    if (parameter.frame != frame) out += fmt::format("\n{}\n", frame = parameter.frame);
    const std::string value = default_text(parameter);
    out += fmt::format("  {}  ({}{}{})\n      {}\n", parameter.name, type_text(parameter),
                       value.empty() ? "" : "; ",
                       parameter.required || value.empty() ? value : "default " + value,
                       parameter.help);
  }
  if (d.makes_nodes()) out += "\nMakes (and takes name, local, label for what it makes)\n";
  for (const catalog::Creates& made : d.creates) {
    out += fmt::format("  {}  ({}, per {})\n      {}\n", made.role, made.kind, made.per, made.help);
  }
  if (!d.changes.empty())
    out += "\nChanges (templates that pin an earlier version keep what it had)\n";
  for (const catalog::Change& change : d.changes)
    out += fmt::format("  {}\n", printable(catalog::describe(change), 300));
  if (!d.example.empty()) out += "\nExample\n\n" + d.example;
  return out;
}

void write_change(json::Writer& w, const catalog::Change& change) {
  w.begin_object().member("version", change.version);
  for (const auto& [key, text] : {std::pair("parameter", &change.parameter),
                                  {"attribute", &change.attribute},
                                  {"was", &change.was},
                                  {"note", &change.note}})
    if (!text->empty()) w.member(key, *text);
  if (change.factor != 1) w.member("factor", change.factor);
  if (change.offset != 0) w.member("offset", change.offset);
  if (change.default_was) {
    w.key("default_was");
    write(w, *change.default_was);
  }
  if (change.min_was) w.member("min_was", *change.min_was);
  if (change.max_was) w.member("max_was", *change.max_was);
  w.end_object();
}

void write_descriptor(json::Writer& w, const Descriptor& d) {
  w.begin_object().member("module", d.module).member("version", d.version).member("title", d.title);
  w.member("category", d.category)
      .member("stage", catalog::name_of(d.stage))
      .member("summary", d.summary);
  w.member("help", d.help).key("parameters").begin_array();
  for (const Parameter& parameter : d.parameters) {
    w.begin_object()
        .member("name", parameter.name)
        .member("type", catalog::name_of(parameter.type));
    w.member("frame", parameter.frame)
        .member("help", parameter.help)
        .member("required", parameter.required);
    if (!parameter.kind.empty()) w.member("kind", parameter.kind);
    if (!parameter.unit.empty()) w.member("unit", parameter.unit);
    if (parameter.min) w.member("min", *parameter.min);
    if (parameter.max) w.member("max", *parameter.max);
    if (!parameter.values.empty()) {
      w.key("values").begin_array();
      for (const std::string& value : parameter.values) w.value(value);
      w.end_array();
    }
    if (parameter.default_value) {
      w.key("default");
      write(w, *parameter.default_value);
    }
    w.end_object();
  }
  w.end_array().key("creates").begin_array();
  for (const catalog::Creates& made : d.creates) {
    w.begin_object().member("role", made.role).member("kind", made.kind).member("per", made.per);
    w.member("help", made.help).end_object();
  }
  w.end_array().key("changes").begin_array();
  for (const catalog::Change& change : d.changes) write_change(w, change);
  w.end_array().member("example", d.example).end_object();
}

const Descriptor* find_module(const std::string& name, const Catalogue& catalogue,
                              Diagnostics& diagnostics) {
  const Descriptor* found = catalogue.find(name);
  if (!found) {
    diagnostics.report(codes::kNoSuchModule, Place(),
                       fmt::format("there is no module \"{}\"", printable(name)),
                       suggest(name, catalogue.modules()));
  }
  return found;
}

}  // namespace

std::string type_text(const Parameter& parameter) {
  std::string text(catalog::name_of(parameter.type));
  if (!parameter.values.empty()) text += ": " + join(parameter.values, ", ");
  if (!parameter.kind.empty()) text += " (" + parameter.kind + ")";
  if (parameter.min || parameter.max) {
    text += fmt::format(" {}..{}", parameter.min ? number_text(*parameter.min) : "",
                        parameter.max ? number_text(*parameter.max) : "");
  }
  if (!parameter.unit.empty()) text += ", " + parameter.unit;
  return text;
}

std::string default_text(const Parameter& parameter) {
  if (parameter.required) return "required";
  return parameter.default_value ? literal_text(*parameter.default_value) : "";
}

std::optional<std::string> modules(const std::string& name, const Paths& paths, bool as_json,
                                   Diagnostics& diagnostics) {
  Catalogue catalogue;
  if (!add_modules(paths, catalogue, diagnostics)) return std::nullopt;
  if (!name.empty()) {
    const Descriptor* found = find_module(name, catalogue, diagnostics);
    if (!found) return std::nullopt;
    if (!as_json) return explain(*found);
    json::Writer w(2);
    write_descriptor(w, *found);
    return w.take() + "\n";
  }
  json::Writer w(2);
  std::string text;
  w.begin_array();
  for (const std::string& module : catalogue.modules()) {
    const Descriptor* found = catalogue.find(module);
    write_descriptor(w, *found);
    text += fmt::format("{:<18} {:<12} {}\n", module, found->category, found->summary);
  }
  w.end_array();
  return as_json ? w.take() + "\n" : text + "`rigc modules NAME` explains one, with an example.\n";
}

std::string module_reference() {
  const Catalogue catalogue;
  std::string out =
      "# Modules\n\nMade from the descriptors in `modules.d/` by `rigc docs`. Every command that "
      "makes nodes also takes "
      "`name`, `local` and `label` for what it makes (default: its joint's).\n";
  for (const std::string& name : catalogue.modules()) {
    const Descriptor* d = catalogue.find(name);
    out += fmt::format("\n## {}\n\n{} Version {}, stage `{}`, category {}.\n", name, d->summary,
                       d->version, catalog::name_of(d->stage), d->category);
    if (!d->help.empty()) out += fmt::format("\n{}\n", trim(d->help));
    if (!d->parameters.empty())
      out += "\n| parameter | type | default | what it does |\n| --- | --- | --- | --- |\n";
    for (const Parameter& parameter : d->parameters) {
      out += fmt::format("| `{}` | {} | {} | {} |\n", parameter.name, type_text(parameter),
                         default_text(parameter), parameter.help);
    }
    if (d->makes_nodes()) out += "\n| makes | kind | per | |\n| --- | --- | --- | --- |\n";
    for (const catalog::Creates& made : d->creates) {
      out += fmt::format("| `{}` | {} | {} | {} |\n", made.role, made.kind, made.per, made.help);
    }
    for (const catalog::Change& change : d->changes)
      out += fmt::format("\n- Changed in {}.\n", catalog::describe(change));
    if (!d->example.empty()) out += fmt::format("\n```yaml\n{}```\n", d->example);
  }
  return out;
}

}  // namespace rigc::pipeline
