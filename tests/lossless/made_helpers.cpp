// SPDX-License-Identifier: MIT
// Files of kinds that the corpus lacks, made from nothing.
#include <fmt/format.h>

#include "gltf/file_helpers.h"
#include "lossless_helpers.h"

namespace rigc::test::lossless {
namespace {

namespace helpers = gltf::test;
using helpers::data_uri;
using helpers::glb;

/// Two joints with a skin each: `skins` of them.
std::string many_skins(std::size_t skins) {
  std::string nodes, list, names;
  for (std::size_t i = 0; i < skins; ++i) {
    const char* comma = i == 0 ? "" : ",";
    nodes += fmt::format(R"({}{{"children":[{}]}},{{}})", comma, 2 * i + 1);
    list += fmt::format(R"({}{{"joints":[{},{}],"name":"same"}})", comma, 2 * i, 2 * i + 1);
    names += fmt::format("{}{}", comma, 2 * i);
  }
  return fmt::format(
      R"({{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[{}]}}],"nodes":[{}],"skins":[{}]}})",
      names, nodes, list);
}

/// Nothing but nodes; `rest` follows them.
std::string bare(const std::string& rest) {
  return R"({"asset":{"version":"2.0"},"nodes":[{"children":[1]},{"extras":{}},{"extras":null}])" +
         rest + "}";
}

std::string empty_containers() {
  return R"({ "asset": {"version": "2.0", "extras": [null, {}, []]}, "extensions": { },
  "extensionsUsed": [ ], "extensionsRequired": [], "accessors": [ ], "bufferViews": [],
  "buffers": [ ], "meshes": [
  ], "materials": [], "skins": [], "animations": [],
  "scenes": [{"nodes": [ ]}, {}],
  "nodes": [{"children": [1], "extras": { }, "extensions": {}}, {"children": [ ], "extras": {"rigc": 7}}] })";
}

/// A compressed view in buffer 0, its uncompressed stand-in in buffer 1, which has no bytes.
std::string meshopt(const std::string& uri) {
  return R"({"asset":{"version":"2.0"},"extensionsUsed":["EXT_meshopt_compression"],)"
         R"("extensionsRequired":["EXT_meshopt_compression"],"nodes":[{}],"scenes":[{"nodes":[0]}],)"
         R"("bufferViews":[{"buffer":1,"byteLength":64,"extensions":{"EXT_meshopt_compression":)"
         R"({"buffer":0,"byteOffset":4,"byteLength":6,"byteStride":16,"mode":"ATTRIBUTES","count":4}}}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC4"}],)"
         R"("buffers":[{"byteLength":10)" +
         uri +
         R"(},{"byteLength":64,"extensions":{"EXT_meshopt_compression":{"fallback":true}}}]})";
}

std::string draco() {
  return R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_draco_mesh_compression"],)"
         R"("extensionsRequired":["KHR_draco_mesh_compression"],"nodes":[{"mesh":0},{}],)"
         R"("scene":0,"scenes":[{"nodes":[0,1]}],"bufferViews":[{"buffer":0,"byteLength":7}],)"
         R"("accessors":[{"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"extensions":)"
         R"({"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":0}}}}]}],)"
         R"("buffers":[{"byteLength":7}]})";
}

/// Two scenes share a root; one joint is a matrix; names are equal or missing.
std::string scenes() {
  return R"({"asset":{"version":"2.0"},"scene":1,"scenes":[{"nodes":[3]},{"name":"b","nodes":[0,3]},)"
         R"({"nodes":[4]}],"nodes":[{"name":"same","children":[1]},)"
         R"({"name":"same","matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,1,0,1],"children":[2]},{},{},{}],)"
         R"("skins":[{"joints":[0,1,2]},{"joints":[1,2]}]})";
}

std::string images_in_bin() {
  return R"({"asset":{"version":"2.0"},"images":[{"bufferView":0,"mimeType":"image/png"}],)"
         R"("bufferViews":[{"buffer":0,"byteOffset":1,"byteLength":8}],"nodes":[{}],)"
         R"("scenes":[{"nodes":[0]}],"buffers":[{"byteLength":1.1e1,"extras":[]}]})";
}

std::string with_chunk(std::string bytes, const std::string& chunk) {
  bytes += chunk;
  for (std::size_t i = 0; i < 4; ++i) bytes[8 + i] = static_cast<char>(bytes.size() >> 8 * i & 255);
  return bytes;
}

}  // namespace

std::vector<Sample> made_samples(const std::string& folder) {
  std::vector<Sample> out;
  const auto add = [&](const std::string& name, std::string bytes) {
    out.push_back({name, folder + "/" + name, std::move(bytes)});
  };
  helpers::write_bytes(folder + "/first.bin", "0123456789");
  helpers::write_bytes(folder + "/sp ace.bin", "abcd");
  const std::string bin = "0123456789", empty_bin("\0\0\0\0BIN\0", 8);
  const std::string small = R"({"asset":{"version":"2.0"},"nodes":[{}],"scenes":[{"nodes":[0]}])";
  const std::string scenes_only = R"(,"scenes":[{"nodes":[0,2]}])";
  add("small.gltf", helpers::small_model());
  add("many_skins.gltf", many_skins(84));
  add("no_scenes.gltf", bare(""));
  add("no_default_scene.glb", glb(bare(scenes_only), ""));
  add("no_nodes.gltf", R"({"asset":{"version":"2.0"}})");
  add("empty_containers.gltf", empty_containers());
  add("empty_containers.glb", glb(empty_containers(), ""));
  add("meshopt.glb", glb(meshopt(""), bin));
  add("meshopt.gltf", meshopt(R"(,"uri":"first.bin")"));
  add("draco.glb", glb(draco(), "draco!!"));
  add("scenes.gltf", scenes());
  add("images_in_bin.glb", glb(images_in_bin(), "0123456789a"));
  add("buffers.gltf",
      small + R"(,"buffers":[{"byteLength":10,"uri":"first.bin"},{"byteLength":3,)" + R"("uri":")" +
          data_uri("xyz") + R"("},{"uri":"sp%20ace.bin","byteLength":4}]})");
  add("buffers.glb", glb(small + R"(,"buffers":[{"byteLength":9.0},{"byteLength":4,)" +
                             R"("uri":"sp%20ace.bin"}]})",
                         bin));
  add("first_is_file.glb", glb(small + R"(,"buffers":[{"byteLength":10,"uri":"first.bin"}]})", ""));
  add("no_bin.glb", glb(small + "}", ""));
  add("bin_without_buffer.glb", glb(small + "}", "bytes that nobody names"));
  add("empty_bin.glb", with_chunk(glb(small + "}", ""), empty_bin));
  add("bin_is_longer.glb", glb(small + R"(,"buffers":[{"byteLength":3}]})", "012345678901234"));
  add("more_chunks.glb",
      with_chunk(glb(small + "}", "abcd"), std::string("\x04\0\0\0XTRAdata", 12)));
  add("blanks.glb", glb("  \n" + small + "}\n" + std::string(23, ' '), ""));
  add("blanks.gltf", "\t\n" + small + "  }  \n\n ");
  return out;
}

}  // namespace rigc::test::lossless
