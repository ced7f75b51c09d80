// SPDX-License-Identifier: MIT
// What the tests of src/gltf share: a small valid model, files on disk, the corpus.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gltf/file.h"
#include "gltf/patch.h"

namespace rigc::gltf::test {

/// Every .glb, .gltf, .vrm and .vrma of the corpus, sorted; empty where there is no corpus.
std::vector<std::string> corpus();
/// One of them by its folder; empty where there is none.
std::string corpus_file(std::string_view folder);

/// A fresh folder below RIGC_TEST_OUT. What lies in a folder `broken` is not shown to the Khronos
/// validator.
std::string make_folder(const std::string& name);
void write_bytes(const std::string& path, std::string_view bytes);
/// Writes an output with its extra files into a folder and copies what it refers to from
/// `source_folder`.
std::string write_output(const Output& output, const std::string& path,
                         const std::string& source_folder);
/// All of some bytes, wherever they are.
std::string text(const Bytes& bytes);
std::string whole(const Output& output);
/// Tells the validator that `path` may have the complaints that `model` has.
void allow_messages_of(const std::string& path, const std::string& model);

/// Opens a text as a file in a folder of the test's.
std::optional<File> open_text(const std::string& text, Diagnostics& diagnostics);
/// A .glb of JSON and BIN with correct header and padding.
std::string glb(std::string json, std::string bin);

/// Numbers of the errors and warnings, in the order reported.
std::vector<int> numbers(const Diagnostics& diagnostics);

/// Little-endian floats.
std::string floats(const std::vector<float>& values);
std::string data_uri(std::string_view bytes);

/// A model with two joints, a skin, a mesh and a clip, whose buffer is a data URI. Valid; tests
/// spoil parts of it.
std::string small_model();
/// `text` with the only occurrence of `from` replaced; fails the test where there is not exactly
/// one.
std::string replaced(std::string text, std::string_view from, std::string_view to);

}  // namespace rigc::gltf::test
