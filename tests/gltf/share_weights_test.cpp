// SPDX-License-Identifier: MIT
// A weight is shared between the two joints that a vertex lies between, and its sum stays.
#include "gltf/share_weights.h"

#include <doctest/doctest.h>

#include <map>

using namespace rigc;
using namespace rigc::gltf;

namespace {

using Weights = std::map<int, double>;

/// Along y from 0 to 2; joint 5 is all at 0, 7 in the middle, 8 at the end.
Sharing bone() { return {5, {0, 0.5, 0}, 0, {{0, 5}, {0.5, 7}, {1, 8}}}; }

/// A vertex at a height with up to four influences.
VertexWeights vertex(const Weights& weights, bool whole = false) {
  VertexWeights out;
  out.whole = whole;
  for (const auto& [joint, weight] : weights) {
    out.joints.push_back(static_cast<std::uint16_t>(joint));
    out.weights.push_back(static_cast<float>(weight));
  }
  out.joints.resize(4);
  out.weights.resize(4);
  return out;
}

Weights weights_of(const VertexWeights& vertices, std::size_t vertex = 0) {
  Weights out;
  for (std::size_t i = vertex * vertices.slots; i < (vertex + 1) * vertices.slots; ++i)
    if (vertices.weights[i] > 0) out[vertices.joints[i]] += vertices.weights[i];
  return out;
}

VertexWeights shared(VertexWeights vertices, float height, const Sharing& along = bone()) {
  share(vertices, {0.3f, height, 0.1f}, {along});
  return vertices;
}

}  // namespace

TEST_CASE("gltf share_weights: between two joints it goes over from one to the other") {
  const auto at = [](float height) { return weights_of(shared(vertex({{5, 1}}), height)); };
  CHECK(at(0) == Weights{{5, 1}});
  CHECK(at(0.5f) == Weights{{5, 0.5}, {7, 0.5}});
  CHECK(at(0.75f) == Weights{{5, 0.25}, {7, 0.75}});
  CHECK(at(1) == Weights{{7, 1}});
  CHECK(at(1.25f) == Weights{{7, 0.75}, {8, 0.25}});
  CHECK(at(2) == Weights{{8, 1}});
  // Beyond the ends the joints there have all.
  CHECK(at(-3) == Weights{{5, 1}});
  CHECK(at(9) == Weights{{8, 1}});
}

TEST_CASE("gltf share_weights: other joints keep their weights, and who has none is left alone") {
  VertexWeights other = vertex({{1, 0.75}, {2, 0.25}});
  const VertexWeights before = other;
  CHECK(share(other, {0, 1, 0}, {bone()}) == std::vector<bool>{false});
  CHECK(other.joints == before.joints);
  CHECK(other.weights == before.weights);
  const Weights after = weights_of(shared(vertex({{1, 0.25}, {5, 0.5}, {9, 0.25}}), 0.5f));
  CHECK(after == Weights{{1, 0.25}, {5, 0.25}, {7, 0.25}, {9, 0.25}});
}

TEST_CASE("gltf share_weights: the joint of the bone may stand at its end") {
  const Sharing turned{5, {0, 0.5, 0}, 0, {{0, 7}, {0.5, 8}, {1, 5}}};
  const auto at = [&](float height) {
    return weights_of(shared(vertex({{5, 1}}), height, turned));
  };
  CHECK(at(0) == Weights{{7, 1}});
  CHECK(at(1.5f) == Weights{{5, 0.5}, {8, 0.5}});
  CHECK(at(2) == Weights{{5, 1}});
}

TEST_CASE("gltf share_weights: whole numbers stay whole and keep their sum") {
  for (int weight = 1; weight <= 255; ++weight)
    for (const float height : {0.1f, 0.37f, 0.5f, 0.77f, 1.01f, 1.93f}) {
      const double other = 255.0 - weight;
      const Weights after =
          weights_of(shared(vertex({{2, other}, {5, static_cast<double>(weight)}}, true), height));
      double sum = 0;
      for (const auto& [joint, part] : after) {
        sum += part;
        CHECK(part == static_cast<int>(part));
      }
      CHECK(sum == 255);
      CHECK((other == 0 || after.at(2) == other));
    }
}

TEST_CASE("gltf share_weights: without a free slot there is another set, the largest come first") {
  const VertexWeights after = shared(vertex({{1, 0.125}, {2, 0.125}, {3, 0.25}, {5, 0.5}}), 0.75f);
  REQUIRE(after.slots == 8);
  CHECK(weights_of(after) == Weights{{1, 0.125}, {2, 0.125}, {3, 0.25}, {5, 0.125}, {7, 0.375}});
  CHECK(after.joints[0] == 7);
  CHECK(after.joints[1] == 3);
  CHECK(after.weights[4] == 0.125f);
}

TEST_CASE("gltf share_weights: more influences than two sets hold join the largest") {
  VertexWeights vertices = vertex({{1, 0.25}, {2, 0.25}, {3, 0.25}, {4, 0.25}});
  std::vector<Sharing> bones;
  for (std::size_t joint = 1; joint <= 4; ++joint)
    bones.push_back({joint, {0, 0.5, 0}, 0, {{0, joint}, {1, 10 + joint}}});
  // The first bone is shared again.
  bones.push_back({11, {0, 0.5, 0}, 0, {{0, 20}, {1, 21}}});
  share(vertices, {0, 0.5f, 0}, bones);
  REQUIRE(vertices.slots == 8);
  double sum = 0;
  for (const float weight : vertices.weights) {
    CHECK(weight > 0);
    sum += weight;
  }
  CHECK(sum == 1);
}

TEST_CASE("gltf share_weights: along a line that is bent a vertex lies where it is nearest") {
  // Up by 1, then along x by 1; joint 5 has none of it for itself.
  const Sharing bent{5, {}, 0, {{0, 7}, {0.5, 8}, {1, 9}}, {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}}};
  const auto at = [&](float x, float y) {
    VertexWeights vertices = vertex({{5, 1}});
    share(vertices, {x, y, 0.3f}, {bent});
    return weights_of(vertices);
  };
  CHECK(at(0.1f, 0) == Weights{{7, 1}});
  CHECK(at(-0.2f, 0.5f) == Weights{{7, 0.5}, {8, 0.5}});
  CHECK(at(-1, 2) == Weights{{8, 1}});
  CHECK(at(0.75f, 1.2f) == Weights{{8, 0.25}, {9, 0.75}});
  CHECK(at(3, 0.9f) == Weights{{9, 1}});
}

TEST_CASE("gltf share_weights: a line that goes round has its last joint before its first") {
  const Sharing round{5,
                      {},
                      0,
                      {{-0.5, 8}, {0, 7}, {0.5, 8}, {1, 7}},
                      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}}};
  const auto at = [&](float x, float y) {
    VertexWeights vertices = vertex({{5, 1}});
    share(vertices, {x, y, 0}, {round});
    return weights_of(vertices);
  };
  CHECK(at(0, 0) == Weights{{7, 1}});
  CHECK(at(1, 0) == Weights{{7, 0.5}, {8, 0.5}});
  CHECK(at(1, 1) == Weights{{8, 1}});
  CHECK(at(0, 1) == Weights{{7, 0.5}, {8, 0.5}});
  CHECK(at(0, 0.5f) == Weights{{7, 0.75}, {8, 0.25}});
}
