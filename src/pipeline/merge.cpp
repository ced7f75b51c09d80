// SPDX-License-Identifier: MIT
// Merge: several files in one. Test: tests/pipeline/merge_test.cpp
#include "pipeline/merge.h"

#include "base/files.h"
#include "base/text.h"
#include "pipeline/build.h"

namespace rigc::pipeline {
namespace {

/// All of them, or nothing where one cannot be read.
std::optional<std::deque<gltf::File>> open_all(const std::vector<std::string>& paths,
                                               Diagnostics& diagnostics) {
  std::deque<gltf::File> files;
  bool complete = true;
  for (const std::string& path : paths) {
    auto file = gltf::open(path, diagnostics);
    complete = complete && file;
    if (file) files.push_back(*std::move(file));
  }
  if (!complete) return std::nullopt;
  return files;
}

}  // namespace

std::optional<MergedFile> merge_files(const MergeRequest& request, const std::string& out,
                                      Diagnostics& diagnostics) {
  if (!check_output_name(out, diagnostics)) return std::nullopt;
  const auto lock = FileLock::take(out, diagnostics);
  if (!lock) return std::nullopt;
  const auto files = open_all(request.files, diagnostics);
  if (!files) return std::nullopt;
  gltf::Patch patch(files->front());
  auto merged =
      gltf::merge(patch, *files, {!ends_with(out, ".gltf"), request.join_clips}, diagnostics);
  if (!merged) return std::nullopt;
  std::vector<Beside> beside;
  for (std::size_t i = 1; i < files->size(); ++i)
    beside.push_back({(*files)[i].path, merged->copies[i]});
  MergedFile result{*std::move(merged), 0};
  if (!write_output(patch, files->front(), out, result.bytes, diagnostics, beside))
    return std::nullopt;
  return result;
}

}  // namespace rigc::pipeline
