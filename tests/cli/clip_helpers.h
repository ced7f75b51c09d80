// SPDX-License-Identifier: MIT
// Clips for tests of the command line, put into .gltf files as another program would.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace rigc::test {

/// The same file with a clip "rise" that moves a node from 0 to 1 m up in a second.
std::string animated(const std::string& gltf, const nlohmann::json& node);

}  // namespace rigc::test
