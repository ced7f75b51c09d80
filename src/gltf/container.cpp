// SPDX-License-Identifier: MIT
// Reads a .glb's header and chunks (glTF 2.0, section 4).
// Test: tests/gltf/file_test.cpp
#include "gltf/container.h"

#include <fmt/format.h>

#include "base/text.h"
#include "gltf/codes.h"

namespace rigc::gltf {
namespace {

constexpr std::uint32_t kJson = 0x4e4f534a;
constexpr std::uint32_t kBin = 0x004e4942;

std::uint32_t uint32_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

bool fail(const Code& code, const std::string& path, std::size_t at, std::string message,
          Diagnostics& diagnostics) {
  diagnostics.report(code, Place::at_byte(path, at), std::move(message));
  return false;
}

bool read_header(std::string_view whole, const std::string& path, Diagnostics& diagnostics) {
  if (whole.size() < 12)
    return fail(codes::kGlbHeader, path, 0, "the file ends inside its header", diagnostics);
  const std::uint32_t version = uint32_at(whole, 4);
  if (version != 2)
    return fail(codes::kGlbHeader, path, 4, fmt::format("a .glb of version {}, not 2", version),
                diagnostics);
  const std::uint32_t length = uint32_at(whole, 8);
  if (length != whole.size())
    return fail(codes::kGlbHeader, path, 8,
                fmt::format("the header says {} bytes, the file has {}", length, whole.size()),
                diagnostics);
  return true;
}

/// Puts one chunk where it belongs; `number` counts from 0.
bool take_chunk(Container& container, std::string_view whole, std::size_t at, std::size_t number,
                const std::string& path, Diagnostics& diagnostics) {
  const std::uint32_t length = uint32_at(whole, at);
  const std::uint32_t type = uint32_at(whole, at + 4);
  const std::string_view bytes = whole.substr(at + 8, length);
  if ((type == kJson) != (number == 0))
    return fail(codes::kGlbChunk, path, at,
                number == 0 ? "the first chunk is not JSON" : "a second JSON chunk", diagnostics);
  if (type == kBin && number != 1)
    return fail(codes::kGlbChunk, path, at, "a BIN chunk that is not the second chunk",
                diagnostics);
  if (type == kJson) {
    container.json = bytes;
    container.json_offset = at + 8;
  } else if (type == kBin) {
    container.bin = bytes;
  } else {
    container.other_chunks.push_back(whole.substr(at, std::size_t{8} + length));
  }
  return true;
}

}  // namespace

std::optional<Container> read_container(std::string_view whole, const std::string& path,
                                        Diagnostics& diagnostics) {
  Container container;
  container.binary = starts_with(whole, "glTF");
  container.json = whole;
  if (!container.binary) return container;
  if (!read_header(whole, path, diagnostics)) return std::nullopt;
  std::size_t number = 0;
  for (std::size_t at = 12; at < whole.size(); ++number) {
    const bool has_header = whole.size() - at >= 8;
    const std::uint32_t length = has_header ? uint32_at(whole, at) : 0;
    if (!has_header || length > whole.size() - at - 8 || length % 4 != 0) {
      fail(codes::kGlbChunk, path, at,
           length % 4 != 0 ? fmt::format("the chunk's {} bytes are no multiple of 4", length)
                           : "the chunk reaches beyond the end of the file",
           diagnostics);
      return std::nullopt;
    }
    if (!take_chunk(container, whole, at, number, path, diagnostics)) return std::nullopt;
    at += std::size_t{8} + length;
  }
  if (number == 0) {
    fail(codes::kGlbChunk, path, 12, "the file has no chunks", diagnostics);
    return std::nullopt;
  }
  return container;
}

}  // namespace rigc::gltf
