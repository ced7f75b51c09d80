// SPDX-License-Identifier: MIT
// Controls that stay while a limb is keyed otherwise. Test: tests/bake/match_test.cpp
#include "bake/held.h"

#include <algorithm>
#include <cmath>

#include "bake/rounded.h"

namespace rigc::bake {
namespace {

using math::Affine;
using math::Quat;
using math::Vec3;
using scene::NodeId;
using scene::Plug;
namespace transform = scene::transform;

/// Axes (of length 1) and places (in units of 1 and of how far out they are) that differ by less
/// are where they were: 32-bit floats do not tell them apart.
constexpr double kSame = 1e-8;

bool is_same(const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::fabs(a[i] - b[i]) > kSame * std::max(1.0, std::fabs(a[i]))) return false;
  return true;
}

}  // namespace

Kept kept(const std::vector<double>& worlds, const std::vector<double>& parents, std::size_t frames,
          Quat before) {
  Kept out;
  for (std::size_t f = 0; f < frames; ++f) {
    const Affine local = math::inverse(affine(parents, f)) * affine(worlds, f);
    Quat q = math::quaternion(math::orthonormal(local.linear));
    if (math::dot(before, q) < 0) q = -q;
    before = q;
    const Vec3 place = rounded(local.origin);
    const Quat turn = rounded(q);
    out.places.insert(out.places.end(), {place.x, place.y, place.z});
    out.turns.insert(out.turns.end(), {turn.x, turn.y, turn.z, turn.w});
  }
  return out;
}

std::vector<Plug> Held::plugs(std::uint16_t attribute) const {
  std::vector<Plug> out;
  for (const NodeId control : controls_) out.push_back({control, attribute});
  return out;
}

bool Held::note() {
  if (controls_.empty()) return true;
  const auto worlds = frames_.evaluate(plugs(transform::kWorld));
  if (worlds) wanted_ = *worlds;
  return worlds.has_value();
}

bool Held::hold() {
  if (controls_.empty()) return true;
  std::vector<Plug> asked = plugs(transform::kWorld);
  const std::vector<Plug> parents = plugs(transform::kParent);
  asked.insert(asked.end(), parents.begin(), parents.end());
  // One may hang below another: toes below the hips.
  for (std::size_t pass = 0; pass < controls_.size(); ++pass) {
    const auto rows = frames_.evaluate(asked);
    if (!rows) return false;
    bool stayed = true;
    for (std::size_t i = 0; i < controls_.size(); ++i) {
      if (is_same((*rows)[i], wanted_[i])) continue;
      set(controls_[i], (*rows)[controls_.size() + i], wanted_[i]);
      stayed = false;
    }
    if (stayed) break;
  }
  return true;
}

void Held::set(NodeId control, const std::vector<double>& parents,
               const std::vector<double>& worlds) {
  const math::Trs rest = scene_.local(control);
  Kept values = kept(worlds, parents, frames_.count(), rest.rotation);
  const auto write = [&](std::uint16_t attribute, std::vector<double> numbers) {
    const Plug plug{control, attribute};
    if (std::find(written_.begin(), written_.end(), plug) == written_.end())
      written_.push_back(plug);
    frames_.table[plug] = std::move(numbers);
  };
  // What goes along turns about the control: one that was never moved need not be.
  const Plug place{control, transform::kTranslate};
  if (frames_.keyed.contains(place) || math::length(rest.translation) > 0)
    write(transform::kTranslate, std::move(values.places));
  write(transform::kRotation, std::move(values.turns));
}

}  // namespace rigc::bake
