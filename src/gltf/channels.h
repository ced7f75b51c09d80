// SPDX-License-Identifier: MIT
// Single channels of a file's animations: other targets, other values. Everything else of an
// animation stays, and what channels share stays shared. Test: tests/gltf/channels_test.cpp
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "anim/clip.h"
#include "gltf/file.h"
#include "gltf/patch.h"

namespace rigc::gltf {

/// A change to one channel.
struct ChannelEdit {
  int animation = 0, channel = 0;             ///< indices in the file
  int node = -1;                              ///< that it drives from now on
  std::string attribute;                      ///< of Path::attribute: name in the node's extras
  anim::Path path = anim::Path::translation;  ///< as it was
  int width = 3;                              ///< numbers of a value
  std::optional<std::vector<float>> values;   ///< in place of those of its sampler
};

/// Changes channels. A sampler that other channels use too is copied where values change. Outputs
/// that nothing uses any more are released first, so that the new ones take their places.
void edit_channels(Patch& patch, const File& file, const std::vector<ChannelEdit>& edits);

/// Nodes that any channel drives, by pointer too, whatever it drives of them.
std::set<int> animated_nodes(const File& file);

/// Takes all channels away that drive one of these nodes, and gives how many there were.
std::size_t drop_channels(Patch& patch, const File& file, const std::set<int>& nodes);

}  // namespace rigc::gltf
