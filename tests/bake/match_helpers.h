// SPDX-License-Identifier: MIT
// Arms with FK and IK, and clips on them, for tests of matches.
#pragma once

#include <string>
#include <vector>

#include "bake/match.h"
#include "support/models.h"

namespace rigc::test {

/// Two arms on a chest with a control, under a root. `elbow`: how far before the shoulders it
/// rests; behind them, as elbows bend, or not.
std::string arms(double elbow = -0.04);

/// Every transform is its own glTF node.
std::vector<int> nodes_of(const scene::Scene& scene);

/// A clip that is put together key by key.
class Keys {
 public:
  Keys(const Rig& rig, std::vector<float> times)
      : rig_(rig), times_(std::make_shared<const std::vector<float>>(std::move(times))) {}

  template <class Make>
  void add(const std::string& selector, int width, Make make) {
    const scene::Plug plug = rig_.plug(selector);
    anim::Channel channel;
    channel.node = static_cast<int>(plug.node.index);
    channel.path = width == 3   ? anim::Path::translation
                   : width == 4 ? anim::Path::rotation
                                : anim::Path::attribute;
    if (width == 1)
      channel.attribute =
          rig_.scene()[plug.node].user[plug.attribute - scene::kUserAttributes].name;
    channel.curve.width = width;
    channel.curve.times = times_;
    for (std::size_t i = 0; i < times_->size(); ++i)
      for (const double number : make()) channel.curve.values.push_back(static_cast<float>(number));
    clip.channels.push_back(channel);
  }
  void translate(const std::string& control, Random& random, double extent) {
    add(control + "@translate", 3, [&] {
      const math::Vec3 v = random.vector(extent);
      return std::vector<double>{v.x, v.y, v.z};
    });
  }
  void turn(const std::string& control, Random& random) {
    add(control + "@rotation", 4, [&] {
      const math::Quat q = random.rotation();
      return std::vector<double>{q.x, q.y, q.z, q.w};
    });
  }
  /// A number of the range, or, as often, what does nothing.
  void number(const std::string& plug, Random& random, double low, double high, double nothing) {
    add(plug, 1, [&] {
      const double value = random.number(low, high);
      return std::vector<double>{random.chance(0.5) ? nothing : value};
    });
  }

  anim::Clip clip;

 private:
  const Rig& rig_;
  std::shared_ptr<const std::vector<float>> times_;
};

/// Worlds of the arm's joints, by evaluating the rig with what the clip holds.
std::vector<math::Affine> joints_at(const Rig& rig, const bake::MatchLimb& limb,
                                    const anim::Clip& clip, double seconds);

const bake::MatchLimb& find(const std::vector<bake::MatchLimb>& limbs, const std::string& name);

}  // namespace rigc::test
