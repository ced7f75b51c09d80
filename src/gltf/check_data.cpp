// SPDX-License-Identifier: MIT
// Checks of buffer views and accessors: nothing reaches beyond what holds it.
// Test: tests/gltf/file_test.cpp
#include <fmt/format.h>

#include "base/text.h"
#include "gltf/check.h"
#include "gltf/codes.h"

namespace rigc::gltf {
namespace {

/// Whether `count` elements of `size` bytes, `stride` apart, lie inside `length` bytes from
/// `offset`.
bool fits(std::int64_t offset, std::int64_t count, std::int64_t stride, std::int64_t size,
          std::int64_t length) {
  if (offset > length || length - offset < size) return false;
  return count - 1 <= (length - offset - size) / stride;
}

/// The data of one accessor, or of one half of a sparse one, inside its view.
void check_range(Check& check, const json::Value& holder, std::size_t view_index,
                 std::int64_t count, std::size_t size, bool strided) {
  const ViewFacts& view = check.views()[view_index];
  const auto bytes = static_cast<std::int64_t>(size);
  const std::int64_t stride = strided && view.stride != 0 ? view.stride : bytes;
  const std::int64_t offset = holder["byteOffset"].integer().value_or(0);
  if (!view.stride_ok() || view.length < 1 || offset < 0) return;  // reported where it stands
  if (stride < bytes)
    check.report(codes::kStride, holder,
                 fmt::format("byteStride {} of buffer view {} is below the {} bytes of an element",
                             stride, view_index, bytes));
  else if (!fits(offset, count, stride, bytes, view.length))
    check.report(codes::kAccessorRange, holder,
                 fmt::format("{} elements of {} bytes from byte {} do not lie inside the {} bytes "
                             "of buffer view {}",
                             count, size, offset, view.length, view_index));
}

void check_sparse(Check& check, const json::Value& accessor, std::size_t size) {
  const json::Value sparse = accessor["sparse"];
  if (!sparse) return;
  const auto count = check.whole(sparse, "count", 1, true);
  const std::int64_t all = accessor["count"].integer().value_or(0);
  if (count && *count > all)
    check.report(codes::kSparse, sparse["count"],
                 fmt::format("{} sparse elements in an accessor of {}", *count, all));
  for (const char* key : {"indices", "values"}) {
    const json::Value half = sparse[key];
    if (!half) {
      check.report(codes::kMissing, sparse, fmt::format("\"{}\" is missing", key));
      continue;
    }
    const bool is_indices = std::string_view(key) == "indices";
    std::size_t bytes = size;
    if (is_indices) {
      const auto type = check.whole(half, "componentType", 0, true);
      bytes = type == 5121 || type == 5123 || type == 5125 ? component_size(*type) : 0;
      if (type && bytes == 0)
        check.report(codes::kValue, half["componentType"],
                     fmt::format("{} is no type of sparse indices", *type));
    }
    check.whole(half, "byteOffset", 0);
    const auto view = check.index(half, "bufferView", "bufferViews", true);
    if (view && count && bytes != 0) check_range(check, half, *view, *count, bytes, false);
  }
}

}  // namespace

std::size_t component_count(std::string_view type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  if (type == "VEC4" || type == "MAT2") return 4;
  if (type == "MAT3") return 9;
  return type == "MAT4" ? 16 : 0;
}

std::size_t component_size(std::int64_t component_type) {
  switch (component_type) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      return 0;
  }
}

std::size_t element_size(std::string_view type, std::int64_t component_type) {
  const std::size_t bytes = component_size(component_type);
  // Columns of matrices begin at multiples of 4 bytes.
  if (type == "MAT2" && bytes == 1) return 8;
  if (type == "MAT3" && bytes < 4) return bytes * 12;
  return bytes * component_count(type);
}

void check_buffer_views(Check& check) {
  std::vector<std::int64_t> lengths;
  for (const json::Value& buffer : check.elements("buffers")) {
    lengths.push_back(check.whole(buffer, "byteLength", 1, true).value_or(0));
    if (buffer["uri"] && !buffer["uri"].is_string())
      check.report(codes::kWrongType, buffer["uri"], "\"uri\" is not a string");
  }
  for (const json::Value& view : check.elements("bufferViews")) {
    const auto buffer = check.index(view, "buffer", "buffers", true);
    const auto length = check.whole(view, "byteLength", 1, true);
    const auto offset = check.whole(view, "byteOffset", 0).value_or(0);
    const auto stride = check.whole(view, "byteStride", 0);
    if (stride && (*stride == 0 || !ViewFacts{0, *stride}.stride_ok()))
      check.report(codes::kStride, view["byteStride"], fmt::format("byteStride is {}", *stride));
    if (!buffer || !length) continue;
    const std::int64_t all = lengths[*buffer];
    if (all > 0 && !fits(offset, 1, 1, *length, all))
      check.report(codes::kViewRange, view,
                   fmt::format("{} bytes from byte {} do not lie inside the {} bytes of buffer {}",
                               *length, offset, all, *buffer));
  }
}

void check_accessors(Check& check) {
  for (const json::Value& accessor : check.elements("accessors")) {
    const auto count = check.whole(accessor, "count", 1, true);
    const auto component = check.whole(accessor, "componentType", 0, true);
    if (component && component_size(*component) == 0)
      check.report(codes::kValue, accessor["componentType"],
                   fmt::format("{} is no component type", *component));
    check.word(accessor, "type", {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"}, true);
    check.whole(accessor, "byteOffset", 0);
    const std::size_t size =
        element_size(accessor["type"].string().value_or(""), component.value_or(0));
    const auto view = check.index(accessor, "bufferView", "bufferViews");
    if (view && count && size != 0) check_range(check, accessor, *view, *count, size, true);
    check_sparse(check, accessor, size);
  }
}

}  // namespace rigc::gltf
