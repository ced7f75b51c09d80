// SPDX-License-Identifier: MIT
// Reads members of JSON objects into plain values and reports what does not fit, with JSON
// pointers. Test: tests/gltf/rig_json_test.cpp
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "base/json.h"
#include "math/math.h"

namespace rigc::gltf {

/// The largest number that a rig may have: what 32-bit floats hold, with room to calculate.
inline constexpr double kLargestNumber = 1e30;

/// Tags, commands, arguments, elements of arrays and the like in all rigs of a file: they take up
/// to a hundred times their shortest text.
inline constexpr std::size_t kMostParts = std::size_t{1} << 18;

enum class Need : std::uint8_t { optional, required };

/// Each function gives false, and leaves `out`, where it reported an error or the member is
/// missing.
class JsonReader {
 public:
  JsonReader(std::string file, Diagnostics& diagnostics, std::size_t room = kMostParts)
      : file_(std::move(file)), diagnostics_(diagnostics), room_(room) {}

  bool ok() const { return errors_ == 0; }
  Diagnostics& diagnostics() { return diagnostics_; }
  /// Reports the first hundred errors of this reader; the others only count.
  void fail(const Code& code, const json::Value& at, std::string message, std::string hint = {});
  void warn(const Code& code, const json::Value& at, std::string message);

  bool read(const json::Value& value, bool& out);
  bool read(const json::Value& value, double& out);
  bool read(const json::Value& value, std::string& out);
  bool read(const json::Value& value, math::Vec3& out);
  bool read(const json::Value& value, math::Quat& out);
  bool read(const json::Value& value,
            math::Affine& out);  ///< 12 numbers: columns x, y, z, then the origin
  bool read(const json::Value& value, JointKey& out);
  bool read(const json::Value& value, Identity& out);
  bool read(const json::Value& value, std::vector<double>& out);
  bool read(const json::Value& value, std::vector<std::string>& out);
  /// Whether there is room for `count` more parts of rigs. Too many are reported, once.
  bool spend(const json::Value& at, std::size_t count);
  /// How many more there is room for.
  std::size_t room() const { return room_; }
  /// A whole number in `low`..`high`.
  bool whole(const json::Value& value, std::int64_t low, std::int64_t high, std::int64_t& out);

  template <class T>
  bool get(const json::Value& object, std::string_view key, T& out, Need need = Need::optional) {
    const json::Value value = member(object, key, need);
    return value && read(value, out);
  }
  /// A whole number in `low`..`high`.
  template <class T>
  bool get(const json::Value& object, std::string_view key, std::int64_t low, std::int64_t high,
           T& out, Need need = Need::optional) {
    const json::Value value = member(object, key, need);
    std::int64_t number = 0;
    if (!value || !whole(value, low, high, number)) return false;
    out = static_cast<T>(number);
    return true;
  }
  /// Elements of an array, all of them objects; more than `most` are an error.
  std::vector<json::Value> objects(const json::Value& object, std::string_view key,
                                   std::size_t most, Need need = Need::optional);
  /// Elements of an array; empty where it is missing.
  std::vector<json::Value> items(const json::Value& object, std::string_view key);
  std::vector<std::pair<std::string, json::Value>> members(const json::Value& object,
                                                           std::string_view key);

 private:
  json::Value member(const json::Value& object, std::string_view key, Need need);
  bool numbers(const json::Value& value, double* out, std::size_t count);

  std::string file_;
  Diagnostics& diagnostics_;
  std::size_t errors_ = 0;
  std::size_t room_;
};

}  // namespace rigc::gltf
