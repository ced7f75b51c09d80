// SPDX-License-Identifier: MIT
// Clips: channels of keys as glTF stores them, and how they are sampled.
// Test: tests/anim/clip_test.cpp
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "math/math.h"

namespace rigc::anim {

enum class Interpolation : std::uint8_t { step, linear, cubic };

/// Keys of one attribute. Times in seconds, strictly rising, shared between channels that share an
/// accessor.
struct Curve {
  Interpolation interpolation = Interpolation::linear;
  int width = 1;                                    ///< numbers a value: 1, 3, 4
  std::shared_ptr<const std::vector<float>> times;  ///< [n], at least one
  std::vector<float> values;  ///< [n][width]; cubic: [n][in tangent, value, out tangent][width]
};

enum class Path : std::uint8_t { translation, rotation, scale, weights, attribute };

/// What a channel drives: a node of the file by its index there.
struct Channel {
  int node = -1;  ///< glTF node
  Path path = Path::translation;
  std::string attribute;    ///< of Path::attribute: name in the node's extras
  int source_channel = -1;  ///< index of the channel in the file's animation
  bool baked = false;       ///< made by a bake: rigc's own, which the next bake makes again
  Curve curve;
};

struct Clip {
  std::string name;
  int source_animation = -1;  ///< index in the file
  std::vector<Channel> channels;
};

/// Value of a curve at a time, exactly as glTF 2.0 appendix C says: clamped outside the keys; step;
/// linear (rotations: slerp the shorter way); cubic Hermite with tangents times the key distance
/// (rotations normalised). `out` takes `width` doubles. `rotation` says that the four numbers are a
/// quaternion.
void sample(const Curve& curve, bool rotation, double seconds, double* out);

/// Samples one curve again and again; where times rise it need not look for the keys. Gives exactly
/// the numbers of sample().
class Sampler {
 public:
  /// `curve` outlives the sampler.
  Sampler(const Curve& curve, bool rotation) : curve_(&curve), rotation_(rotation) {}
  void at(double seconds, double* out);
  /// The same at every time.
  bool is_constant() const { return curve_->times->size() == 1; }

 private:
  const Curve* curve_;
  bool rotation_;
  std::size_t after_ = 0;  ///< keys up to the last time that was asked for
};

/// Time of the earliest and the latest key of any channel; 0 for a clip without keys.
double first_time(const Clip& clip);
double last_time(const Clip& clip);

/// Union of the key times of all channels, rising, without repeats.
std::vector<double> key_times(const Clip& clip);

}  // namespace rigc::anim
