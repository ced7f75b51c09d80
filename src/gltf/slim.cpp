// SPDX-License-Identifier: MIT
// The one file that knows tinygltf: it reads a slimmed text of what rigc must understand, after our
// own checks. tinygltf drops what it does not know and crashes on some of it, so nothing else is
// shown to it. Test: tests/gltf/clips_test.cpp, tests/gltf/skeletons_test.cpp
#include "gltf/slim.h"

#include <tiny_gltf.h>

#include "base/text.h"
#include "gltf/codes.h"

namespace rigc::gltf {
namespace {

void copy_numbers(json::Writer& writer, const json::Value& object,
                  std::initializer_list<const char*> keys) {
  for (const char* key : keys)
    if (const json::Value value = object[key]) writer.key(key).raw(value.text());
}

/// Integers in plain spelling: tinygltf takes `3.0` and `3e0` for no integers.
void copy_integers(json::Writer& writer, const json::Value& object,
                   std::initializer_list<const char*> keys) {
  for (const char* key : keys)
    if (const auto number = object[key].integer()) writer.key(key).integer(*number);
}

void copy_integer_list(json::Writer& writer, const json::Value& object, const char* key) {
  if (!object[key]) return;
  writer.key(key).begin_array();
  for (const json::Value& item : object[key].items()) writer.integer(item.integer().value_or(-1));
  writer.end_array();
}

void copy_node(json::Writer& writer, const json::Value& node) {
  copy_numbers(writer, node, {"name", "translation", "rotation", "scale", "matrix"});
  copy_integers(writer, node, {"mesh", "skin", "camera"});
  copy_integer_list(writer, node, "children");
}

void copy_skin(json::Writer& writer, const json::Value& skin) {
  copy_numbers(writer, skin, {"name"});
  copy_integers(writer, skin, {"inverseBindMatrices"});
  copy_integer_list(writer, skin, "joints");
}

void copy_view(json::Writer& writer, const json::Value& view) {
  copy_integers(writer, view, {"buffer", "byteOffset", "byteLength", "byteStride"});
}

void copy_accessor(json::Writer& writer, const json::Value& accessor) {
  copy_integers(writer, accessor, {"bufferView", "byteOffset", "componentType", "count"});
  copy_numbers(writer, accessor, {"type", "normalized"});
  const json::Value sparse = accessor["sparse"];
  if (!sparse) return;
  writer.key("sparse").begin_object();
  copy_integers(writer, sparse, {"count"});
  for (const char* half : {"indices", "values"}) {
    writer.key(half).begin_object();
    copy_integers(writer, sparse[half], {"bufferView", "byteOffset", "componentType"});
    writer.end_object();
  }
  writer.end_object();
}

/// Whether tinygltf can hold the channel.
bool is_plain(const json::Value& channel) {
  return channel["target"]["node"] && channel["target"]["path"].string() != "pointer";
}

void copy_animation(json::Writer& writer, const json::Value& animation) {
  copy_numbers(writer, animation, {"name"});
  writer.key("samplers").begin_array();
  for (const json::Value& sampler : animation["samplers"].items()) {
    writer.begin_object();
    copy_integers(writer, sampler, {"input", "output"});
    copy_numbers(writer, sampler, {"interpolation"});
    writer.end_object();
  }
  writer.end_array().key("channels").begin_array();
  for (const json::Value& channel : animation["channels"].items()) {
    if (!is_plain(channel)) continue;
    writer.begin_object();
    copy_integers(writer, channel, {"sampler"});
    writer.key("target").begin_object();
    copy_integers(writer, channel["target"], {"node"});
    copy_numbers(writer, channel["target"], {"path"});
    writer.end_object().end_object();
  }
  writer.end_array();
}

std::string slim_text(const File& file, bool animations) {
  struct Part {
    const char* array;
    void (*copy)(json::Writer&, const json::Value&);
  };
  constexpr Part kParts[] = {{"nodes", copy_node},
                             {"skins", copy_skin},
                             {"bufferViews", copy_view},
                             {"accessors", copy_accessor},
                             {"animations", copy_animation}};
  json::Writer writer;
  writer.begin_object();
  writer.key("asset").begin_object().member("version", "2.0").end_object();
  for (const Part& part : kParts) {
    const auto items = file.root()[part.array].items();
    if (items.empty() || (part.copy == copy_animation && !animations)) continue;
    writer.key(part.array).begin_array();
    for (const json::Value& item : items) {
      writer.begin_object();
      part.copy(writer, item);
      writer.end_object();
    }
    writer.end_array();
  }
  writer.end_object();
  return writer.take();
}

SlimNode slim_node(const tinygltf::Node& from) {
  SlimNode node;
  node.name = from.name;
  node.children = from.children;
  node.mesh = from.mesh;
  node.skin = from.skin;
  node.camera = from.camera;
  if (const auto& m = from.matrix; !m.empty()) {
    node.matrix.linear = {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}};
    node.matrix.origin = {m[12], m[13], m[14]};
    node.local = math::decompose(node.matrix);
    return node;
  }
  if (const auto& t = from.translation; !t.empty()) node.local.translation = {t[0], t[1], t[2]};
  if (const auto& r = from.rotation; !r.empty())
    node.local.rotation = math::normalised(math::Quat{r[0], r[1], r[2], r[3]});
  if (const auto& s = from.scale; !s.empty()) node.local.scale = {s[0], s[1], s[2]};
  node.matrix = math::compose(node.local);
  return node;
}

SlimAccessor slim_accessor(const tinygltf::Accessor& from) {
  SlimAccessor accessor;
  accessor.view = from.bufferView;
  accessor.offset = from.byteOffset;
  accessor.count = from.count;
  accessor.component = from.componentType;
  accessor.width = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(from.type));
  accessor.normalised = from.normalized;
  if (!from.sparse.isSparse) return accessor;
  accessor.sparse.count = static_cast<std::uint64_t>(from.sparse.count);
  accessor.sparse.index_view = from.sparse.indices.bufferView;
  accessor.sparse.index_offset = static_cast<std::uint64_t>(from.sparse.indices.byteOffset);
  accessor.sparse.index_component = from.sparse.indices.componentType;
  accessor.sparse.value_view = from.sparse.values.bufferView;
  accessor.sparse.value_offset = static_cast<std::uint64_t>(from.sparse.values.byteOffset);
  return accessor;
}

anim::Interpolation interpolation(const std::string& word) {
  if (word == "STEP") return anim::Interpolation::step;
  return word == "CUBICSPLINE" ? anim::Interpolation::cubic : anim::Interpolation::linear;
}

SlimAnimation slim_animation(const tinygltf::Animation& from, const json::Value& original) {
  SlimAnimation animation;
  animation.name = from.name;
  for (const tinygltf::AnimationSampler& sampler : from.samplers)
    animation.samplers.push_back(
        {sampler.input, sampler.output, interpolation(sampler.interpolation)});
  const auto channels = original["channels"].items();
  std::size_t next = 0;
  for (std::size_t i = 0; i < channels.size() && next < from.channels.size(); ++i) {
    if (!is_plain(channels[i])) continue;
    const tinygltf::AnimationChannel& channel = from.channels[next++];
    animation.channels.push_back(
        {static_cast<int>(i), channel.sampler, channel.target_node, channel.target_path});
  }
  return animation;
}

/// Parents, order and world matrices, without recursion: hierarchies may be as deep as the file has
/// nodes.
void link(Slim& slim) {
  for (std::size_t i = 0; i < slim.nodes.size(); ++i)
    for (int child : slim.nodes[i].children)
      slim.nodes[static_cast<std::size_t>(child)].parent = static_cast<int>(i);
  std::vector<int> stack;
  for (std::size_t i = slim.nodes.size(); i-- > 0;)
    if (slim.nodes[i].parent < 0) stack.push_back(static_cast<int>(i));
  while (!stack.empty()) {
    const int index = stack.back();
    stack.pop_back();
    SlimNode& node = slim.nodes[static_cast<std::size_t>(index)];
    node.world = slim.world(node.parent) * node.matrix;
    slim.preorder.push_back(index);
    stack.insert(stack.end(), node.children.rbegin(), node.children.rend());
  }
}

Slim convert(const tinygltf::Model& model, const File& file) {
  Slim slim;
  for (const tinygltf::Node& node : model.nodes) slim.nodes.push_back(slim_node(node));
  link(slim);
  for (const tinygltf::Skin& skin : model.skins)
    slim.skins.push_back({skin.name, skin.joints, skin.inverseBindMatrices});
  for (const tinygltf::BufferView& view : model.bufferViews)
    slim.views.push_back({view.buffer, view.byteOffset, view.byteLength, view.byteStride});
  for (const tinygltf::Accessor& accessor : model.accessors)
    slim.accessors.push_back(slim_accessor(accessor));
  const auto animations = file.root()["animations"].items();
  for (std::size_t i = 0; i < model.animations.size(); ++i)
    slim.animations.push_back(slim_animation(model.animations[i], animations[i]));
  return slim;
}

}  // namespace

std::optional<Slim> read_slim(const File& file, Diagnostics& diagnostics, bool animations) {
  tinygltf::TinyGLTF reader;
  tinygltf::Model model;
  std::string error, warning;
  const std::string text = slim_text(file, animations);
  const json::Value root = file.root();
  const bool read = reader.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                               static_cast<unsigned>(text.size()), "");
  const bool complete = model.nodes.size() == root["nodes"].size() &&
                        model.skins.size() == root["skins"].size() &&
                        model.accessors.size() == root["accessors"].size() &&
                        model.bufferViews.size() == root["bufferViews"].size() &&
                        model.animations.size() == (animations ? root["animations"].size() : 0);
  if (read && complete) return convert(model, file);
  diagnostics.report(codes::kReader, Place(file.path),
                     "tinygltf cannot read the nodes and animations: " + printable(trim(error)));
  return std::nullopt;
}

}  // namespace rigc::gltf
