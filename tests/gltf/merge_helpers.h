// SPDX-License-Identifier: MIT
// What the tests of merging share.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "gltf/merge.h"

namespace rigc::gltf::test {

/// A value by its JSON pointer, which must lead to one.
json::Value at(const json::Value& root, const std::string& pointer);
/// A .glb of JSON and BIN.
File opened(const std::string& text, const std::string& bin, const std::string& name);
/// The merged file, opened; empty where something was refused.
std::optional<File> merged(const std::deque<File>& files, Diagnostics& diagnostics,
                           const MergeOptions& options = {});

}  // namespace rigc::gltf::test
