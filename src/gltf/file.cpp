// SPDX-License-Identifier: MIT
// Opens a file: container, JSON, checks, buffers.
// Test: tests/gltf/file_test.cpp
#include "gltf/file.h"

#include <fmt/format.h>

#include <cassert>
#include <map>

#include "base/codes.h"
#include "base/text.h"
#include "base/trace.h"
#include "gltf/check.h"
#include "gltf/codes.h"
#include "gltf/container.h"
#include "gltf/uri.h"

namespace rigc::gltf {
namespace {

/// Loads buffers; a file that several of them name is read once.
class BufferLoader {
 public:
  BufferLoader(File& file, OtherFiles others, Diagnostics& diagnostics)
      : file_(file), others_(others), diagnostics_(diagnostics) {}

  void load(std::size_t index, const json::Value& value) {
    index_ = index;
    Buffer& buffer = file_.buffers[index];
    const auto length = static_cast<std::uint64_t>(value["byteLength"].integer().value_or(0));
    if (value["uri"]) {
      buffer.uri = value["uri"].string().value_or("");
      if (others_ == OtherFiles::left_alone && !is_data_uri(buffer.uri)) return;
      auto bytes = read_uri(buffer.uri);
      if (!bytes) return;
      buffer.bytes = *std::move(bytes);
    } else if (index == 0 && file_.bin) {
      buffer.bytes = *file_.bin;
    } else {
      return;
    }
    if (buffer.bytes.size() < length)
      report(codes::kBufferShort,
             fmt::format("buffer {} has {} bytes of {}", index, buffer.bytes.size(), length));
    else
      buffer.bytes = buffer.bytes.part(0, length);
  }

 private:
  std::nullopt_t report(const Code& code, std::string message) {
    diagnostics_.report(code, Place(file_.path, fmt::format("/buffers/{}", index_)),
                        std::move(message));
    return std::nullopt;
  }

  /// The bytes that a URI names; nothing where that was reported.
  std::optional<Bytes> read_uri(const std::string& uri) {
    if (is_data_uri(uri)) {
      auto bytes = data_uri_bytes(uri);
      if (!bytes) return report(codes::kBufferUri, "the data URI is broken");
      return Bytes(*std::move(bytes));
    }
    const auto name = percent_decoded(uri);
    if (!name || name->empty() || is_absolute_uri(uri))
      return report(codes::kBufferUri,
                    fmt::format("\"{}\" is no path beside the file", printable(uri, 80)));
    const auto path = confine(folder_of(file_.path), *name);
    if (!path)
      return report(codes::kBufferEscapes,
                    fmt::format("\"{}\" leaves the folder of the file", printable(*name, 80)));
    auto [known, is_new] = read_.try_emplace(*path);
    if (is_new) known->second = open_file(*path, *name);
    return known->second;
  }

  /// What is wrong with a buffer's file is said of the buffer: people look for it in the model.
  std::optional<Bytes> open_file(const std::string& path, const std::string& name) {
    Diagnostics opening;
    auto bytes = Bytes::open(path, kLargestFile, opening);
    for (const Diagnostic& wrong : opening.all()) {
      const bool special = wrong.code == &rigc::codes::kNotRegularFile;
      report(special ? codes::kBufferNotFile : *wrong.code,
             fmt::format("\"{}\": {}", printable(name, 80), wrong.message));
    }
    return bytes;
  }

  File& file_;
  OtherFiles others_;
  Diagnostics& diagnostics_;
  std::size_t index_ = 0;
  std::map<std::string, std::optional<Bytes>> read_;  ///< by resolved path
};

}  // namespace

std::optional<File> open(const std::string& path, Diagnostics& diagnostics) {
  const trace::Span span("read file");
  auto bytes = Bytes::open(path, kLargestFile, diagnostics);
  if (!bytes) return std::nullopt;
  return open(path, *std::move(bytes), diagnostics);
}

std::optional<File> open(const std::string& path, Bytes bytes, Diagnostics& diagnostics,
                         OtherFiles others) {
  const std::size_t errors = diagnostics.errors();
  File file;
  file.path = path;
  file.whole = std::move(bytes);
  auto container = read_container(file.whole, path, diagnostics);
  if (!container) return std::nullopt;
  file.binary = container->binary;
  file.bin = std::move(container->bin);
  file.other_chunks = std::move(container->other_chunks);
  auto text = container->json.text(diagnostics);
  if (!text) return std::nullopt;
  auto json = json::parse(*std::move(text), path, container->json_offset, diagnostics);
  if (!json) return std::nullopt;
  file.json = *std::move(json);
  check(file, diagnostics);
  if (diagnostics.errors() != errors) return std::nullopt;
  const auto buffers = file.root()["buffers"].items();
  file.buffers.resize(buffers.size());
  BufferLoader loader(file, others, diagnostics);
  for (std::size_t i = 0; i < buffers.size(); ++i) loader.load(i, buffers[i]);
  if (diagnostics.errors() != errors) return std::nullopt;
  return file;
}

File empty_file() {
  const std::string text =
      R"({"asset":{"version":"2.0","generator":"rigc"},"scene":0,"scenes":[{}]})";
  Diagnostics none;
  File file;
  file.whole = Bytes(std::string(text));
  auto json = json::parse(text, "", 0, none);
  assert(json);
  file.json = *std::move(json);
  return file;
}

}  // namespace rigc::gltf
