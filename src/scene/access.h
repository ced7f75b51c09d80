// SPDX-License-Identifier: MIT
// What animators may do with a control's attributes, component by component: locked, hidden,
// keyable. Bits as in control::kLocked. Test: tests/scene/access_test.cpp
#pragma once

#include <string_view>

#include "scene/scene.h"

namespace rigc::scene {

inline constexpr unsigned kTranslateBits = 7;
inline constexpr unsigned kRotateBits = 7 << 3;
inline constexpr unsigned kScaleBits = 7 << 6;
inline constexpr unsigned kAllComponents = 9;

/// The bits of translate, rotate, scale or one component of them; 0 for every other attribute and
/// for components of `rotation`.
unsigned component_bits(const Plug& plug);
/// `translate.x` for 0, to `scale.z` for 8.
std::string_view component_name(unsigned component);

/// What is stored in control::kLocked or control::kHidden.
unsigned bits_at(const Scene& scene, NodeId control, std::uint16_t attribute);
/// Components that animators may key: of attributes that are keyable, and not locked.
unsigned keyable_bits(const Scene& scene, NodeId control);
/// Components that a connection decides.
unsigned driven_bits(const Scene& scene, NodeId transform);

}  // namespace rigc::scene
