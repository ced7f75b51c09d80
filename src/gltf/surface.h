// SPDX-License-Identifier: MIT
// A mesh of a file, found by name, as a surface that things are laid on: triangles with places in a
// texture. Test: tests/gltf/surface_test.cpp
#pragma once

#include <set>
#include <string>
#include <vector>

#include "gltf/file.h"
#include "gltf/slim.h"
#include "tags/tags.h"

namespace rigc::gltf {

/// Nodes with a mesh whose name this is; where there is none, those whose mesh has it. `without`:
/// nodes that do not count.
std::vector<int> surface_nodes(const File& file, const std::string& name,
                               const std::set<int>& without = {});

/// The mesh of a node that has one. Where it cannot be read (compressed, damaged, without texture
/// coordinates or triangles), its `trouble` says so.
tags::Surface read_surface(const File& file, const Slim& slim, int node);

}  // namespace rigc::gltf
