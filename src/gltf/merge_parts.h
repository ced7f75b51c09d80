// SPDX-License-Identifier: MIT
// Steps of a merge, in their order: each for one file that comes to the first. Inside of
// merge*.cpp. Test: tests/gltf/merge_test.cpp
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gltf/merge.h"
#include "gltf/merge_places.h"

namespace rigc::gltf {

/// Elements of the file that join one that is there already.
struct Joins {
  struct Join {
    int to = -1;               ///< animation of the merged file
    std::size_t samplers = 0;  ///< that it had before
  };
  std::map<std::size_t, Join> clips;  ///< by animation of the file
  int scene = -1;            ///< of the file, whose roots join the merged file's default scene
  bool scene_comes = false;  ///< it is appended all the same, for what it says besides
};

/// Takes a place for every element of the file in the merged one.
Joins take_places(Patch& patch, const File& file, const MergeOptions& options, Places& places);
/// Channels of clips that join another name samplers behind its own.
void shift_samplers(const File& file, const Joins& joins, Edits& edits);
/// Puts the elements on their places, but for buffer views.
void write_elements(Patch& patch, const File& file, const Places& places, const Joins& joins,
                    const Edits& edits, Diagnostics& diagnostics);

/// Buffer views, and the bytes of buffers that become a part of the merged file's.
void write_views(Patch& patch, const File& file, const Places& places, const MergeOptions& options);
/// Whether the bytes of buffer `index` become a part of the merged file's buffer.
bool is_taken_in(const File& file, std::size_t index, const MergeOptions& options);
/// Files beside the file that its buffers and images go on naming.
std::vector<std::string> referenced_files(const File& file, const MergeOptions& options);

/// The merged file's default scene (else its first); -1 where it has none.
int default_scene(const Patch& patch);
void join_scenes(Patch& patch, const File& file, const Places& places, const Joins& joins);
/// Extensions of the root, rigs among them, their names, and extras.
bool join_root(Patch& patch, const File& file, const Places& places, const Edits& edits,
               Diagnostics& diagnostics);

}  // namespace rigc::gltf
