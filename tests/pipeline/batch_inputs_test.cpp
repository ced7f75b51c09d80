// SPDX-License-Identifier: MIT
// Tests of src/pipeline/batch_inputs.h: which files arguments mean.
#include "pipeline/batch_inputs.h"

#include <doctest/doctest.h>
#include <algorithm>

#include "base/codes.h"
#include "base/files_helpers.h"
#include "pipeline/batch_codes.h"

using namespace rigc;
using test::TestFolder;
namespace fs = std::filesystem;

namespace {

using Texts = std::vector<std::string>;

/// A tree of shots, and what is found in it with the tree's own path cut off.
class Tree {
 public:
  explicit Tree(const std::string& name) : folder_("inputs_" + name) {
    for (const char* file : {"b.glb", "a.gltf", "a.bin", "notes.txt", ".hidden.glb", "sq/010/x.glb",
                             "sq/010/x.vrm", "sq/020/x.glb", "sq/020/deep/y.glb", ".git/z.glb"})
      put(file);
  }
  void put(const std::string& file, const std::string& text = "") const {
    fs::create_directories(fs::path(folder_ / file).parent_path());
    folder_.put(file, text);
  }
  std::string operator/(const std::string& name) const { return folder_ / name; }

  Texts found(const Texts& arguments, const Texts& left_out = {}) const {
    Texts paths;
    for (const auto& input : inputs(arguments, left_out))
      paths.push_back(input.path.substr(folder_.path().size() + 1));
    return paths;
  }
  Texts mirrored(const Texts& arguments) const {
    Texts places;
    for (const auto& input : inputs(arguments, {})) places.push_back(input.below);
    return places;
  }
  /// Code of the only error.
  int error(const std::string& argument) const {
    Diagnostics diagnostics;
    const auto none = pipeline::find_inputs({folder_ / argument}, {}, diagnostics);
    CHECK(!none);
    REQUIRE(diagnostics.errors() == 1);
    return diagnostics.all()[0].code->number;
  }

 private:
  std::vector<pipeline::BatchInput> inputs(const Texts& arguments, const Texts& left_out) const {
    Texts full, left;
    for (const std::string& one : arguments)
      full.push_back(one[0] == '@' ? '@' + (folder_ / one.substr(1)) : folder_ / one);
    for (const std::string& one : left_out) left.push_back(folder_ / one);
    Diagnostics diagnostics;
    const auto inputs = pipeline::find_inputs(full, left, diagnostics);
    REQUIRE_MESSAGE(inputs, render(diagnostics, false));
    return *inputs;
  }

  TestFolder folder_;
};

}  // namespace

TEST_CASE("pipeline batch inputs: a folder is searched, sorted, hidden names left out") {
  const Tree tree("folder");
  CHECK(tree.found({"."}).size() == 6);
  CHECK(tree.found({"sq"}) ==
        Texts{"sq/010/x.glb", "sq/010/x.vrm", "sq/020/deep/y.glb", "sq/020/x.glb"});
  CHECK(tree.mirrored({"sq"}) == Texts{"010/x.glb", "010/x.vrm", "020/deep/y.glb", "020/x.glb"});
  CHECK(tree.found({"sq"}, {"sq/020"}) == Texts{"sq/010/x.glb", "sq/010/x.vrm"});
  CHECK(tree.found({".git"}) == Texts{".git/z.glb"});
}

TEST_CASE("pipeline batch inputs: files are taken as they are named") {
  const Tree tree("file");
  CHECK(tree.found({"b.glb", "a.gltf"}) == Texts{"b.glb", "a.gltf"});
  CHECK(tree.mirrored({"sq/010/x.glb"}) == Texts{"x.glb"});
  CHECK(tree.found({"none.glb"}) == Texts{"none.glb"});
  tree.put("take[1].glb");
  CHECK(tree.found({"take[1].glb"}) == Texts{"take[1].glb"});
}

TEST_CASE("pipeline batch inputs: patterns") {
  const Tree tree("pattern");
  CHECK(tree.found({"*.gl*"}) == Texts{"a.gltf", "b.glb"});
  CHECK(tree.mirrored({"*"}) == tree.mirrored({"."}));
  CHECK(tree.found({"sq/0[12]0/x.glb"}) == Texts{"sq/010/x.glb", "sq/020/x.glb"});
  CHECK(tree.found({"sq/?20"}) == Texts{"sq/020/deep/y.glb", "sq/020/x.glb"});
  CHECK(tree.found({"**/x.glb"}) == Texts{"sq/010/x.glb", "sq/020/x.glb"});
  CHECK(tree.found({"**/**/deep/*"}) == Texts{"sq/020/deep/y.glb"});
  CHECK(tree.found({"sq/**"}) == tree.found({"sq"}));
  CHECK(tree.found({"**/*.glb"}, {"sq"}) == Texts{"b.glb"});
  CHECK(tree.mirrored({"sq/*/x.glb"}) == Texts{"010/x.glb", "020/x.glb"});
  CHECK(tree.mirrored({"sq/**/y.glb"}) == Texts{"020/deep/y.glb"});
}

TEST_CASE("pipeline batch inputs: lists name paths from their own folder on") {
  const Tree tree("list");
  tree.put("lists/one.txt", "# shots\n\n../b.glb\r\n  ../sq/010/x.glb  \n../sq/020\n");
  CHECK(tree.found({"@lists/one.txt"}) == Texts{"lists/../b.glb", "lists/../sq/010/x.glb",
                                                "lists/../sq/020/deep/y.glb",
                                                "lists/../sq/020/x.glb"});
  tree.put("all.txt", "sq/010/x.glb\nsq/020\n" + (tree / "b.glb"));
  CHECK(tree.mirrored({"@all.txt"}) ==
        Texts{"sq/010/x.glb", "sq/020/deep/y.glb", "sq/020/x.glb", "b.glb"});
}

TEST_CASE("pipeline batch inputs: every file once, and loops of links end") {
  const Tree tree("once");
  CHECK(tree.found({"sq/010/x.glb", "sq/010", "**/x.glb"}) ==
        Texts{"sq/010/x.glb", "sq/010/x.vrm", "sq/020/x.glb"});
  fs::create_symlink("..", tree / "sq/up");
  fs::create_symlink("x.glb", tree / "sq/010/link.glb");
  fs::create_symlink("self.glb", tree / "sq/010/self.glb");
  const Texts found = tree.found({"sq"});
  CHECK(std::count(found.begin(), found.end(), "sq/010/link.glb") == 1);
  CHECK(std::count(found.begin(), found.end(), "sq/010/x.glb") == 0);
  CHECK(found.size() == 4 + 1 + 2);
  CHECK(tree.found({"sq/up/sq/up/b.glb", "b.glb"}).size() == 1);
}

TEST_CASE("pipeline batch inputs: what finds nothing is an error") {
  const Tree tree("nothing");
  fs::create_directories(tree / "empty");
  tree.put("empty.txt", "# nothing\n");
  using namespace pipeline::codes;
  CHECK(tree.error("empty") == kNoInputs.number);
  CHECK(tree.error("*.fbx") == kNoInputs.number);
  CHECK(tree.error("none/*.glb") == kNoInputs.number);
  Diagnostics diagnostics;
  CHECK(!pipeline::find_inputs({"@" + (tree / "empty.txt"), "@" + (tree / "none.txt")}, {},
                               diagnostics));
  REQUIRE(diagnostics.errors() == 2);
  CHECK(diagnostics.all()[0].code->number == kNoInputs.number);
  CHECK(diagnostics.all()[1].code->number == rigc::codes::kCannotRead.number);
}
