// SPDX-License-Identifier: MIT
// Clips for tests of the command line.
#include "cli/clip_helpers.h"

namespace rigc::test {

std::string animated(const std::string& gltf, const nlohmann::json& node) {
  auto document = nlohmann::json::parse(gltf);
  const auto append = [&](const char* array, const char* text) {
    document[array].push_back(nlohmann::json::parse(text));
    return document[array].size() - 1;
  };
  // Times 0, 1; then the vectors 0 0 0 and 0 1 0.
  const std::size_t buffer =
      append("buffers", R"({"byteLength": 32, "uri": "data:application/octet-stream;base64,)"
                        R"(AAAAAAAAgD8AAAAAAAAAAAAAAAAAAAAAAACAPwAAAAA="})");
  const std::size_t view = append("bufferViews", R"({"byteLength": 32})");
  document["bufferViews"][view]["buffer"] = buffer;
  const std::size_t times =
      append("accessors",
             R"({"componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]})");
  const std::size_t values = append(
      "accessors", R"({"byteOffset": 8, "componentType": 5126, "count": 2, "type": "VEC3"})");
  for (const std::size_t accessor : {times, values})
    document["accessors"][accessor]["bufferView"] = view;
  const std::size_t clip = append("animations", R"({"name": "rise", "channels": [{"sampler": 0,
      "target": {"path": "translation"}}], "samplers": [{}]})");
  document["animations"][clip]["channels"][0]["target"]["node"] = node;
  document["animations"][clip]["samplers"][0] = {{"input", times}, {"output", values}};
  return document.dump();
}

}  // namespace rigc::test
