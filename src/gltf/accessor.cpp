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
constexpr std::uint64_t kBlock = std::uint64_t{1} << 16;

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
      const std::size_t size = component_size(accessor.component) * width;
      const std::uint64_t given = slim_.views[static_cast<std::size_t>(accessor.view)].stride;
      const bool good =
          for_each(accessor.view, accessor.offset, given != 0 ? given : size, size, count,
                   [&](std::uint64_t i, const char* at) { element(at, &values[i * width]); });
      if (!good) return std::nullopt;
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
  std::optional<Bytes> view_bytes(int index) {
    const SlimView& view = slim_.views[static_cast<std::size_t>(index)];
    const Bytes& bytes = file_.buffers[static_cast<std::size_t>(view.buffer)].bytes;
    if (bytes.empty() || view.unfilled)
      return fail(codes::kNoData, "has its data in a buffer without bytes");
    return bytes.part(view.offset, view.length);
  }

  /// Calls `use(i, bytes)` for `count` elements of `size` bytes in a view, `stride` apart, which
  /// are read in blocks; false where they could not be, which is reported.
  template <class Use>
  bool for_each(int view, std::uint64_t offset, std::uint64_t stride, std::size_t size,
                std::uint64_t count, const Use& use) {
    const auto bytes = view_bytes(view);
    if (!bytes) return false;
    std::string block;
    for (std::uint64_t first = 0; first < count;) {
      const std::uint64_t end =
          std::min(count, first + std::max<std::uint64_t>(kBlock / stride, 1));
      block.resize((end - first - 1) * stride + size);
      if (!bytes->read(offset + first * stride, block.size(), block.data(), diagnostics_))
        return false;
      for (const char* at = block.data(); first < end; ++first, at += stride) use(first, at);
    }
    return true;
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
    const auto width = static_cast<std::size_t>(accessor.width);
    const std::size_t size = component_size(accessor.component) * width;
    const std::size_t index_size = component_size(sparse.index_component);
    std::vector<std::uint64_t> indices;
    bool rising = true;
    const bool good = for_each(
        sparse.index_view, sparse.index_offset, index_size, index_size, sparse.count,
        [&](std::uint64_t, const char* at) {
          const std::uint64_t index = sparse_index(at, sparse.index_component);
          rising = rising && index < accessor.count && (indices.empty() || index > indices.back());
          indices.push_back(index);
        });
    if (!good) return false;
    if (!rising) {
      fail(codes::kSparse, "has sparse indices that do not rise or lie beyond its end");
      return false;
    }
    return for_each(sparse.value_view, sparse.value_offset, size, size, sparse.count,
                    [&](std::uint64_t i, const char* at) {
                      if (indices[i] < count) element(at, &values[indices[i] * width]);
                    });
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

std::optional<std::vector<float>> read_times(const File& file, const Slim& slim, int accessor,
                                             Diagnostics& diagnostics) {
  const std::uint64_t count = slim.accessors[static_cast<std::size_t>(accessor)].count;
  auto read = read_floats(file, slim, accessor, count, diagnostics);
  if (!read) return std::nullopt;
  for (std::size_t i = 0; i < read->size(); ++i) {
    if (i == 0 ? (*read)[0] >= 0 : (*read)[i] > (*read)[i - 1]) continue;
    diagnostics.report(codes::kTimes, Place(file.path, fmt::format("/accessors/{}", accessor)),
                       fmt::format("time {} of accessor {} is {}{}", i, accessor, (*read)[i],
                                   i == 0 ? "" : fmt::format(" after {}", (*read)[i - 1])));
    return std::nullopt;
  }
  return read;
}

}  // namespace rigc::gltf
