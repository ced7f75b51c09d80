// SPDX-License-Identifier: MIT
// Capsules, boxes and cylinders around bones as triangles. Test: tests/gltf/proxy_mesh_test.cpp
#include "gltf/proxy_shapes.h"

#include <algorithm>
#include <array>

namespace rigc::gltf {
namespace {

constexpr std::uint32_t kSegments = 16;  // around the bone
constexpr std::uint32_t kAround = 32;    // around a cylinder
constexpr std::uint32_t kRings = 4;      // of each half sphere
constexpr double kThinnest = 1e-9;

/// Axes of a piece, right-handed: across, across, along the bone.
struct Frame {
  math::Vec3 side, front, along;
};

Frame frame_of(const ProxyPart& part) {
  const math::Vec3 along = math::normalised(part.tail - part.head, {0, 1, 0});
  const math::Mat3 frame = math::frame(along, math::normalised(part.side));
  return {frame.y, frame.z, frame.x};
}

/// Point of a half-sphere's ring, `latitude` from the equator toward the tail, `longitude` about
/// the bone.
void add_ring_point(Surface& out, const ProxyPart& part, const Frame& frame,
                    const math::Vec3& center, double latitude, double longitude) {
  const double across = std::max(part.width / 2, kThinnest);
  const double deep = std::max(part.depth / 2, kThinnest);
  const double cap = std::min(across, deep);
  const double x = math::cos(longitude) * math::cos(latitude);
  const double y = math::sin(longitude) * math::cos(latitude);
  const double z = math::sin(latitude);
  out.points.push_back(center + frame.side * (across * x) + frame.front * (deep * y) +
                       frame.along * (cap * z));
  out.normals.push_back(math::normalised(
      frame.side * (x / across) + frame.front * (y / deep) + frame.along * (z / cap), frame.along));
}

/// From pole to pole: a half sphere about the head, one about the tail; between them the equators
/// are joined.
Surface capsule(const ProxyPart& part) {
  Surface out;
  const Frame frame = frame_of(part);
  const double step = math::kPi / 2 / kRings;
  add_ring_point(out, part, frame, part.head, -math::kPi / 2, 0);
  for (std::uint32_t ring = 0; ring < 2 * kRings; ++ring) {
    const bool tail = ring >= kRings;
    const double latitude = tail ? step * (ring - kRings) : step * (ring + 1.0) - math::kPi / 2;
    for (std::uint32_t i = 0; i < kSegments; ++i)
      add_ring_point(out, part, frame, tail ? part.tail : part.head, latitude,
                     2 * math::kPi / kSegments * i);
  }
  add_ring_point(out, part, frame, part.tail, math::kPi / 2, 0);

  const auto at = [](std::uint32_t ring, std::uint32_t i) {
    return 1 + ring * kSegments + i % kSegments;
  };
  const std::uint32_t top = at(2 * kRings, 0);
  for (std::uint32_t i = 0; i < kSegments; ++i) {
    out.indices.insert(out.indices.end(), {0, at(0, i + 1), at(0, i)});
    for (std::uint32_t ring = 0; ring + 1 < 2 * kRings; ++ring) {
      out.indices.insert(out.indices.end(), {at(ring, i), at(ring, i + 1), at(ring + 1, i + 1)});
      out.indices.insert(out.indices.end(), {at(ring, i), at(ring + 1, i + 1), at(ring + 1, i)});
    }
    out.indices.insert(out.indices.end(), {top, at(2 * kRings - 1, i), at(2 * kRings - 1, i + 1)});
  }
  return out;
}

Surface box(const ProxyPart& part) {
  Surface out;
  const Frame frame = frame_of(part);
  const math::Vec3 center = math::lerp(part.head, part.tail, 0.5);
  const double length = math::length(part.tail - part.head);
  const std::array<math::Vec3, 3> half = {frame.side * (std::max(part.width, kThinnest) / 2),
                                          frame.front * (std::max(part.depth, kThinnest) / 2),
                                          frame.along * (std::max(length, kThinnest) / 2)};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const math::Vec3 out_of = half[axis] * sign;
      const math::Vec3 u = half[(axis + 1) % 3] * sign;
      const math::Vec3 v = half[(axis + 2) % 3];
      const auto first = static_cast<std::uint32_t>(out.points.size());
      for (const math::Vec3& corner : {-u - v, u - v, u + v, v - u}) {
        out.points.push_back(center + out_of + corner);
        out.normals.push_back(math::normalised(out_of));
      }
      for (const std::uint32_t i : {0, 1, 2, 0, 2, 3}) out.indices.push_back(first + i);
    }
  }
  return out;
}

/// A ring of points about the bone at `center`; normals outward, or along `flat` where it is given.
std::uint32_t add_ring(Surface& out, const ProxyPart& part, const Frame& frame, math::Vec3 center,
                       const math::Vec3* flat) {
  const auto first = static_cast<std::uint32_t>(out.points.size());
  const double across = std::max(part.width / 2, kThinnest);
  const double deep = std::max(part.depth / 2, kThinnest);
  for (std::uint32_t i = 0; i < kAround; ++i) {
    const double angle = 2 * math::kPi / kAround * i;
    const double x = math::cos(angle), y = math::sin(angle);
    out.points.push_back(center + frame.side * (across * x) + frame.front * (deep * y));
    out.normals.push_back(
        flat ? *flat
             : math::normalised(frame.side * (x / across) + frame.front * (y / deep), frame.side));
  }
  return first;
}

/// A wall from head to tail and a flat lid at each end.
Surface cylinder(const ProxyPart& part) {
  Surface out;
  const Frame frame = frame_of(part);
  const bool flat = math::length(part.tail - part.head) < kThinnest;
  const math::Vec3 tail = flat ? part.head + frame.along * kThinnest : part.tail;
  const std::uint32_t low = add_ring(out, part, frame, part.head, nullptr);
  const std::uint32_t high = add_ring(out, part, frame, tail, nullptr);
  for (std::uint32_t i = 0; i < kAround; ++i) {
    const std::uint32_t next = (i + 1) % kAround;
    out.indices.insert(out.indices.end(), {low + i, low + next, high + next});
    out.indices.insert(out.indices.end(), {low + i, high + next, high + i});
  }
  const math::Vec3 down = -frame.along;
  const std::uint32_t floor = add_ring(out, part, frame, part.head, &down);
  const std::uint32_t lid = add_ring(out, part, frame, tail, &frame.along);
  for (std::uint32_t i = 1; i + 1 < kAround; ++i) {
    out.indices.insert(out.indices.end(), {floor, floor + i + 1, floor + i});
    out.indices.insert(out.indices.end(), {lid, lid + i, lid + i + 1});
  }
  return out;
}

}  // namespace

Surface surface(const ProxyPart& part) {
  if (part.style == ProxyStyle::cylinder) return cylinder(part);
  return part.style == ProxyStyle::box ? box(part) : capsule(part);
}

}  // namespace rigc::gltf
