// SPDX-License-Identifier: MIT
// A glTF file as it lies on disk: checked JSON text with spans, and its buffers' bytes untouched.
// Test: tests/gltf/file_test.cpp
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "base/files.h"
#include "base/json.h"

namespace rigc::gltf {

/// One buffer of the file: bytes of BIN, of another file, or of a data URI.
struct Buffer {
  Bytes bytes;      ///< byteLength long; empty for a buffer that an extension leaves unfilled
  std::string uri;  ///< as written; empty for BIN
};

struct File {
  std::string path;     ///< as the user gave it, for messages
  bool binary = false;  ///< .glb
  Bytes whole;          ///< the file's bytes
  json::Document json;
  std::optional<Bytes> bin;         ///< BIN chunk's bytes with padding, part of whole
  std::vector<Bytes> other_chunks;  ///< header and bytes of chunks after BIN, parts of whole
  std::vector<Buffer> buffers;

  json::Value root() const { return json.root(); }
};

/// Reads and checks container, JSON, `asset.version`, indices, ranges, hierarchy (no cycles, one
/// parent) and buffers. Everything that later stages rely on is checked here or in their own
/// readers.
std::optional<File> open(const std::string& path, Diagnostics& diagnostics);

/// Buffers in files of their own: needed for what the file draws and plays, not for its rigs.
enum class OtherFiles { read, left_alone /* these buffers are empty */ };

/// The same for bytes in memory; `path` is what messages call them and where their buffers are
/// looked for.
std::optional<File> open(const std::string& path, Bytes bytes, Diagnostics& diagnostics,
                         OtherFiles others = OtherFiles::read);

/// An empty file to write a rig into where there is no model: asset, scene 0.
File empty_file();

}  // namespace rigc::gltf
