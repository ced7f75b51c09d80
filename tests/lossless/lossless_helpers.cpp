// SPDX-License-Identifier: MIT
// What the tests of law 8 share: opening, rigging, stripping, and the check of what may differ.
#include "lossless_helpers.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/text.h"
#include "gltf/file_helpers.h"
#include "gltf/rig_helpers.h"
#include "gltf/uri.h"

namespace rigc::test::lossless {
namespace fs = std::filesystem;
namespace helpers = gltf::test;
using gltf::File;
using json::Value;
using scene::NodeId;

namespace {

constexpr const char* kArrays[] = {"accessors", "animations", "bufferViews", "buffers", "cameras",
                                   "images",    "materials",  "meshes",      "nodes",   "samplers",
                                   "scenes",    "skins",      "textures"};

std::string text_of(const Bytes& bytes) { return helpers::text(bytes); }

bool is_array(const std::string& key) {
  return std::find(std::begin(kArrays), std::end(kArrays), key) != std::end(kArrays);
}

/// The items of `before` are the first of `after`, in the same spelling.
void expect_prefix(const Value& before, const Value& after) {
  const auto was = before.items(), now = after.items();
  REQUIRE(now.size() >= was.size());
  for (std::size_t i = 0; i < was.size(); ++i) CHECK(now[i].text() == was[i].text());
}

/// Members of `before` stand at the beginning of `after`, in order, and have the same text; those
/// in `grown` may differ and are given to `look`. What is new must be one of `added`.
template <class Look>
void expect_members(const Value& before, const Value& after, const std::set<std::string>& grown,
                    const std::set<std::string>& added, Look look) {
  const auto was = before.members(), now = after.members();
  REQUIRE(now.size() >= was.size());
  for (std::size_t i = 0; i < was.size(); ++i) {
    CAPTURE(was[i].first);
    REQUIRE(now[i].first == was[i].first);
    if (now[i].second.text() == was[i].second.text()) continue;
    CHECK(grown.count(was[i].first) != 0);
    look(was[i].first, was[i].second, now[i].second);
  }
  for (std::size_t i = was.size(); i < now.size(); ++i) {
    CAPTURE(now[i].first);
    CHECK(added.count(now[i].first) != 0);
  }
}

void expect_node_kept(const Value& before, const Value& after) {
  const std::set<std::string> ours = {"children", "extras"};
  expect_members(before, after, ours, ours,
                 [](const std::string& key, const Value& was, const Value& now) {
                   if (key == "children") return expect_prefix(was, now);
                   expect_members(was, now, {}, {"rigc"}, [](auto&&...) {});
                 });
}

void expect_array_kept(const std::string& name, const Value& before, const Value& after,
                       const std::set<int>& touched, bool same_container, bool in_bin) {
  const auto was = before.items(), now = after.items();
  REQUIRE(now.size() >= was.size());
  for (std::size_t i = 0; i < was.size(); ++i) {
    // Placeholders are ours.
    if (was[i].text() == now[i].text() || was[i]["extras"]["rigc"]["free"]) continue;
    CAPTURE(i);
    // A buffer file of ours is named by its content.
    const bool ours = was[i]["uri"].string().value_or("").starts_with("rigc_");
    const bool takes_bytes = ours || (i == 0 && (in_bin || !same_container));
    const bool may = name == "scenes" || (name == "buffers" && takes_bytes) ||
                     (name == "nodes" && touched.count(static_cast<int>(i)) != 0);
    CHECK(may);
    if (name == "nodes") expect_node_kept(was[i], now[i]);
    if (name == "scenes")
      expect_members(
          was[i], now[i], {"nodes"}, {"nodes"},
          [](const std::string&, const Value& a, const Value& b) { expect_prefix(a, b); });
    if (name == "buffers" && same_container)
      expect_members(
          was[i], now[i],
          ours ? std::set<std::string>{"byteLength", "uri"} : std::set<std::string>{"byteLength"},
          {}, [](auto&&...) {});
  }
}

/// The bytes of a view; nothing where its buffer has none.
std::string bytes_of(const File& file, const Value& view) {
  const auto& buffer = file.buffers[static_cast<std::size_t>(*view["buffer"].integer())];
  return text_of(
      buffer.bytes.part(static_cast<std::uint64_t>(view["byteOffset"].integer().value_or(0)),
                        static_cast<std::uint64_t>(*view["byteLength"].integer())));
}

/// Every view has its bytes; a buffer in which nothing was free begins with all that it had.
void expect_bytes_kept(const File& before, const File& after) {
  std::set<std::int64_t> may_change;
  const auto was = before.root()["bufferViews"].items(), now = after.root()["bufferViews"].items();
  for (std::size_t i = 0; i < was.size(); ++i) {
    if (was[i]["extras"]["rigc"]["free"])
      may_change.insert(*was[i]["buffer"].integer());
    else
      CHECK(bytes_of(before, was[i]) == bytes_of(after, now[i]));
  }
  REQUIRE(after.buffers.size() >= before.buffers.size());
  for (std::size_t i = 0; i < before.buffers.size(); ++i) {
    if (may_change.count(static_cast<std::int64_t>(i))) continue;
    const std::string bytes = text_of(before.buffers[i].bytes);
    CHECK(text_of(after.buffers[i].bytes).compare(0, bytes.size(), bytes) == 0);
  }
  if (before.binary != after.binary || !before.bin || may_change.count(0)) return;
  const std::string bytes = text_of(*before.bin);
  REQUIRE(after.bin);
  CHECK(text_of(*after.bin).compare(0, bytes.size(), bytes) == 0);
}

/// Nodes of the file that a rig may touch: its joints, and what its nodes hang under.
std::set<int> touched_nodes(const gltf::Rig& rig) {
  std::set<int> touched = {rig.ancestor};
  for (const auto& joint : rig.skeleton.joints) touched.insert(joint.foreign_node);
  return touched;
}

void copy_beside(const fs::path& model, const std::string& folder) {
  Diagnostics diagnostics;
  const auto file = gltf::open(model, diagnostics);
  REQUIRE(file);
  for (const char* array : {"buffers", "images"}) {
    for (const Value& item : file->root()[array].items()) {
      const auto uri = item["uri"].string();
      if (!uri || gltf::is_data_uri(*uri)) continue;
      const std::string name = gltf::percent_decoded(*uri).value_or("");
      if (!fs::exists(model.parent_path() / name)) continue;
      fs::create_directories(fs::path(folder + "/" + name).parent_path());
      fs::copy_file(model.parent_path() / name, folder + "/" + name,
                    fs::copy_options::overwrite_existing);
    }
  }
}

}  // namespace

std::string folder(const std::string& name) {
  const std::string path = std::string(RIGC_TEST_OUT) + "/lossless/" + name;
  fs::remove_all(path);
  fs::create_directories(path);
  return path;
}

std::size_t below(std::mt19937_64& random, std::size_t end) {
  return static_cast<std::size_t>(random() % end);
}

std::vector<Sample> corpus_samples(const std::string& folder) {
  std::vector<Sample> samples;
  for (const std::string& path : helpers::corpus()) {
    const std::string kind = fs::path(path).parent_path().filename();
    const std::string own = folder + "/" + kind;
    fs::create_directories(own);
    copy_beside(path, own);
    Sample sample{kind, own + "/" + fs::path(path).filename().string(), {}};
    fs::copy_file(path, sample.path, fs::copy_options::overwrite_existing);
    Diagnostics diagnostics;
    const auto bytes = Bytes::open(path, UINT64_MAX, diagnostics);
    REQUIRE(bytes);
    sample.bytes = text_of(*bytes);
    helpers::allow_messages_of(sample.path, sample.path);
    samples.push_back(std::move(sample));
  }
  if (samples.empty()) MESSAGE("no corpus: only files that the tests make");
  return samples;
}

File opened(const Sample& sample) {
  Diagnostics diagnostics;
  auto file = gltf::open(sample.path, Bytes(std::string(sample.bytes)), diagnostics);
  INFO(sample.name, "\n", render(diagnostics, false));
  REQUIRE(file);
  return *std::move(file);
}

std::string bytes_of(const gltf::Output& output) { return helpers::whole(output); }

Sample finished(gltf::Patch& patch, const Sample& sample, bool binary) {
  Diagnostics diagnostics;
  const auto output = patch.finish(binary, diagnostics);
  INFO(sample.name, "\n", render(diagnostics, false));
  REQUIRE(output);
  for (const gltf::ExtraFile& extra : output->extra_files)
    helpers::write_bytes(folder_of(sample.path) + "/" + extra.name, text_of(extra.bytes));
  return {sample.name, sample.path, bytes_of(*output)};
}

gltf::Rig rig_for(const File& file, std::mt19937_64& random, std::uint32_t id, bool helpers,
                  int& ancestor) {
  const auto nodes = file.root()["nodes"].items();
  std::vector<int> parents(nodes.size(), -1), pool;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const Value& child : nodes[i]["children"].items())
      parents[static_cast<std::size_t>(*child.integer())] = static_cast<int>(i);
  for (const Value& skin : file.root()["skins"].items())
    for (const Value& joint : skin["joints"].items())
      pool.push_back(static_cast<int>(*joint.integer()));
  for (std::size_t i = 0; pool.empty() && i < nodes.size(); ++i)
    pool.push_back(static_cast<int>(i));
  std::set<int> chosen;
  for (std::size_t i = below(random, 6); !pool.empty() && i < 6; ++i)
    chosen.insert(pool[below(random, pool.size())]);

  helpers::RigMaker maker(id);
  ancestor = -1;
  const auto depth = [&](int node) {
    int steps = 0;
    for (; node >= 0; node = parents[static_cast<std::size_t>(node)]) ++steps;
    return steps;
  };
  std::vector<int> order(chosen.begin(), chosen.end());
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return depth(a) < depth(b); });
  const int extra = helpers ? -1 : static_cast<int>(order.size());
  std::vector<int> placed;  // foreign node of each joint
  if (extra < 0) {
    maker.joint("helper", -1, {});
    placed.push_back(-2);
  }
  for (const int node : order) {
    int above = parents[static_cast<std::size_t>(node)];
    while (above >= 0 && !chosen.count(above)) above = parents[static_cast<std::size_t>(above)];
    const auto at = std::find(placed.begin(), placed.end(), above);
    const int parent =
        at == placed.end() ? (helpers ? 0 : -1) : static_cast<int>(at - placed.begin());
    maker.joint("j" + std::to_string(node), parent, {}, node);
    placed.push_back(node);
  }
  if (placed.empty()) maker.joint("alone", -1, {});
  if (!order.empty() && below(random, 2) == 0) {
    ancestor = parents[static_cast<std::size_t>(order[0])];
    while (ancestor >= 0 && chosen.count(ancestor))
      ancestor = parents[static_cast<std::size_t>(ancestor)];
  }
  maker.command("main", "control");
  const std::size_t controls = 1 + below(random, 3);
  NodeId zero, control;
  for (std::size_t i = 0; i < controls; ++i) {
    zero = maker.node(scene::Kind::transform, "zero" + std::to_string(i), control);
    control = maker.node(scene::Kind::control, "control" + std::to_string(i), zero);
    std::vector<double> points = {2, 0, 0, 0, 1, 0, static_cast<double>(below(random, 5))};
    maker.edit.set({control, scene::control::kPoints}, points);
  }
  maker.edit.add_attribute(control,
                           {"blend", scene::UserAttribute::Flavour::number, 1, 0.5, 0, 1, true});
  if (below(random, 2) == 0)
    maker.node(scene::Kind::handle, "handle", maker.edit.scene().nodes().front());
  return maker.take();
}

void expect_kept(const File& before, const File& after, const gltf::Rig& rig) {
  const std::set<int> touched = touched_nodes(rig);
  const bool same = before.binary == after.binary;
  std::set<std::string> grown(std::begin(kArrays), std::end(kArrays));
  grown.insert({"extensions", "extensionsUsed"});
  std::set<std::string> added = grown;
  if (rig.skeleton.joints.empty() || touched == std::set<int>{-1}) added.insert("scene");
  expect_members(before.root(), after.root(), grown, added,
                 [&](const std::string& key, const Value& was, const Value& now) {
                   if (is_array(key))
                     return expect_array_kept(key, was, now, touched, same, before.binary);
                   if (key == "extensionsUsed") return expect_prefix(was, now);
                   expect_members(was, now, {"RIGC_rig"}, {"RIGC_rig"}, [](auto&&...) {});
                 });
  expect_bytes_kept(before, after);
  if (after.binary && before.binary) {
    REQUIRE(after.other_chunks.size() == before.other_chunks.size());
    for (std::size_t i = 0; i < before.other_chunks.size(); ++i)
      CHECK(text_of(after.other_chunks[i]) == text_of(before.other_chunks[i]));
  }
}

Sample rigged(const Sample& sample, gltf::Rig& rig, int ancestor) {
  const File file = opened(sample);
  Diagnostics diagnostics;
  gltf::Patch patch(file);
  const bool written = gltf::write_rig(patch, rig, ancestor, diagnostics);
  INFO(sample.name, "\n", render(diagnostics, false));
  REQUIRE(written);
  Sample out = finished(patch, sample, file.binary);
  expect_kept(file, opened(out), rig);
  return out;
}

Sample stripped(const Sample& sample) {
  const File file = opened(sample);
  Diagnostics diagnostics;
  const auto rigs = gltf::read_rigs(file, diagnostics);
  INFO(sample.name, "\n", render(diagnostics, false));
  REQUIRE(rigs);
  CHECK(diagnostics.all().empty());
  gltf::Patch patch(file);
  gltf::strip_rigs(patch, file, *rigs, gltf::Strip::nothing);
  return finished(patch, sample, file.binary);
}

void show(const Sample& sample, const std::string& path, const std::string& model) {
  helpers::write_bytes(path, sample.bytes);
  helpers::allow_messages_of(path, model);
}

}  // namespace rigc::test::lossless
