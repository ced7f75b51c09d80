// SPDX-License-Identifier: MIT
// Reads members of JSON objects into plain values. Test: tests/gltf/rig_json_test.cpp
#include "gltf/rig_json_reader.h"

#include <fmt/format.h>

#include <cmath>

#include "base/text.h"
#include "gltf/rig_codes.h"

namespace rigc::gltf {
namespace {

constexpr std::size_t kMostReported = 100;

}  // namespace

void JsonReader::fail(const Code& code, const json::Value& at, std::string message,
                      std::string hint) {
  // A pointer costs a walk over its siblings: a hostile file must not make that quadratic.
  if (errors_++ >= kMostReported) return;
  diagnostics_.report(code, Place(file_, at.pointer()), std::move(message), std::move(hint));
}

void JsonReader::warn(const Code& code, const json::Value& at, std::string message) {
  diagnostics_.report(code, Place(file_, at.pointer()), std::move(message));
}

json::Value JsonReader::member(const json::Value& object, std::string_view key, Need need) {
  const json::Value value = object[key];
  if (!value && need == Need::required)
    fail(codes::kRigType, object, fmt::format("\"{}\" is missing", key));
  return value;
}

bool JsonReader::read(const json::Value& value, bool& out) {
  const auto flag = value.boolean();
  if (!flag) return fail(codes::kRigType, value, "true or false is needed here"), false;
  out = *flag;
  return true;
}

bool JsonReader::read(const json::Value& value, double& out) {
  const auto number = value.number();
  if (!number) return fail(codes::kRigType, value, "a number is needed here"), false;
  if (std::abs(*number) > kLargestNumber)
    return fail(codes::kRigValue, value, "numbers of a rig are not above 1e30"), false;
  out = *number;
  return true;
}

bool JsonReader::read(const json::Value& value, std::string& out) {
  auto text = value.string();
  if (!text) return fail(codes::kRigType, value, "a string is needed here"), false;
  out = std::move(*text);
  return true;
}

bool JsonReader::numbers(const json::Value& value, double* out, std::size_t count) {
  std::vector<double> read_numbers;
  if (!value.is_array() || value.size() != count)
    return fail(codes::kRigValue, value, fmt::format("{} numbers are needed here", count)), false;
  if (!read(value, read_numbers)) return false;
  std::copy(read_numbers.begin(), read_numbers.end(), out);
  return true;
}

bool JsonReader::read(const json::Value& value, math::Vec3& out) {
  double n[3];
  if (!numbers(value, n, 3)) return false;
  out = {n[0], n[1], n[2]};
  return true;
}

bool JsonReader::read(const json::Value& value, math::Quat& out) {
  double n[4];
  if (!numbers(value, n, 4)) return false;
  out = {n[0], n[1], n[2], n[3]};
  if (!(math::dot(out, out) > 1e-12))
    return fail(codes::kRigValue, value, "the quaternion has length zero"), false;
  return true;
}

bool JsonReader::read(const json::Value& value, math::Affine& out) {
  double n[12];
  if (!numbers(value, n, 12)) return false;
  out.linear = {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}};
  out.origin = {n[9], n[10], n[11]};
  return true;
}

bool JsonReader::read(const json::Value& value, JointKey& out) {
  std::string text;
  if (!read(value, text)) return false;
  const auto key = parse_joint_key(text);
  if (!key)
    return fail(codes::kRigText, value,
                fmt::format("\"{}\" is no uid of a joint", printable(text))),
           false;
  out = *key;
  return true;
}

bool JsonReader::read(const json::Value& value, Identity& out) {
  std::string text;
  if (!read(value, text)) return false;
  auto identity = parse_identity(text);
  if (!identity)
    return fail(codes::kRigText, value, fmt::format("\"{}\" is no identity", printable(text))),
           false;
  out = std::move(*identity);
  return true;
}

bool JsonReader::read(const json::Value& value, std::vector<double>& out) {
  if (!value.is_array())
    return fail(codes::kRigType, value, "an array of numbers is needed here"), false;
  std::vector<double> list;
  list.reserve(value.size());
  for (const json::Value& item : value.items()) {
    double number = 0;
    if (!read(item, number)) return false;
    list.push_back(number);
  }
  out = std::move(list);
  return true;
}

bool JsonReader::read(const json::Value& value, std::vector<std::string>& out) {
  if (!value.is_array())
    return fail(codes::kRigType, value, "an array of strings is needed here"), false;
  std::vector<std::string> list;
  for (const json::Value& item : value.items()) {
    std::string text;
    if (!read(item, text)) return false;
    list.push_back(std::move(text));
  }
  out = std::move(list);
  return true;
}

bool JsonReader::spend(const json::Value& at, std::size_t count) {
  if (count <= room_) {
    room_ -= count;
    return true;
  }
  fail(codes::kRigTooLarge, at,
       fmt::format("rigs have more than {} tags, arguments and elements", kMostParts));
  return false;
}

bool JsonReader::whole(const json::Value& value, std::int64_t low, std::int64_t high,
                       std::int64_t& out) {
  const auto number = value.integer();
  if (!number) return fail(codes::kRigType, value, "a whole number is needed here"), false;
  if (*number < low || *number > high) {
    fail(codes::kRigIndex, value,
         low > high ? fmt::format("{} names nothing: there is nothing to name", *number)
                    : fmt::format("{} is not between {} and {}", *number, low, high));
    return false;
  }
  out = *number;
  return true;
}

std::vector<json::Value> JsonReader::items(const json::Value& object, std::string_view key) {
  const json::Value value = object[key];
  if (!value) return {};
  if (!value.is_array()) fail(codes::kRigType, value, "an array is needed here");
  return value.items();
}

std::vector<json::Value> JsonReader::objects(const json::Value& object, std::string_view key,
                                             std::size_t most, Need need) {
  if (!member(object, key, need)) return {};
  std::vector<json::Value> list = items(object, key);
  if (list.size() > most) {
    fail(codes::kRigTooLarge, object[key],
         fmt::format("{} elements; at most {} are allowed", list.size(), most));
    return {};
  }
  if (!spend(object[key], list.size())) return {};
  for (const json::Value& item : list) {
    if (item.is_object()) continue;
    fail(codes::kRigType, item, "an object is needed here");
    return {};
  }
  return list;
}

std::vector<std::pair<std::string, json::Value>> JsonReader::members(const json::Value& object,
                                                                     std::string_view key) {
  const json::Value value = object[key];
  if (!value) return {};
  if (!value.is_object()) fail(codes::kRigType, value, "an object is needed here");
  return value.members();
}

}  // namespace rigc::gltf
