// SPDX-License-Identifier: MIT
// Pieces of the descriptor reader that its files share. Each reads one part of a YAML tree and
// reports what is wrong with it. Test: tests/catalog/descriptor_test.cpp
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "base/yaml.h"
#include "catalog/descriptor.h"

namespace rigc::catalog {

std::vector<std::string> type_names();
std::vector<std::string> stage_names();

/// The value of a key that must be there; null where it is not, which is reported.
const yaml::Node* need(const yaml::Node& map, std::string_view key, std::string_view what,
                       Diagnostics& diagnostics);

/// A text that must be there and not be blank; empty where it is not, which is reported.
std::string need_text(const yaml::Node& map, std::string_view key, std::string_view what,
                      Diagnostics& diagnostics);

/// A name that must be there; empty where it is not, which is reported.
std::string need_name(const yaml::Node& map, std::string_view key, std::string_view what,
                      Diagnostics& diagnostics);

/// A text that may be there; empty where it is not.
std::string text_of(const yaml::Node& map, std::string_view key, Diagnostics& diagnostics);

/// One of a few words; empty where it is another, which is reported.
std::string word_of(const yaml::Node& node, const std::vector<std::string>& words,
                    std::string_view what, Diagnostics& diagnostics);

/// The list under `key`, which may be missing; anything but a list is reported.
const std::vector<yaml::Node>& list_of(const yaml::Node& map, std::string_view key,
                                       Diagnostics& diagnostics);

/// Whether a node is a map; anything else is reported.
bool expect_map(const yaml::Node& node, std::string_view what, Diagnostics& diagnostics);

/// `parameters:` with its frames, checked but for what concerns the whole descriptor.
void read_parameters(const yaml::Node& map, Descriptor& descriptor, Diagnostics& diagnostics);

/// `changes:`, behind the parameters that it names.
void read_changes(const yaml::Node& map, Descriptor& descriptor, Diagnostics& diagnostics);

}  // namespace rigc::catalog
