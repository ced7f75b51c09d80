// SPDX-License-Identifier: MIT
// JSON Schema of the tables of keys: sections, keys, forms. Test: tests/pipeline/schema_test.cpp
#include "pipeline/schema_format.h"

#include <fmt/format.h>

#include "base/text.h"
#include "catalog/format.h"
#include "pipeline/schema_values.h"
#include "templates/format.h"

namespace rigc::pipeline {

using yaml::Form;
using yaml::Key;
using yaml::Section;

namespace {

constexpr const char* kNameMessage =
    "a name has letters, digits, `_` and `-` and does not start with a digit or `-`";
constexpr std::string_view kUidPattern = "[0-9a-fA-F]{16}";
constexpr const char* kUidMessage = "16 hexadecimal digits are needed";
constexpr const char* kConditionPattern =
    R"(\s*(not\s+$|$(\s+(==|!=)\s+\S+|\s+(<|<=|>|>=)\s+[-+.0-9eE]+)?)\s*)";

std::string condition_pattern() {
  std::string pattern = kConditionPattern;
  for (std::size_t at = 0; (at = pattern.find('$', at)) != std::string::npos;
       at += kPlaceholderPattern.size())
    pattern.replace(at, 1, kPlaceholderPattern);
  return pattern;
}

void write_words(json::Writer& w, const std::vector<std::string>& words) {
  w.key("enum").begin_array();
  for (const std::string& word : words) {
    if (const auto number = parse_number(word))
      w.value(*number);
    else
      w.value(word);
  }
  w.end_array();
}

void write_limits(json::Writer& w, const yaml::Rule& rule) {
  if (rule.min) w.member("minimum", *rule.min);
  if (rule.max) w.member("maximum", *rule.max);
  if (rule.above) w.member("exclusiveMinimum", *rule.above);
}

/// One text of a pattern, or a list of such.
void write_one_or_list(json::Writer& w, std::string_view pattern, const char* message) {
  write_types(w, {"string", "array"});
  write_pattern(w, pattern, message);
  w.key("items").begin_object();
  write_types(w, {"string"});
  write_pattern(w, pattern, message);
  w.end_object();
}

void write_point(json::Writer& w) {
  write_types(w, {"array"});
  w.key("items").begin_object();
  write_types(w, {"number"});
  w.member("minimum", -1000).member("maximum", 1000).end_object();
  w.member("minItems", 2).member("maxItems", 3);
}

void write_lines(json::Writer& w) {
  write_types(w, {"array"});
  w.key("items").begin_object();
  write_types(w, {"array"});
  w.member("minItems", 2).key("items").begin_object();
  write_point(w);
  w.end_object().end_object();
}

/// Texts need no quotes where YAML reads them as numbers.
void write_texts(json::Writer& w) {
  write_types(w, {"string", "number", "array"});
  w.key("items").begin_object();
  write_types(w, {"string", "number"});
  w.end_object();
}

}  // namespace

template <class Members>
void FormatSchema::object(const char* name, Members members) {
  w_.key(name).begin_object();
  members();
  w_.end_object();
}

std::string FormatSchema::write(const Section& root, const std::string& title,
                                const std::string& description) {
  w_.begin_object()
      .member("$schema", "http://json-schema.org/draft-07/schema#")
      .member("title", title);
  write_description(w_, description);
  section(root);
  definitions();
  w_.end_object();
  return w_.take() + "\n";
}

void FormatSchema::definitions() {
  object("definitions", [&] {
    while (!open_.empty()) {
      const Section* next = open_.back();
      open_.pop_back();
      object(next->name.c_str(), [&] { section(*next); });
    }
    if (!uses_modules_) return;
    for (const std::string& name : catalogue_.modules()) {
      w_.key("with_" + name);
      write_arguments(w_, *catalogue_.find(name));
    }
  });
}

void FormatSchema::section(const Section& section) {
  write_types(w_, {"object"});
  w_.member("additionalProperties", false);
  object("properties", [&] {
    for (const Key& each : section.keys) object(each.name.c_str(), [&] { key(each); });
  });
  w_.key("required").begin_array();
  for (const Key& each : section.keys)
    if (each.rule.required) w_.value(each.name);
  w_.end_array();
  restrictions(section);
}

/// Of the keys in `needs_one` at least one is there and not empty.
void FormatSchema::needs_one(const Section& section) {
  w_.key("anyOf").begin_array();
  for (const std::string& name : section.needs_one) {
    w_.begin_object().key("required").begin_array().value(name).end_array();
    object("properties", [&] {
      object(name.c_str(), [&] {
        write_types(w_, {"array"});
        w_.member("minItems", 1);
      });
    });
    w_.end_object();
  }
  w_.end_array();
}

void FormatSchema::excludes(const std::string& a, const std::string& b) {
  w_.begin_object().member("errorMessage", fmt::format("`{}` and `{}`: keep one of them", a, b));
  object("not", [&] { w_.key("required").begin_array().value(a).value(b).end_array(); });
  w_.end_object();
}

/// What concerns several keys of a section.
void FormatSchema::restrictions(const Section& section) {
  if (!section.needs_one.empty()) needs_one(section);
  const bool of_command = section.name == templates::command_format().name;
  const bool of_parameter = section.name == templates::parameter_format().name;
  if (of_command) command_arguments();
  if (section.exclusive.empty() && !of_parameter) return;
  w_.key("allOf").begin_array();
  for (const std::vector<std::string>& names : section.exclusive)
    for (std::size_t b = 1; b < names.size(); ++b)
      for (std::size_t a = 0; a < b; ++a) excludes(names[a], names[b]);
  if (of_parameter) parameter_defaults();
  w_.end_array();
}

/// `with:` is what the command's module takes. Under `dependencies` and by a pattern, because
/// editors offer the keys of every condition that the half-written text may still fulfil.
void FormatSchema::command_arguments() {
  uses_modules_ = true;
  w_.key("dependencies").begin_object().key("command").begin_object().key("allOf").begin_array();
  for (const std::string& name : catalogue_.modules()) {
    w_.begin_object();
    object("if", [&] {
      object("properties",
             [&] { object("command", [&] { w_.member("pattern", fmt::format("^{}$", name)); }); });
    });
    object("then", [&] {
      object("properties", [&] { object("with", [&] { reference("with_" + name); }); });
      bool required = false;
      for (const catalog::Parameter& parameter : catalogue_.find(name)->parameters)
        required = required || parameter.required;
      if (required) w_.key("required").begin_array().value("with").end_array();
    });
    w_.end_object();
  }
  w_.end_array().end_object().end_object();
}

/// The default of a template's parameter has its type, and an enum lists its words.
void FormatSchema::parameter_defaults() {
  const Section& format = templates::parameter_format();
  for (const std::string& name : format.words("type")) {
    catalog::Parameter parameter;
    parameter.type = catalog::parse_type(name).value();
    const bool words = parameter.type == catalog::ParameterType::enumeration;
    w_.begin_object();
    object("if", [&] {
      object("properties", [&] { object("type", [&] { w_.member("const", name); }); });
      w_.key("required").begin_array().value("type").end_array();
    });
    object("then", [&] {
      object("properties", [&] {
        object("default", [&] {
          if (words)
            write_types(w_, {"string"});
          else
            write_parameter_values(w_, parameter, false);
        });
      });
      if (words) w_.key("required").begin_array().value("values").end_array();
    });
    w_.end_object();
  }
}

void FormatSchema::key(const Key& key) {
  write_description(w_, key.help);
  form(key);
}

void FormatSchema::form(const Key& key) {
  if (key.form >= Form::arguments)
    deep_form(key);
  else
    simple_form(key);
}

void FormatSchema::simple_form(const Key& key) {
  switch (key.form) {
    case Form::text:
      return write_types(w_, {"string", "number"});
    case Form::name:
      if (key.rule.null)
        write_types(w_, {"string", "null"});
      else
        write_types(w_, {"string"});
      return write_pattern(w_, kNamePattern, kNameMessage);
    case Form::names:
      write_one_or_list(w_, kNamePattern, kNameMessage);
      w_.member("uniqueItems", true).member("maxItems", 64);
      return;
    case Form::texts:
      return write_texts(w_);
    case Form::text_lists:
      write_types(w_, {"array"});
      return object("items", [&] { write_texts(w_); });
    case Form::boolean:
      w_.key("enum").begin_array().value(true).value(false).value("on").value("off").end_array();
      return;
    case Form::integer:
      write_types(w_, {"integer"});
      return write_limits(w_, key.rule);
    case Form::number:
      write_types(w_, {"number"});
      return write_limits(w_, key.rule);
    case Form::numbers:
      write_types(w_, {"array"});
      object("items", [&] {
        write_types(w_, {"number"});
        write_limits(w_, key.rule);
      });
      w_.member("minItems", key.rule.count).member("maxItems", key.rule.count);
      return;
    case Form::word:
      return write_words(w_, key.rule.words);
    case Form::condition:
      write_types(w_, {"string"});
      return write_pattern(w_, condition_pattern(), "write `$name`, `not $name` or `$name >= 3`");
    case Form::holders:
      return write_one_or_list(w_, fmt::format("({0}|{1})/{0}", kNamePattern, kUidPattern),
                               "write JOINT/COMMAND, like elbow/main");
    case Form::uid:
      write_types(w_, {"string", "number", "array"});
      write_pattern(w_, kUidPattern, kUidMessage);
      return object("items", [&] {
        write_types(w_, {"string", "number"});
        write_pattern(w_, kUidPattern, kUidMessage);
      });
    case Form::count:
      write_types(w_, {"integer", "string"});
      write_limits(w_, key.rule);
      return write_pattern(w_, kPlaceholderPattern, "expected an integer or `$parameter`");
    case Form::lines:
      return write_lines(w_);
    case Form::point:
      return write_point(w_);
    case Form::module:
      return module_names();
    default:
      return;
  }
}

void FormatSchema::deep_form(const Key& key) {
  switch (key.form) {
    case Form::arguments:
    case Form::values:
      if (key.rule.null) return write_types(w_, {"object", "null"});
      return write_types(w_, {"object"});
    case Form::names_by_name:
      write_types(w_, {"object"});
      return object("additionalProperties", [&] {
        write_types(w_, {"string"});
        write_pattern(w_, kNamePattern, kNameMessage);
      });
    case Form::texts_by_name:
      write_types(w_, {"object"});
      return object("additionalProperties", [&] { write_texts(w_); });
    case Form::bones:
      return bones();
    case Form::versions:
      return module_versions();
    case Form::tags:
      return tags();
    case Form::parameters:
      write_types(w_, {"array"});
      return object("items", [&] {
        object("if", [&] { w_.key("required").begin_array().value("frame").end_array(); });
        object("then", [&] { reference(catalog::frame_format()); });
        object("else", [&] { reference(catalog::parameter_format()); });
      });
    case Form::map:
      return reference(*key.rule.section);
    case Form::list:
      if (key.rule.null)
        write_types(w_, {"array", "null"});
      else
        write_types(w_, {"array"});
      return object("items", [&] { reference(*key.rule.section); });
    case Form::named:
      return named(key);
    default:
      return;
  }
}

/// A bone, or bones of which one counts, or of a chain a list of these; nothing: no such bone.
void FormatSchema::bones() {
  write_types(w_, {"object"});
  object("propertyNames", [&] {
    write_pattern(w_, R"(([A-Za-z0-9_-]|\{s\})+(\.([A-Za-z0-9_-]|\{s\})+)?)",
                  "write GROUP.LABEL, or GROUP for the group's chain");
  });
  object("additionalProperties", [&] {
    write_types(w_, {"string", "number", "array", "null"});
    object("items", [&] { write_texts(w_); });
  });
}

void FormatSchema::module_names() {
  write_types(w_, {"string"});
  w_.key("enum").begin_array();
  for (const std::string& name : catalogue_.modules()) w_.value(name);
  w_.end_array().key("markdownEnumDescriptions").begin_array();
  for (const std::string& name : catalogue_.modules()) w_.value(catalogue_.find(name)->summary);
  w_.end_array();
}

void FormatSchema::module_versions() {
  write_types(w_, {"object"});
  w_.member("additionalProperties", false);
  object("properties", [&] {
    for (const std::string& name : catalogue_.modules())
      object(name.c_str(), [&] {
        write_description(w_, catalogue_.find(name)->summary);
        write_types(w_, {"integer"});
        w_.member("minimum", 1).member("maximum", catalogue_.find(name)->version);
      });
  });
}

void FormatSchema::named(const Key& key) {
  write_types(w_, {"object"});
  object("propertyNames", [&] { write_pattern(w_, kNamePattern, kNameMessage); });
  object("additionalProperties", [&] {
    if (!key.rule.null) return reference(*key.rule.section);
    w_.key("anyOf").begin_array().begin_object();
    reference(*key.rule.section);
    w_.end_object().begin_object();
    write_types(w_, {"null"});
    w_.end_object().end_array();
  });
}

/// An item is a command where it has that key.
void FormatSchema::tags() {
  write_types(w_, {"array", "null"});
  object("items", [&] {
    write_types(w_, {"object"});
    object("properties", [&] {  // editors offer the keys of `then` in an empty item, and these
      for (const char* name : {"feature", "commands"})
        object(name, [&] {
          const Key& key = *templates::feature_format().find(name);
          write_description(w_, key.help);
          write_types(w_, {key.form == Form::list ? "array" : "string", "null"});
        });
    });
    object("if", [&] { w_.key("required").begin_array().value("command").end_array(); });
    object("then", [&] { reference(templates::command_format()); });
    object("else", [&] { reference(templates::feature_format()); });
  });
}

void FormatSchema::reference(const std::string& definition) {
  w_.member("$ref", "#/definitions/" + definition);
}

void FormatSchema::reference(const Section& section) {
  if (seen_.insert(section.name).second) open_.push_back(&section);
  reference(section.name);
}

}  // namespace rigc::pipeline
