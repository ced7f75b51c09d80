// SPDX-License-Identifier: MIT
// Shares weights along bones. Test: tests/gltf/share_weights_test.cpp
#include "gltf/share_weights.h"

#include <algorithm>
#include <cmath>

namespace rigc::gltf {
namespace {

/// A share below this part of a weight is not worth a slot.
constexpr double kLeastShare = 1e-3;

struct Influence {
  std::uint16_t joint = 0;
  float weight = 0;
};
using Influences = std::vector<Influence>;

/// The stop before a fraction, and which part of a weight goes to the one after it.
struct Place {
  std::size_t stop = 0;
  double part = 0;
};
Place place_of(const Sharing& bone, double fraction) {
  const auto& stops = bone.stops;
  if (!(fraction > stops.front().fraction)) return {};
  if (fraction >= stops.back().fraction) return {stops.size() - 1, 0};
  Place place;
  while (stops[place.stop + 1].fraction <= fraction) ++place.stop;
  const double begin = stops[place.stop].fraction, end = stops[place.stop + 1].fraction;
  place.part = (fraction - begin) / (end - begin);
  if (place.part < kLeastShare) place.part = 0;
  if (place.part > 1 - kLeastShare) place = {place.stop + 1, 0};
  return place;
}

/// How far along a line, in parts of its length, the point of it lies that is nearest to
/// `position`.
double nearest_part(const std::vector<math::Vec3>& line, math::Vec3 position) {
  double least = 0, found = 0, passed = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const math::Vec3 piece = line[i + 1] - line[i];
    const double square = math::dot(piece, piece), length = std::sqrt(square);
    const double part =
        square > 0 ? std::clamp(math::dot(position - line[i], piece) / square, 0.0, 1.0) : 0;
    const math::Vec3 off = position - (line[i] + piece * part);
    if (i == 0 || math::dot(off, off) < least) {
      least = math::dot(off, off);
      found = passed + part * length;
    }
    passed += length;
  }
  return passed > 0 ? found / passed : 0;
}

double fraction_of(const Sharing& bone, math::Vec3 position) {
  if (!bone.line.empty()) return nearest_part(bone.line, position);
  return math::dot(bone.along, position) + bone.begin;
}

/// Shares the weight of one influence.
void share(Influences& list, std::size_t i, const Sharing& bone, const Place& place, bool whole) {
  const float weight = list[i].weight;
  const double part = weight * place.part;
  const auto second = static_cast<float>(whole ? std::floor(part + 0.5) : part);
  if (second < weight) {
    list[i] = {static_cast<std::uint16_t>(bone.stops[place.stop].joint), weight - second};
    if (second > 0)
      list.push_back({static_cast<std::uint16_t>(bone.stops[place.stop + 1].joint), second});
  } else {
    list[i].joint = static_cast<std::uint16_t>(bone.stops[place.stop + 1].joint);
  }
}

/// The largest first; those beyond `most` join it.
void order_and_cut(Influences& list, std::size_t most) {
  std::stable_sort(list.begin(), list.end(),
                   [](const Influence& a, const Influence& b) { return a.weight > b.weight; });
  while (list.size() > most) {
    list.front().weight += list.back().weight;
    list.pop_back();
  }
}

void read(const VertexWeights& vertices, std::size_t vertex, Influences& list) {
  list.clear();
  for (std::size_t i = vertex * vertices.slots; i < (vertex + 1) * vertices.slots; ++i)
    if (vertices.weights[i] > 0) list.push_back({vertices.joints[i], vertices.weights[i]});
}

void write(const Influences& list, VertexWeights& vertices, std::size_t vertex) {
  for (std::size_t i = 0; i < vertices.slots; ++i) {
    const Influence influence = i < list.size() ? list[i] : Influence();
    vertices.joints[vertex * vertices.slots + i] = influence.joint;
    vertices.weights[vertex * vertices.slots + i] = influence.weight;
  }
}

}  // namespace

std::vector<bool> share(VertexWeights& vertices, const std::vector<float>& positions,
                        const std::vector<Sharing>& bones) {
  const std::size_t count = positions.size() / 3, slots = vertices.slots;
  VertexWeights out = vertices;
  out.slots = slots + 4;
  out.joints.assign(count * out.slots, 0);
  out.weights.assign(count * out.slots, 0);
  std::vector<bool> shared(bones.size(), false);
  bool overflows = false;
  Influences list;
  for (std::size_t v = 0; v < count; ++v) {
    const math::Vec3 position{positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]};
    read(vertices, v, list);
    for (std::size_t b = 0; b < bones.size(); ++b) {
      const std::size_t known = list.size();
      for (std::size_t i = 0; i < known; ++i) {
        if (list[i].joint != bones[b].joint) continue;
        const Place place = place_of(bones[b], fraction_of(bones[b], position));
        share(list, i, bones[b], place, vertices.whole);
        shared[b] = true;
      }
    }
    if (list.size() > slots) order_and_cut(list, out.slots);
    overflows = overflows || list.size() > slots;
    write(list, out, v);
  }
  if (overflows) {
    vertices = std::move(out);
    return shared;
  }
  for (std::size_t v = 0; v < count; ++v) {
    const auto from = static_cast<std::ptrdiff_t>(v * out.slots);
    const auto to = static_cast<std::ptrdiff_t>(v * slots);
    const auto width = static_cast<std::ptrdiff_t>(slots);
    std::copy_n(out.joints.begin() + from, width, vertices.joints.begin() + to);
    std::copy_n(out.weights.begin() + from, width, vertices.weights.begin() + to);
  }
  return shared;
}

}  // namespace rigc::gltf
