// SPDX-License-Identifier: MIT
// What an update would do, from who made a rig and what is installed.
#include "pipeline/assess.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "base/ids.h"
#include "pipeline/character_helpers.h"

namespace rigc {
namespace {

using pipeline::Action;
using pipeline::ModuleState;
using pipeline::TemplateState;
using References = std::vector<tags::TemplateReference>;
using Modules = std::vector<std::pair<std::string, int>>;

std::string template_text(const std::string& name, int version, const std::string& more = {}) {
  return "rigc: 1\nname: " + name + "\nversion: " + std::to_string(version) + "\n" + more +
         "joints: [{name: a}]\n";
}

/// An empty folder of templates or modules.
class Folder {
 public:
  explicit Folder(const std::string& name) : path_(test::test_out("assess/" + name)) {
    std::filesystem::remove_all(path_);
  }
  void write(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = path_ + "/" + name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

tags::TemplateReference made(const std::string& name, int version, const std::string& file,
                             const std::string& text) {
  return {name, version, file, hex16(hash64(text))};
}

/// A lamp of two parts, one of them inside of the other, and a module `bounce` of version 3.
struct Shop {
  Folder templates{"templates"}, modules{"modules"};
  std::string lamp = template_text("lamp", 7, "parts: [{template: parts/arm, as: arm}]\n");
  std::string arm = template_text("arm", 2, "parts:\n  - template: joint\n    as: joint\n");
  std::string joint = template_text("joint", 1);
  catalog::Catalogue catalogue;

  Shop() {
    modules.write("bounce.yaml",
                  "module: bounce\nversion: 3\ntitle: B\ncategory: tests\nsummary: B.\n");
    Diagnostics diagnostics;
    REQUIRE(catalogue.add_folder(modules.path(), diagnostics));
    // A stand-alone template that only has the name of the inner part.
    templates.write("joint.yaml", template_text("joint", 5, "global: other\n"));
  }
  References references() const {
    return {made("lamp", 7, "lamp.yaml", lamp), made("arm", 2, "parts/arm", arm),
            made("joint", 1, "joint", joint)};
  }
  /// What is installed: the texts as they are now.
  pipeline::Assessment assess(const References& references, const Modules& made_by = {}) const {
    templates.write("lamp.yaml", lamp);
    templates.write("parts/arm.yaml", arm);
    templates.write("parts/joint.yaml", joint);
    return pipeline::Installed({templates.path()}, catalogue).assess(references, made_by);
  }
};

std::string told(const pipeline::Assessment& assessment) {
  return std::string(name_of(assessment.action)) + " | " + assessment.reason;
}

}  // namespace

TEST_CASE("pipeline assess: nothing where templates and modules are what they were") {
  const Shop shop;
  const auto now = shop.assess(shop.references(), {{"bounce", 3}, {"control", 1}});
  CHECK(told(now) == "nothing | ");
  CHECK_FALSE(now.needs_update());
  REQUIRE(now.templates.size() == 3);
  CHECK(now.templates[2].state == TemplateState::current);
  CHECK(now.templates[2].path == shop.templates.path() + "/parts/joint.yaml");
}

TEST_CASE("pipeline assess: newer versions") {
  Shop shop;
  const References references = shop.references();
  shop.lamp = template_text("lamp", 9, "parts: [{template: parts/arm, as: arm}]\n");
  auto now = shop.assess(references);
  CHECK(told(now) == "update | lamp 7 -> 9");
  CHECK(now.needs_update());
  CHECK(now.templates[0].found == 9);
  // Parts and modules that the new version may no longer use do not stop it.
  shop.lamp = template_text("lamp", 9);
  CHECK(told(shop.assess(references, {{"gone", 1}})) == "update | lamp 7 -> 9");
  shop = Shop();
  shop.arm = template_text("arm", 3, "parts: [{template: joint, as: joint}]\n");
  now = shop.assess(references);
  CHECK(told(now) == "update | part parts/arm 2 -> 3");
  CHECK(now.templates[1].state == TemplateState::newer);
}

TEST_CASE("pipeline assess: parts behind an alias are found by their names") {
  Shop shop;
  shop.lamp =
      template_text("lamp", 7, "description: &arm parts/arm\nparts: [{template: *arm, as: arm}]\n");
  const References references = {made("lamp", 7, "lamp.yaml", shop.lamp),
                                 made("arm", 2, "parts/arm", shop.arm)};
  CHECK(told(shop.assess(references)) == "nothing | ");
  shop.arm += "# edited\n";
  CHECK(told(shop.assess(references)) == "rebuild | part parts/arm changed without a new version");
}

TEST_CASE("pipeline assess: contents that changed without a new version, and newer modules") {
  Shop shop;
  const References references = shop.references();
  shop.lamp += "# edited\n";
  auto now = shop.assess(references);
  CHECK(told(now) == "rebuild | lamp changed without a new version");
  CHECK(now.needs_update());
  CHECK(now.templates[0].state == TemplateState::changed);
  // What an edited template no longer uses does not stop it.
  shop.lamp = template_text("lamp", 7);
  CHECK(told(shop.assess(references, {{"gone", 1}})) ==
        "rebuild | lamp changed without a new version");
  shop = Shop();
  shop.joint += "# edited\n";
  CHECK(told(shop.assess(references)) == "rebuild | part joint changed without a new version");
  shop = Shop();
  now = shop.assess(references, {{"bounce", 1}});
  CHECK(told(now) == "rebuild | module bounce 1 -> 3");
  CHECK(now.modules[0].state == ModuleState::newer);
}

TEST_CASE("pipeline assess: what cannot be updated says why") {
  Shop shop;
  References references = shop.references();
  shop.lamp = template_text("lamp", 6);
  CHECK(told(shop.assess(references)) == "cannot | made by lamp 7, but only 6 is found");
  shop = Shop();
  shop.arm = template_text("arm", 1, "parts: [{template: joint, as: joint}]\n");
  CHECK(told(shop.assess(references)) == "cannot | made with part parts/arm 2, but 1 is found");
  CHECK_FALSE(shop.assess(references).lost);
  shop = Shop();
  CHECK(told(shop.assess(references, {{"bounce", 4}, {"gone", 1}})) ==
        "cannot | made by module bounce 4, this rigc has 3; there is no module gone");
  references[0].name = "torch";
  const auto now = shop.assess(references);
  CHECK(told(now) == "cannot | no template torch is found");
  CHECK(now.lost);
  CHECK(now.templates[0].found == 0);
  CHECK(told(shop.assess({})) == "cannot | the rig does not say which template made it");
  references = shop.references();
  references[1].file = "parts/leg";
  CHECK(told(shop.assess(references)) == "cannot | part parts/leg is not found");
  references[1].file = "../../etc/passwd";
  CHECK(shop.assess(references).action == Action::cannot);
  references.resize(5000, references[1]);
  const auto absurd = shop.assess(references);
  CHECK(absurd.templates.size() == 5000);
  CHECK(absurd.reason.size() < 500);
  CHECK(absurd.reason.ends_with("; and 4993 more"));
}

TEST_CASE("pipeline assess: forks are told, not followed") {
  Shop shop;
  shop.templates.write("led.yaml", template_text("led", 4, "was: [lamp]\n"));
  const auto now = shop.assess(shop.references());
  CHECK(now.action == Action::nothing);
  REQUIRE(now.forks.size() == 1);
  CHECK(now.forks[0].name == "led");
  CHECK(now.forks[0].version == 4);
}

}  // namespace rigc
