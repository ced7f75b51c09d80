// SPDX-License-Identifier: MIT
// Clips of a file in and out. Test: tests/gltf/clips_test.cpp
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "anim/clip.h"
#include "gltf/file.h"
#include "gltf/patch.h"

namespace rigc::gltf {

struct Slim;

/// All animations: node channels and KHR_animation_pointer channels at /nodes/N/extras/<attribute>,
/// /nodes/N/translation and so on; other pointers and morph weights are counted in `other_channels`
/// and left alone.
struct ClipFile {
  std::vector<anim::Clip> clips;
  std::vector<int> other_channels;  ///< by clip
};
/// `known`: of this file with its animations, where that has been read already.
std::optional<ClipFile> read_clips(const File& file, Diagnostics& diagnostics,
                                   const Slim* known = nullptr);

/// What becomes of animation `clip.source_animation` of a file (-1: a new one): channels with the
/// target of one that the clip brings, and those whose index is in `dropped_channels`, go; the
/// clip's channels come; everything else stays, with its samplers at their index.
struct ClipChange {
  anim::Clip clip;
  std::vector<int> dropped_channels;
};

/// Changes animations. Accessors that only channels used that go are released first, so that the
/// new ones take their places; equal times are written once. A node with a matrix that gets a
/// channel has the equal translation, rotation and scale from then on. An animation that is left
/// without channels becomes a placeholder, because others may have its index.
void write_clips(Patch& patch, const File& file, const std::vector<ClipChange>& changes);
inline void write_clip(Patch& patch, const File& file, const anim::Clip& clip,
                       const std::vector<int>& dropped_channels) {
  write_clips(patch, file, {{clip, dropped_channels}});
}

/// `extras.rigc` of a channel that a bake made.
inline constexpr std::string_view kBakedMark = "baked";

/// A step of a JSON pointer with `~` and `/` escaped (RFC 6901), and back.
std::string pointer_escaped(std::string_view step);
std::string pointer_unescaped(std::string_view step);

}  // namespace rigc::gltf
