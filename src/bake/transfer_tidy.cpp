// SPDX-License-Identifier: MIT
// Makes curves of what was solved frame by frame. Test: tests/bake/transfer_test.cpp
#include "bake/transfer_tidy.h"

#include <algorithm>
#include <cmath>

#include "bake/rounded.h"

namespace rigc::bake {
namespace {

/// What counts as rounding in an angle.
constexpr double kDegreeNoise = 2e-5;
/// And in a length, of true lengths.
constexpr double kLengthNoise = 3e-7;

void copy(const math::Trs& from, anim::Path path, math::Trs& to) {
  if (path == anim::Path::translation) to.translation = from.translation;
  if (path == anim::Path::rotation) to.rotation = from.rotation;
  if (path == anim::Path::scale) to.scale = from.scale;
}

}  // namespace

void Tidy::make_continuous(const Unknown& u, std::vector<math::Trs>& locals) const {
  math::Quat before = scene_.local(u.node).rotation;
  for (math::Trs& local : locals) {
    if (math::dot(before, local.rotation) < 0) local.rotation = -local.rotation;
    before = local.rotation;
  }
}

void Tidy::make_continuous(const Unknown& u, std::vector<double>& numbers) const {
  if (numbers.empty()) return;
  const double turn = 360 * u.per_degree;
  double before = scene_.number(u.attribute);
  for (double& number : numbers) {
    if (!is_length(u)) number += std::nearbyint((before - number) / turn) * turn;
    number = before = rounded(number);
  }
}

void Tidy::settle(const Unknown& u, std::vector<math::Trs>& locals,
                  const std::vector<math::Trs>* others) const {
  for (const anim::Path path : kPaths)
    if (solves(u, path) && !locals.empty()) settle_path(u, path, locals, others);
}

void Tidy::settle_path(const Unknown& u, anim::Path path, std::vector<math::Trs>& locals,
                       const std::vector<math::Trs>* others) const {
  const auto all_near = [&](const std::vector<math::Trs>& list, const math::Trs& still,
                            double noise) {
    return std::all_of(list.begin(), list.end(),
                       [&](const math::Trs& local) { return differ(local, still, path) <= noise; });
  };
  std::vector<math::Trs> choices;
  if (!others) choices.push_back(scene_.local(u.node));
  if (!others && !u.plays) choices.push_back(locals.front());  // else its curve stays, as it is
  if (others && all_near(*others, others->front(), 0)) choices.push_back(others->front());
  for (const math::Trs& still : choices) {
    if (!all_near(locals, still, noise_.of(u.node, path))) continue;
    for (math::Trs& local : locals) copy(still, path, local);
    return;
  }
}

void Tidy::settle(const Unknown& u, std::vector<double>& numbers,
                  const std::vector<double>* others) const {
  if (numbers.empty()) return;
  const auto all_near = [](const std::vector<double>& list, double still, double noise) {
    return std::all_of(list.begin(), list.end(),
                       [&](double number) { return std::abs(number - still) <= noise; });
  };
  std::vector<double> choices;
  if (!others) choices = {scene_.number(u.attribute), numbers.front()};
  if (others && all_near(*others, others->front(), 0)) choices = {others->front()};
  for (const double still : choices) {
    if (!all_near(numbers, still, is_length(u) ? kLengthNoise : kDegreeNoise)) continue;
    std::fill(numbers.begin(), numbers.end(), still);
    return;
  }
}

}  // namespace rigc::bake
