// SPDX-License-Identifier: MIT
// The catalogue of diagnostics: every folder's table, by number. Test:
// tests/cli/bad_test.cpp
#include <fmt/format.h>

#include <algorithm>

#include "bake/codes.h"
#include "base/codes.h"
#include "catalog/codes.h"
#include "eval/codes.h"
#include "gltf/codes.h"
#include "gltf/merge_codes.h"
#include "gltf/rig_codes.h"
#include "modules/codes.h"
#include "pipeline/batch_codes.h"
#include "pipeline/codes.h"
#include "pipeline/match_codes.h"
#include "pipeline/merge_codes.h"
#include "pipeline/reference.h"
#include "pipeline/transfer_codes.h"
#include "pipeline/update_codes.h"
#include "processor/codes.h"
#include "scene/codes.h"
#include "selector/codes.h"
#include "tags/codes.h"
#include "templates/codes.h"
#include "traversal/codes.h"

namespace rigc::pipeline {
namespace {

template <std::size_t N>
void add(const Code* const (&table)[N], std::vector<const Code*>& codes) {
  codes.insert(codes.end(), std::begin(table), std::end(table));
}

}  // namespace

std::vector<const Code*> all_codes() {
  std::vector<const Code*> codes;
  add(rigc::codes::base_codes, codes);
  add(catalog::codes::kCatalogCodes, codes);
  add(selector::codes::kSelectorCodes, codes);
  add(tags::codes::kTagsCodes, codes);
  add(templates::codes::kTemplatesCodes, codes);
  add(scene::codes::kSceneCodes, codes);
  add(traversal::codes::kTraversalCodes, codes);
  add(modules::codes::kModulesCodes, codes);
  add(processor::codes::kProcessorCodes, codes);
  add(eval::codes::kEvalCodes, codes);
  add(bake::codes::kBakeCodes, codes);
  add(gltf::codes::kGltfCodes, codes);
  add(gltf::codes::kMergeCodes, codes);
  add(gltf::codes::kRigCodes, codes);
  add(pipeline::codes::kPipelineCodes, codes);
  add(pipeline::codes::kUpdateCodes, codes);
  add(pipeline::codes::kBatchCodes, codes);
  add(pipeline::codes::kTransferCodes, codes);
  add(pipeline::codes::kMatchCodes, codes);
  add(pipeline::codes::kMergeFileCodes, codes);
  std::sort(codes.begin(), codes.end(),
            [](const Code* a, const Code* b) { return a->number < b->number; });
  return codes;
}

std::string diagnostic_reference() {
  std::string out =
      "# Diagnostics\n\nMade from the tables in `src/*/codes.h` by `rigc docs`.\n\n| code | | what "
      "it says | what to do |\n"
      "| --- | --- | --- | --- |\n";
  for (const Code* code : all_codes()) {
    out += fmt::format("| RIG{:04} | {} | {} | {} |\n", code->number,
                       code->severity == Severity::error ? "error" : "warning", code->title,
                       code->help);
  }
  return out;
}

}  // namespace rigc::pipeline
