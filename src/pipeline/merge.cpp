// SPDX-License-Identifier: MIT
// Merge: several files in one. Test: tests/pipeline/merge_test.cpp
#include "pipeline/merge.h"

#include <fmt/format.h>

#include <map>

#include "base/files.h"
#include "base/text.h"
#include "pipeline/build.h"
#include "pipeline/merge_codes.h"
#include "pipeline/rename.h"

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

std::optional<gltf::Attach> read_attach(const std::string& text) {
  const auto sides = split(text, '=');
  if (sides.size() != 2) return std::nullopt;
  const auto from = split(sides[0], ':'), to = split(sides[1], '.');
  if (from.size() > 2 || to.size() != 2) return std::nullopt;
  gltf::Attach attach;
  if (from.size() == 2) attach.global = from[0];
  attach.local = from.back();
  attach.to_local = to[0];
  attach.to_label = to[1];
  const bool named = from.size() == 1 || is_name(attach.global);
  if (!named || !is_name(attach.local) || !is_name(to[0]) || !is_name(to[1])) return std::nullopt;
  return attach;
}

std::optional<std::vector<gltf::Attach>> read_attachments(const MergeRequest& request,
                                                          Diagnostics& diagnostics) {
  std::vector<gltf::Attach> out;
  for (const std::string& text : request.attach) {
    if (const auto attach = read_attach(text)) {
      out.push_back(*attach);
      continue;
    }
    diagnostics.report(codes::kBadAttach, Place(request.files.front()),
                       fmt::format("--attach \"{}\"", printable(text, 80)));
    return std::nullopt;
  }
  if (out.empty() == request.into.empty()) return out;
  diagnostics.report(codes::kBadAttach, Place(request.files.front()),
                     out.empty() ? "--into without --attach" : "--attach without --into");
  return std::nullopt;
}

/// Makes one rig of several, and lets selectors follow.
bool join_rigs(gltf::Patch& patch, const MergeRequest& request,
               const std::vector<gltf::Attach>& attach, MergedFile& result,
               Diagnostics& diagnostics) {
  catalog::Catalogue catalogue;
  if (!add_modules(request.paths, catalogue, diagnostics)) return false;
  auto joined = gltf::join_into(patch, request.files.front(), request.into, attach, diagnostics);
  if (!joined) return false;
  std::map<std::string, std::string> names;
  for (const std::string& rig : joined->rigs) names[rig] = request.into;
  rename_selectors(patch, names, catalogue);
  result.merged.rigs -= joined->rigs.size();
  result.joined = *std::move(joined);
  return true;
}

}  // namespace

std::optional<MergedFile> merge_files(const MergeRequest& request, const std::string& out,
                                      Diagnostics& diagnostics) {
  const auto attach = read_attachments(request, diagnostics);
  if (!attach || !check_output_name(out, diagnostics)) return std::nullopt;
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
  MergedFile result{*std::move(merged), {}, 0};
  if (!attach->empty() && !join_rigs(patch, request, *attach, result, diagnostics))
    return std::nullopt;
  if (!write_output(patch, files->front(), out, result.bytes, diagnostics, beside))
    return std::nullopt;
  return result;
}

}  // namespace rigc::pipeline
