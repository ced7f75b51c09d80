// SPDX-License-Identifier: MIT
// Opens a file: container, JSON, checks, buffers.
// Test: tests/gltf/file_test.cpp
#include "gltf/file.h"

#include <fmt/format.h>

#include <cassert>
#include <map>

#include "base/text.h"
#include "gltf/check.h"
#include "gltf/codes.h"
#include "gltf/container.h"
#include "gltf/uri.h"

namespace rigc::gltf {
namespace {

constexpr std::uint64_t kLargest = std::uint64_t{8} << 30;

/// Loads buffers; a file that several of them name is read once.
class BufferLoader {
 public:
  BufferLoader(File& file, Diagnostics& diagnostics) : file_(file), diagnostics_(diagnostics) {}

  void load(std::size_t index, const json::Value& value) {
    index_ = index;
    Buffer& buffer = file_.buffers[index];
    const auto length = static_cast<std::uint64_t>(value["byteLength"].integer().value_or(0));
    if (value["uri"]) {
      buffer.uri = value["uri"].string().value_or("");
      buffer.storage = read_uri(buffer.uri);
      if (!buffer.storage) return;
      buffer.bytes = *buffer.storage;
    } else if (index == 0 && file_.bin.data()) {
      buffer.storage = file_.whole;
      buffer.bytes = file_.bin;
    } else {
      return;
    }
    if (buffer.bytes.size() < length)
      report(codes::kBufferShort,
             fmt::format("buffer {} has {} bytes of {}", index, buffer.bytes.size(), length));
    else
      buffer.bytes = buffer.bytes.substr(0, length);
  }

 private:
  Bytes report(const Code& code, std::string message) {
    diagnostics_.report(code, Place(file_.path, fmt::format("/buffers/{}", index_)),
                        std::move(message));
    return nullptr;
  }

  /// The bytes that a URI names; null where that was reported.
  Bytes read_uri(const std::string& uri) {
    if (is_data_uri(uri)) {
      auto bytes = data_uri_bytes(uri);
      if (!bytes) return report(codes::kBufferUri, "the data URI is broken");
      return std::make_shared<const std::string>(*std::move(bytes));
    }
    const auto name = percent_decoded(uri);
    if (!name || name->empty() || is_absolute_uri(uri))
      return report(codes::kBufferUri,
                    fmt::format("\"{}\" is no path beside the file", printable(uri, 80)));
    const auto path = confine(folder_of(file_.path), *name);
    if (!path)
      return report(codes::kBufferEscapes,
                    fmt::format("\"{}\" leaves the folder of the file", printable(*name, 80)));
    Bytes& known = read_[*path];
    if (known) return known;
    if (auto bytes = read_file(*path, kLargest, diagnostics_))
      known = std::make_shared<const std::string>(*std::move(bytes));
    return known;
  }

  File& file_;
  Diagnostics& diagnostics_;
  std::size_t index_ = 0;
  std::map<std::string, Bytes> read_;  ///< by resolved path
};

}  // namespace

std::optional<File> open(const std::string& path, Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.errors();
  auto bytes = read_file(path, kLargest, diagnostics);
  if (!bytes) return std::nullopt;
  File file;
  file.path = path;
  file.whole = std::make_shared<const std::string>(*std::move(bytes));
  const auto container = read_container(*file.whole, path, diagnostics);
  if (!container) return std::nullopt;
  file.binary = container->binary;
  file.bin = container->bin;
  file.other_chunks = container->other_chunks;
  auto json = json::parse(std::string(container->json), path, container->json_offset, diagnostics);
  if (!json) return std::nullopt;
  file.json = *std::move(json);
  check(file, diagnostics);
  if (diagnostics.errors() != errors) return std::nullopt;
  const auto buffers = file.root()["buffers"].items();
  file.buffers.resize(buffers.size());
  BufferLoader loader(file, diagnostics);
  for (std::size_t i = 0; i < buffers.size(); ++i) loader.load(i, buffers[i]);
  if (diagnostics.errors() != errors) return std::nullopt;
  return file;
}

File empty_file() {
  const std::string text =
      R"({"asset":{"version":"2.0","generator":"rigc"},"scene":0,"scenes":[{}]})";
  Diagnostics none;
  File file;
  file.whole = std::make_shared<const std::string>(text);
  auto json = json::parse(text, "", 0, none);
  assert(json);
  file.json = *std::move(json);
  return file;
}

}  // namespace rigc::gltf
