// SPDX-License-Identifier: MIT
// A file whose rigs are compiled again: what update, rebuild and unbuild share. Test:
// tests/pipeline/update_test.cpp
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/batch.h"
#include "pipeline/build.h"
#include "pipeline/carry.h"

namespace rigc::pipeline {

/// Whether a work replaces its input, however the paths are spelled.
bool is_in_place(const FileWork& work);
/// A file that is replaced in place is locked before it is read; false where that cannot be had.
bool lock_input(const FileWork& work, std::optional<FileLock>& lock, Diagnostics& diagnostics);
/// A file that needs nothing: written to the output, with what it names, where that is another
/// file.
bool pass_on(const FileWork& work, std::uint64_t& bytes, Diagnostics& diagnostics);

/// What is asked of a recompilation whatever made it.
struct CarryOptions {
  bool plan = false;    ///< find out and write nothing
  bool strict = false;  ///< keys and values that would lose their node are an error
  bool keep_local = false;
  std::optional<double> tolerance_mm;  ///< a joint that moves by more is an error
};

/// Members of an object that says what was asked for, for the reports of batches.
void write_members(json::Writer& writer, const CarryOptions& options);

/// What one rig becomes.
struct NewRig {
  tags::TaggedSkeleton skeleton;  ///< tags as declared, placed
  tags::Settings settings;
  bool skeleton_only = false;  ///< no command runs
};

struct RigReport {
  std::string global;
  std::string template_name, template_before;
  int version = 0, version_before = 0;
  std::string why;  ///< `new version`, `changed content`, ...
  CarryReport carry;
  std::vector<ClipComparison> clips;
  std::vector<std::string> put_back;          ///< joints and controls that guides set back
  std::vector<std::string> dropped_settings;  ///< that the new template does not have
  std::vector<std::string> skinned_joints;    ///< gone from the template, but a skin uses them
};

/// Largest differences of a rig over all clips.
struct Largest {
  double mm = 0, degrees = 0;
  std::string joint, clip;
};
Largest largest_difference(const RigReport& report);

class Recompilation {
 public:
  /// Reads a file with its rigs and clips. A file without rigs is reported.
  static std::unique_ptr<Recompilation> open(const std::string& path, Diagnostics& diagnostics);

  const gltf::File& file() const { return *file_; }
  const std::vector<gltf::Rig>& rigs() const { return rigs_; }

  /// Builds a rig anew and carries over what was on it. Reported: an old or new rig that cannot be
  /// evaluated, what is lost with `strict`, what moves beyond the tolerance.
  bool compile(std::size_t rig, NewRig next, const catalog::Catalogue& catalogue,
               const CarryOptions& options, RigReport& report, Diagnostics& diagnostics);

  /// Writes the file with all rigs that were compiled.
  bool write(const FileWork& work, std::uint64_t& bytes, Diagnostics& diagnostics);

 private:
  struct Compiled {
    std::size_t rig = 0;
    gltf::Rig fresh;
    Sources sources;  ///< that its spans point into
    std::unique_ptr<Carrier> carrier;
  };
  std::optional<gltf::File> file_;
  std::vector<gltf::Rig> rigs_;
  std::vector<anim::Clip> clips_;
  std::set<int> used_;  ///< nodes that channels drive or that others have added to
  std::vector<std::unique_ptr<Compiled>> compiled_;
};

/// For people, several lines; `verbose` lists every control and property.
std::string as_text(const RigReport& report, bool verbose);
/// An object.
void write_json(json::Writer& writer, const RigReport& report);

}  // namespace rigc::pipeline
