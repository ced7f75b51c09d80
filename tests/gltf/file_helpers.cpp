// SPDX-License-Identifier: MIT
// What the tests of src/gltf share.
#include "file_helpers.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "gltf/uri.h"

namespace rigc::gltf::test {
namespace fs = std::filesystem;
namespace {

std::string corpus_folder() {
  const char* given = std::getenv("RIGC_CORPUS");
  return given ? given : std::string(RIGC_SOURCE_DIR) + "/../shared/corpus";
}

void append_uint32(std::string& out, std::size_t value) {
  for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(value >> shift & 255);
}

}  // namespace

std::vector<std::string> corpus() {
  std::vector<std::string> files;
  if (!fs::is_directory(corpus_folder())) return files;
  for (const auto& entry : fs::recursive_directory_iterator(corpus_folder())) {
    const std::string extension = entry.path().extension();
    if (extension == ".glb" || extension == ".gltf" || extension == ".vrm" || extension == ".vrma")
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string corpus_file(std::string_view folder) {
  for (const std::string& path : corpus())
    if (path.find("/" + std::string(folder) + "/") != std::string::npos) return path;
  return {};
}

std::string make_folder(const std::string& name) {
  const std::string path = std::string(RIGC_TEST_OUT) + "/gltf/" + name;
  fs::remove_all(path);
  fs::create_directories(path);
  return path;
}

void write_bytes(const std::string& path, std::string_view bytes) {
  std::ofstream stream(path, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  REQUIRE(stream.good());
}

std::string write_output(const Output& output, const std::string& path,
                         const std::string& source_folder) {
  const std::string folder = folder_of(path);
  for (const ExtraFile& file : output.extra_files)
    write_bytes(join_path(folder, file.name), text(file.bytes));
  for (const std::string& name : output.copies) {
    const fs::path target = fs::path(folder) / name;
    fs::create_directories(target.parent_path());
    if (fs::exists(fs::path(source_folder) / name) && folder != source_folder)
      fs::copy_file(fs::path(source_folder) / name, target, fs::copy_options::overwrite_existing);
  }
  write_bytes(path, whole(output));
  return path;
}

void allow_messages_of(const std::string& path, const std::string& model) {
  write_bytes(path + ".model", fs::absolute(model).string() + "\n");
}

std::string text(const Bytes& bytes) {
  Diagnostics diagnostics;
  const auto read = bytes.text(diagnostics);
  REQUIRE(read);
  return *read;
}

std::string whole(const Output& output) {
  std::string bytes;
  for (const Bytes& piece : output.pieces) bytes += text(piece);
  return bytes;
}

std::optional<File> open_text(const std::string& text, Diagnostics& diagnostics) {
  const std::string path = make_folder("broken/text") + "/model.gltf";
  write_bytes(path, text);
  return gltf::open(path, diagnostics);
}

std::string glb(std::string json, std::string bin) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  bin.resize((bin.size() + 3) / 4 * 4, '\0');
  std::string out = "glTF";
  append_uint32(out, 2);
  append_uint32(out, 20 + json.size() + (bin.empty() ? 0 : 8 + bin.size()));
  append_uint32(out, json.size());
  out += "JSON" + json;
  if (bin.empty()) return out;
  append_uint32(out, bin.size());
  out.append("BIN\0", 4);
  return out + bin;
}

std::vector<int> numbers(const Diagnostics& diagnostics) {
  std::vector<int> list;
  for (const Diagnostic& diagnostic : diagnostics.all()) list.push_back(diagnostic.code->number);
  return list;
}

std::string floats(const std::vector<float>& values) {
  std::string bytes(values.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

std::string data_uri(std::string_view bytes) {
  return "data:application/octet-stream;base64," + base64(bytes);
}

std::string small_model() {
  // Views: 0 inverse bind matrices (128 bytes), 1 times (8), 2 rotations (32), 3 positions (36).
  std::string bytes = floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,
                              1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1});
  bytes += floats({0, 1}) + floats({0, 0, 0, 1, 0, 0, 1, 0}) + floats({0, 0, 0, 1, 0, 0, 0, 1, 0});
  return R"({
  "asset": {"version": "2.0"},
  "scene": 0,
  "scenes": [{"nodes": [0, 2]}],
  "nodes": [
    {"name": "root", "children": [1], "translation": [0, 0, 0]},
    {"name": "tip", "translation": [0, 1, 0], "rotation": [0, 0, 0, 1]},
    {"name": "body", "mesh": 0, "skin": 0}
  ],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 3}}]}],
  "skins": [{"joints": [0, 1], "inverseBindMatrices": 0}],
  "animations": [{
    "name": "turn",
    "channels": [{"sampler": 0, "target": {"node": 1, "path": "rotation"}}],
    "samplers": [{"input": 1, "output": 2, "interpolation": "LINEAR"}]
  }],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 2, "type": "MAT4"},
    {"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
    {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC4"},
    {"bufferView": 3, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}
  ],
  "bufferViews": [
    {"buffer": 0, "byteLength": 128},
    {"buffer": 0, "byteOffset": 128, "byteLength": 8},
    {"buffer": 0, "byteOffset": 136, "byteLength": 32},
    {"buffer": 0, "byteOffset": 168, "byteLength": 36}
  ],
  "buffers": [{"byteLength": 204, "uri": ")" +
         data_uri(bytes) + R"("}]
}
)";
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  INFO(from);
  REQUIRE(at != std::string::npos);
  REQUIRE(text.find(from, at + 1) == std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace rigc::gltf::test
