// SPDX-License-Identifier: MIT
// What animators may do with a control's attributes. Test: tests/scene/access_test.cpp
#include "scene/access.h"

#include <array>
#include <cassert>

namespace rigc::scene {

namespace {

constexpr std::array<std::string_view, kAllComponents> kNames = {
    "translate.x", "translate.y", "translate.z", "rotate.x", "rotate.y",
    "rotate.z",    "scale.x",     "scale.y",     "scale.z"};

unsigned whole_bits(std::uint16_t attribute) {
  switch (attribute) {
    case transform::kTranslate:
      return kTranslateBits;
    case transform::kRotation:
    case transform::kRotate:
      return kRotateBits;
    case transform::kScale:
      return kScaleBits;
    default:
      return 0;
  }
}

}  // namespace

unsigned component_bits(const Plug& plug) {
  const unsigned whole = whole_bits(plug.attribute);
  if (plug.component < 0) return whole;
  if (plug.attribute == transform::kRotation) return 0;
  return whole & (0b001001001u << plug.component);
}

std::string_view component_name(unsigned component) { return kNames[component]; }

unsigned bits_at(const Scene& scene, NodeId control, std::uint16_t attribute) {
  assert(scene[control].kind == Kind::control);
  const double stored = scene.number({control, attribute});
  // Files may hold anything.
  return stored >= 0 && stored < 512 ? static_cast<unsigned>(stored) : 0;
}

unsigned keyable_bits(const Scene& scene, NodeId control) {
  const unsigned attributes = bits_at(scene, control, control::kKeyable);
  const unsigned bits = (attributes & 1 ? kTranslateBits : 0) | (attributes & 2 ? kRotateBits : 0) |
                        (attributes & 4 ? kScaleBits : 0);
  return bits & ~bits_at(scene, control, control::kLocked);
}

unsigned driven_bits(const Scene& scene, NodeId node) {
  unsigned bits = 0;
  for (const Connection& connection : scene[node].inputs) {
    const unsigned found = component_bits(connection.to);
    // One number of a quaternion decides about all three angles.
    bits |= found == 0 ? whole_bits(connection.to.attribute) : found;
  }
  return bits;
}

}  // namespace rigc::scene
