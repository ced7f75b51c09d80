// SPDX-License-Identifier: MIT
// What other programs put into the file of a rig, and whether it is still there.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "support/skeletons.h"

namespace rigc::test {

/// What is not rigc's in a file: by JSON pointer, and bytes by view.
struct Foreign {
  std::map<std::string, std::string> texts;
  std::map<int, std::string> bytes;
  std::vector<std::pair<int, int>> children;  ///< parent, child
};

/// What other programs do with a rig's file: nodes, a mesh, a clip and unknown extensions of theirs
/// after ours; extras, an extension and children on our controls and joints; a channel of theirs in
/// one of our clips.
Foreign add_foreign(const std::string& path, Random& random);

/// What of it a file no longer has as it was, one a line.
std::string changes(const Foreign& foreign, const std::string& path);

}  // namespace rigc::test
