// SPDX-License-Identifier: MIT
// Puts new keys into a range of a curve. Test: tests/bake/key_edit_test.cpp
#include "bake/key_edit.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rigc::bake {
namespace {

using anim::Interpolation;
using Numbers = std::array<double, 4>;

/// Between two keys of a cubic rotation the numbers are not of length 1: players make them so. A
/// key there must be, so where they are off by more than this, the part of the curve that stays is
/// written as so many short ones that follow what players make of it.
constexpr double kOffUnit = 1e-4;
constexpr int kShortOnes = 32;

/// A key with tangents, which only cubic curves write.
struct Key {
  float time = 0;
  Numbers in{}, value{}, out{};
};

class Editor {
 public:
  explicit Editor(const KeyEdit& edit) : edit_(edit), width_(edit.rest.size()) {
    if (edit.curve) interpolation_ = edit.curve->interpolation;
    const bool alone = !edit.curve || (edit.opens && edit.closes);
    if (alone && edit.steps) interpolation_ = Interpolation::step;
    if (!edit.steps && interpolation_ == Interpolation::step) {
      interpolation_ = Interpolation::linear;
      old_steps_ = true;
    }
  }

  anim::Curve run() {
    const auto first = static_cast<float>(edit_.times.front());
    const auto last = static_cast<float>(edit_.times.back());
    const float before = std::nextafter(first, -HUGE_VALF), after = std::nextafter(last, HUGE_VALF);
    if (!edit_.opens && before >= 0) {
      keep([&](float time) { return time < before; });
      guard(before);
      if (is_off_unit(keys_.back())) shorten_before();
    }
    add_new();
    if (!edit_.closes) {
      guard(after);
      const bool off_unit = is_off_unit(keys_.back());
      const std::size_t at = keys_.size() - 1;
      keep([&](float time) { return time > after; });
      if (off_unit) shorten_after(at);
    }
    return curve();
  }

 private:
  std::size_t keys_before() const { return edit_.curve ? edit_.curve->times->size() : 0; }

  Numbers numbers_at(std::size_t row) const {
    Numbers out{};
    for (std::size_t i = 0; i < width_; ++i)
      out[i] = static_cast<double>(edit_.curve->values[row * width_ + i]);
    return out;
  }

  Key old_key(std::size_t i) const {
    Key key;
    key.time = (*edit_.curve->times)[i];
    const bool cubic = interpolation_ == Interpolation::cubic;
    key.value = numbers_at(cubic ? 3 * i + 1 : i);
    if (cubic) {
      key.in = numbers_at(3 * i);
      key.out = numbers_at(3 * i + 2);
    }
    return key;
  }

  template <class Keeps>
  void keep(Keeps keeps) {
    for (std::size_t i = 0; i < keys_before(); ++i)
      if (Key key = old_key(i); keeps(key.time)) {
        if (old_steps_) hold_until(key);
        keys_.push_back(key);
      }
  }

  /// Right before a key that a step leads to: lines there play the step too.
  void hold_until(const Key& key) {
    const float before = std::nextafter(key.time, -HUGE_VALF);
    if (keys_.empty() || keys_.back().time >= before || keys_.back().value == key.value) return;
    Key held;
    held.time = before;
    held.value = keys_.back().value;
    join(held);
    keys_.push_back(held);
  }

  /// A key on the old curve. A cubic one is divided there: both parts are the same cubics.
  void guard(float time) {
    Key key;
    key.time = time;
    if (!edit_.curve) {
      std::copy(edit_.rest.begin(), edit_.rest.end(), key.value.begin());
    } else if (interpolation_ == Interpolation::cubic) {
      divide(key);
    } else {
      anim::sample(*edit_.curve, edit_.rotation, static_cast<double>(time), key.value.data());
    }
    if (old_steps_) hold_until(key);
    keys_.push_back(key);
  }

  void divide(Key& key) const {
    const auto& times = *edit_.curve->times;
    const std::size_t next = key_after(key.time);
    if (next == 0 || next == times.size()) {
      key.value = old_key(next == 0 ? 0 : next - 1).value;
      return;
    }
    const Key divided = on_cubic(old_key(next - 1), old_key(next), key.time);
    key.value = divided.value;
    key.in = key.out = divided.out;
  }

  std::size_t key_after(float time) const {
    const auto& times = *edit_.curve->times;
    return static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time) -
                                    times.begin());
  }

  /// Value and derivative, which is both tangents, of the cubic between two keys.
  Key on_cubic(const Key& a, const Key& b, float time) const {
    Key key;
    key.time = time;
    const double distance = static_cast<double>(b.time) - static_cast<double>(a.time);
    const double t = (static_cast<double>(time) - static_cast<double>(a.time)) / distance;
    const double t2 = t * t, t3 = t2 * t;
    for (std::size_t i = 0; i < width_; ++i) {
      const double rise = b.value[i] - a.value[i];
      key.value[i] = a.value[i] + (3 * t2 - 2 * t3) * rise +
                     distance * ((t3 - 2 * t2 + t) * a.out[i] + (t3 - t2) * b.in[i]);
      key.out[i] = 6 * (t - t2) * rise / distance + (3 * t2 - 4 * t + 1) * a.out[i] +
                   (3 * t2 - 2 * t) * b.in[i];
    }
    key.in = key.out;
    return key;
  }

  static double dot(const Numbers& a, const Numbers& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  }

  bool is_off_unit(const Key& key) const {
    return edit_.rotation && interpolation_ == Interpolation::cubic &&
           std::fabs(std::sqrt(dot(key.value, key.value)) - 1) > kOffUnit;
  }

  /// What players make of a key's numbers: of length 1, and their derivative.
  static void make_unit(Key& key) {
    const double length = std::sqrt(dot(key.value, key.value));
    if (!(length > 1e-9)) return;  // players make nothing of it either
    for (double& number : key.value) number /= length;
    const double along = dot(key.value, key.out);
    for (std::size_t i = 0; i < 4; ++i) key.out[i] = (key.out[i] - key.value[i] * along) / length;
    key.in = key.out;
  }

  /// Keys of length 1 on the cubic from `a` to `b`, from one time to another, both included.
  std::vector<Key> short_ones(const Key& a, const Key& b, float from, float to) const {
    std::vector<Key> keys;
    for (int i = 0; i <= kShortOnes; ++i) {
      const float part = static_cast<float>(i) / kShortOnes;
      const float time = i == kShortOnes ? to : from + (to - from) * part;
      if (!keys.empty() && (time <= keys.back().time || (time >= to && i < kShortOnes))) continue;
      keys.push_back(on_cubic(a, b, time));
      make_unit(keys.back());
    }
    return keys;
  }

  /// The last key divides a cubic of which the part before it stays.
  void shorten_before() {
    const float time = keys_.back().time;
    const std::size_t next = key_after(time);
    keys_.pop_back();
    const Key a = old_key(next - 1);
    const std::vector<Key> keys = short_ones(a, old_key(next), a.time, time);
    keys_.back().out = keys.front().out;
    keys_.insert(keys_.end(), keys.begin() + 1, keys.end());
  }

  /// The key at `at` divides a cubic of which the part after it stays.
  void shorten_after(std::size_t at) {
    const float time = keys_[at].time;
    const std::size_t next = key_after(time);
    const Key b = old_key(next);
    const std::vector<Key> keys = short_ones(old_key(next - 1), b, time, b.time);
    keys_[at + 1].in = keys.back().in;
    keys_[at] = keys.front();
    keys_.insert(keys_.begin() + static_cast<std::ptrdiff_t>(at) + 1, keys.begin() + 1,
                 keys.end() - 1);
  }

  void add_new() {
    const std::size_t count = edit_.times.size();
    const auto same = [&](std::size_t i) {
      return std::equal(edit_.values.begin(), edit_.values.begin() + width(),
                        edit_.values.begin() + static_cast<std::ptrdiff_t>(i * width_));
    };
    bool constant = true;
    for (std::size_t i = 1; i < count; ++i) constant = constant && same(i);
    for (std::size_t i = 0; i < count; ++i) {
      const bool at_end = i == 0 || (i + 1 == count && !edit_.closes);
      if (constant && !at_end) continue;
      Key key;
      key.time = static_cast<float>(edit_.times[i]);
      std::copy_n(edit_.values.begin() + static_cast<std::ptrdiff_t>(i * width_), width(),
                  key.value.begin());
      turn_to_last(key);
      if (edit_.steps && interpolation_ != Interpolation::step && new_keys_) hold_until(key);
      join(key);
      keys_.push_back(key);
      new_keys_ = true;
    }
    new_keys_ = false;
  }

  /// A straight line from the new key before.
  void join(Key& key) {
    if (!new_keys_) return;
    Key& last = keys_.back();
    const double distance = static_cast<double>(key.time) - static_cast<double>(last.time);
    for (std::size_t i = 0; i < width_; ++i)
      last.out[i] = key.in[i] = (key.value[i] - last.value[i]) / distance;
  }

  std::ptrdiff_t width() const { return static_cast<std::ptrdiff_t>(width_); }

  /// Of a rotation and its negative the one nearer to the key before.
  void turn_to_last(Key& key) const {
    if (!edit_.rotation || keys_.empty() || dot(key.value, keys_.back().value) >= 0) return;
    for (double& number : key.value) number = -number;
  }

  anim::Curve curve() {
    anim::Curve out;
    out.interpolation = interpolation_;
    out.width = static_cast<int>(width_);
    std::vector<float> times;
    const auto write = [&](const Numbers& numbers) {
      for (std::size_t i = 0; i < width_; ++i)
        out.values.push_back(static_cast<float>(numbers[i]) + 0.0f);
    };
    for (const Key& key : keys_) {
      times.push_back(key.time);
      if (interpolation_ == Interpolation::cubic) write(key.in);
      write(key.value);
      if (interpolation_ == Interpolation::cubic) write(key.out);
    }
    out.times = std::make_shared<const std::vector<float>>(std::move(times));
    return out;
  }

  const KeyEdit& edit_;
  std::size_t width_;
  Interpolation interpolation_ = Interpolation::linear;
  bool old_steps_ = false;  // played by lines
  std::vector<Key> keys_;
  bool new_keys_ = false;  // the last key is one
};

}  // namespace

anim::Curve edited(const KeyEdit& edit) { return Editor(edit).run(); }

}  // namespace rigc::bake
