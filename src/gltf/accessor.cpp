// SPDX-License-Identifier: MIT
// Reads accessors; their ranges were checked when the file was opened.
// Test: tests/gltf/clips_test.cpp
#include "gltf/accessor.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "gltf/check.h"
#include "gltf/codes.h"

namespace rigc::gltf {
namespace {

/// Zeros take no bytes in a file, so its size does not bound them.
constexpr std::uint64_t kMostZeros = std::uint64_t{1} << 24;

class Reader {
 public:
  Reader(const File& file, const Slim& slim, int accessor, Diagnostics& diagnostics)
      : file_(file), slim_(slim), index_(accessor), diagnostics_(diagnostics) {}

  std::optional<std::vector<float>> read(std::uint64_t count) {
    const SlimAccessor& accessor = slim_.accessors[static_cast<std::size_t>(index_)];
    const auto width = static_cast<std::size_t>(accessor.width);
    if (accessor.view < 0 && count > kMostZeros / width)
      return fail(codes::kNoData, "has no buffer view and is too long to be all zeros");
    std::vector<float> values(count * width, 0.0f);
    if (accessor.view >= 0) {
      const auto bytes = view_bytes(accessor.view);
      if (!bytes) return std::nullopt;
      const std::size_t size = component_size(accessor.component) * width;
      const std::uint64_t given = slim_.views[static_cast<std::size_t>(accessor.view)].stride;
      const std::uint64_t stride = given != 0 ? given : size;
      for (std::uint64_t i = 0; i < count; ++i)
        element(bytes->data() + accessor.offset + i * stride, &values[i * width]);
    }
    if (accessor.sparse.count != 0 && !read_sparse(values, count)) return std::nullopt;
    for (float value : values)
      if (!std::isfinite(value)) return fail(codes::kNotFinite, "has NaN or infinite numbers");
    return values;
  }

 private:
  std::nullopt_t fail(const Code& code, const std::string& what) {
    diagnostics_.report(code, Place(file_.path, fmt::format("/accessors/{}", index_)),
                        fmt::format("accessor {} {}", index_, what));
    return std::nullopt;
  }

  /// The bytes of a view; reported where an extension holds them or the buffer is not there.
  std::optional<std::string_view> view_bytes(int index) {
    const SlimView& view = slim_.views[static_cast<std::size_t>(index)];
    const std::string_view bytes = file_.buffers[static_cast<std::size_t>(view.buffer)].bytes;
    if (bytes.empty()) return fail(codes::kNoData, "has its data in a buffer without bytes");
    return bytes.substr(view.offset, view.length);
  }

  template <class T>
  static float number(const char* bytes, bool normalised) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    const auto result = static_cast<float>(value);
    if (!normalised) return result;
    return std::max(result / static_cast<float>(std::numeric_limits<T>::max()), -1.0f);
  }

  float component(const char* bytes) const {
    const SlimAccessor& accessor = slim_.accessors[static_cast<std::size_t>(index_)];
    switch (accessor.component) {
      case 5120:
        return number<std::int8_t>(bytes, accessor.normalised);
      case 5121:
        return number<std::uint8_t>(bytes, accessor.normalised);
      case 5122:
        return number<std::int16_t>(bytes, accessor.normalised);
      case 5123:
        return number<std::uint16_t>(bytes, accessor.normalised);
      case 5125:
        return number<std::uint32_t>(bytes, false);
      default:
        return number<float>(bytes, false);
    }
  }

  void element(const char* bytes, float* out) const {
    const SlimAccessor& accessor = slim_.accessors[static_cast<std::size_t>(index_)];
    const std::size_t size = component_size(accessor.component);
    for (int i = 0; i < accessor.width; ++i) out[i] = component(bytes + size * i);
  }

  static std::uint64_t sparse_index(const char* bytes, int component) {
    std::uint64_t index = 0;
    for (std::size_t i = component_size(component); i-- > 0;)
      index = index << 8 | static_cast<unsigned char>(bytes[i]);
    return index;
  }

  bool read_sparse(std::vector<float>& values, std::uint64_t count) {
    const SlimAccessor& accessor = slim_.accessors[static_cast<std::size_t>(index_)];
    const SlimAccessor::Sparse& sparse = accessor.sparse;
    const auto indices = view_bytes(sparse.index_view);
    const auto elements = view_bytes(sparse.value_view);
    if (!indices || !elements) return false;
    const auto width = static_cast<std::size_t>(accessor.width);
    const std::size_t size = component_size(accessor.component) * width;
    const std::size_t index_size = component_size(sparse.index_component);
    std::optional<std::uint64_t> last;
    for (std::uint64_t i = 0; i < sparse.count; ++i) {
      const char* at = indices->data() + sparse.index_offset + i * index_size;
      const std::uint64_t index = sparse_index(at, sparse.index_component);
      if (index >= accessor.count || (last && index <= *last)) {
        fail(codes::kSparse, "has sparse indices that do not rise or lie beyond its end");
        return false;
      }
      last = index;
      if (index < count)
        element(elements->data() + sparse.value_offset + i * size, &values[index * width]);
    }
    return true;
  }

  const File& file_;
  const Slim& slim_;
  int index_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::optional<std::vector<float>> read_floats(const File& file, const Slim& slim, int accessor,
                                              std::uint64_t count, Diagnostics& diagnostics) {
  return Reader(file, slim, accessor, diagnostics).read(count);
}

}  // namespace rigc::gltf
