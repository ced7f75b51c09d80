// SPDX-License-Identifier: MIT
// The humanoids of the corpus and how the biped gets onto them: one table that the tests of
// fitting, of losslessness and of motion share. Test: tests/pipeline/humanoids_test.cpp
#pragma once

#include <string>
#include <vector>

namespace rigc::test {

/// A character that `rigc build templates/biped.yaml --model FILE` must rig.
struct Humanoid {
  std::string file;  ///< below the corpus folder
  std::string map;   ///< a user map in tests/maps, for --map; empty: the map is found by detection
  std::string fitted_with;  ///< name of the map that the fit then reports
  std::size_t matched = 0;  ///< bones that joints of the biped stand for
};

const std::vector<Humanoid>& humanoids();

/// What goes into BuildRequest::map: the path of a humanoid's user map, or empty.
inline std::string user_map(const Humanoid& humanoid) {
  return humanoid.map.empty() ? "" : std::string(RIGC_SOURCE_DIR) + "/tests/maps/" + humanoid.map;
}

}  // namespace rigc::test
