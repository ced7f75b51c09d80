// SPDX-License-Identifier: MIT
// Fits an expanded template to the skeleton of a model: matched joints take their rest and their
// parents from the model, the rest of its joints stay as untagged ones. Test:
// tests/templates/fit_test.cpp
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "templates/expand.h"
#include "templates/map.h"

namespace rigc::templates {

/// What a fit found, for people and for `--json`.
struct FitReport {
  struct Match {
    std::string joint;  ///< of the template
    std::string bone;   ///< of the model
    int node = -1;      ///< glTF node of the bone
  };
  struct Asymmetry {
    std::string joint, opposite;  ///< bones
    double metres = 0;            ///< in world space
    double share = 0;             ///< of the height
  };
  std::string map;
  std::vector<Match> matched;
  std::vector<std::string> dropped;    ///< optional joints of the template that the model lacks
  std::vector<std::string> helpers;    ///< helper joints that were made
  std::vector<std::string> twists;     ///< bones that roll or twist with a limb's joints: kept
  std::vector<std::string> missing;    ///< required joints that the model lacks: errors
  std::vector<std::string> extra;      ///< bones that no joint of the template stands for
  std::optional<Asymmetry> asymmetry;  ///< the largest
  double misfit = 0;  ///< how differently the model is built: 0 as the template, 1 not at all so
  double height_metres = 0;  ///< extent of the matched joints in world space
};

/// What an earlier fit of a template to the same model found.
struct Bindings {
  std::map<JointKey, int> nodes;  ///< glTF node of each joint that has a bone
  std::set<JointKey> made;        ///< joints that were made because the model has none
};

/// `known` counts before the map; with it a required joint that the model lacks is made and not
/// missing.
std::optional<tags::TaggedSkeleton> fit(const Expanded& expanded,
                                        const tags::ForeignSkeleton& model, const Map& map,
                                        FitReport& report, Diagnostics& diagnostics,
                                        const Bindings* known = nullptr);

}  // namespace rigc::templates
