// SPDX-License-Identifier: MIT
// What a bake may change: channels of joints that the rig drives and of controls; everything else
// of every clip stays, byte for byte, and baking again and again does not make the file grow.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "gltf/clips.h"
#include "gltf/file_helpers.h"
#include "gltf/rig_helpers.h"
#include "gltf/slim.h"
#include "lossless_helpers.h"
#include "pipeline/bake_file.h"

using namespace rigc;
using namespace rigc::test::lossless;
namespace helpers = rigc::gltf::test;
namespace fs = std::filesystem;

namespace {

/// A control that drives the place and the rotation of one node.
gltf::Rig driving_rig(int node) {
  helpers::RigMaker maker;
  const scene::NodeId joint = maker.joint("driven", -1, {}, node);
  maker.command("main", "control");
  const scene::NodeId control = maker.node(scene::Kind::control, "control");
  maker.edit.set({control, scene::control::kPoints}, std::vector<double>{2, 0, 0, 0, 1, 0, 0});
  maker.edit.add_attribute(control,
                           {"blend", scene::UserAttribute::Flavour::number, 1, 0.5, 0, 1, true});
  namespace constraint = scene::constraint;
  namespace transform = scene::transform;
  const scene::NodeId driver = maker.node(scene::Kind::parent_constraint, "driver");
  maker.edit.connect({joint, transform::kParent}, {driver, constraint::kParent});
  maker.edit.connect({control, transform::kWorld}, {driver, constraint::kTargets, 0});
  maker.edit.set({driver, constraint::kWeights, 0}, 1.0);
  maker.edit.set({driver, constraint::kOffsets, 0}, math::Affine{});
  maker.edit.connect({driver, constraint::kTranslate}, {joint, transform::kTranslate});
  maker.edit.connect({driver, constraint::kRotation}, {joint, transform::kRotation});
  return maker.take();
}

anim::Channel channel(int node, anim::Path path, int width, std::vector<float> values) {
  anim::Channel out;
  out.node = node;
  out.path = path;
  if (path == anim::Path::attribute) out.attribute = "blend";
  out.curve.width = width;
  out.curve.times = std::make_shared<const std::vector<float>>(std::vector<float>{0, 0.5f, 1});
  out.curve.values = std::move(values);
  return out;
}

/// Keys the control in the file's first clip, or in a new one, and in a clip of its own.
Sample animated(const Sample& sample, int control) {
  const gltf::File file = opened(sample);
  gltf::Patch patch(file);
  anim::Clip clip;
  clip.source_animation = file.root()["animations"].size() > 0 ? 0 : -1;
  clip.channels = {channel(control, anim::Path::translation, 3, {0, 0, 0, 1, 0, 0, 0, 2, 0}),
                   channel(control, anim::Path::attribute, 1, {0, 1, 0})};
  gltf::write_clip(patch, file, clip, {});
  gltf::write_clip(patch, file, {"own", -1, {clip.channels[0]}}, {});
  return finished(patch, sample, file.binary);
}

/// Bakes a sample where it lies.
Sample baked(const Sample& sample, bool keep_rig) {
  helpers::write_bytes(sample.path, sample.bytes);
  Diagnostics diagnostics;
  pipeline::BakeRequest request;
  request.file = sample.path;
  request.keep_rig = keep_rig;
  const auto done = pipeline::bake_file(request, sample.path, diagnostics);
  INFO(sample.name, "\n", render(diagnostics, false));
  REQUIRE(done);
  const auto bytes = Bytes::open(sample.path, UINT64_MAX, diagnostics);
  REQUIRE(bytes);
  return {sample.name, sample.path, helpers::text(*bytes)};
}

std::string accessor_bytes(const gltf::File& file, const json::Value& index) {
  const auto accessors = file.root()["accessors"].items();
  const json::Value accessor = accessors[static_cast<std::size_t>(*index.integer())];
  if (!accessor["bufferView"]) return std::string(accessor.text());
  const auto views = file.root()["bufferViews"].items();
  const json::Value view = views[static_cast<std::size_t>(*accessor["bufferView"].integer())];
  const auto& buffer = file.buffers[static_cast<std::size_t>(*view["buffer"].integer())];
  return std::string(accessor.text()) + std::string(view.text()) +
         helpers::text(
             buffer.bytes.part(static_cast<std::uint64_t>(view["byteOffset"].integer().value_or(0)),
                               static_cast<std::uint64_t>(*view["byteLength"].integer())));
}

/// Channels of a clip as what they say and play.
std::multiset<std::string> channels_of(const gltf::File& file, const json::Value& animation,
                                       int without_node) {
  std::multiset<std::string> out;
  const auto samplers = animation["samplers"].items();
  for (const json::Value& channel : animation["channels"].items()) {
    const json::Value target = channel["target"];
    const std::string pointer =
        target["extensions"]["KHR_animation_pointer"]["pointer"].string().value_or("");
    if (target["node"].integer() == without_node) continue;
    if (pointer.starts_with("/nodes/" + std::to_string(without_node) + "/")) continue;
    const json::Value sampler = samplers[static_cast<std::size_t>(*channel["sampler"].integer())];
    out.insert(std::string(channel.text()) + std::string(sampler.text()) +
               accessor_bytes(file, sampler["input"]) + accessor_bytes(file, sampler["output"]));
  }
  return out;
}

/// What `before`, the model, had is in `after`, but for channels of the driven node.
void expect_clips_kept(const gltf::File& before, const gltf::File& after, int driven) {
  const auto was = before.root()["animations"].items();
  const auto now = after.root()["animations"].items();
  REQUIRE(now.size() >= was.size());
  for (std::size_t i = 0; i < was.size(); ++i) {
    CAPTURE(i);
    // The first clip has keys on the control, all others pass through.
    if (i > 0) CHECK(now[i].text() == was[i].text());
    const auto channels = channels_of(after, now[i], driven);
    for (const std::string& channel : channels_of(before, was[i], driven))
      CHECK(channels.count(channel) > 0);
    CHECK(now[i]["name"].text() == was[i]["name"].text());
  }
}

/// Nodes have their texts, but for a driven one with a matrix, which has become the equal TRS.
void expect_nodes_kept(const gltf::File& before, const gltf::File& after, int driven) {
  const auto was = before.root()["nodes"].items(), now = after.root()["nodes"].items();
  REQUIRE(now.size() == was.size());
  for (std::size_t i = 0; i < was.size(); ++i) {
    CAPTURE(i);
    if (static_cast<int>(i) != driven || !was[i]["matrix"]) {
      CHECK(now[i].text() == was[i].text());
      continue;
    }
    CHECK_FALSE(now[i]["matrix"]);
    Diagnostics diagnostics;
    const auto a = gltf::read_slim(before, diagnostics), b = gltf::read_slim(after, diagnostics);
    REQUIRE(a);
    REQUIRE(b);
    const math::Affine difference = math::inverse(a->node(driven).matrix) * b->node(driven).matrix;
    CHECK(math::length(difference.origin) < 1e-5);
    CHECK(math::length(difference.linear.x - math::Vec3{1, 0, 0}) < 1e-6);
    CHECK(math::length(difference.linear.y - math::Vec3{0, 1, 0}) < 1e-6);
  }
}

/// Accessors that no clip, mesh or skin names, besides those that the model had so already.
std::size_t unused_accessors(const gltf::File& file) {
  std::set<std::int64_t> used;
  for (const json::Value& animation : file.root()["animations"].items())
    for (const json::Value& sampler : animation["samplers"].items())
      used.insert({*sampler["input"].integer(), *sampler["output"].integer()});
  for (const json::Value& mesh : file.root()["meshes"].items())
    for (const json::Value& primitive : mesh["primitives"].items()) {
      if (primitive["indices"]) used.insert(*primitive["indices"].integer());
      for (const auto& [name, value] : primitive["attributes"].members())
        used.insert(*value.integer());
      for (const json::Value& target : primitive["targets"].items())
        for (const auto& [name, value] : target.members()) used.insert(*value.integer());
    }
  for (const json::Value& skin : file.root()["skins"].items())
    used.insert(skin["inverseBindMatrices"].integer().value_or(-1));
  used.erase(-1);
  return file.root()["accessors"].size() - used.size();
}

/// The joint in the middle of the first skin, else the first node that has a channel, else node 0.
int some_node(const gltf::File& file) {
  for (const json::Value& skin : file.root()["skins"].items()) {
    const auto joints = skin["joints"].items();
    return static_cast<int>(*joints[joints.size() / 2].integer());
  }
  for (const json::Value& animation : file.root()["animations"].items())
    for (const json::Value& channel : animation["channels"].items())
      if (const auto node = channel["target"]["node"].integer()) return static_cast<int>(*node);
  return 0;
}

std::vector<Sample> samples(const std::string& name) {
  const std::string place = folder(name);
  std::vector<Sample> out;
  for (Sample& sample : made_samples(place))
    if (sample.name.starts_with("small")) out.push_back(std::move(sample));
  for (Sample& sample : corpus_samples(place)) {
    const gltf::File file = opened(sample);
    const bool plays = file.root()["animations"].size() > 0;
    if (file.root()["nodes"].size() == 0) continue;
    if (sample.path.ends_with(".vrma")) sample.path += ".glb";  // the name of an output
    if (plays || file.root()["skins"].size() > 0) out.push_back(std::move(sample));
  }
  return out;
}

}  // namespace

TEST_CASE("lossless bake: every clip keeps what the rig does not drive") {
  for (const Sample& sample : samples("bake")) {
    CAPTURE(sample.name);
    const gltf::File model = opened(sample);
    const std::string original =
        sample.path + ".original" + fs::path(sample.path).extension().string();
    show(sample, original, original);
    const int driven = some_node(model);
    gltf::Rig rig = driving_rig(driven);
    const Sample with_rig = rigged(sample, rig, -1);
    const int control = rig.nodes[helpers::with_role(rig, "control").index];
    const Sample keyed = animated(with_rig, control);
    expect_clips_kept(model, opened(keyed), -1);

    const Sample kept = baked(keyed, true);
    expect_clips_kept(model, opened(kept), driven);
    helpers::allow_messages_of(kept.path, original);
    // The first bake replaces what the model's own clip does to the driven joint; from then on
    // nothing changes. Each round is flushed to disk.
    if (sample.bytes.size() < 14000) {
      const Sample again = baked(kept, true);
      CHECK(again.bytes.size() <= kept.bytes.size());
      for (int round = 0; round < 10; ++round) CHECK(baked(again, true).bytes == again.bytes);
    }

    Sample plain = keyed;
    plain.path = folder_of(sample.path) + "/plain_" + fs::path(sample.path).filename().string();
    plain = baked(plain, false);
    helpers::allow_messages_of(plain.path, original);
    const gltf::File after = opened(plain);
    expect_clips_kept(model, after, driven);
    CHECK(after.json.text().find("RIGC_rig") == std::string_view::npos);
    expect_nodes_kept(model, after, driven);
    for (const char* array : {"meshes", "materials", "skins", "scenes", "textures", "images"})
      CHECK(after.root()[array].text() == model.root()[array].text());
    CHECK(unused_accessors(after) <= unused_accessors(model));
  }
}
