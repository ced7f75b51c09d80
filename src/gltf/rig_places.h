// SPDX-License-Identifier: MIT
// Places in template files as RIGC_rig keeps them: a list of file names, and [file, line, column].
// Test: tests/gltf/rig_json_test.cpp
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/json.h"
#include "base/span.h"
#include "gltf/rig_json_reader.h"
#include "tags/tags.h"

namespace rigc::gltf {

/// Template files as the templates name each other, without the folder that the main one lies in.
std::vector<std::string> reference_names(const std::vector<tags::TemplateReference>& templates);

/// The longest reference that a file's name ends with, else the name without folders: nothing that
/// says where on a disk a rig was built.
std::string portable_name(std::string_view file, const std::vector<std::string>& references);

/// Names of files in the order they are first needed.
class PlaceWriter {
 public:
  PlaceWriter(const Sources& sources, std::vector<std::string> references)
      : sources_(sources), references_(std::move(references)) {}
  /// `"at": [file, line, column]` where the span is known.
  void write(json::Writer& writer, const Span& span);
  /// `"at": [file, line]` where the name is not empty.
  void write(json::Writer& writer, const std::string& file, int line);
  const std::vector<std::string>& files() const { return files_; }

 private:
  int number(std::string_view file);
  const Sources& sources_;
  std::vector<std::string> references_;
  std::map<std::string, int, std::less<>> numbers_;
  std::vector<std::string> files_;
};

class PlaceReader {
 public:
  /// Reads `files` of a rig and adds each to the sources, without text. `rig_file`: the file that
  /// the rig is in, where nodes shall say that they come from it.
  PlaceReader(const json::Value& rig, JsonReader& reader, const std::string& rig_file = {});
  Span read(const json::Value& object);
  void read(const json::Value& object, std::string& file, int& line);
  /// The place of node `index`: where its command stands in a template, or where it stands in the
  /// rig's file.
  Span read_node(const json::Value& object, std::size_t index);

 private:
  bool numbers(const json::Value& object, std::size_t count, std::int64_t* out);
  JsonReader& reader_;
  std::vector<std::string> files_;
  std::vector<std::uint32_t> sources_;
  std::string rig_place_;  ///< `shot.glb#/extensions/RIGC_rig/rigs/0`; empty: templates count
};

}  // namespace rigc::gltf
