// SPDX-License-Identifier: MIT
// Checks of a parsed file: everything that later stages rely on and that the glTF schema or
// specification promises. One file a theme; check.cpp names them in order. Test:
// tests/gltf/file_test.cpp
#pragma once

#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gltf/file.h"

namespace rigc::gltf {

/// Reports every error of the JSON (not of the buffers' bytes).
void check(const File& file, Diagnostics& diagnostics);

/// Properties of an accessor that others depend on; 0 and false where they are wrong. Read once: an
/// object of a hostile file may have a million members, and a million others may refer to it.
struct AccessorFacts {
  std::int64_t count = 0;
  std::int64_t component = 0;
  std::string type;
  bool normalised = false;
  bool is_real(std::string_view wanted) const { return component == 5126 && type == wanted; }
};

/// The same of a buffer view.
struct ViewFacts {
  std::int64_t length = 0;
  std::int64_t stride = 0;  ///< 0: not given
  bool stride_ok() const { return stride >= 0 && stride <= 252 && stride % 4 == 0; }
};

/// What the checks share: the top-level arrays and lookups that report what is wrong.
class Check {
 public:
  Check(const File& file, Diagnostics& diagnostics);

  const std::vector<json::Value>& elements(std::string_view array) const;
  const std::vector<AccessorFacts>& accessors() const { return accessors_; }
  const std::vector<ViewFacts>& views() const { return views_; }
  void report(const Code& code, const json::Value& at, std::string message, std::string hint = {});
  void report(const Code& code, Place place, std::string message, std::string hint = {});

  /// An array of objects inside an object; missing is empty.
  std::vector<json::Value> objects(const json::Value& object, std::string_view key);
  /// A whole number of at least `least`; reported and empty where it is wrong, or missing and
  /// required.
  std::optional<std::int64_t> whole(const json::Value& object, std::string_view key,
                                    std::int64_t least, bool required = false);
  /// An index into a top-level array, like whole().
  std::optional<std::size_t> index(const json::Value& object, std::string_view key,
                                   std::string_view array, bool required = false);
  /// An array of indices; wrong ones are reported and left out.
  std::vector<std::size_t> indices(const json::Value& object, std::string_view key,
                                   std::string_view array);
  /// One of some words; empty where it is missing or wrong.
  std::optional<std::string> word(const json::Value& object, std::string_view key,
                                  std::initializer_list<std::string_view> allowed,
                                  bool required = false);

  /// A value as an index into a top-level array.
  std::optional<std::size_t> in_range(const json::Value& value, std::string_view array);

 private:
  const File& file_;
  Diagnostics& diagnostics_;
  std::map<std::string, std::vector<json::Value>, std::less<>> arrays_;
  std::vector<AccessorFacts> accessors_;
  std::vector<ViewFacts> views_;
};

void check_nodes(Check& check);
void check_skins(Check& check);
void check_buffer_views(Check& check);
void check_accessors(Check& check);
void check_animations(Check& check);

/// Bytes of one element of an accessor with the padding of matrix columns; 0 where it is malformed.
std::size_t element_size(std::string_view type, std::int64_t component_type);
/// Numbers in one element; 0 for an unknown type.
std::size_t component_count(std::string_view type);
/// Bytes of a component; 0 for an unknown type.
std::size_t component_size(std::int64_t component_type);

}  // namespace rigc::gltf
