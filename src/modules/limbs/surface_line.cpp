// SPDX-License-Identifier: MIT
// Lines along surfaces. Test: tests/modules/surface_line_test.cpp
#include "modules/limbs/surface_line.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

namespace rigc::modules {
namespace {

using math::Vec3;

/// A line at the very edge would cross no triangle: it lies so much inside, of the whole extent.
constexpr double kInside = 1e-4;
/// Parts of the length: over which directions are measured on both sides, and how near to each
/// other the ends of a closed line are.
constexpr double kSmooth = 0.01, kClosed = 1e-3;
/// Points nearer to each other, in parts of the length, are one.
constexpr double kSame = 1e-9;

/// By vertex the first one that is at the same place, in space and in the texture: models have
/// several where colours or shading break.
std::vector<std::uint32_t> welded(const tags::Surface& surface) {
  std::vector<std::uint32_t> order(surface.places.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t v) {
    const Vec3& p = surface.places[v];
    const auto& t = surface.texture[v];
    return std::make_tuple(p.x, p.y, p.z, t[0], t[1]);
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::make_tuple(key(a), a) < std::make_tuple(key(b), b);
  });
  std::vector<std::uint32_t> out(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    out[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? out[order[i - 1]] : order[i];
  return out;
}

/// By vertex one of the island of the texture that it lies in, the same for all of the island.
std::vector<std::uint32_t> islands_of(const tags::Surface& surface,
                                      const std::vector<std::uint32_t>& weld) {
  std::vector<std::uint32_t> out = weld;
  const auto root = [&](std::uint32_t v) {
    while (out[v] != v) v = out[v] = out[out[v]];
    return v;
  };
  for (const auto& [a, b, c] : surface.triangles)
    for (const std::uint32_t other : {b, c}) out[root(other)] = root(a);
  for (std::uint32_t v = 0; v < out.size(); ++v) out[v] = root(v);
  return out;
}

/// Normals of vertices: of the triangles around each, by their areas. Not of length 1.
std::vector<Vec3> normals_of(const tags::Surface& surface, const std::vector<std::uint32_t>& weld) {
  std::vector<Vec3> out(surface.places.size());
  for (const auto& [a, b, c] : surface.triangles) {
    const Vec3& from = surface.places[a];
    const Vec3 normal = math::cross(surface.places[b] - from, surface.places[c] - from);
    for (const std::uint32_t v : {a, b, c}) out[weld[v]] = out[weld[v]] + normal;
  }
  return out;
}

/// Where the line crosses an edge.
struct Crossing {
  Vec3 point, normal;
  double along = 0;  ///< texture coordinate
  std::vector<std::size_t> next;
};

/// Crossings of triangles' edges and which of them one triangle joins.
class Crossings {
 public:
  /// `along`: 0 the line runs along u, 1 along v.
  Crossings(const tags::Surface& surface, std::size_t along, double row)
      : surface_(surface),
        along_(along),
        weld_(welded(surface)),
        islands_(islands_of(surface, weld_)),
        normals_(normals_of(surface, weld_)) {
    std::vector<double> least(surface.places.size(), 1e300), greatest(least.size(), -1e300);
    for (const auto& triangle : surface.triangles)
      for (const std::uint32_t v : triangle) {
        least[islands_[v]] = std::min(least[islands_[v]], across(v));
        greatest[islands_[v]] = std::max(greatest[islands_[v]], across(v));
      }
    const double inside = std::clamp(row, kInside, 1 - kInside);
    for (std::size_t i = 0; i < least.size(); ++i)
      levels_.push_back(least[i] + (greatest[i] - least[i]) * inside);
    for (const auto& triangle : surface.triangles) cross(triangle);
  }

  /// The longest of the pieces, as its points follow one another; less than two where there is
  /// none.
  std::vector<Crossing> longest() {
    std::vector<std::size_t> best;
    double length = 0;
    // Open pieces first, from their ends; what is left then goes round.
    for (const bool ends : {true, false})
      for (std::size_t i = 0; i < all_.size(); ++i) {
        if (seen_[i] || (ends && all_[i].next.size() > 1)) continue;
        std::vector<std::size_t> piece = walk(ends ? i : least_of_round(i));
        if (!ends) piece.push_back(piece.front());
        double whole = 0;
        for (std::size_t k = 0; k + 1 < piece.size(); ++k)
          whole += math::length(all_[piece[k + 1]].point - all_[piece[k]].point);
        if (!(whole > length)) continue;
        length = whole;
        best = std::move(piece);
      }
    std::vector<Crossing> out;
    for (const std::size_t i : best) out.push_back(all_[i]);
    if (!out.empty() && out.back().along < out.front().along) std::reverse(out.begin(), out.end());
    return out;
  }

 private:
  double across(std::uint32_t v) const { return surface_.texture[v][1 - along_]; }
  double level(std::uint32_t v) const { return levels_[islands_[v]]; }
  bool above(std::uint32_t v) const { return across(v) >= level(v); }

  void cross(const std::array<std::uint32_t, 3>& triangle) {
    std::vector<std::size_t> ends;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = weld_[triangle[i]], b = weld_[triangle[(i + 1) % 3]];
      if (above(a) != above(b)) ends.push_back(crossing(std::min(a, b), std::max(a, b)));
    }
    if (ends.size() != 2 || ends[0] == ends[1]) return;
    Crossing &first = all_[ends[0]], &second = all_[ends[1]];
    // Cloth may have each triangle once more, with its back to the front.
    if (std::find(first.next.begin(), first.next.end(), ends[1]) != first.next.end()) return;
    // Where more than two triangles meet at an edge, the line goes on in the first ones.
    if (first.next.size() > 1 || second.next.size() > 1) return;
    first.next.push_back(ends[1]);
    second.next.push_back(ends[0]);
  }

  std::size_t crossing(std::uint32_t a, std::uint32_t b) {
    const auto [known, is_new] = by_edge_.try_emplace({a, b}, all_.size());
    if (!is_new) return known->second;
    const double t = (level(a) - across(a)) / (across(b) - across(a));
    const auto between = [&](const auto& from, const auto& to) { return from + (to - from) * t; };
    all_.push_back({between(surface_.places[a], surface_.places[b]),
                    between(normals_[a], normals_[b]),
                    between(surface_.texture[a][along_], surface_.texture[b][along_]),
                    {}});
    seen_.push_back(false);
    return known->second;
  }

  std::vector<std::size_t> walk(std::size_t from) {
    std::vector<std::size_t> piece{from};
    seen_[from] = true;
    for (;;) {
      const auto& next = all_[piece.back()].next;
      const auto unseen =
          std::find_if(next.begin(), next.end(), [&](std::size_t i) { return !seen_[i]; });
      if (unseen == next.end()) return piece;
      seen_[*unseen] = true;
      piece.push_back(*unseen);
    }
  }

  /// Of a piece that goes round: where the texture coordinate is least.
  std::size_t least_of_round(std::size_t from) const {
    std::size_t least = from, before = from;
    for (std::size_t at = all_[from].next[0]; at != from;) {
      if (all_[at].along < all_[least].along) least = at;
      const auto& next = all_[at].next;
      const std::size_t on = next[0] == before ? next[1] : next[0];
      before = at;
      at = on;
    }
    return least;
  }

  const tags::Surface& surface_;
  std::size_t along_;
  std::vector<std::uint32_t> weld_;
  std::vector<std::uint32_t> islands_;
  std::vector<Vec3> normals_;
  std::vector<double> levels_;  ///< by the islands' vertices: texture coordinate of the line
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> by_edge_;
  std::vector<Crossing> all_;
  std::vector<bool> seen_;
};

std::optional<SurfaceLine> line_along(const tags::Surface& surface, std::size_t along, double row) {
  const std::vector<Crossing> found = Crossings(surface, along, row).longest();
  double length = 0;
  for (std::size_t i = 0; i + 1 < found.size(); ++i)
    length += math::length(found[i + 1].point - found[i].point);
  std::vector<Vec3> points, normals;
  for (const Crossing& each : found) {
    if (!points.empty() && !(math::length(each.point - points.back()) > kSame * length)) continue;
    points.push_back(each.point);
    normals.push_back(math::normalised(each.normal, {}));
  }
  if (points.size() < 2) return std::nullopt;
  const bool closed = math::length(points.back() - points.front()) <= kClosed * length;
  if (closed) points.back() = points.front();
  return SurfaceLine(std::move(points), std::move(normals), closed);
}

}  // namespace

SurfaceLine::SurfaceLine(std::vector<Vec3> points, std::vector<Vec3> normals, bool closed)
    : points_(std::move(points)), normals_(std::move(normals)), passed_{0}, closed_(closed) {
  for (std::size_t i = 0; i + 1 < points_.size(); ++i)
    passed_.push_back(passed_.back() + math::length(points_[i + 1] - points_[i]));
}

SurfaceLine::Segment SurfaceLine::segment_at(double part) const {
  if (closed_ && part != 1) part -= std::floor(part);
  const double want = std::clamp(part, 0.0, 1.0) * length();
  const auto beyond = std::upper_bound(passed_.begin() + 1, passed_.end() - 1, want);
  const auto index = static_cast<std::size_t>(beyond - passed_.begin()) - 1;
  const double own = passed_[index + 1] - passed_[index];
  return {index, own > 0 ? std::min((want - passed_[index]) / own, 1.0) : 0};
}

Vec3 SurfaceLine::point_at(double part) const {
  const Segment s = segment_at(part);
  return points_[s.index] + (points_[s.index + 1] - points_[s.index]) * s.part;
}

SurfacePlace SurfaceLine::at(double part) const {
  const Segment s = segment_at(part);
  SurfacePlace out;
  out.point = point_at(part);
  const Vec3 segment = points_[s.index + 1] - points_[s.index];
  const double low = closed_ ? part - kSmooth : std::clamp(part - kSmooth, 0.0, 1 - kSmooth);
  const double high = closed_ ? part + kSmooth : std::clamp(part + kSmooth, kSmooth, 1.0);
  out.along = math::normalised(point_at(high) - point_at(low), math::normalised(segment));
  const Vec3 normal = normals_[s.index] * (1 - s.part) + normals_[s.index + 1] * s.part;
  out.normal = math::normalised(normal - out.along * math::dot(normal, out.along),
                                math::perpendicular(out.along));
  return out;
}

double SurfaceLine::nearest(Vec3 point) const {
  double least = 0, found = 0;
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
    const Vec3 piece = points_[i + 1] - points_[i];
    const double square = math::dot(piece, piece);
    const double part =
        square > 0 ? std::clamp(math::dot(point - points_[i], piece) / square, 0.0, 1.0) : 0;
    const double off = math::length(point - (points_[i] + piece * part));
    if (i > 0 && !(off < least)) continue;
    least = off;
    found = passed_[i] + part * (passed_[i + 1] - passed_[i]);
  }
  return found / length();
}

std::optional<SurfaceLine> line_on(const tags::Surface& surface, const std::string& direction,
                                   double row) {
  if (direction != "auto") return line_along(surface, direction == "u" ? 0 : 1, row);
  auto u = line_along(surface, 0, row), v = line_along(surface, 1, row);
  if (!u || !v) return u ? u : v;
  return v->length() > u->length() ? v : u;
}

}  // namespace rigc::modules
