// SPDX-License-Identifier: MIT
// Sheets with texture coordinates that stand for meshes of a model.
#pragma once

#include <functional>
#include <memory>

#include "support/rig.h"

namespace rigc::test {

/// A grid of so many columns along u and rows along v, each from 0 to 1, as `place` bends it.
tags::Surface sheet(const std::function<math::Vec3(double u, double v)>& place, int columns = 24,
                    int rows = 2);

/// A mesh "sash" in the template's space that one joint of the model moves.
class Sash {
 public:
  /// `joint`: index of the one that moves it.
  Sash(tags::Surface surface, std::size_t joint)
      : surface_(std::make_shared<tags::Surface>(std::move(surface))), joint_(joint) {}

  /// To be given to a rig: `first`, then binds the mesh, which `by` leads into the rig's space.
  Rig::Change change(const math::Affine& by = {}, const Rig::Change& first = {}) const;
  tags::Geometry geometry() const;

 private:
  std::shared_ptr<tags::Surface> surface_;
  std::size_t joint_ = 0;
};

}  // namespace rigc::test
