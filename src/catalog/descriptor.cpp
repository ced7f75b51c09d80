// SPDX-License-Identifier: MIT
// Reads a module's descriptor: a YAML file in, a Descriptor or diagnostics out.
// Test: tests/catalog/descriptor_test.cpp
#include "catalog/descriptor.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/files.h"
#include "base/text.h"
#include "catalog/codes.h"
#include "catalog/format.h"
#include "catalog/reader.h"

namespace rigc::catalog {
namespace {

class DescriptorReader {
 public:
  DescriptorReader(const yaml::Node& root, Diagnostics& diagnostics)
      : root_(root), diagnostics_(diagnostics) {}

  Descriptor read(std::uint32_t file);

 private:
  void read_head(std::uint32_t file);
  void read_creates();
  void read_replaces();
  bool has_role(const std::string& role) const;
  void check_role(const std::string& role, const Span& span);

  const yaml::Node& root_;
  Diagnostics& diagnostics_;
  Descriptor descriptor_;
};

Descriptor DescriptorReader::read(std::uint32_t file) {
  read_head(file);
  read_parameters(root_, descriptor_, diagnostics_);
  read_creates();
  read_replaces();
  read_changes(root_, descriptor_, diagnostics_);
  return std::move(descriptor_);
}

void DescriptorReader::read_head(std::uint32_t file) {
  descriptor_.module = need_name(root_, "module", "descriptor", diagnostics_);
  const std::string stem = stem_of(std::string(diagnostics_.sources().name(file)));
  if (!descriptor_.module.empty() && stem != descriptor_.module) {
    diagnostics_.report(codes::kWrongFileName, root_.find("module")->span,
                        fmt::format("the descriptor of {} stands in {}.yaml", descriptor_.module,
                                    printable(stem, 60)),
                        fmt::format("rename the file to {}.yaml", descriptor_.module));
  }
  if (const yaml::Node* version = need(root_, "version", "descriptor", diagnostics_)) {
    const auto number = yaml::as_integer(*version, "version", diagnostics_);
    if (number && (*number < 1 || *number > 1'000'000)) {
      diagnostics_.report(codes::kBadVersion, version->span,
                          fmt::format("version {} is not in 1..1000000", *number));
    } else if (number) {
      descriptor_.version = static_cast<int>(*number);
    }
  }
  descriptor_.title = need_text(root_, "title", "descriptor", diagnostics_);
  descriptor_.category = need_name(root_, "category", "descriptor", diagnostics_);
  descriptor_.summary = need_text(root_, "summary", "descriptor", diagnostics_);
  descriptor_.help = text_of(root_, "help", diagnostics_);
  descriptor_.example = text_of(root_, "example", diagnostics_);
  if (const yaml::Node* stage = root_.find("stage")) {
    const std::string word = word_of(*stage, stage_names(), "stage", diagnostics_);
    descriptor_.stage = parse_stage(word).value_or(Stage::build);
  }
  if (const yaml::Node* name = root_.find("implementation")) {
    descriptor_.implementation =
        yaml::as_name(*name, "implementation", diagnostics_).value_or("builtin");
  }
}

bool DescriptorReader::has_role(const std::string& role) const {
  return std::any_of(descriptor_.creates.begin(), descriptor_.creates.end(),
                     [&](const Creates& made) { return made.role == role; });
}

void DescriptorReader::read_creates() {
  for (const yaml::Node& item : list_of(root_, "creates", diagnostics_)) {
    yaml::check_section(item, creates_format(), diagnostics_);
    if (!item.is_map()) continue;
    Creates made;
    made.role = need_name(item, "role", "creates", diagnostics_);
    made.kind = need_name(item, "kind", "creates", diagnostics_);
    made.help = need_text(item, "help", "creates", diagnostics_);
    if (const yaml::Node* per = item.find("per")) {
      made.per = word_of(*per, creates_format().words("per"), "per", diagnostics_);
    }
    const auto& creates = descriptor_.creates;
    const bool twice = std::any_of(creates.begin(), creates.end(), [&](const Creates& other) {
      return !made.role.empty() && other.role == made.role && other.kind == made.kind;
    });
    if (twice) {
      diagnostics_.report(
          codes::kDuplicateCreates, item.span,
          fmt::format("role {} of kind {} is declared twice", made.role, made.kind));
    }
    descriptor_.creates.push_back(std::move(made));
  }
}

void DescriptorReader::check_role(const std::string& role, const Span& span) {
  if (has_role(role)) return;
  std::vector<std::string> known;
  for (const Creates& made : descriptor_.creates) known.push_back(made.role);
  diagnostics_.report(codes::kBadReplaces, span,
                      fmt::format("{} does not make a node in role {}", descriptor_.module, role),
                      suggest(role, known));
}

void DescriptorReader::read_replaces() {
  const yaml::Node* replaces = root_.find("replaces");
  if (!replaces || !expect_map(*replaces, "replaces", diagnostics_)) return;
  for (const yaml::Node::Entry& entry : replaces->entries) {
    auto& [module, roles] = descriptor_.replaces.emplace_back();
    module = entry.key;
    if (!expect_map(entry.value, "roles", diagnostics_)) continue;
    for (const yaml::Node::Entry& pair : entry.value.entries) {
      const std::size_t dot = pair.key.find('.');
      if (dot != std::string::npos) {
        const auto number = yaml::as_number(pair.value, "value", diagnostics_);
        check_role(pair.key.substr(0, dot), pair.value.span);
        if (number) roles.emplace_back(pair.key, number_text(*number));
      } else if (const auto role = yaml::as_name(pair.value, "role", diagnostics_)) {
        check_role(*role, pair.value.span);
        roles.emplace_back(pair.key, *role);
      }
    }
  }
}

}  // namespace

std::optional<Descriptor> read_descriptor(std::uint32_t file, Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.errors();
  const auto root = yaml::read(file, diagnostics);
  if (!root) return std::nullopt;
  yaml::check_section(*root, descriptor_format(), diagnostics);
  if (!root->is_map()) return std::nullopt;
  Descriptor descriptor = DescriptorReader(*root, diagnostics).read(file);
  if (diagnostics.errors() != errors) return std::nullopt;
  return descriptor;
}

}  // namespace rigc::catalog
