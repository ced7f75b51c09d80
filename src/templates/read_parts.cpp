// SPDX-License-Identifier: MIT
// Reads `parts:`. Their files are opened when the template is expanded. Test:
// tests/templates/read_test.cpp
#include <fmt/format.h>

#include <unordered_map>

#include "base/text.h"
#include "templates/arguments.h"
#include "templates/codes.h"
#include "templates/format.h"
#include "templates/reader.h"

namespace rigc::templates {
namespace {

void read_mirror(Reader& reader, const yaml::Node& node, Part& part) {
  const auto text = yaml::as_text(node, "mirror", reader.diagnostics);
  if (!text) return;
  if (*text == "x")
    part.mirror = 0;
  else if (*text == "y")
    part.mirror = 1;
  else if (*text == "z")
    part.mirror = 2;
  else
    reader.error(codes::kUnknownWord, node.span,
                 fmt::format("mirror: \"{}\" is no axis", printable(*text, 40)),
                 suggest(*text, part_format().words("mirror")));
}

void read_groups(Reader& reader, const yaml::Node& node, Part& part) {
  part.groups_span = node.span;
  if (!node.is_map()) {
    yaml::check_keys(node, {}, "groups", reader.diagnostics);
    return;
  }
  if (!reader.at_most(node, 64, "groups")) return;
  for (const yaml::Node::Entry& entry : node.entries)
    if (const auto name = yaml::as_name(entry.value, entry.key, reader.diagnostics))
      part.groups.emplace_back(entry.key, *name);
}

void read_with(Reader& reader, const yaml::Node& node, Part& part) {
  if (!node.is_map()) {
    if (!node.is_null()) yaml::check_keys(node, {}, "with", reader.diagnostics);
    return;
  }
  if (!reader.at_most(node, 256, "with")) return;
  for (const yaml::Node::Entry& entry : node.entries) {
    auto value = literal_from(entry.value, reader.diagnostics);
    if (value && check_declared(*value, reader.out, reader.diagnostics))
      part.with.push_back({entry.key, entry.key_span, std::move(*value)});
  }
}

void read_size(Reader& reader, const yaml::Node& node, Part& part) {
  const auto size = yaml::as_number(node, "size", reader.diagnostics);
  if (!size) return;
  if (*size > kSmallestScale)
    part.size = *size;
  else
    reader.error(codes::kNotAllowed, node.span, "size: a number above 0 is needed");
}

void read_part(Reader& reader, const yaml::Node& node) {
  if (!yaml::check_section(node, part_format(), reader.diagnostics) && !node.is_map()) return;
  Part part;
  part.span = part.as_span = part.groups_span = node.span;
  if (const yaml::Node* reference = reader.required(node, "template", "a part")) {
    part.reference = yaml::as_text(*reference, "template", reader.diagnostics).value_or("");
    part.span = reference->span;
    if (ends_with(part.reference, ".yaml")) part.reference.resize(part.reference.size() - 5);
  }
  if (const yaml::Node* as = reader.required(node, "as", "a part")) {
    part.as = yaml::as_name(*as, "as", reader.diagnostics).value_or("");
    part.as_span = as->span;
  }
  if (const yaml::Node* was = node.find("was")) part.was = reader.names(*was, "was");
  if (const yaml::Node* attach = node.find("attach")) {
    part.attach = yaml::as_text(*attach, "attach", reader.diagnostics).value_or("");
    part.attach_span = attach->span;
  }
  if (const yaml::Node* mirror = node.find("mirror")) read_mirror(reader, *mirror, part);
  if (const yaml::Node* at = node.find("at"))
    part.at = reader.metres(*at, "at").value_or(math::Vec3{});
  if (const yaml::Node* rotate = node.find("rotate"))
    part.rotation = reader.euler(*rotate, "rotate").value_or(math::Quat{});
  if (const yaml::Node* size = node.find("size")) read_size(reader, *size, part);
  if (const yaml::Node* with = node.find("with")) read_with(reader, *with, part);
  if (const yaml::Node* groups = node.find("groups")) read_groups(reader, *groups, part);
  if (const yaml::Node* condition = node.find("if")) part.condition = reader.condition(*condition);
  reader.out.parts.push_back(std::move(part));
}

}  // namespace

void read_parts(Reader& reader, const yaml::Node& node) {
  if (!node.is_sequence()) {
    reader.error(codes::kMissingKey, node.span, "`parts` is a list", "write `- template: ...`");
    return;
  }
  if (!reader.at_most(node, 1000, "parts")) return;
  for (const yaml::Node& item : node.items) read_part(reader, item);
  std::unordered_map<std::string, std::uint32_t> lines;
  for (const Part& part : reader.out.parts) {
    if (part.as.empty()) continue;
    const auto [other, fresh] = lines.emplace(part.as, part.as_span.line);
    if (!fresh)
      reader.error(
          codes::kDuplicatePart, part.as_span,
          fmt::format("there is a part \"{}\" already, in line {}", part.as, other->second),
          "give it another name");
  }
}

}  // namespace rigc::templates
