// SPDX-License-Identifier: MIT
// Build: from a template (and perhaps a model) to a rig. The driver names every stage in order.
// Test: tests/pipeline/build_test.cpp
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gltf/rig.h"
#include "pipeline/environment.h"
#include "processor/processor.h"
#include "templates/fit.h"

namespace rigc::pipeline {

struct BuildRequest {
  std::string template_file;  ///< path, or name looked for in the template folders
  std::string model;          ///< empty: the template's own skeleton
  std::string map;            ///< name or path; empty: by detection
  std::string skeleton;       ///< node of the model, by name or number
  std::string rest = "bind";
  std::string global;                 ///< empty: the template's
  std::vector<std::string> features;  ///< [GROUP/]NAME[:SWITCH]=on|off
  std::vector<std::string> groups;    ///< GROUP=on|off
  std::vector<std::string> only;      ///< groups whose commands run; empty: all
  std::string until;                  ///< JOINT/COMMAND
  std::string guides;                 ///< file of moved joints and edited controls; empty: none
  bool skeleton_only = false;
  bool split_weights =
      false;  ///< the skins of the model share weights with joints that the rig makes
  Paths paths;
};

/// What a skeleton and settings become before anything runs.
struct Compilation {
  std::uint32_t rig_id = 0;       ///< number of the rig in the file
  tags::TaggedSkeleton declared;  ///< tags as the template has them
  tags::Settings settings;
  tags::TaggedSkeleton skeleton;  ///< with the settings applied
  processor::CommandList commands;
  std::size_t end = 0;  ///< how many commands run
};

/// From `declared` and `settings` to the commands; the request says how far to run.
bool list_commands(Compilation& compilation, const BuildRequest& request,
                   const catalog::Catalogue& catalogue, Diagnostics& diagnostics);

/// Runs the commands; nodes of the file and `owned` are still to be found. `geometry`: of the
/// character's meshes, empty without. `skipped`: commands that did not run because an optional
/// selector was empty.
std::optional<gltf::Rig> run_commands(const Compilation& compilation,
                                      const catalog::Catalogue& catalogue,
                                      const tags::Geometry& geometry, std::size_t& skipped,
                                      Diagnostics& diagnostics);

/// Everything up to the commands: what `plan`, `check` and `build` share.
struct Prepared : Compilation {
  catalog::Catalogue catalogue;
  std::optional<gltf::File> model;
  int ancestor = -1;           ///< glTF node that the rig goes under
  bool needs_outside = false;  ///< the template is a part: its commands name groups of an outer one
  std::vector<std::string> names;  ///< of the template: its own first, then earlier ones
  bool centimetres = false;        ///< the template's unit
  std::optional<templates::Expanded> expanded;
  templates::FitReport fit;
};
std::optional<Prepared> prepare(const BuildRequest& request, Diagnostics& diagnostics);

struct Built {
  gltf::Rig rig;
  templates::FitReport fit;
  std::size_t skipped = 0;
  std::uint64_t bytes = 0;
};

/// Builds and writes `out` (.glb or .gltf). Nothing is written where anything failed.
std::optional<Built> build(const BuildRequest& request, const std::string& out,
                           Diagnostics& diagnostics);

/// The skeleton that `--skeleton` names, or the only one; a null pointer was reported.
const tags::ForeignSkeleton* choose_skeleton(const std::vector<tags::ForeignSkeleton>& skeletons,
                                             const BuildRequest& request, Diagnostics& diagnostics);
/// Whether every transform of a scene can be computed; a cycle is reported.
bool check_evaluates(const scene::Scene& scene, Diagnostics& diagnostics);
/// The same for a rig that was read: what is wrong is said of its nodes in the file.
bool check_evaluates(const gltf::File& file, const gltf::Rig& rig, Diagnostics& diagnostics);
/// Ends in .glb or .gltf; else reported.
bool check_output_name(const std::string& out, Diagnostics& diagnostics);
/// Files beside an input that the output goes on naming: relative paths.
struct Beside {
  std::string input;
  std::vector<std::string> names;
};
/// Writes a finished patch: buffers first, then the file. `more`: of files that were merged into
/// `file`.
bool write_output(gltf::Patch& patch, const gltf::File& file, const std::string& out,
                  std::uint64_t& bytes, Diagnostics& diagnostics,
                  const std::vector<Beside>& more = {});

}  // namespace rigc::pipeline
