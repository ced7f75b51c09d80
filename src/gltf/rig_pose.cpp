// SPDX-License-Identifier: MIT
// What animators set in a file without keying it. Test: tests/gltf/rig_read_test.cpp
#include "gltf/rig_pose.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "gltf/rig_codes.h"
#include "gltf/rig_json_values.h"
#include "math/limit.h"
#include "scene/access.h"

namespace rigc::gltf {
namespace {

using scene::NodeId;
using scene::Plug;

// Other programs keep floats, and their way from and to matrices costs a few more bits.
constexpr double kRelative = 1.0 / (1 << 22);
constexpr double kAbsolute = 1e-9;

bool same(double a, double b) {
  return static_cast<float>(a) == static_cast<float>(b) ||
         std::abs(a - b) <= std::max(kAbsolute, kRelative * std::max(std::abs(a), std::abs(b)));
}

bool same(const math::Vec3& a, const math::Vec3& b) {
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z);
}

/// As rotations: the two signs of a quaternion are one.
bool same(const math::Quat& a, const math::Quat& b) {
  const math::Quat c = math::dot(a, b) < 0 ? -b : b;
  const double largest = std::max(
      {std::abs(a.x - c.x), std::abs(a.y - c.y), std::abs(a.z - c.z), std::abs(a.w - c.w)});
  return largest <= kRelative;
}

bool is_driven(const scene::Scene& scene, NodeId id, std::uint16_t attribute) {
  const auto& inputs = scene[id].inputs;
  return std::any_of(inputs.begin(), inputs.end(), [&](const scene::Connection& connection) {
    return connection.to.attribute == attribute;
  });
}

/// A value whose locked components are what they were.
template <class T>
T held(const T& now, const math::Vec3& components_before, unsigned locked) {
  math::LimitSpace space;
  for (unsigned i = 0; i < 3; ++i)
    if (locked & 1u << i) space.min[i] = space.max[i] = components_before[i];
  if constexpr (std::is_same_v<T, math::Quat>)
    return math::limit_rotation(now, space);
  else
    return math::limit_vector(now, space);
}

/// Changes a scene and remembers what was there.
class Poser {
 public:
  explicit Poser(Rig& rig) : maker_(rig.scene), posed_(rig.posed) {}
  const scene::Scene& scene() const { return maker_.scene(); }
  void set(const Plug& plug, const scene::Value& value) {
    posed_.push_back({plug, scene().value(plug)});
    maker_.set(plug, value);
  }

 private:
  SceneMaker maker_;
  std::vector<Posed>& posed_;
};

void take_over_transform(const math::Trs& local, Poser& poser, NodeId id, const Place& place,
                         Diagnostics& diagnostics) {
  namespace transform = scene::transform;
  const scene::Scene& scene = poser.scene();
  const math::Trs before = scene.local(id);
  const auto angles = std::get<math::Vec3>(scene.value({id, transform::kRotate}));
  const unsigned locked = scene::bits_at(scene, id, scene::control::kLocked);
  bool moved = false;
  const auto take = [&](std::uint16_t attribute, const auto& now, const auto& was,
                        const math::Vec3& components, unsigned bits) {
    if (same(now, was)) return;
    const auto value = held(now, components, bits & 7);
    moved = moved || !same(value, now);
    if (!same(value, was)) poser.set({id, attribute}, value);
  };
  if (!is_driven(scene, id, transform::kTranslate))
    take(transform::kTranslate, local.translation, before.translation, before.translation, locked);
  if (!is_driven(scene, id, transform::kRotation) && !is_driven(scene, id, transform::kRotate))
    take(transform::kRotation, local.rotation, before.rotation, angles, locked >> 3);
  if (!is_driven(scene, id, transform::kScale))
    take(transform::kScale, local.scale, before.scale, before.scale, locked >> 6);
  if (!moved) return;
  diagnostics.report(
      codes::kLockedMoved, place,
      fmt::format("\"{}\" stands where the rig's locks do not let it", printable(scene[id].name)));
}

void take_over_attributes(const File& file, const json::Value& extras, Poser& poser, NodeId id,
                          Diagnostics& diagnostics) {
  const std::size_t count = poser.scene()[id].user.size();
  for (std::size_t i = 0; i < count; ++i) {
    const scene::UserAttribute& attribute = poser.scene()[id].user[i];
    const Plug plug{id, static_cast<std::uint16_t>(scene::kUserAttributes + i)};
    const json::Value value = extras[attribute.name];
    if (!value || !attribute.keyable || poser.scene().source(plug)) continue;
    std::optional<double> number = value.number();
    if (const auto flag = value.boolean()) number = *flag ? 1 : 0;
    if (!number) {
      diagnostics.report(codes::kExtraNotNumber, Place(file.path, value.pointer()),
                         fmt::format("\"{}\" of \"{}\" is not a number", attribute.name,
                                     printable(poser.scene()[id].name)));
    } else if (!same(*number, attribute.value)) {
      poser.set(plug, *number);
    }
  }
}

}  // namespace

void take_over_pose(const File& file, const Slim& slim, const std::vector<json::Value>& nodes,
                    Rig& rig, Diagnostics& diagnostics) {
  Poser poser(rig);
  for (const NodeId id : rig.scene.nodes()) {
    const int node = rig.nodes[id.index];
    if (rig.scene[id].kind != scene::Kind::control || node < 0) continue;
    take_over_transform(slim.node(node).local, poser, id,
                        Place(file.path, fmt::format("/nodes/{}", node)), diagnostics);
    take_over_attributes(file, nodes[static_cast<std::size_t>(node)]["extras"], poser, id,
                         diagnostics);
  }
}

scene::Scene built_scene(const Rig& rig) {
  scene::Scene scene = rig.scene;
  SceneMaker maker(scene);
  for (auto posed = rig.posed.rbegin(); posed != rig.posed.rend(); ++posed)
    maker.set(posed->plug, posed->built);
  return scene;
}

}  // namespace rigc::gltf
