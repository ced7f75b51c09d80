// SPDX-License-Identifier: MIT
// rigc update over many files: the same bytes for any number of jobs, what fails among what works,
// places, and files that need nothing.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/process_helpers.h"

namespace rigc::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr int kShots = 6;

/// A folder with built shots and the next version of their template. Below `broken`: reports have
/// paths in them, and one of the files is none.
class Shots {
 public:
  explicit Shots(const std::string& name) : folder_(fresh_folder("broken/" + name)) {
    const fs::path built = folder_ / "shots/000.glb";
    fs::create_directories(folder_ / "shots/sq");
    fs::create_directories(folder_ / "templates");
    const Outcome outcome = run_rigc({"build", own_template(), "-o", built});
    REQUIRE_MESSAGE(outcome.status == 0, outcome.err);
    for (int i = 1; i < kShots; ++i) fs::copy_file(built, shot(i));
  }
  /// From now on there is a newer version.
  void publish() const {
    std::string text = file_text(own_template());
    const std::string key = "\nversion: ";
    text.insert(text.find(key) + key.size(), "9");
    std::ofstream(folder_ / "templates/biped.yaml", std::ios::binary) << text;
  }
  Outcome update(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "update");
    for (const fs::path& place : {folder_ / "templates", source_folder() / "templates"})
      arguments.insert(arguments.end(), {"--templates", place.string()});
    Surroundings surroundings;
    surroundings.folder = folder_;
    return run_rigc(arguments, surroundings);
  }
  fs::path shot(int i) const {
    return folder_ / (i % 2 == 0 ? "shots" : "shots/sq") / ("00" + std::to_string(i) + ".glb");
  }
  fs::path path() const { return folder_; }

 private:
  static std::string own_template() { return (source_folder() / "templates/biped.yaml").string(); }
  fs::path folder_;
};

/// What tells whether a file was touched.
std::pair<ino_t, timespec> state(const fs::path& file) {
  struct stat status {};
  REQUIRE(::stat(file.c_str(), &status) == 0);
  return {status.st_ino, status.st_mtim};
}

bool same(const std::pair<ino_t, timespec>& a, const std::pair<ino_t, timespec>& b) {
  return a.first == b.first && a.second.tv_sec == b.second.tv_sec &&
         a.second.tv_nsec == b.second.tv_nsec;
}

}  // namespace

TEST_CASE("cli update: any number of jobs writes the same files and the same report") {
  std::set<std::string> reports, outputs;
  for (const char* jobs : {"1", "2", "5"}) {
    const Shots shots("update_jobs");
    shots.publish();
    std::ofstream(shots.shot(3), std::ios::binary) << "no model";
    const Outcome outcome =
        shots.update({"shots", "--jobs", jobs, "--report", "r.json", "--backup", "old"});
    CHECK(outcome.status == 1);
    CHECK(outcome.err.find("shots/sq/003.glb") != std::string::npos);
    CHECK(outcome.out.find("         5 changed\n") != std::string::npos);
    CHECK(outcome.out.find("         1 failed\n") != std::string::npos);
    const std::string report = file_text(shots.path() / "r.json");
    CHECK(Json::parse(report)["files"].size() == kShots);
    reports.insert(report);
    std::string all;
    for (int i = 0; i < kShots; ++i) all += file_text(shots.shot(i));
    outputs.insert(all);
    CHECK(file_text(shots.shot(3)) == "no model");
    CHECK(file_text(shots.path() / "old/000.glb") == file_text(shots.path() / "old/sq/001.glb"));
    CHECK(file_text(shots.path() / "old/000.glb") != file_text(shots.shot(0)));
    CHECK(!fs::exists(shots.path() / "old/sq/003.glb"));
  }
  CHECK(reports.size() == 1);
  CHECK(outputs.size() == 1);
}

TEST_CASE("cli update: a file that needs no update is not touched") {
  const Shots shots("update_nothing");
  std::map<int, std::pair<ino_t, timespec>> before;
  for (int i = 0; i < kShots; ++i) before[i] = state(shots.shot(i));
  const Outcome outcome = shots.update({"shots", "--json"});
  CHECK(outcome.status == 0);
  CHECK(Json::parse(outcome.out)["totals"]["unchanged"] == kShots);
  for (int i = 0; i < kShots; ++i) CHECK(same(before[i], state(shots.shot(i))));
  shots.publish();
  CHECK(shots.update({"shots", "--plan"}).status == 0);
  for (int i = 0; i < kShots; ++i) CHECK(same(before[i], state(shots.shot(i))));
}

TEST_CASE("cli update: patterns, lists and another folder") {
  const Shots shots("update_places");
  shots.publish();
  CHECK(shots.update({"shots/**/00[12].glb", "--out-dir", "new"}).status == 0);
  CHECK(fs::exists(shots.path() / "new/002.glb"));
  CHECK(fs::exists(shots.path() / "new/sq/001.glb"));
  CHECK(!fs::exists(shots.path() / "new/sq/003.glb"));
  CHECK(file_text(shots.path() / "new/002.glb") == file_text(shots.path() / "new/sq/001.glb"));
  CHECK(file_text(shots.path() / "new/002.glb") != file_text(shots.shot(2)));
  std::ofstream(shots.path() / "list.txt") << "# of today\nshots/000.glb\nshots/sq/005.glb\n";
  const Outcome listed = shots.update({"@list.txt", "--report", "r.json"});
  CHECK(listed.status == 0);
  CHECK(file_text(shots.shot(0)) == file_text(shots.path() / "new/002.glb"));
  CHECK(file_text(shots.shot(5)) == file_text(shots.shot(0)));
  // What a report says is done is left out, with other options it is another work.
  CHECK(shots.update({"shots", "--resume", "r.json", "--report", "r.json"}).status == 0);
  const Json report = Json::parse(file_text(shots.path() / "r.json"));
  CHECK(report["totals"]["changed"] == kShots);
  CHECK(shots.update({"shots", "--resume", "r.json", "--strict"}).status == 1);
  CHECK(shots.update({"none*.glb"}).status == 1);
  CHECK(shots.update({"none.glb"}).status == 3);
}

}  // namespace rigc::test
