// SPDX-License-Identifier: MIT
// Sampling of curves as glTF 2.0 appendix C defines it, and the times of a clip.
// Test: tests/anim/clip_test.cpp
#include "anim/clip.h"

#include <algorithm>
#include <cassert>
#include <unordered_set>

namespace rigc::anim {

namespace {

// The rows of a key: cubic keys have an in tangent, a value and an out tangent.
const float* value_of(const Curve& curve, std::size_t key) {
  const auto width = static_cast<std::size_t>(curve.width);
  const bool cubic = curve.interpolation == Interpolation::cubic;
  return curve.values.data() + (cubic ? (key * 3 + 1) * width : key * width);
}

math::Quat quaternion_at(const float* v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]),
          static_cast<double>(v[3])};
}

void write(math::Quat q, double* out) {
  q = math::normalised(q);
  out[0] = q.x, out[1] = q.y, out[2] = q.z, out[3] = q.w;
}

void copy_key(const Curve& curve, bool rotation, std::size_t key, double* out) {
  const float* value = value_of(curve, key);
  if (rotation) return write(quaternion_at(value), out);
  for (int i = 0; i < curve.width; ++i) out[i] = static_cast<double>(value[i]);
}

void linear(const Curve& curve, bool rotation, std::size_t key, double t, double* out) {
  const float* a = value_of(curve, key);
  const float* b = value_of(curve, key + 1);
  if (rotation) {
    return write(
        math::slerp(math::normalised(quaternion_at(a)), math::normalised(quaternion_at(b)), t),
        out);
  }
  for (int i = 0; i < curve.width; ++i) {
    const auto from = static_cast<double>(a[i]), to = static_cast<double>(b[i]);
    out[i] = from + (to - from) * t;
  }
}

// Hermite: v(t) = (2t3 - 3t2 + 1) v0 + d (t3 - 2t2 + t) out0 + (-2t3 + 3t2) v1 + d (t3 - t2) in1.
void cubic(const Curve& curve, bool rotation, std::size_t key, double t, double distance,
           double* out) {
  const int width = curve.width;
  const float* v0 = value_of(curve, key);
  const float* v1 = value_of(curve, key + 1);
  const float* out0 = v0 + width;
  const float* in1 = v1 - width;
  const double t2 = t * t, t3 = t2 * t;
  const double of_v0 = 2 * t3 - 3 * t2 + 1, of_out0 = distance * (t3 - 2 * t2 + t);
  const double of_v1 = 3 * t2 - 2 * t3, of_in1 = distance * (t3 - t2);
  for (int i = 0; i < width; ++i) {
    out[i] = of_v0 * static_cast<double>(v0[i]) + of_out0 * static_cast<double>(out0[i]) +
             of_v1 * static_cast<double>(v1[i]) + of_in1 * static_cast<double>(in1[i]);
  }
  if (rotation) write({out[0], out[1], out[2], out[3]}, out);
}

/// `after`: how many keys lie at or before the time.
void sample_after(const Curve& curve, bool rotation, std::size_t after, double seconds,
                  double* out) {
  const std::vector<float>& times = *curve.times;
  assert(!times.empty() && (!rotation || curve.width == 4));
  if (after == 0) return copy_key(curve, rotation, 0, out);
  const std::size_t key = after - 1;
  if (after == times.size() || curve.interpolation == Interpolation::step) {
    return copy_key(curve, rotation, key, out);
  }
  const auto begin = static_cast<double>(times[key]);
  const double distance = static_cast<double>(times[key + 1]) - begin;
  const double t = (seconds - begin) / distance;
  if (curve.interpolation == Interpolation::linear) return linear(curve, rotation, key, t, out);
  cubic(curve, rotation, key, t, distance, out);
}

std::size_t keys_up_to(const std::vector<float>& times, double seconds) {
  const auto after = std::upper_bound(times.begin(), times.end(), seconds, [](double t, float key) {
    return t < static_cast<double>(key);
  });
  return static_cast<std::size_t>(after - times.begin());
}

}  // namespace

void sample(const Curve& curve, bool rotation, double seconds, double* out) {
  sample_after(curve, rotation, keys_up_to(*curve.times, seconds), seconds, out);
}

void Sampler::at(double seconds, double* out) {
  const std::vector<float>& times = *curve_->times;
  const auto passed = [&](std::size_t key) { return static_cast<double>(times[key]) <= seconds; };
  const bool rises = after_ > 0 && passed(after_ - 1);
  if (!rises) after_ = keys_up_to(times, seconds);
  while (after_ < times.size() && passed(after_)) ++after_;
  sample_after(*curve_, rotation_, after_, seconds, out);
}

double first_time(const Clip& clip) {
  bool found = false;
  double first = 0;
  for (const Channel& channel : clip.channels) {
    if (!channel.curve.times || channel.curve.times->empty()) continue;
    const auto t = static_cast<double>(channel.curve.times->front());
    first = found ? std::min(first, t) : t;
    found = true;
  }
  return first;
}

double last_time(const Clip& clip) {
  bool found = false;
  double last = 0;
  for (const Channel& channel : clip.channels) {
    if (!channel.curve.times || channel.curve.times->empty()) continue;
    const auto t = static_cast<double>(channel.curve.times->back());
    last = found ? std::max(last, t) : t;
    found = true;
  }
  return last;
}

std::vector<double> key_times(const Clip& clip) {
  // Channels mostly share their times; each list is taken once.
  std::unordered_set<const std::vector<float>*> seen;
  std::vector<double> all;
  for (const Channel& channel : clip.channels) {
    const std::vector<float>* times = channel.curve.times.get();
    if (!times || !seen.insert(times).second) continue;
    for (const float t : *times) all.push_back(static_cast<double>(t));
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace rigc::anim
