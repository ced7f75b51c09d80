// SPDX-License-Identifier: MIT
// Reads a .glb's header and chunks (glTF 2.0, section 4).
// Test: tests/gltf/file_test.cpp
#include "gltf/container.h"

#include <fmt/format.h>

#include "base/codes.h"
#include "base/json.h"
#include "gltf/codes.h"

namespace rigc::gltf {
namespace {

constexpr std::uint32_t kJson = 0x4e4f534a;
constexpr std::uint32_t kBin = 0x004e4942;
/// Each costs a call of the system; real files have two or three.
constexpr std::size_t kMostChunks = 1000;

std::uint32_t uint32_at(const char* bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

/// What reading a container needs everywhere.
struct Input {
  const Bytes& whole;
  const std::string& path;
  Diagnostics& diagnostics;

  bool fail(const Code& code, std::size_t at, std::string message) const {
    diagnostics.report(code, Place::at_byte(path, at), std::move(message));
    return false;
  }
};

bool read_header(const Input& input) {
  const std::uint64_t size = input.whole.size();
  char header[12];
  if (size < sizeof header)
    return input.fail(codes::kGlbHeader, 0, "the file ends inside its header");
  if (!input.whole.read(0, sizeof header, header, input.diagnostics)) return false;
  const std::uint32_t version = uint32_at(header + 4);
  if (version != 2)
    return input.fail(codes::kGlbHeader, 4, fmt::format("a .glb of version {}, not 2", version));
  const std::uint32_t length = uint32_at(header + 8);
  if (length != size)
    return input.fail(codes::kGlbHeader, 8,
                      fmt::format("the header says {} bytes, the file has {}", length, size));
  return true;
}

/// Reads the chunk at `at`, puts it where it belongs and moves `at` behind it; `number` counts from
/// 0.
bool take_chunk(Container& container, const Input& input, std::uint64_t& at, std::size_t number) {
  const std::uint64_t rest = input.whole.size() - at;
  char header[8] = {};
  const bool has_header = rest >= sizeof header;
  if (has_header && !input.whole.read(at, sizeof header, header, input.diagnostics)) return false;
  const std::uint32_t length = uint32_at(header), type = uint32_at(header + 4);
  if (length % 4 != 0)
    return input.fail(codes::kGlbChunk, at,
                      fmt::format("the chunk's {} bytes are no multiple of 4", length));
  if (!has_header || length > rest - sizeof header)
    return input.fail(codes::kGlbChunk, at, "the chunk reaches beyond the end of the file");
  if ((type == kJson) != (number == 0))
    return input.fail(codes::kGlbChunk, at,
                      number == 0 ? "the first chunk is not JSON" : "a second JSON chunk");
  if (type == kBin && number != 1)
    return input.fail(codes::kGlbChunk, at, "a BIN chunk that is not the second chunk");
  if (number == kMostChunks)
    return input.fail(codes::kGlbChunk, at, fmt::format("more than {} chunks", kMostChunks));
  const Bytes bytes = input.whole.part(at + sizeof header, length);
  if (type == kJson) {
    container.json = bytes;
    container.json_offset = at + sizeof header;
  } else if (type == kBin) {
    container.bin = bytes;
  } else {
    container.other_chunks.push_back(input.whole.part(at, sizeof header + length));
  }
  at += sizeof header + length;
  return true;
}

std::optional<Container> split_up(const Input& input) {
  const Bytes& whole = input.whole;
  Container container;
  char magic[4] = {};
  if (whole.size() >= sizeof magic && !whole.read(0, sizeof magic, magic, input.diagnostics))
    return std::nullopt;
  container.binary = std::string_view(magic, sizeof magic) == "glTF";
  container.json = whole;
  if (!container.binary) return container;
  if (!read_header(input)) return std::nullopt;
  std::size_t number = 0;
  for (std::uint64_t at = 12; at < whole.size(); ++number)
    if (!take_chunk(container, input, at, number)) return std::nullopt;
  if (number == 0) {
    input.fail(codes::kGlbChunk, 12, "the file has no chunks");
    return std::nullopt;
  }
  return container;
}

}  // namespace

std::optional<Container> read_container(const Bytes& whole, const std::string& path,
                                        Diagnostics& diagnostics) {
  const Input input{whole, path, diagnostics};
  auto container = split_up(input);
  if (!container || container->json.size() <= json::kMostBytes) return container;
  input.fail(rigc::codes::kJsonTooLarge, container->json_offset,
             fmt::format("{} bytes of JSON", container->json.size()));
  return std::nullopt;
}

}  // namespace rigc::gltf
