// SPDX-License-Identifier: MIT
// Tests of src/catalog/catalogue.cpp and of what is compiled in: the tables say what the files say.
#include "catalog/catalogue.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/codes.h"
#include "base/files.h"
#include "base/text.h"
#include "catalog/codes.h"

using namespace rigc;
using namespace rigc::catalog;

namespace {

const std::string kSource = RIGC_SOURCE_DIR;

std::uint32_t open(const std::string& path, Diagnostics& diagnostics) {
  const auto text = read_file(path, 4u << 20, diagnostics);
  REQUIRE(text);
  return diagnostics.sources().add(path, *text);
}

/// An empty folder of this test's own.
std::string folder(const std::string& name) {
  const std::string path = std::string(RIGC_TEST_OUT) + "/" + name;
  std::filesystem::remove_all(path);
  std::filesystem::create_directories(path);
  return path;
}

void put(const std::string& path, const std::string& text) {
  Diagnostics diagnostics;
  REQUIRE(write_file(path, {text}, diagnostics));
}

std::string module_text(const std::string& name) {
  return "module: " + name + "\nversion: 1\ntitle: T\ncategory: c\nsummary: S.\n";
}

}  // namespace

TEST_CASE("catalog catalogue: every descriptor is compiled in as its file says") {
  const Catalogue catalogue;
  std::vector<std::string> names;
  for (const std::string& file : list_folder(kSource + "/modules.d")) {
    if (!ends_with(file, ".yaml")) continue;
    CAPTURE(file);
    names.push_back(stem_of(file));
    Diagnostics diagnostics;
    const auto read =
        read_descriptor(open(kSource + "/modules.d/" + file, diagnostics), diagnostics);
    REQUIRE(read);
    const Descriptor* built_in = catalogue.find(stem_of(file));
    REQUIRE(built_in);
    CHECK(*built_in == *read);
  }
  CHECK(catalogue.modules() == names);
  CHECK(names.size() >= 21);
}

TEST_CASE("catalog catalogue: every shape is compiled in as its file says") {
  const Catalogue catalogue;
  std::set<std::string> names;
  for (const std::string& file : list_folder(kSource + "/shapes")) {
    if (!ends_with(file, ".yaml")) continue;
    Diagnostics diagnostics;
    const auto node = yaml::read(open(kSource + "/shapes/" + file, diagnostics), diagnostics);
    REQUIRE(node);
    const auto shapes = read_shapes(*node, diagnostics);
    REQUIRE(shapes);
    for (const Shape& shape : *shapes) {
      CAPTURE(shape.name);
      names.insert(shape.name);
      REQUIRE(catalogue.find_shape(shape.name));
      CHECK(*catalogue.find_shape(shape.name) == shape);
    }
  }
  const auto known = catalogue.shapes();
  CHECK(std::is_sorted(known.begin(), known.end()));
  CHECK(std::set<std::string>(known.begin(), known.end()) == names);
}

TEST_CASE("catalog catalogue: the shapes that riggers expect, about one unit across") {
  const Catalogue catalogue;
  for (const char* name : {"circle", "square", "triangle", "cube", "sphere", "diamond", "cross",
                           "arrow_one", "arrow_two", "arrow_four", "pin", "gear", "half_circle",
                           "ring_of_arrows", "foot", "hand"}) {
    CAPTURE(name);
    CHECK(catalogue.find_shape(name));
  }
  for (const std::string& name : catalogue.shapes()) {
    CAPTURE(name);
    const Shape& shape = *catalogue.find_shape(name);
    CHECK(!shape.help.empty());
    double widest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double low = 0, high = 0;
      for (const auto& line : shape.lines) {
        for (const Point& point : line) {
          low = std::min(low, point[axis]);
          high = std::max(high, point[axis]);
        }
      }
      widest = std::max(widest, high - low);
    }
    CHECK(widest >= 0.75);
    CHECK(widest <= 1.15);
  }
}

TEST_CASE("catalog catalogue: built-in descriptors are complete") {
  const Catalogue catalogue;
  for (const std::string& name : catalogue.modules()) {
    CAPTURE(name);
    const Descriptor& descriptor = *catalogue.find(name);
    CHECK(descriptor.example.find("name: example_" + name + "\n") != std::string::npos);
    CHECK(descriptor.example.find("command: " + name + "\n") != std::string::npos);
    CHECK(descriptor.implementation == "builtin");
    CHECK(ends_with(descriptor.summary, "."));
    for (const Parameter& parameter : descriptor.parameters) {
      CAPTURE(parameter.name);
      CHECK(ends_with(parameter.help, "."));
      CHECK(parameter.help.size() > 10);
    }
  }
}

TEST_CASE("catalog catalogue: names that are not there") {
  const Catalogue catalogue;
  CHECK(catalogue.find("contrl") == nullptr);
  CHECK(catalogue.find("") == nullptr);
  CHECK(catalogue.find_shape("zzz") == nullptr);
}

TEST_CASE("catalog catalogue: one name is one object, also after a move") {
  Catalogue catalogue;
  const Descriptor* control = catalogue.find("control");
  CHECK(catalogue.find("control") == control);
  const Catalogue moved = std::move(catalogue);
  CHECK(moved.find("control") == control);
}

TEST_CASE("catalog catalogue: a folder of modules is added") {
  const std::string path = folder("catalogue_added");
  put(path + "/zig.yaml", module_text("zig"));
  put(path + "/aaa.yaml", module_text("aaa"));
  put(path + "/readme.txt", "not a module");
  Catalogue catalogue;
  Diagnostics diagnostics;
  CHECK(catalogue.add_folder(path, diagnostics));
  REQUIRE(catalogue.find("zig"));
  CHECK(catalogue.find("zig")->title == "T");
  CHECK(catalogue.modules().front() == "aaa");
  CHECK(!Catalogue().find("zig"));
}

TEST_CASE("catalog catalogue: a module that exists, a wrong one and no folder") {
  const std::string path = folder("catalogue_wrong");
  put(path + "/control.yaml", module_text("control"));
  put(path + "/zig.yaml", module_text("zag"));
  Catalogue catalogue;
  Diagnostics diagnostics;
  CHECK(!catalogue.add_folder(path, diagnostics));
  REQUIRE(diagnostics.all().size() == 2);
  CHECK(diagnostics.all()[0].code->number == catalog::codes::kDuplicateModule.number);
  CHECK(diagnostics.all()[1].code->number == catalog::codes::kWrongFileName.number);
  CHECK(catalogue.find("control")->title == "Control");
  CHECK(!catalogue.add_folder(path + "/none", diagnostics));
  CHECK(diagnostics.all()[2].code->number == rigc::codes::kCannotRead.number);
}
