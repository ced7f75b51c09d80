// SPDX-License-Identifier: MIT
// Checks of nodes, their hierarchy, scenes and skins.
// Test: tests/gltf/file_test.cpp
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gltf/check.h"
#include "gltf/codes.h"

namespace rigc::gltf {
namespace {

void check_numbers(Check& check, const json::Value& node, std::string_view key, std::size_t count) {
  const json::Value list = node[key];
  if (!list) return;
  const auto items = list.items();
  const bool numbers = std::all_of(items.begin(), items.end(),
                                   [](const json::Value& item) { return item.is_number(); });
  if (!list.is_array() || items.size() != count || !numbers) {
    check.report(codes::kTransform, list, fmt::format("\"{}\" is not {} numbers", key, count));
    return;
  }
  if (key != "rotation") return;
  double largest = 0;
  for (const json::Value& item : items) largest = std::max(largest, std::abs(*item.number()));
  if (largest < 1e-6) check.report(codes::kZeroRotation, list, "the quaternion has length zero");
}

void check_transform(Check& check, const json::Value& node) {
  check_numbers(check, node, "translation", 3);
  check_numbers(check, node, "rotation", 4);
  check_numbers(check, node, "scale", 3);
  check_numbers(check, node, "matrix", 16);
  if (node["matrix"] && (node["translation"] || node["rotation"] || node["scale"]))
    check.report(codes::kTransform, node["matrix"],
                 "the node has both a matrix and translation, rotation or scale");
}

/// Reports one node of each cycle. Each node has at most one parent in `parents`.
void check_cycles(Check& check, const std::vector<int>& parents) {
  const auto& nodes = check.elements("nodes");
  std::vector<std::size_t> walk(nodes.size(), 0);  // number of the walk that came here first
  for (std::size_t first = 0; first < nodes.size(); ++first) {
    std::size_t at = first;
    while (walk[at] == 0) {
      walk[at] = first + 1;
      if (parents[at] < 0) break;
      at = static_cast<std::size_t>(parents[at]);
      if (walk[at] == first + 1)
        check.report(codes::kNodeCycle, nodes[at], fmt::format("node {} is its own ancestor", at));
    }
  }
}

}  // namespace

void check_nodes(Check& check) {
  const auto& nodes = check.elements("nodes");
  std::vector<int> parents(nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    check_transform(check, nodes[i]);
    check.index(nodes[i], "mesh", "meshes");
    check.index(nodes[i], "skin", "skins");
    check.index(nodes[i], "camera", "cameras");
    for (const std::size_t child : check.indices(nodes[i], "children", "nodes")) {
      if (parents[child] >= 0)
        check.report(
            codes::kTwoParents, nodes[child],
            fmt::format("node {} is a child of node {} and of node {}", child, parents[child], i));
      parents[child] = static_cast<int>(i);
    }
  }
  check_cycles(check, parents);
  for (const json::Value& scene : check.elements("scenes")) check.indices(scene, "nodes", "nodes");
}

void check_skins(Check& check) {
  for (const json::Value& skin : check.elements("skins")) {
    check.index(skin, "skeleton", "nodes");
    std::vector<std::size_t> joints = check.indices(skin, "joints", "nodes");
    const std::size_t count = joints.size();
    std::sort(joints.begin(), joints.end());
    const bool twice = std::adjacent_find(joints.begin(), joints.end()) != joints.end();
    if (twice || skin["joints"].size() == 0)
      check.report(codes::kSkinJoints, skin,
                   twice ? "the skin names a joint twice" : "the skin has no joints");
    const auto matrices = check.index(skin, "inverseBindMatrices", "accessors");
    if (!matrices) continue;
    const AccessorFacts& accessor = check.accessors()[*matrices];
    if (!accessor.is_real("MAT4"))
      check.report(codes::kSkinMatrices, skin["inverseBindMatrices"],
                   fmt::format("accessor {} is not of float MAT4", *matrices));
    else if (accessor.count >= 1 && accessor.count < static_cast<std::int64_t>(count))
      check.report(codes::kSkinMatrices, skin["inverseBindMatrices"],
                   fmt::format("{} matrices for {} joints", accessor.count, count));
  }
}

}  // namespace rigc::gltf
