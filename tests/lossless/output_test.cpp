// SPDX-License-Identifier: MIT
// Outputs in other folders and other containers: what a file refers to goes along, nothing of
// others is overwritten, and the data are the same.
#include <doctest/doctest.h>

#include <filesystem>

#include "base/files.h"
#include "gltf/codes.h"
#include "gltf/file_helpers.h"
#include "gltf/uri.h"
#include "lossless_helpers.h"
#include "pipeline/build.h"

using namespace rigc;
using namespace rigc::test::lossless;
namespace fs = std::filesystem;
namespace helpers = rigc::gltf::test;

namespace {

/// Two buffers and two images in folders with odd names, one of each embedded, one image of nobody.
std::string model_text() {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
         R"("meshes":[{"primitives":[{"mode":0,"attributes":{"POSITION":0,"_A":1,"_B":2}}]}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":1,"type":"VEC3",)"
         R"("min":[0,0,0],"max":[0,0,0]},{"bufferView":1,"componentType":5126,"count":1,)"
         R"("type":"SCALAR"},{"bufferView":2,"componentType":5126,"count":1,"type":"SCALAR"}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":12},{"buffer":1,"byteLength":4},)"
         R"({"buffer":2,"byteLength":4}],)"
         R"("images":[{"uri":"textures/a%20b.png"},{"uri":"textures/%C3%A9.png"}],)"
         R"("buffers":[{"byteLength":12,"uri":"data/first.bin"},{"byteLength":4,"uri":")" +
         helpers::data_uri(helpers::floats({0.25f})) +
         R"("},{"uri":"data%2Fdeep/sp%20ace.bin","byteLength":4}]})";
}

const char* const kFiles[] = {"data/first.bin", "data/deep/sp ace.bin", "textures/a b.png",
                              "textures/\xc3\xa9.png"};

/// Images are never decoded.
std::string png() { return std::string("\x89PNG\0\r\n", 7); }

std::string write_model(const std::string& folder) {
  for (const char* name : {"data/deep", "textures"}) fs::create_directories(folder + "/" + name);
  helpers::write_bytes(folder + "/" + kFiles[0], helpers::floats({0, 0, 0}));
  helpers::write_bytes(folder + "/" + kFiles[1], helpers::floats({1}));
  helpers::write_bytes(folder + "/" + kFiles[2], png());
  helpers::write_bytes(folder + "/" + kFiles[3], png());
  helpers::write_bytes(folder + "/model.gltf", model_text());
  return folder + "/model.gltf";
}

/// Opens a model, puts a rig onto it and writes it as `out`; gives what was reported.
std::vector<int> rewritten(const std::string& model, const std::string& out) {
  Diagnostics diagnostics;
  const auto file = gltf::open(model, diagnostics);
  REQUIRE_MESSAGE(file, render(diagnostics, false));
  std::mt19937_64 random(4);
  int ancestor = -1;
  gltf::Rig rig = rig_for(*file, random, 0, false, ancestor);
  gltf::Patch patch(*file);
  REQUIRE(gltf::write_rig(patch, rig, ancestor, diagnostics));
  std::uint64_t bytes = 0;
  const bool written = pipeline::write_output(patch, *file, out, bytes, diagnostics);
  CHECK(written == diagnostics.ok());
  if (!written) return helpers::numbers(diagnostics);
  const auto after = gltf::open(out, diagnostics);
  REQUIRE_MESSAGE(after, render(diagnostics, false));
  expect_kept(*file, *after, rig);
  helpers::allow_messages_of(out, model);
  return helpers::numbers(diagnostics);
}

std::string bytes_at(const std::string& path) {
  Diagnostics diagnostics;
  const auto bytes = Bytes::open(path, UINT64_MAX, diagnostics);
  return bytes ? helpers::text(*bytes) : "missing";
}

using Numbers = std::vector<int>;
const int kClash = gltf::codes::kCopyClash.number;
const int kMissed = gltf::codes::kNotCopied.number;

}  // namespace

TEST_CASE("lossless output: what a file refers to goes along into another folder") {
  const std::string from = folder("broken/from"), to = folder("broken/to");
  const std::string model = write_model(from);
  CHECK(rewritten(model, to + "/out.gltf") == Numbers{});
  for (const char* name : kFiles) CHECK(bytes_at(to + "/" + name) == bytes_at(from + "/" + name));
  // From .gltf to .glb: the first buffer is in BIN.
  const std::string binary = folder("broken/to_glb");
  CHECK(rewritten(model, binary + "/out.glb") == Numbers{});
  CHECK_FALSE(fs::exists(binary + "/data/first.bin"));
  CHECK(bytes_at(binary + "/" + kFiles[1]) == bytes_at(from + "/" + kFiles[1]));
  // From there to .gltf.
  const std::string back = folder("broken/back");
  fs::remove(from + "/" + kFiles[2]);
  CHECK(rewritten(binary + "/out.glb", back + "/out.gltf") == Numbers{});
  CHECK(bytes_at(back + "/" + kFiles[2]) == png());
  // In place, and beside the model.
  CHECK(rewritten(to + "/out.gltf", to + "/out.gltf") == Numbers{});
  CHECK(rewritten(to + "/out.gltf", to + "/second.glb") == Numbers{});
}

TEST_CASE("lossless output: what lies in the way stays, what is missing is said") {
  const std::string from = folder("broken/clash_from"), to = folder("broken/clash_to");
  const std::string model = write_model(from);
  fs::create_directories(to + "/textures");
  helpers::write_bytes(to + "/textures/a b.png", "mine");
  CHECK(rewritten(model, to + "/out.gltf") == Numbers{kClash});
  CHECK(bytes_at(to + "/textures/a b.png") == "mine");
  CHECK_FALSE(fs::exists(to + "/out.gltf"));
  CHECK_FALSE(fs::exists(to + "/data"));
  helpers::write_bytes(to + "/textures/a b.png", png());  // the same content is not in the way
  CHECK(rewritten(model, to + "/out.gltf") == Numbers{});

  const std::string missing = folder("broken/clash_missing");
  fs::remove(from + "/textures/a b.png");
  CHECK(rewritten(model, missing + "/out.gltf") == Numbers{kMissed});
  fs::create_directories(from + "/textures/a b.png");
  CHECK(rewritten(model, missing + "/out.gltf") == Numbers{kMissed});

  const std::string leaving = folder("broken/clash_leaving");
  helpers::write_bytes(from + "/../secret.png", "secret");
  helpers::write_bytes(from + "/leaving.gltf",
                       R"({"asset":{"version":"2.0"},"images":[{"uri":"../secret.png"},)"
                       R"({"uri":"/etc/hostname"},{"uri":"https://example.org/a.png"}]})");
  CHECK(rewritten(from + "/leaving.gltf", leaving + "/inner/out.gltf") ==
        Numbers{kMissed, 5});  // there is no folder inner
  CHECK(rewritten(from + "/leaving.gltf", leaving + "/out.gltf") == Numbers{kMissed});
  CHECK_FALSE(fs::exists(leaving + "/secret.png"));

  helpers::write_bytes(from + "/itself.gltf",
                       R"({"asset":{"version":"2.0"},"images":[{"uri":"out.gltf"}]})");
  helpers::write_bytes(from + "/out.gltf", "no image");
  CHECK(rewritten(from + "/itself.gltf", leaving + "/out.gltf") == Numbers{kClash});
  // A link that leads out of the output's folder is not followed.
  fs::create_directory_symlink(fs::absolute(from), missing + "/data_link");
  helpers::write_bytes(from + "/b.png", png());
  fs::create_directories(from + "/data_link");
  helpers::write_bytes(from + "/data_link/b.png", png());
  helpers::write_bytes(from + "/link.gltf",
                       R"({"asset":{"version":"2.0"},"images":[{"uri":"data_link/b.png"}]})");
  CHECK(rewritten(from + "/link.gltf", missing + "/link.gltf") == Numbers{kMissed});
}

TEST_CASE("lossless output: the corpus from each container into the other and back") {
  const std::string hidden = folder("broken/containers");
  for (const Sample& sample : corpus_samples(folder("containers"))) {
    CAPTURE(sample.name);
    const gltf::File file = opened(sample);
    Diagnostics diagnostics;
    gltf::Patch patch(file);
    std::uint64_t bytes = 0;
    std::string other = sample.path + (file.binary ? ".gltf" : ".glb");
    // Embedded buffers stay embedded; the validator warns of every one in a .glb but the first.
    for (std::size_t i = 1; i < file.buffers.size(); ++i)
      if (gltf::is_data_uri(file.buffers[i].uri)) other = hidden + "/" + sample.name + ".glb";
    REQUIRE(pipeline::write_output(patch, file, other, bytes, diagnostics));
    helpers::allow_messages_of(other, sample.path);
    const auto second = gltf::open(other, diagnostics);
    REQUIRE_MESSAGE(second, render(diagnostics, false));
    gltf::Patch again(*second);
    const std::string third = sample.path + ".back." + (file.binary ? "glb" : "gltf");
    REQUIRE(pipeline::write_output(again, *second, third, bytes, diagnostics));
    helpers::allow_messages_of(third, sample.path);
    const auto back = gltf::open(third, diagnostics);
    REQUIRE_MESSAGE(back, render(diagnostics, false));
    for (const auto& [key, value] : file.root().members())
      if (key != "buffers") CHECK(back->root()[key].text() == value.text());
    REQUIRE(back->buffers.size() == file.buffers.size());
    for (std::size_t i = 0; i < file.buffers.size(); ++i)
      CHECK(helpers::text(back->buffers[i].bytes) == helpers::text(file.buffers[i].bytes));
    if (file.binary && file.other_chunks.empty())
      CHECK(bytes_at(third) == helpers::text(file.whole));
  }
}
