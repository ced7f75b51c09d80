// SPDX-License-Identifier: MIT
// Opens a file: container, JSON, checks, buffers.
// Test: tests/gltf/file_test.cpp
#include "gltf/file.h"

#include <fmt/format.h>

#include <cassert>

#include "base/text.h"
#include "gltf/check.h"
#include "gltf/codes.h"
#include "gltf/container.h"
#include "gltf/uri.h"

namespace rigc::gltf {
namespace {

constexpr std::uint64_t kLargest = std::uint64_t{8} << 30;

void report(const File& file, const Code& code, const json::Value& at, std::string message,
            Diagnostics& diagnostics, std::string hint = {}) {
  diagnostics.report(code, Place(file.path, at.pointer()), std::move(message), std::move(hint));
}

/// The bytes that a buffer's URI names; nothing where that was reported.
Bytes read_uri(const File& file, const json::Value& at, const std::string& uri,
               Diagnostics& diagnostics) {
  if (is_data_uri(uri)) {
    auto bytes = data_uri_bytes(uri);
    if (!bytes) {
      report(file, codes::kBufferUri, at, "the data URI is not valid base64", diagnostics);
      return nullptr;
    }
    return std::make_shared<const std::string>(*std::move(bytes));
  }
  const auto name = percent_decoded(uri);
  if (!name || name->empty() || is_absolute_uri(uri)) {
    report(file, codes::kBufferUri, at,
           fmt::format("\"{}\" is no path beside the file", printable(uri, 80)), diagnostics);
    return nullptr;
  }
  const auto path = confine(folder_of(file.path), *name);
  if (!path) {
    report(file, codes::kBufferEscapes, at,
           fmt::format("\"{}\" leaves the folder of the file", printable(*name, 80)), diagnostics);
    return nullptr;
  }
  auto bytes = read_file(*path, kLargest, diagnostics);
  return bytes ? std::make_shared<const std::string>(*std::move(bytes)) : nullptr;
}

void load_buffer(File& file, std::size_t index, const json::Value& value,
                 Diagnostics& diagnostics) {
  Buffer& buffer = file.buffers[index];
  const auto length = static_cast<std::uint64_t>(value["byteLength"].integer().value_or(0));
  if (value["uri"]) {
    buffer.uri = value["uri"].string().value_or("");
    buffer.storage = read_uri(file, value["uri"], buffer.uri, diagnostics);
    if (!buffer.storage) return;
    buffer.bytes = *buffer.storage;
  } else if (index == 0 && file.bin.data()) {
    buffer.storage = file.whole;
    buffer.bytes = file.bin;
  } else {
    return;
  }
  if (buffer.bytes.size() < length)
    report(file, codes::kBufferShort, value,
           fmt::format("buffer {} has {} bytes of {}", index, buffer.bytes.size(), length),
           diagnostics);
  else
    buffer.bytes = buffer.bytes.substr(0, length);
}

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
  for (std::size_t i = 0; i < buffers.size(); ++i) load_buffer(file, i, buffers[i], diagnostics);
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
