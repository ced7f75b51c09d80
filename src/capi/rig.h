// SPDX-License-Identifier: MIT
// A rig as callers of rigc_eval.h see it: controls with their channels, and joints, by number.
// Test: tests/capi/capi_test.cpp
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.h"
#include "base/diagnostics.h"
#include "capi/rigc_eval.h"
#include "math/math.h"
#include "scene/scene.h"

namespace rigc::capi {

struct Channel {
  scene::Plug plug;
  rigc_channel_info info;
};

struct Control {
  scene::NodeId id;
  rigc_control_info info;
  std::uint32_t first_channel = 0;  ///< into Rig::channels
};

struct Joint {
  scene::NodeId id;
  rigc_joint_info info;
  scene::NodeId base;    ///< node of the scene that it hangs under in its file; invalid: the space
  math::Affine between;  ///< from the base to the node's parent in the file
};

/// Immutable. What its infos point to are its own strings.
struct Rig {
  scene::Scene scene;
  Sources sources;  ///< that places in the scene point into
  rigc_rig_info info;
  std::vector<Control> controls;
  std::vector<Channel> channels;  ///< control by control
  std::vector<Joint> joints;
  std::map<std::string, std::uint32_t, std::less<>> control_numbers,
      joint_numbers;  ///< by identity
  std::deque<std::string> texts;

  const Channel* channel(std::uint32_t control, std::uint32_t channel) const;
};

/// What there is to open: which rig of which bytes, and what messages call them.
struct Source {
  Bytes bytes;
  std::string name;
  std::uint32_t rig = 0;
};

/// Null where the bytes are no rig file, which is reported, or have no such rig, which is not.
std::shared_ptr<const Rig> open(const Source& source, Diagnostics& diagnostics);

}  // namespace rigc::capi
