// SPDX-License-Identifier: MIT
// Looking into JSON that rigc printed, with another parser than rigc's own.
#pragma once

#include <string>

namespace rigc::test {

/// One complete JSON document and nothing else.
bool is_json(const std::string& text);
/// The value at a JSON pointer as JSON text; empty where there is none.
std::string json_at(const std::string& text, const std::string& pointer);
/// Keys of the object at a JSON pointer, sorted, each followed by a blank; empty where there is
/// none.
std::string json_keys(const std::string& text, const std::string& pointer);

}  // namespace rigc::test
