// SPDX-License-Identifier: MIT
// The one file that knows tinygltf: it reads a slimmed text of nodes, skins and animations, after
// our own checks. tinygltf drops what it does not know and crashes on some of it, so nothing else
// is shown to it; accessors and views, which are the most and only numbers, are read here. Test:
// tests/gltf/clips_test.cpp, tests/gltf/skeletons_test.cpp
#include "gltf/slim.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "base/text.h"
#include "base/trace.h"
#include "gltf/check.h"
#include "gltf/codes.h"

namespace rigc::gltf {
namespace {

/// Values go through files and back many times: what was normalised keeps its bits.
math::Quat normalised_once(const math::Quat& q) {
  constexpr double kRounding = 1e-15;
  return std::abs(dot(q, q) - 1) <= kRounding ? q : math::normalised(q);
}

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

/// Whether tinygltf can hold the channel.
bool is_plain(const json::Value& channel) {
  return channel["target"]["node"] && channel["target"]["path"].string() != "pointer";
}

void copy_sampler(json::Writer& writer, const json::Value& sampler) {
  copy_integers(writer, sampler, {"input", "output"});
  copy_numbers(writer, sampler, {"interpolation"});
}

void copy_channel(json::Writer& writer, const json::Value& channel) {
  copy_integers(writer, channel, {"sampler"});
  writer.key("target").begin_object();
  copy_integers(writer, channel["target"], {"node"});
  copy_numbers(writer, channel["target"], {"path"});
  writer.end_object();
}

/// Elements of one array as tinygltf sees them. Its model of a node takes a hundred times the
/// node's text, so it is shown a few at a time.
struct Part {
  const char* before;  ///< of the array in a glTF text
  const char* after;
  void (*copy)(json::Writer&, const json::Value&);
};
constexpr Part kNodes = {R"("nodes":[)", "]", copy_node};
constexpr Part kSkins = {R"("skins":[)", "]", copy_skin};
constexpr Part kSamplers = {R"("animations":[{"samplers":[)", "]}]", copy_sampler};
constexpr Part kChannels = {R"("animations":[{"channels":[)", "]}]", copy_channel};
constexpr std::size_t kBatch = 1024;

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
    node.local.rotation = normalised_once({r[0], r[1], r[2], r[3]});
  if (const auto& s = from.scale; !s.empty()) node.local.scale = {s[0], s[1], s[2]};
  node.matrix = math::compose(node.local);
  return node;
}

int index_of(const json::Value& object, std::string_view key) {
  return static_cast<int>(object[key].integer().value_or(-1));
}

std::uint64_t number_of(const json::Value& object, std::string_view key) {
  return static_cast<std::uint64_t>(object[key].integer().value_or(0));
}

/// A view whose place in its buffer is only for what a decoder makes (meshopt).
bool is_unfilled(const json::Value& view, const std::vector<json::Value>& buffers) {
  const json::Value& buffer = buffers[static_cast<std::size_t>(index_of(view, "buffer"))];
  for (const auto& [name, extension] : view["extensions"].members())
    if (buffer["extensions"][name]["fallback"].boolean().value_or(false)) return true;
  return false;
}

SlimAccessor slim_accessor(const json::Value& from) {
  SlimAccessor accessor;
  accessor.view = index_of(from, "bufferView");
  accessor.offset = number_of(from, "byteOffset");
  accessor.count = number_of(from, "count");
  accessor.component = index_of(from, "componentType");
  accessor.width = static_cast<int>(component_count(from["type"].string().value_or("")));
  accessor.normalised = from["normalized"].boolean().value_or(false);
  const json::Value sparse = from["sparse"];
  if (!sparse) return accessor;
  const json::Value indices = sparse["indices"], values = sparse["values"];
  accessor.sparse.count = number_of(sparse, "count");
  accessor.sparse.index_view = index_of(indices, "bufferView");
  accessor.sparse.index_offset = number_of(indices, "byteOffset");
  accessor.sparse.index_component = index_of(indices, "componentType");
  accessor.sparse.value_view = index_of(values, "bufferView");
  accessor.sparse.value_offset = number_of(values, "byteOffset");
  return accessor;
}

anim::Interpolation interpolation(const std::string& word) {
  if (word == "STEP") return anim::Interpolation::step;
  return word == "CUBICSPLINE" ? anim::Interpolation::cubic : anim::Interpolation::linear;
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

std::string slim_text(std::span<const json::Value> items, const Part& part) {
  std::string text = R"({"asset":{"version":"2.0"},)";
  text += part.before;
  for (const json::Value& item : items) {
    json::Writer writer;
    writer.begin_object();
    part.copy(writer, item);
    if (&item != items.data()) text += ',';
    text += writer.end_object().text();
  }
  return text + part.after + '}';
}

class SlimReader {
 public:
  SlimReader(const File& file, Diagnostics& diagnostics) : file_(file), diagnostics_(diagnostics) {}

  bool read(Slim& slim, bool animations) {
    const json::Value root = file_.root();
    const auto buffers = root["buffers"].items();
    for (const json::Value& view : root["bufferViews"].items())
      slim.views.push_back({index_of(view, "buffer"), number_of(view, "byteOffset"),
                            number_of(view, "byteLength"), number_of(view, "byteStride"),
                            is_unfilled(view, buffers)});
    for (const json::Value& accessor : root["accessors"].items())
      slim.accessors.push_back(slim_accessor(accessor));
    bool good = each(root["nodes"].items(), kNodes, [&](const tinygltf::Model& model) {
      for (const tinygltf::Node& node : model.nodes) slim.nodes.push_back(slim_node(node));
      return model.nodes.size();
    });
    good = good && each(root["skins"].items(), kSkins, [&](const tinygltf::Model& model) {
             for (const tinygltf::Skin& skin : model.skins)
               slim.skins.push_back({skin.name, skin.joints, skin.inverseBindMatrices});
             return model.skins.size();
           });
    if (!good) return false;
    link(slim);
    for (const json::Value& animation : root["animations"].items())
      if (animations && !read_animation(animation, slim.animations.emplace_back())) return false;
    return true;
  }

 private:
  bool read_animation(const json::Value& from, SlimAnimation& animation) {
    animation.name = from["name"].string().value_or("");
    std::vector<json::Value> plain;
    std::vector<int> places;
    const auto channels = from["channels"].items();
    for (std::size_t i = 0; i < channels.size(); ++i) {
      if (!is_plain(channels[i])) continue;
      plain.push_back(channels[i]);
      places.push_back(static_cast<int>(i));
    }
    const bool good = each(from["samplers"].items(), kSamplers, [&](const tinygltf::Model& model) {
      for (const tinygltf::AnimationSampler& sampler : model.animations.at(0).samplers)
        animation.samplers.push_back(
            {sampler.input, sampler.output, interpolation(sampler.interpolation)});
      return model.animations[0].samplers.size();
    });
    return good && each(plain, kChannels, [&](const tinygltf::Model& model) {
             for (const tinygltf::AnimationChannel& channel : model.animations.at(0).channels)
               animation.channels.push_back({places.at(animation.channels.size()), channel.sampler,
                                             channel.target_node, channel.target_path});
             return model.animations[0].channels.size();
           });
  }

  /// Shows elements to tinygltf; `use` takes what it made of them and says how many there were.
  template <class Use>
  bool each(const std::vector<json::Value>& items, const Part& part, const Use& use) {
    for (std::size_t first = 0; first < items.size(); first += kBatch) {
      const std::size_t count = std::min(items.size() - first, kBatch);
      tinygltf::Model model;
      std::string error, warning;
      const std::string text = slim_text({items.data() + first, count}, part);
      const bool read = tinygltf::TinyGLTF().LoadASCIIFromString(
          &model, &error, &warning, text.data(), static_cast<unsigned>(text.size()), "");
      if (read && use(model) == count) continue;
      diagnostics_.report(codes::kReader, Place(file_.path, items[first].pointer()),
                          "tinygltf cannot read this, or one of the next " +
                              std::to_string(count - 1) + ": " + printable(trim(error)));
      return false;
    }
    return true;
  }

  const File& file_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::optional<Slim> read_slim(const File& file, Diagnostics& diagnostics, bool animations) {
  const trace::Span span("read nodes");
  Slim slim;
  if (!SlimReader(file, diagnostics).read(slim, animations)) return std::nullopt;
  return slim;
}

}  // namespace rigc::gltf
