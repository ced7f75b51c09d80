// SPDX-License-Identifier: MIT
// Sheets, and models that hold one.
#include "support/surfaces.h"

#include "support/skeletons.h"

namespace rigc::test {

tags::Surface sheet(const std::function<math::Vec3(double u, double v)>& place, int columns,
                    int rows) {
  tags::Surface out;
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= columns; ++c) {
      const double u = static_cast<double>(c) / columns, v = static_cast<double>(r) / rows;
      out.places.push_back(place(u, v));
      out.texture.push_back({u, v});
      if (r == rows || c == columns) continue;
      const auto corner = static_cast<std::uint32_t>(r * (columns + 1) + c);
      const std::uint32_t next = corner + 1, up = corner + static_cast<std::uint32_t>(columns) + 1;
      out.triangles.push_back({corner, next, up + 1});
      out.triangles.push_back({corner, up + 1, up});
    }
  return out;
}

Rig::Change Sash::change(const math::Affine& by, const Rig::Change& first) const {
  return [surface = surface_, joint = joint_, by, first](tags::TaggedSkeleton& skeleton) {
    if (first) first(skeleton);
    skeleton.joints[joint].foreign_node = 7;
    surface->bound = {{7, math::inverse(worlds(skeleton)[joint]) * by}};
  };
}

tags::Geometry Sash::geometry() const {
  tags::Geometry out;
  out.surfaces = [surface = surface_](const std::string& name) {
    return name == "sash" ? std::vector{*surface} : std::vector<tags::Surface>{};
  };
  return out;
}

}  // namespace rigc::test
