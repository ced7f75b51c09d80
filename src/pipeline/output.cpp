// SPDX-License-Identifier: MIT
// Writes finished files: what they refer to first, the file itself last. Test:
// tests/lossless/output_test.cpp
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "base/files.h"
#include "base/text.h"
#include "base/trace.h"
#include "gltf/codes.h"
#include "pipeline/build.h"
#include "pipeline/codes.h"

namespace rigc::pipeline {
namespace {

constexpr std::uint64_t kLargestCopy = std::uint64_t{4} << 30;

/// Gathers what is to be copied: nothing where a file lies on its place, or where it was missing
/// already. False where another file lies there.
class Copies {
 public:
  Copies(const std::string& out, Diagnostics& diagnostics)
      : to_folder_(folder_of(out)),
        out_(confine(to_folder_, file_name(out))),
        diagnostics_(diagnostics) {}

  bool add(const Beside& beside) {
    place_ = Place(beside.input);
    bool good = true;
    for (const std::string& name : beside.names) good = add(folder_of(beside.input), name) && good;
    return good;
  }

  bool write() {
    return std::all_of(list_.begin(), list_.end(), [&](const auto& copy) {
      std::error_code refused;  // write_file reports that there is no folder
      std::filesystem::create_directories(folder_of(copy.first), refused);
      return write_file(copy.first, {copy.second}, diagnostics_);
    });
  }

 private:
  bool add(const std::string& folder, const std::string& name) {
    const auto from = confine(folder, name);
    const auto to = confine(to_folder_, name);
    if (from && from == to) return stays(name, *to);
    if (!from || !to) return skip(name, "leaves the folder");
    if (!file_exists(*from)) return skip(name, "is not there, or is no file");
    auto bytes = Bytes::open(*from, kLargestCopy, diagnostics_);
    if (!bytes) return false;
    if (to == out_) return clash(name, "has the name of the output");
    const auto [known, is_new] = list_.emplace(*to, *bytes);
    if (!is_new)
      return same_bytes(known->second, *bytes, diagnostics_) ||
             clash(name, "has the name of another file that is copied beside the output");
    if (!file_exists(*to)) return true;
    const auto there = Bytes::open(*to, kLargestCopy, diagnostics_);
    if (!there) return false;
    list_.erase(known);
    return same_bytes(*there, *bytes, diagnostics_) ||
           clash(name, "is another file beside the output");
  }

  /// The file lies on its place, where no other may go.
  bool stays(const std::string& name, const std::string& to) {
    return list_.count(to) == 0 ||
           clash(name, "has the name of another file that is copied beside the output");
  }

  static std::string file_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

  bool skip(const std::string& name, const char* why) {
    diagnostics_.report(
        gltf::codes::kNotCopied, place_,
        fmt::format("\"{}\", which the model names, {}; it is not copied", printable(name), why));
    return true;
  }

  bool clash(const std::string& name, const char* why) {
    diagnostics_.report(gltf::codes::kCopyClash, place_,
                        fmt::format("\"{}\", which the model names, {}", printable(name), why),
                        "write into an empty folder, or into the folder of the model");
    return false;
  }

  std::string to_folder_;
  std::optional<std::string> out_;
  Place place_;
  Diagnostics& diagnostics_;
  std::map<std::string, Bytes> list_;  ///< by the path that they go to
};

/// A file that is written over itself must still be the one that was read.
WriteSettings replacing(const gltf::File& file, const std::string& out) {
  WriteSettings settings;
  const auto from = resolved_path(file.path);
  if (from && from == resolved_path(out)) settings.expected = file.whole.version();
  return settings;
}

}  // namespace

bool check_output_name(const std::string& out, Diagnostics& diagnostics) {
  if (ends_with(out, ".glb") || ends_with(out, ".gltf") || ends_with(out, ".vrm")) return true;
  diagnostics.report(codes::kUnknownFormat, Place(out),
                     "the output's name ends neither in .glb nor in .gltf");
  return false;
}

bool write_output(gltf::Patch& patch, const gltf::File& file, const std::string& out,
                  std::uint64_t& bytes, Diagnostics& diagnostics, const std::vector<Beside>& more) {
  const trace::Span span("write file");
  const auto output = patch.finish(!ends_with(out, ".gltf"), diagnostics);
  if (!output) return false;
  Copies copies(out, diagnostics);
  bool good = copies.add({file.path, output->copies});
  for (const Beside& beside : more) good = copies.add(beside) && good;
  if (!good || !copies.write()) return false;
  for (const gltf::ExtraFile& extra : output->extra_files) {
    if (!write_file(join_path(folder_of(out), extra.name), {extra.bytes}, diagnostics))
      return false;
  }
  bytes = output->size();
  return write_file(out, output->pieces, diagnostics, replacing(file, out));
}

}  // namespace rigc::pipeline
