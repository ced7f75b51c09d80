// SPDX-License-Identifier: MIT
// Writes finished files: what they refer to first, the file itself last. Test:
// tests/pipeline/build_test.cpp
#include <fmt/format.h>

#include "base/files.h"
#include "base/text.h"
#include "pipeline/build.h"
#include "pipeline/codes.h"

namespace rigc::pipeline {
namespace {

constexpr std::uint64_t kLargestCopy = std::uint64_t{4} << 30;

/// Copies a file that the output refers to from beside the input to beside the output, unless it is
/// there already.
bool copy_beside(const std::string& from_folder, const std::string& to_folder,
                 const std::string& name, Diagnostics& diagnostics) {
  const std::string from = join_path(from_folder, name);
  const std::string to = join_path(to_folder, name);
  if (from == to || !file_exists(from)) return true;
  const auto bytes = read_file(from, kLargestCopy, diagnostics);
  return bytes && write_file(to, {*bytes}, diagnostics);
}

}  // namespace

bool check_output_name(const std::string& out, Diagnostics& diagnostics) {
  if (ends_with(out, ".glb") || ends_with(out, ".gltf") || ends_with(out, ".vrm")) return true;
  diagnostics.report(codes::kUnknownFormat, Place(out),
                     "the output's name ends neither in .glb nor in .gltf");
  return false;
}

bool write_output(gltf::Patch& patch, const gltf::File& file, const std::string& out,
                  std::uint64_t& bytes, Diagnostics& diagnostics) {
  const auto output = patch.finish(!ends_with(out, ".gltf"), diagnostics);
  if (!output) return false;
  const std::string from_folder = folder_of(file.path);
  const std::string to_folder = folder_of(out);
  for (const std::string& name : output->copies) {
    if (!copy_beside(from_folder, to_folder, name, diagnostics)) return false;
  }
  for (const gltf::ExtraFile& extra : output->extra_files) {
    if (!write_file(join_path(to_folder, extra.name), {extra.bytes}, diagnostics)) return false;
  }
  bytes = output->size();
  return write_file(out, output->pieces, diagnostics);
}

}  // namespace rigc::pipeline
