// SPDX-License-Identifier: MIT
// Check: the driver, templates, maps and descriptors. Test: tests/pipeline/check_test.cpp
#include "pipeline/check.h"

#include <fmt/format.h>

#include "base/files.h"
#include "base/text.h"
#include "pipeline/build.h"
#include "pipeline/check_kinds.h"
#include "pipeline/codes.h"
#include "templates/map.h"

namespace rigc::pipeline {
namespace {

void check_template(const CheckRequest& request, CheckedFile& out, Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.errors();
  BuildRequest build;
  build.template_file = out.file;
  build.paths = request.paths;
  const auto prepared = prepare(build, diagnostics);
  if (!prepared) return;
  const tags::TemplateReference& main = prepared->skeleton.templates.front();
  out.facts.push_back(fmt::format("{} version {}: {} joints, {} commands", printable(main.name),
                                  main.version, prepared->skeleton.joints.size(),
                                  prepared->commands.commands.size()));
  if (prepared->needs_outside) {
    out.facts.push_back("a part: its commands run inside the template that uses it");
  } else {
    processor::Processor processor(prepared->skeleton, prepared->commands, prepared->catalogue);
    if (processor.run(diagnostics)) check_evaluates(processor.scene(), diagnostics);
  }
  if (request.pin && diagnostics.errors() == errors)
    pin_modules(out.file, prepared->catalogue, out, diagnostics);
}

std::optional<std::uint32_t> add_source(const std::string& path, Diagnostics& diagnostics) {
  auto text = read_file(path, 4u << 20, diagnostics);
  if (!text) return std::nullopt;
  return diagnostics.sources().add(path, std::move(*text));
}

void check_map(CheckedFile& out, Diagnostics& diagnostics) {
  const auto source = add_source(out.file, diagnostics);
  const auto map = source ? templates::read_map(*source, diagnostics) : std::nullopt;
  if (map)
    out.facts.push_back(fmt::format("{}: {} joints", printable(map->name), map->entries.size()));
}

void check_module(CheckedFile& out, Diagnostics& diagnostics) {
  const auto source = add_source(out.file, diagnostics);
  const auto module = source ? catalog::read_descriptor(*source, diagnostics) : std::nullopt;
  if (module)
    out.facts.push_back(fmt::format("{} version {}: {} parameters", module->module, module->version,
                                    module->parameters.size()));
}

void check_file(const CheckRequest& request, CheckedFile& out, Diagnostics& diagnostics) {
  if (is_gltf(out.file)) return check_gltf(request, out, diagnostics);
  out.kind = "template";
  if (file_exists(out.file)) {
    Diagnostics ignored;  // the file's own reader reports what is wrong
    const std::string kind = yaml_kind(out.file, ignored);
    if (!kind.empty()) out.kind = kind;
  }
  if (out.kind == "map")
    check_map(out, diagnostics);
  else if (out.kind == "module")
    check_module(out, diagnostics);
  else
    check_template(request, out, diagnostics);
}

}  // namespace

std::vector<CheckedFile> check(const CheckRequest& request, Diagnostics& diagnostics) {
  std::vector<CheckedFile> checked;
  for (const std::string& path : request.paths_to_check) {
    const bool folder = folder_exists(path);
    auto files = folder ? files_to_check(path) : std::vector<std::string>{path};
    if (folder && request.pin) std::erase_if(files, is_gltf);
    if (files.empty())
      diagnostics.report(codes::kNothingToCheck, Place(path),
                         "the folder has no template, map, module descriptor or glTF file");
    for (const std::string& file : files) {
      CheckedFile& out = checked.emplace_back();
      out.file = file;
      out.first = diagnostics.all().size();
      const std::size_t errors = diagnostics.errors(), warnings = diagnostics.warnings();
      check_file(request, out, diagnostics);
      out.last = diagnostics.all().size();
      out.errors = diagnostics.errors() - errors;
      out.warnings = diagnostics.warnings() - warnings;
    }
  }
  return checked;
}

bool check(const std::string& file, const Paths& paths, Diagnostics& diagnostics) {
  CheckRequest request;
  request.paths_to_check = {file};
  request.paths = paths;
  const std::size_t errors = diagnostics.errors();
  check(request, diagnostics);
  return diagnostics.errors() == errors;
}

}  // namespace rigc::pipeline
