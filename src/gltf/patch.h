// SPDX-License-Identifier: MIT
// Changes to a file as spans of its original JSON text: everything that is not named here is copied
// through, byte for byte and index for index. Test: tests/gltf/patch_test.cpp
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gltf/file.h"

namespace rigc::gltf {

enum class ComponentType : int {
  byte = 5120,
  unsigned_byte = 5121,
  unsigned_short = 5123,
  unsigned_int = 5125,
  real = 5126
};

/// Bytes of a new accessor. `data` is packed little-endian; min and max are written where they are
/// not empty.
struct NewAccessor {
  std::string data;
  ComponentType component = ComponentType::real;
  std::string type = "SCALAR";  ///< SCALAR VEC2 VEC3 VEC4 MAT4
  std::size_t count = 0;
  std::vector<double> min, max;
  bool normalised = false;  ///< integers stand for 0..1 (or -1..1)
  int target = 0;           ///< 34962 vertices, 34963 indices, 0 none
  std::string name;
};

/// A file that must stand beside the output, written and flushed before it.
struct ExtraFile {
  std::string name;  ///< by content: `rigc_0123456789abcdef.bin`
  Bytes bytes;
};

/// A finished file, as pieces to write one after another.
struct Output {
  std::vector<Bytes> pieces;
  std::vector<ExtraFile> extra_files;
  std::vector<std::string>
      copies;              ///< files beside the input that the output refers to, relative paths
  bool unchanged = false;  ///< the pieces are the input, byte for byte
  std::uint64_t size() const;
};

class Patch {
 public:
  explicit Patch(const File& file);

  const File& file() const { return file_; }

  /// Adds an element to a top-level array ("nodes", "meshes", "materials", "skins", "animations")
  /// and gives its index: the first that is free, else a new one at the end.
  int append(std::string_view array, std::string json);
  /// Adds an accessor with a buffer view of its own into our bytes in the rig's buffer.
  int append(NewAccessor accessor);
  /// Adds bytes with a buffer view of their own and gives the view's index.
  int append_view(std::string_view data, int target);
  /// Adds bytes as they are, on a multiple of 8. When the patch finishes, `placed` is told which
  /// buffer has them and from which byte on, and replaces the views that lie in them.
  void append_bytes(Bytes bytes, std::function<void(int buffer, std::uint64_t at)> placed);
  /// How many elements a top-level array has, appended ones included.
  int count(std::string_view array) const;
  /// Indices that append gave out, in order.
  std::vector<int> given(std::string_view array) const;

  /// The text of an element as it is now.
  std::string element(std::string_view array, int index) const;

  /// Replaces a whole element of a top-level array; where `json` is empty by a valid placeholder
  /// marked ours.
  void replace(std::string_view array, int index, std::string json);
  /// Nothing uses this element any more: its place, and a buffer view's bytes, are given out again.
  /// What is free at the end is cut; what remains in the middle becomes a minimal valid placeholder
  /// marked ours, which a later patch finds.
  void release(std::string_view array, int index);
  /// Releases all elements from index `size` on.
  void truncate(std::string_view array, int size);
  /// Sets one member of an element ("nodes", 3, "extras", ...) keeping the others; json empty
  /// removes it.
  void set_member(std::string_view array, int index, std::string_view member, std::string json);
  /// Adds a child to a node, or a root to the default (else the first, else a new) scene where
  /// `node` is -1.
  void add_child(int node, int child);
  /// Adds a root to a scene.
  void add_root(int scene, int node);
  void remove_child(int node, int child);
  /// Sets member `key` of `extras` of a node, or removes it where `json` is empty, keeping other
  /// extras. Extras that are no object (glTF allows any value) are the user's and stay as they are.
  void set_extra(int node, std::string_view key, std::string json);
  /// Sets or (empty) removes an extension of the root object and its entry in extensionsUsed.
  void set_root_extension(std::string_view name, std::string json);
  /// Text of an extension of the root object as it is now; empty where there is none.
  std::string root_extension(std::string_view name) const;
  void use_extension(std::string_view name);
  /// Sets or (empty) removes a member of the root object that is no top-level array.
  void set_root_member(std::string_view name, std::string json);
  /// Its text as it is now; empty where there is none.
  std::string root_member(std::string_view name) const;
  void drop_extension(std::string_view name);
  /// What `RIGC_rig.before` has to say so that taking out all that was added gives the very bytes
  /// back. A file that has it keeps it: this is what to write next.
  std::string before() const;

  /// The file's text with all changes, and its buffers, as .glb or .gltf; to be called once. Our
  /// bytes extend BIN, and buffer 0 of a .gltf becomes BIN; a .gltf, and a .glb whose buffer 0 is a
  /// file, get a buffer file of our own.
  std::optional<Output> finish(bool binary, Diagnostics& diagnostics);

  struct State;

 private:
  const File& file_;
  std::shared_ptr<State> state_;
};

}  // namespace rigc::gltf
