// SPDX-License-Identifier: MIT
// Where indices stand in a glTF file: in the elements of its top-level arrays and in the extensions
// that rigc knows. What is in no table may hold indices that rigc would not see.
// Test: tests/gltf/merge_table_test.cpp
#pragma once

#include <string_view>
#include <vector>

namespace rigc::gltf {

/// The top-level arrays, in the order in which a merge appends to them.
inline constexpr std::string_view kTopLevel[] = {
    "buffers", "bufferViews", "accessors", "images", "samplers", "textures",  "materials",
    "meshes",  "cameras",     "nodes",     "skins",  "scenes",   "animations"};

/// A place that holds an index.
struct IndexRule {
  std::string_view owner;  ///< top-level array or extension in which the path begins
  std::string_view path;   ///< steps divided by `/`; `*` is each element or member
  /// The array that the index counts: a top-level one, `EXTENSION.ARRAY` of the root, or `pointer`:
  /// a JSON pointer into the file.
  std::string_view array;
  std::string_view place = {};  ///< holds only in elements of this top-level array
};
const std::vector<const IndexRule*>& rules_of(std::string_view owner);

/// What becomes of an extension of the root that several files have.
enum class AtRoot {
  unite,       ///< its arrays are joined (united_arrays)
  one,         ///< only one file can have it
  first_only,  ///< only the first file can have it: it goes by the order of the materials
};

/// Whether rigc knows every index of an extension.
bool is_known_extension(std::string_view name);
AtRoot at_root(std::string_view extension);
/// Arrays of a root extension that others refer to by index, or that are just lists.
std::vector<std::string_view> united_arrays(std::string_view extension);

}  // namespace rigc::gltf
