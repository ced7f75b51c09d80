// SPDX-License-Identifier: MIT
// Skeletons: the bind pose is found in whatever space an exporter wrote it, whatever pose the nodes
// stand in.
#include "gltf/skeletons.h"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <random>

#include "gltf/accessor.h"
#include "tests/gltf/file_helpers.h"

using namespace rigc;
using namespace rigc::gltf;
using namespace rigc::gltf::test;
using math::Affine;
using math::Quat;
using math::Trs;
using math::Vec3;

namespace {

using Skeletons = std::vector<tags::ForeignSkeleton>;

Skeletons read(const File& file, const std::string& rest = "bind") {
  Diagnostics diagnostics;
  auto skeletons = read_skeletons(file, rest, diagnostics);
  INFO(file.path, "\n", render(diagnostics, false));
  REQUIRE(skeletons);
  return *std::move(skeletons);
}

File text_file(const std::string& text) {
  Diagnostics diagnostics;
  auto file = open_text(text, diagnostics);
  INFO(text, "\n", render(diagnostics, false));
  REQUIRE(file);
  return *std::move(file);
}

std::optional<File> corpus_model(std::string_view folder) {
  const std::string path = corpus_file(folder);
  if (path.empty()) {
    MESSAGE("no corpus: ", folder, " not read");
    return std::nullopt;
  }
  Diagnostics diagnostics;
  auto file = gltf::open(path, diagnostics);
  REQUIRE(file);
  return file;
}

struct Box {
  Vec3 low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
};

/// Of the skinned joints, in the space of the scene.
Box box(const tags::ForeignSkeleton& skeleton) {
  Box result;
  for (const tags::ForeignJoint& joint : skeleton.joints) {
    if (!joint.in_skin) continue;
    const Vec3 at = skeleton.ancestor_world * joint.rest.origin;
    for (std::size_t i = 0; i < 3; ++i) {
      result.low[i] = std::min(result.low[i], at[i]);
      result.high[i] = std::max(result.high[i], at[i]);
    }
  }
  return result;
}

double distance(const Affine& a, const Affine& b) {
  double most = math::length(a.origin - b.origin);
  most = std::max(most, math::length(a.linear.x - b.linear.x));
  most = std::max(most, math::length(a.linear.y - b.linear.y));
  return std::max(most, math::length(a.linear.z - b.linear.z));
}

struct Random {
  std::mt19937_64 engine;
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53;
  }
  Quat turn(double degrees) {
    const Vec3 axis = math::normalised(Vec3{(*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1)});
    return math::axis_angle(axis, math::radians((*this)(0, degrees)));
  }
  Vec3 point(double size) {
    return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)};
  }
};

std::string node_text(const Trs& trs, const std::string& more) {
  json::Writer writer;
  const Vec3& t = trs.translation;
  const Quat& r = trs.rotation;
  const Vec3& s = trs.scale;
  const double tv[] = {t.x, t.y, t.z}, rv[] = {r.x, r.y, r.z, r.w}, sv[] = {s.x, s.y, s.z};
  writer.begin_object().key("translation").numbers(tv, 3).key("rotation").numbers(rv, 4);
  writer.key("scale").numbers(sv, 3).end_object();
  std::string text = writer.take();
  text.pop_back();
  return text + more + "}";
}

/// Column-major, as glTF stores it.
void append_matrix(std::vector<float>& out, const Affine& a) {
  const Vec3 columns[] = {a.linear.x, a.linear.y, a.linear.z, a.origin};
  for (std::size_t c = 0; c < 4; ++c)
    for (std::size_t i = 0; i < 4; ++i)
      out.push_back(i < 3 ? static_cast<float>(columns[c][i]) : c == 3 ? 1.0f : 0.0f);
}

/// What makes a synthetic character.
struct Exporter {
  Trs ancestor, mesh;
  int space = 0;    ///< of the inverse bind matrices: 0 scene, 1 ancestor, 2 mesh node
  double pose = 0;  ///< degrees that nodes are turned away from bind
  double walk = 0;  ///< part of its size that the root is moved away
};

struct Character {
  std::string text;
  std::vector<Affine> bind;  ///< by joint, ancestor space
};

/// Nodes: 0 ancestor, 1 mesh node, 2... joints in a random tree of about one unit.
Character make_character(Random& random, const Exporter& exporter) {
  constexpr int kJoints = 12;
  Character character;
  std::vector<Trs> local(kJoints);
  std::vector<int> parent(kJoints, -1);
  std::vector<std::string> children(kJoints);
  for (int i = 0; i < kJoints; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (i > 0) {
      parent[k] = static_cast<int>(random.engine() % k);
      auto& list = children[static_cast<std::size_t>(parent[k])];
      list += (list.empty() ? "" : ",") + std::to_string(i + 2);
    }
    local[k].translation = random.point(0.3);
    local[k].rotation = random.turn(180);
    const Affine own = math::compose(local[k]);
    character.bind.push_back(i == 0 ? own
                                    : character.bind[static_cast<std::size_t>(parent[k])] * own);
  }
  const Affine ancestor = math::compose(exporter.ancestor);
  const Affine mesh = math::compose(exporter.mesh);
  const Affine to_space = exporter.space == 0   ? ancestor
                          : exporter.space == 1 ? Affine()
                                                : math::inverse(mesh) * ancestor;
  std::vector<float> matrices;
  std::string nodes = node_text(exporter.ancestor, R"(,"children":[2])") + "," +
                      node_text(exporter.mesh, R"(,"mesh":0,"skin":0)");
  std::string joints;
  for (std::size_t k = 0; k < local.size(); ++k) {
    append_matrix(matrices, math::inverse(to_space * character.bind[k]));
    Trs posed = local[k];
    posed.rotation = posed.rotation * random.turn(exporter.pose);
    if (k == 0) posed.translation = posed.translation + random.point(exporter.walk);
    nodes +=
        "," + node_text(posed, children[k].empty() ? "" : ",\"children\":[" + children[k] + "]");
    joints += (k ? "," : "") + std::to_string(k + 2);
  }
  const std::string bytes = floats(matrices);
  character.text =
      R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0,1]}],"nodes":[)" + nodes +
      R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":1}}]}],"skins":[{"joints":[)" +
      joints + R"(],"inverseBindMatrices":0}],"accessors":[{"bufferView":0,"count":12,)" +
      R"("type":"MAT4","componentType":5126},{"count":1,"type":"VEC3","componentType":5126}],)" +
      R"("bufferViews":[{"buffer":0,"byteLength":768}],"buffers":[{"byteLength":768,"uri":")" +
      data_uri(bytes) + "\"}]}";
  return character;
}

}  // namespace

TEST_CASE("gltf skeletons: bind is found in each exporter's space under any ancestor") {
  Random random{std::mt19937_64(23)};
  const Quat quarter = math::axis_angle({1, 0, 0}, -math::kPi / 2);
  const Trs ancestors[] = {{},
                           {{0, 0, 0}, quarter, {100, 100, 100}},
                           {{0, 0, 0}, quarter, {0.01, 0.01, 0.01}},
                           {{0, 0, 0}, quarter, {-1, 1, 1}},
                           {{5, 0, 0}, {}, {1, 1, 1}}};
  for (int round = 0; round < 300; ++round) {
    Exporter exporter;
    exporter.ancestor = ancestors[random.engine() % 5];
    exporter.mesh = random.engine() % 2 == 0 ? Trs() : exporter.ancestor;
    exporter.space = static_cast<int>(random.engine() % 3);
    exporter.pose = random.engine() % 2 == 0 ? 0 : 30;
    exporter.walk = random.engine() % 2 == 0 ? 0 : 0.1;
    const Character character = make_character(random, exporter);
    const auto skeletons = read(text_file(character.text));
    REQUIRE(skeletons.size() == 1);
    CHECK(skeletons[0].ancestor == 0);
    REQUIRE(skeletons[0].joints.size() == 12);
    for (const tags::ForeignJoint& joint : skeletons[0].joints) {
      INFO("round ", round, " space ", exporter.space);
      CHECK(joint.in_skin);
      CHECK(distance(joint.rest, character.bind[static_cast<std::size_t>(joint.node - 2)]) < 1e-5);
    }
  }
}

TEST_CASE("gltf skeletons: joints of a skin keep the distances of their inverse bind matrices") {
  for (const std::string& path : corpus()) {
    Diagnostics diagnostics;
    const auto file = gltf::open(path, diagnostics);
    REQUIRE(file);
    const auto slim = read_slim(*file, diagnostics);
    REQUIRE(slim);
    std::map<int, Affine> rest;
    for (const tags::ForeignSkeleton& skeleton : read(*file))
      for (const tags::ForeignJoint& joint : skeleton.joints) rest[joint.node] = joint.rest;
    if (slim->skins.empty() || slim->skins[0].matrices < 0) continue;
    INFO(path);
    const SlimSkin& skin = slim->skins[0];
    const auto m = read_floats(*file, *slim, skin.matrices, skin.joints.size(), diagnostics);
    REQUIRE(m);
    for (std::size_t i = 0; i < skin.joints.size(); ++i) {
      const auto matrix = [&](std::size_t k) {
        const float* f = m->data() + 16 * k;
        return Affine{{{f[0], f[1], f[2]}, {f[4], f[5], f[6]}, {f[8], f[9], f[10]}},
                      {f[12], f[13], f[14]}};
      };
      const Affine expected = matrix(0) * math::inverse(matrix(i));
      const Affine found = math::inverse(rest[skin.joints[0]]) * rest[skin.joints[i]];
      CHECK(distance(expected, found) < 1e-4 * (1 + math::length(expected.origin)));
    }
  }
}

TEST_CASE("gltf skeletons: Xbot stands mid-clip but rests in a T-pose") {
  const auto file = corpus_model("mixamo_Xbot_blender");
  if (!file) return;
  const auto skeletons = read(*file);
  REQUIRE(skeletons.size() == 1);
  const tags::ForeignSkeleton& skeleton = skeletons[0];
  CHECK(skeleton.joints.size() == 67);
  const auto nodes = file->root()["nodes"].items();
  CHECK(nodes[static_cast<std::size_t>(skeleton.ancestor)]["name"].string() == "XBOT");
  const Box bind = box(skeleton);
  CHECK(bind.high.y - bind.low.y == doctest::Approx(1.778).epsilon(0.01));
  CHECK(bind.high.x - bind.low.x == doctest::Approx(1.812).epsilon(0.01));
  CHECK((bind.high.x + bind.low.x) / 2 == doctest::Approx(-2).epsilon(0.001));
  CHECK(std::abs(bind.low.y) < 0.01);
  std::map<std::string, Vec3> at;
  for (const tags::ForeignJoint& joint : skeleton.joints) at[joint.name] = joint.rest.origin;
  const Vec3 left = at["mixamorig:LeftHand"];
  const Vec3 right = at["mixamorig:RightHand"];
  CHECK(left.y == doctest::Approx(right.y).epsilon(1e-3));
  CHECK(left.y == doctest::Approx(at["mixamorig:LeftArm"].y).epsilon(0.01));
  CHECK(left.x + right.x == doctest::Approx(2 * at["mixamorig:Hips"].x).epsilon(1e-3));
  const Box stands = box(read(*file, "nodes")[0]);
  CHECK(stands.high.x - stands.low.x < 1);
}

TEST_CASE("gltf skeletons: exporters that write bind in the mesh node's space") {
  struct Case {
    const char* folder;
    double height;
  };
  // Heights of the nodes as they stand, which is close to bind in these files.
  for (const Case& c :
       {Case{"max_RiggedElf", 1.35}, Case{"maya_Elf", 107.0}, Case{"fbx2gltf_TRex", 13.3},
        Case{"khronos_CesiumMan", 1.17}, Case{"gltftransform_RobotExpressive_quant", 3.04}}) {
    const auto file = corpus_model(c.folder);
    if (!file) return;
    INFO(c.folder);
    const Box bind = box(read(*file)[0]);
    CHECK(bind.high.y - bind.low.y == doctest::Approx(c.height).epsilon(0.02));
    CHECK(read(*file)[0].notes.size() == 1);
  }
}

TEST_CASE("gltf skeletons: VRM humanoid tables") {
  for (const auto& [folder, bones] :
       {std::pair{"vrm0_catbot_unigltf", 54}, {"vrm1_Example", 53}, {"vrma_test", 51}}) {
    const auto file = corpus_model(folder);
    if (!file) return;
    const auto skeletons = read(*file);
    REQUIRE(skeletons.size() == 1);
    CHECK(skeletons[0].humanoid.size() == static_cast<std::size_t>(bones));
    std::map<std::string, Vec3> at;
    for (const auto& [bone, joint] : skeletons[0].humanoid)
      at[bone] = skeletons[0].joints[static_cast<std::size_t>(joint)].rest.origin;
    CHECK(at.count("hips") == 1);
    CHECK(at["head"].y > at["hips"].y);
    CHECK(at["hips"].y > at["leftFoot"].y);
  }
}

TEST_CASE("gltf skeletons: which nodes belong to one") {
  // 0 armature > 1 joint > 2 between > 3 joint > 4 end > 5 end of end; 3 > 6 hat with a mesh > 7; 0
  // > 8 mesh node; 9 alone > 10 another skin's joint
  const File file = text_file(
      R"({"asset":{"version":"2.0"},"nodes":[{"children":[1,8]},{"children":[2]},)"
      R"({"children":[3],"translation":[0,1,0]},{"children":[4,6],"translation":[0,2,0]},)"
      R"({"children":[5],"translation":[0,3,0]},{"translation":[0,4,0]},{"mesh":0,"children":[7]},)"
      R"({},{"mesh":0,"skin":0},{"children":[10]},{}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
      R"("accessors":[{"count":1,"type":"VEC3","componentType":5126}],)"
      R"("skins":[{"joints":[3]},{"joints":[1]},{"joints":[10]}]})");
  const auto skeletons = read(file);
  REQUIRE(skeletons.size() == 2);
  const auto& first = skeletons[0].joints;
  std::vector<int> nodes, parents;
  for (const tags::ForeignJoint& joint : first) {
    nodes.push_back(joint.node);
    parents.push_back(joint.parent);
  }
  CHECK(nodes == std::vector<int>{1, 2, 3, 4, 5});
  CHECK(parents == std::vector<int>{-1, 0, 1, 2, 3});
  CHECK(first[0].in_skin);
  CHECK_FALSE(first[1].in_skin);
  CHECK(first[2].in_skin);
  CHECK(first[4].rest.origin.y == 10);
  CHECK(skeletons[0].ancestor == 0);
  CHECK(skeletons[0].notes.size() == 2);
  CHECK(skeletons[1].joints.size() == 1);
  CHECK(skeletons[1].ancestor == 9);
}

TEST_CASE("gltf skeletons: rest poses nodes and CLIP@SECONDS") {
  const File file = text_file(small_model());
  CHECK(read(file, "nodes")[0].joints[1].rest.origin == Vec3{0, 1, 0});
  const auto half = read(file, "turn@1");
  const Affine turned = half[0].joints[1].rest;
  CHECK(distance(turned, math::compose({{0, 1, 0}, {0, 0, 1, 0}, {1, 1, 1}})) < 1e-6);
  CHECK(half[0].joints[1].local.rotation == Quat{0, 0, 0, 1});
  for (const char* bad : {"pose", "turn", "turn@", "turn@x", "turn@-1", "trun@0", ""}) {
    Diagnostics diagnostics;
    CHECK_FALSE(read_skeletons(file, bad, diagnostics));
    CHECK(numbers(diagnostics) == std::vector<int>{685});
  }
}

TEST_CASE("gltf skeletons: a bind pose that does not exist is an error, not for --rest nodes") {
  const std::string model = small_model();
  std::string bytes = floats(std::vector<float>(16, 0)) + floats(std::vector<float>(35, 1));
  const std::size_t at = model.find("data:");
  const File file = text_file(model.substr(0, at) + data_uri(bytes) + "\"}]}");
  Diagnostics diagnostics;
  CHECK_FALSE(read_skeletons(file, "bind", diagnostics));
  CHECK(numbers(diagnostics) == std::vector<int>{677, 677});
  CHECK(read(file, "nodes").size() == 1);
}

TEST_CASE("gltf skeletons: a chain as deep as a rig may be") {
  std::string nodes = "{\"children\":[1]}";
  std::string joints = "0";
  constexpr int kDepth = 16000;
  for (int i = 1; i < kDepth; ++i) {
    nodes += i + 1 < kDepth ? ",{\"children\":[" + std::to_string(i + 1) + "]}" : ",{}";
    joints += i % 7 == 0 ? "," + std::to_string(i) : "";
  }
  const File file = text_file(R"({"asset":{"version":"2.0"},"nodes":[)" + nodes +
                              R"(],"skins":[{"joints":[)" + joints + "]}]}");
  const auto skeletons = read(file);
  REQUIRE(skeletons.size() == 1);
  CHECK(skeletons[0].joints.size() == kDepth);
}
