// SPDX-License-Identifier: MIT
// The driver of reading: the keys of a template file in the order in which they depend on each
// other. Test: tests/templates/read_test.cpp
#include "templates/read.h"

#include <fmt/format.h>

#include "base/files.h"
#include "base/ids.h"
#include "base/text.h"
#include "templates/codes.h"
#include "templates/format.h"
#include "templates/reader.h"

namespace rigc::templates {
namespace {

bool read_format(Reader& reader, const yaml::Node& root) {
  const yaml::Node* format = root.find("rigc");
  if (!format) {
    reader.error(codes::kUnknownFormat, root.span, "this is not a template: `rigc: 1` is missing",
                 "begin the file with `rigc: 1`");
    return false;
  }
  if (format->is_scalar() && format->text == "1") return true;
  reader.error(codes::kUnknownFormat, format->span,
               fmt::format("format \"{}\" is not known", printable(format->text, 40)),
               "this program reads `rigc: 1`");
  return false;
}

void read_version(Reader& reader, const yaml::Node& root) {
  const yaml::Node* node = reader.required(root, "version", "a template");
  if (!node) return;
  const auto version = yaml::as_integer(*node, "version", reader.diagnostics);
  if (!version) return;
  if (*version < 1 || *version > kMostVersion)
    reader.error(codes::kNotAllowed, node->span, fmt::format("version {} is below 1", *version),
                 "versions count from 1 and rise with every published change");
  else
    reader.out.version = static_cast<int>(*version);
}

void read_units(Reader& reader, const yaml::Node& root) {
  const yaml::Node* node = root.find("units");
  if (!node) return;
  const auto units = yaml::as_text(*node, "units", reader.diagnostics);
  if (!units || *units == "metre") return;
  if (*units == "centimetre")
    reader.out.metres_per_unit = 0.01;
  else
    reader.error(codes::kUnknownWord, node->span,
                 fmt::format("units: \"{}\" is not known", printable(*units, 60)),
                 suggest(*units, template_format().words("units")));
}

void read_head(Reader& reader, const yaml::Node& root) {
  Template& out = reader.out;
  if (const yaml::Node* node = reader.required(root, "name", "a template")) {
    out.name = yaml::as_name(*node, "name", reader.diagnostics).value_or("");
    out.span = node->span;
  }
  read_version(reader, root);
  read_units(reader, root);
  if (const yaml::Node* node = root.find("was")) out.was = reader.names(*node, "was");
  if (const yaml::Node* node = root.find("description"))
    out.description = yaml::as_text(*node, "description", reader.diagnostics).value_or("");
  if (const yaml::Node* node = root.find("preview"))
    out.preview = yaml::as_text(*node, "preview", reader.diagnostics).value_or("");
  out.global = out.name;
  if (const yaml::Node* node = root.find("global"))
    out.global = yaml::as_name(*node, "global", reader.diagnostics).value_or("");
  if (const yaml::Node* node = root.find("needs")) out.needs = reader.names(*node, "needs");
}

void read_body(Reader& reader, const yaml::Node& root) {
  if (const yaml::Node* node = root.find("parameters")) read_parameters(reader, *node);
  if (const yaml::Node* node = root.find("features")) read_features(reader, *node);
  if (const yaml::Node* node = root.find("modules")) read_pins(reader, *node);
  if (const yaml::Node* node = root.find("groups")) read_groups(reader, *node);
  if (const yaml::Node* node = root.find("shapes")) {
    auto shapes = catalog::read_shapes(*node, reader.diagnostics);
    if (shapes) reader.out.shapes = std::move(*shapes);
  }
  const yaml::Node* joints = root.find("joints");
  const yaml::Node* parts = root.find("parts");
  const auto has_items = [](const yaml::Node* node) {
    return node && !node->is_null() && !(node->is_sequence() && node->items.empty());
  };
  if (!has_items(joints) && !has_items(parts)) {
    reader.error(codes::kEmptyTemplate, reader.out.span,
                 "the template has neither joints nor parts");
    return;
  }
  if (has_items(parts)) read_parts(reader, *parts);
  if (has_items(joints)) read_joints(reader, *joints);
}

}  // namespace

std::optional<Template> read(std::uint32_t file, const catalog::Catalogue& catalogue,
                             Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.errors();
  const auto root = yaml::read(file, diagnostics);
  if (!root) return std::nullopt;

  Template out;
  const std::string path(diagnostics.sources().name(file));
  out.file = file;
  out.folder = folder_of(path);
  out.reference = stem_of(path) + ".yaml";
  out.digest = hex16(hash64(diagnostics.sources().text(file)));

  Reader reader{catalogue, diagnostics, out};
  if (!root->is_map() && !root->is_null()) {
    yaml::check_section(*root, template_format(), diagnostics);
    return std::nullopt;
  }
  if (!read_format(reader, *root)) return std::nullopt;
  yaml::check_section(*root, template_format(), diagnostics);
  read_head(reader, *root);
  read_body(reader, *root);
  if (diagnostics.errors() != errors_before) return std::nullopt;
  return out;
}

}  // namespace rigc::templates
