// SPDX-License-Identifier: MIT
// Merging real files: every clip of every file plays as it did alone, bit for bit, and so do rigs;
// every byte of every view is there.
#include "pipeline/merge.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "bake/bake.h"
#include "base/files.h"
#include "gltf/clips.h"
#include "gltf/rig.h"
#include "pipeline/build.h"
#include "pipeline/character_helpers.h"
#include "pipeline/door_helpers.h"
#include "support/corpus.h"
#include "support/rig.h"
#include "support/skeletons.h"

using namespace rigc;
namespace fs = std::filesystem;

namespace {

/// Every file of the corpus, sorted; none where there is no corpus.
std::vector<std::string> corpus() {
  std::vector<std::string> files;
  const std::string some = test::corpus_file("khronos_Fox/Fox.glb");
  if (some.empty()) return files;
  for (const auto& entry : fs::recursive_directory_iterator(folder_of(folder_of(some)))) {
    const std::string extension = entry.path().extension();
    if (extension == ".glb" || extension == ".gltf" || extension == ".vrm" || extension == ".vrma")
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Files that only come first: what they are refused for.
std::optional<int> refused(const std::string& path) {
  const std::pair<const char*, int> rows[] = {
      {"unitygltf_Ghost", 681}, {"momentum_model_with_motion", 681}, {"vrm0_catbot", 683}};
  for (const auto& [name, code] : rows)
    if (path.find(name) != std::string::npos) return code;
  return std::nullopt;
}

std::string stem(const std::string& path) { return fs::path(path).stem(); }

/// Merges into a folder of its own and gives the path; empty where that was refused.
std::string merged(const std::vector<std::string>& paths, const std::string& name,
                   Diagnostics& diagnostics, bool join_clips = false) {
  const std::string folder = test::test_out("merge/" + fs::path(name).stem().string());
  fs::remove_all(folder);
  fs::create_directories(folder);
  const std::string out = folder + "/" + name;
  if (!pipeline::merge_files({paths, join_clips, {}, {}, {}}, out, diagnostics)) return {};
  std::string models;
  for (const std::string& path : paths)
    models += (fs::path(path).is_absolute() ? path : fs::absolute(path).string()) + "\n";
  test::made_from(out, models);
  return out;
}

gltf::File opened(const std::string& path) {
  Diagnostics diagnostics;
  auto file = gltf::open(path, diagnostics);
  REQUIRE_MESSAGE(file, render(diagnostics, false));
  return *std::move(file);
}

std::string bytes_of(const gltf::File& file, const json::Value& view) {
  Diagnostics diagnostics;
  const auto number = [&](const char* key) {
    return static_cast<std::uint64_t>(view[key].integer().value_or(0));
  };
  const Bytes& buffer = file.buffers[number("buffer")].bytes;
  const auto text = buffer.part(number("byteOffset"), number("byteLength")).text(diagnostics);
  REQUIRE(text);
  return *text;
}

/// The bytes of all views of `part` stand in `whole` behind those of `before` views.
void expect_same_bytes(const gltf::File& part, const gltf::File& whole, std::size_t before) {
  const auto mine = part.root()["bufferViews"].items(), all = whole.root()["bufferViews"].items();
  REQUIRE(before + mine.size() <= all.size());
  bool same = true;
  for (std::size_t i = 0; i < mine.size(); ++i)
    same = same && bytes_of(part, mine[i]) == bytes_of(whole, all[before + i]);
  CHECK(same);
}

/// Clips by name; those whose name several have are left out.
std::map<std::string, int> clip_names(const gltf::File& file) {
  std::map<std::string, int> out;
  for (const json::Value& clip : file.root()["animations"].items())
    ++out[clip["name"].string().value_or("")];
  return out;
}

/// Worlds of the nodes of `part` are those of `whole` behind `before` nodes, in each clip.
std::size_t expect_same_motion(const gltf::File& part, const gltf::File& whole,
                               std::size_t before) {
  std::size_t played = 0;
  const auto names = clip_names(whole);
  const std::size_t count = part.root()["nodes"].size();
  for (const auto& entry : clip_names(part)) {
    const std::string& name = entry.first;
    if (entry.second != 1 || names.at(name) != 1 || name.empty()) continue;
    CAPTURE(name);
    const std::vector<double> seconds = {0, 0.31, 1.7};
    const auto alone = test::play(part.path, name, seconds);
    const auto together = test::play(whole.path, name, seconds);
    bool same = true;
    for (std::size_t second = 0; second < seconds.size(); ++second)
      for (std::size_t i = 0; i < count; ++i)
        same = same && alone[second][i] == together[second][before + i];
    CHECK(same);
    ++played;
  }
  return played;
}

/// What a bake makes of each clip on a rig: everything but glTF's indices.
std::map<std::string, std::vector<anim::Channel>> baked(const std::string& path) {
  Diagnostics diagnostics;
  const gltf::File file = opened(path);
  const auto rigs = gltf::read_rigs(file, diagnostics);
  const auto clips = gltf::read_clips(file, diagnostics);
  REQUIRE_MESSAGE((rigs && clips), render(diagnostics, false));
  CHECK_MESSAGE(diagnostics.all().empty(), render(diagnostics, false));
  std::map<std::string, std::vector<anim::Channel>> out;
  for (const gltf::Rig& rig : *rigs) {
    std::map<int, int> numbers;  // of the rig's nodes, by node of the file
    for (scene::NodeId id : rig.scene.nodes())
      if (rig.nodes[id.index] >= 0) numbers[rig.nodes[id.index]] = static_cast<int>(id.index);
    bake::Options options;
    const auto standings = gltf::standings(file, rig, diagnostics);
    REQUIRE(standings);
    for (const gltf::Standing& s : *standings)
      options.standings.push_back({s.base, s.between, s.local});
    for (const anim::Clip& clip : clips->clips) {
      if (clip.name.find(rig.skeleton.global) == std::string::npos) continue;
      bake::Report report;
      auto joints = bake::bake(rig.scene, rig.nodes, clip, options, report, diagnostics);
      REQUIRE_MESSAGE(joints, render(diagnostics, false));
      for (anim::Channel& channel : joints->channels) channel.node = numbers.at(channel.node);
      out[clip.name] = std::move(joints->channels);
    }
  }
  return out;
}

void expect_same(const std::vector<anim::Channel>& a, const std::vector<anim::Channel>& b) {
  REQUIRE(a.size() == b.size());
  bool same = true;
  for (std::size_t i = 0; i < a.size(); ++i)
    same = same && a[i].node == b[i].node && a[i].path == b[i].path &&
           *a[i].curve.times == *b[i].curve.times && a[i].curve.values == b[i].curve.values;
  CHECK(same);
}

/// The biped on a model, with random keys on all of its controls in a clip named by its group.
std::string animated(const std::string& model, const std::string& map, const std::string& global,
                     const std::string& extension) {
  Diagnostics diagnostics;
  pipeline::BuildRequest request;
  request.template_file = test::templates_folder() + "/biped.yaml";
  request.paths.templates = {test::templates_folder()};
  request.model = model;
  request.map = map;
  request.global = global;
  const std::string folder = test::test_out("merge_" + global);
  fs::remove_all(folder);
  fs::create_directories(folder);
  const std::string built = folder + "/built" + extension;
  const auto rig = pipeline::build(request, built, diagnostics);
  REQUIRE_MESSAGE(rig, render(diagnostics, false));
  const gltf::File file = opened(built);
  test::Random random(global.size());
  std::vector<anim::Channel> channels;
  for (scene::NodeId id : rig->rig.scene.nodes()) {
    const scene::Node& node = rig->rig.scene[id];
    if (node.kind != scene::Kind::control) continue;
    std::vector<float> values;
    for (int i = 0; i < 5; ++i) {
      const math::Quat q = random.rotation();
      for (const double number : {q.x, q.y, q.z, q.w}) values.push_back(static_cast<float>(number));
    }
    channels.push_back(
        test::keys(rig->rig.nodes[id.index], anim::Path::rotation, 4, std::move(values)));
    for (const scene::UserAttribute& user : node.user)
      if (user.keyable && user.flavour == scene::UserAttribute::Flavour::number)
        channels.push_back(
            test::attribute_keys(rig->rig.nodes[id.index], user.name, {0, 0.25f, 1}));
  }
  gltf::Patch patch(file);
  gltf::write_clip(patch, file, {"on " + global, -1, channels}, {});
  const std::string out = folder + "/" + global + extension;
  std::uint64_t bytes = 0;
  REQUIRE(pipeline::write_output(patch, file, out, bytes, diagnostics));
  for (const std::string& path : {built, out})
    if (!model.empty()) test::made_from(path, model);
  return out;
}

}  // namespace

TEST_CASE("merge: pairs of real files keep their bytes and play as they did") {
  const std::vector<std::string> files = corpus();
  std::size_t clips = 0, pairs = 0;
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (const std::size_t step : {1, 7}) {
      const std::string &first = files[i], &second = files[(i + step) % files.size()];
      CAPTURE(first);
      CAPTURE(second);
      Diagnostics diagnostics;
      const std::string name =
          stem(first) + "_" + stem(second) + (first.ends_with(".gltf") ? ".gltf" : ".glb");
      const std::string out = merged({first, second}, name, diagnostics);
      if (const auto code = refused(second)) {
        CHECK(out.empty());
        CHECK(diagnostics.all().back().code->number == *code);
        continue;
      }
      REQUIRE_MESSAGE(!out.empty(), render(diagnostics, false));
      ++pairs;
      const gltf::File a = opened(first), b = opened(second), both = opened(out);
      for (const char* array : {"nodes", "meshes", "skins", "animations", "accessors", "materials",
                                "textures", "images", "samplers", "cameras"})
        CHECK(both.root()[array].size() == a.root()[array].size() + b.root()[array].size());
      expect_same_bytes(a, both, 0);
      expect_same_bytes(b, both, a.root()["bufferViews"].size());
      clips += expect_same_motion(a, both, 0);
      clips += expect_same_motion(b, both, a.root()["nodes"].size());
    }
  }
  MESSAGE(pairs << " pairs, " << clips << " clips");
  CHECK((files.empty() || (pairs > 50 && clips > 100)));
}

TEST_CASE("merge: rigs play as they did alone, and so after a second merge") {
  const std::string xbot = test::corpus_file("mixamo_Xbot_blender/Xbot.glb"),
                    mannequin = test::corpus_file("gdquest_mannequiny/mannequiny-0.3.0.glb");
  if (xbot.empty()) return;
  const std::vector<std::string> shots = {animated("", "", "biped", ".gltf"),
                                          animated(xbot, "", "hero", ".glb"),
                                          animated(mannequin, "", "villain", ".glb")};
  std::map<std::string, std::vector<anim::Channel>> alone;
  for (const std::string& shot : shots)
    for (auto& [name, channels] : baked(shot)) alone[name] = std::move(channels);
  REQUIRE(alone.size() == 3);
  std::vector<std::string> order = shots;
  for (const char* kind : {".glb", ".gltf"}) {
    for (int turn = 0; turn < 3; ++turn) {
      std::rotate(order.begin(), order.begin() + 1, order.end());
      Diagnostics diagnostics;
      const std::string name = "rigs" + std::to_string(turn) + kind;
      const std::string out = merged(order, name, diagnostics);
      REQUIRE_MESSAGE(!out.empty(), render(diagnostics, false));
      const auto together = baked(out);
      REQUIRE(together.size() == 3);
      for (const auto& [clip, channels] : alone) expect_same(channels, together.at(clip));
    }
  }
  // Two at a time gives the same rigs as all at once.
  Diagnostics diagnostics;
  const std::string two = merged({shots[0], shots[1]}, "two.glb", diagnostics);
  REQUIRE(!two.empty());
  const std::string three = merged({shots[2], two}, "three.glb", diagnostics);
  REQUIRE_MESSAGE(!three.empty(), render(diagnostics, false));
  const auto together = baked(three);
  for (const auto& [clip, channels] : alone) expect_same(channels, together.at(clip));
}

TEST_CASE("merge: the same files give the same bytes") {
  const std::string fox = test::corpus_file("khronos_Fox/Fox.glb"),
                    bat = test::corpus_file("gdquest_bat/bat.glb");
  if (fox.empty()) return;
  Diagnostics diagnostics;
  const std::string first = merged({fox, bat}, "again.glb", diagnostics);
  const std::string bytes = test::bytes_of(first);
  const std::string second = merged({fox, bat}, "again.glb", diagnostics);
  CHECK(bytes == test::bytes_of(second));
  CHECK(bytes.size() > 100000);
}

TEST_CASE("merge: files of other folders come along unless another file is in the way") {
  const std::string folder = test::test_out("broken/merge_files");
  fs::remove_all(folder);
  const auto write = [&](const std::string& name, const std::string& text) {
    fs::create_directories(folder_of(folder + "/" + name));
    Diagnostics diagnostics;
    REQUIRE(write_file(folder + "/" + name, {Bytes(text)}, diagnostics));
    return folder + "/" + name;
  };
  const std::string model =
      R"({"asset":{"version":"2.0"},"images":[{"uri":"t/a.png"}],"buffers":[{"byteLength":4,)"
      R"("uri":"a.bin"}],"bufferViews":[{"buffer":0,"byteLength":4}]})";
  const std::string png("\x89PNG\r\n\x1a\n", 8);
  std::vector<std::string> models;
  for (const char* place : {"one/", "two/", "third/"}) {
    models.push_back(write(place + std::string("model.gltf"), model));
    write(place + std::string("t/a.png"), png + (*place == 't' && place[1] == 'h' ? "other" : ""));
    write(place + std::string("a.bin"), place);
  }
  fs::create_directories(folder + "/out");
  Diagnostics diagnostics;
  const auto run = [&](const std::vector<std::string>& files, const std::string& out) {
    return pipeline::merge_files({files, false, {}, {}, {}}, folder + "/out/" + out, diagnostics);
  };
  REQUIRE_MESSAGE(run({models[0], models[1]}, "m.glb"), render(diagnostics, false));
  CHECK(fs::exists(folder + "/out/t/a.png"));
  CHECK(!fs::exists(folder + "/out/a.bin"));
  const gltf::File file = opened(folder + "/out/m.glb");
  CHECK(bytes_of(file, file.root()["bufferViews"].items()[1]) == "two/");
  // The other picture of that name cannot lie there too, nor can the other buffer of a .gltf.
  CHECK(!run({models[0], models[2]}, "n.glb"));
  CHECK(!run({models[0], models[1]}, "m.gltf"));
  CHECK(diagnostics.errors() == 2);
  for (const Diagnostic& diagnostic : diagnostics.all()) CHECK(diagnostic.code->number == 686);
  CHECK(!fs::exists(folder + "/out/n.glb"));
  CHECK(!fs::exists(folder + "/out/m.gltf"));
}
