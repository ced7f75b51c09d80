// SPDX-License-Identifier: MIT
// JSON Schemas by name. Test: tests/pipeline/schema_test.cpp
#include "pipeline/schema.h"

#include <fmt/format.h>

#include "base/files.h"
#include "base/text.h"
#include "catalog/format.h"
#include "pipeline/codes.h"
#include "pipeline/schema_format.h"
#include "pipeline/schema_values.h"
#include "templates/format.h"

namespace rigc::pipeline {
namespace {

std::optional<std::string> rig_schema(Diagnostics& diagnostics) {
  const std::string file = "RIGC_rig.schema.json";
  for (const char* folder : {"schema", "docs/schema"}) {
    const std::string path = join_path(join_path(data_folder(), folder), file);
    if (file_exists(path)) return read_file(path, 1 << 20, diagnostics);
  }
  return read_file(join_path(join_path(data_folder(), "schema"), file), 1 << 20, diagnostics);
}

std::string arguments_schema(const catalog::Descriptor& descriptor) {
  json::Writer w(2);
  write_arguments(w, descriptor);
  return w.take() + "\n";
}

}  // namespace

std::optional<std::string> schema(const std::string& name, const Paths& paths,
                                  Diagnostics& diagnostics) {
  if (name == "RIGC_rig") return rig_schema(diagnostics);
  catalog::Catalogue catalogue;
  if (!add_modules(paths, catalogue, diagnostics)) return std::nullopt;
  if (name == "template")
    return FormatSchema(catalogue).write(templates::template_format(), "rigc template",
                                         "A template of rigc: what a rig is made of.");
  if (name == "map")
    return FormatSchema(catalogue).write(
        templates::map_format(), "rigc map",
        "A map of rigc: which bone of a kind of model is which joint of a template.");
  if (name == "guides")
    return FormatSchema(catalogue).write(
        templates::guides_format(), "rigc guides",
        "Guides of rigc: where joints are and what controls look like, over a template.");
  if (name == "module")
    return FormatSchema(catalogue).write(catalog::descriptor_format(), "rigc module",
                                         "A module of rigc: what a command takes and makes.");
  if (const catalog::Descriptor* found = catalogue.find(name)) return arguments_schema(*found);
  std::vector<std::string> names = {"template", "map", "guides", "module", "RIGC_rig"};
  for (const std::string& module : catalogue.modules()) names.push_back(module);
  diagnostics.report(codes::kNoSuchModule, Place(),
                     fmt::format("there is no schema and no module \"{}\"", printable(name)),
                     suggest(name, names));
  return std::nullopt;
}

}  // namespace rigc::pipeline
