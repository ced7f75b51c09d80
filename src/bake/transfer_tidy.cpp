// SPDX-License-Identifier: MIT
// Makes curves of what was solved frame by frame. Test: tests/bake/transfer_test.cpp
#include "bake/transfer_tidy.h"

#include <algorithm>
#include <cmath>

namespace rigc::bake {
namespace {

/// What counts as rounding in an angle.
constexpr double kDegreeNoise = 2e-5;

void copy(const math::Trs& from, anim::Path path, math::Trs& to) {
  if (path == anim::Path::translation) to.translation = from.translation;
  if (path == anim::Path::rotation) to.rotation = from.rotation;
  if (path == anim::Path::scale) to.scale = from.scale;
}

}  // namespace

void Tidy::operator()(const Unknown& u, std::vector<math::Trs>& locals) const {
  math::Quat before = scene_.local(u.node).rotation;
  for (math::Trs& local : locals) {
    if (math::dot(before, local.rotation) < 0) local.rotation = -local.rotation;
    before = local.rotation;
  }
  for (const anim::Path path : kPaths)
    if (solves(u, path) && !locals.empty()) settle(u, path, locals);
}

void Tidy::settle(const Unknown& u, anim::Path path, std::vector<math::Trs>& locals) const {
  const double noise = noise_.of(u.node, path);
  std::vector<math::Trs> choices{scene_.local(u.node)};
  if (!u.plays) choices.push_back(locals.front());  // else its curve stays, as it is
  for (const math::Trs& still : choices) {
    const bool stays = std::all_of(locals.begin(), locals.end(), [&](const math::Trs& local) {
      return differ(local, still, path) <= noise;
    });
    if (!stays) continue;
    for (math::Trs& local : locals) copy(still, path, local);
    return;
  }
}

void Tidy::operator()(const Unknown& twist, std::vector<double>& numbers) const {
  if (numbers.empty()) return;
  const double turn = 360 * twist.per_degree, rest = scene_.number(twist.attribute);
  double before = rest;
  for (double& number : numbers) {
    number += std::nearbyint((before - number) / turn) * turn;
    number = before = static_cast<double>(static_cast<float>(number));
  }
  for (const double still : {rest, numbers.front()}) {
    const bool stays = std::all_of(numbers.begin(), numbers.end(), [&](double number) {
      return std::abs(number - still) <= kDegreeNoise;
    });
    if (!stays) continue;
    std::fill(numbers.begin(), numbers.end(), still);
    return;
  }
}

}  // namespace rigc::bake
