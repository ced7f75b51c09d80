// SPDX-License-Identifier: MIT
// Tests of src/pipeline/batch.h with works that only copy: order, failures, places, backups.
#include "pipeline/batch.h"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "base/codes.h"
#include "base/files_helpers.h"
#include "pipeline/batch_codes.h"

using namespace rigc;
using pipeline::Batch;
using pipeline::BatchRequest;
using pipeline::FileResult;
using pipeline::FileWork;
using test::TestFolder;
namespace fs = std::filesystem;
using Json = nlohmann::json;
using Outcome = FileResult::Outcome;

namespace {

constexpr Code kWrong{890, Severity::error, "wrong", ""};
constexpr Code kOdd{891, Severity::warning, "odd", ""};

/// Writes the input's text with "+" behind it. What the text is decides what goes wrong.
FileResult append_plus(const FileWork& work, Diagnostics& diagnostics) {
  FileResult result;
  const auto lock = FileLock::take(work.input, diagnostics);
  const auto bytes = Bytes::open(work.input, 1 << 20, diagnostics);
  if (!lock || !bytes) return result;
  const auto text = bytes->text(diagnostics);
  if (!text) return result;
  result.summary = fmt::format("{} bytes", text->size());
  result.json = fmt::format("{{\"length\": {}}}", text->size());
  if (*text == "memory") throw std::bad_alloc();
  if (*text == "odd") diagnostics.report(kOdd, work.input, "odd text");
  if (*text == "bad") diagnostics.report(kWrong, work.input, "bad text");
  if (*text == "same" || !diagnostics.ok()) return result;
  result.outcome = Outcome::changed;
  result.bytes = text->size() + 1;
  WriteSettings settings;
  if (work.output == work.input) settings.expected = bytes->version();
  if (keep_original(work, *bytes, diagnostics))
    write_file(work.output, {*bytes, "+"}, diagnostics, settings);
  return result;
}

/// Records what it hears.
class Recorder final : public pipeline::BatchListener {
 public:
  void progress(const pipeline::BatchProgress& progress) override {
    CHECK(progress.done >= last.done);
    last = progress;
  }
  void said(const std::string& text) override { said_texts.push_back(text); }
  pipeline::BatchProgress last;
  std::vector<std::string> said_texts;
};

Batch run(const BatchRequest& request, const pipeline::Work& work = append_plus) {
  Diagnostics diagnostics;
  const auto batch = run_batch(request, work, diagnostics);
  REQUIRE_MESSAGE(batch, render(diagnostics, false));
  return *batch;
}

/// Codes of the errors that keep a batch from beginning.
std::vector<int> refused(const BatchRequest& request) {
  Diagnostics diagnostics;
  bool began = false;
  const auto batch = run_batch(
      request,
      [&](const FileWork&, Diagnostics&) {
        began = true;
        return FileResult();
      },
      diagnostics);
  CHECK(!batch);
  CHECK(!began);
  std::vector<int> codes;
  for (const Diagnostic& one : diagnostics.all()) codes.push_back(one.code->number);
  return codes;
}

void put_in(const TestFolder& folder, const std::string& file, const std::string& text) {
  fs::create_directories(fs::path(folder / file).parent_path());
  folder.put(file, text);
}

}  // namespace

TEST_CASE("pipeline batch: the report and what is said are the same for any number of jobs") {
  std::set<std::string> reports, said;
  for (unsigned jobs : {1u, 2u, 7u}) {
    const TestFolder folder("batch_jobs");
    for (int i = 0; i < 60; ++i)
      put_in(folder, fmt::format("in/{:02}/a.glb", i), i % 7 == 3 ? "bad" : "odd");
    BatchRequest request;
    request.inputs = {folder / "in"};
    request.jobs = jobs;
    std::atomic<int> running{0}, most{0};
    Recorder recorder;
    Diagnostics diagnostics;
    const auto batch = run_batch(
        request,
        [&](const FileWork& work, Diagnostics& own) {
          most = std::max<int>(most, ++running);
          // The first files are the slowest.
          std::this_thread::sleep_for(std::chrono::milliseconds(work.input.back() == '0' ? 5 : 1));
          FileResult result = append_plus(work, own);
          --running;
          return result;
        },
        diagnostics, &recorder);
    REQUIRE(batch);
    CHECK(diagnostics.all().empty());
    CHECK(most <= static_cast<int>(jobs));
    CHECK(recorder.last.done == 60);
    CHECK(recorder.last.total == 60);
    CHECK(recorder.last.failed == 9);
    CHECK(recorder.said_texts.size() == 60);
    CHECK(batch->exit_status() == 1);
    reports.insert(batch->report + batch_table(*batch));
    std::string all;
    for (const std::string& text : recorder.said_texts) all += text;
    said.insert(all);
    CHECK(folder.get("in/04/a.glb") == "odd+");
    CHECK(folder.get("in/03/a.glb") == "bad");
  }
  CHECK(reports.size() == 1);
  CHECK(said.size() == 1);
}

TEST_CASE("pipeline batch: outcomes, members of the work, errors with code and place") {
  const TestFolder folder("batch_outcomes");
  put_in(folder, "a.glb", "text");
  put_in(folder, "b.glb", "same");
  put_in(folder, "c.glb", "bad");
  put_in(folder, "d.glb", "odd");
  put_in(folder, "e.glb", "memory");
  BatchRequest request;
  request.inputs = {folder.path(), folder / "none.glb"};
  request.settings = "{\"to\":\"\"}";
  request.report = folder / "report.json";
  const Batch batch = run(request);
  CHECK(folder.get("report.json") == batch.report);
  // tools/node/check_report.mjs looks at this one.
  fs::create_directories(RIGC_TEST_OUT "/pipeline/broken/batch");
  fs::copy_file(folder / "report.json", RIGC_TEST_OUT "/pipeline/broken/batch/report.json",
                fs::copy_options::overwrite_existing);
  const Json report = Json::parse(batch.report);
  CHECK(report["rigc_report"] == 1);
  CHECK(report["command"] == "update");
  CHECK(report["settings"] == Json{{"to", ""}});
  CHECK(report["interrupted"] == false);
  CHECK(report["totals"] == Json{{"files", 6},
                                 {"changed", 2},
                                 {"unchanged", 1},
                                 {"failed", 3},
                                 {"skipped", 0},
                                 {"remaining", 0}});
  REQUIRE(report["files"].size() == 6);
  CHECK(report["files"][0]["file"] == folder / "a.glb");
  CHECK(report["files"][0]["output"] == folder / "a.glb");
  CHECK(report["files"][0]["outcome"] == "changed");
  CHECK(report["files"][0]["bytes"] == 5);
  CHECK(report["files"][0]["length"] == 4);
  CHECK(report["files"][1]["outcome"] == "unchanged");
  CHECK(report["files"][2]["errors"] ==
        Json::array({{{"code", "RIG0890"}, {"message", "bad text"}, {"place", folder / "c.glb"}}}));
  CHECK(report["files"][3]["outcome"] == "changed");
  CHECK(report["files"][3]["warnings"][0]["code"] == "RIG0891");
  CHECK(report["files"][4]["errors"][0]["code"] == "RIG0815");
  CHECK(report["files"][5]["errors"][0]["code"] == "RIG0001");
  CHECK(batch.exit_status() == 1);
  const std::string table = batch_table(batch);
  CHECK(table.find("c.glb: RIG0890 bad text\n") != std::string::npos);
  CHECK(table.find("         3 failed\n") != std::string::npos);
}

TEST_CASE("pipeline batch: exit status 3 only where nothing but the file system failed") {
  const TestFolder folder("batch_status");
  put_in(folder, "a.glb", "same");
  BatchRequest request;
  request.inputs = {folder / "a.glb"};
  CHECK(run(request).exit_status() == 0);
  request.inputs = {folder / "a.glb", folder / "none.glb"};
  CHECK(run(request).exit_status() == 3);
  put_in(folder, "b.glb", "bad");
  request.inputs = {folder / "b.glb", folder / "none.glb"};
  CHECK(run(request).exit_status() == 1);
}

TEST_CASE("pipeline batch: --out-dir mirrors the tree, which stays as it is") {
  const TestFolder folder("batch_out");
  put_in(folder, "in/a.glb", "a");
  put_in(folder, "in/sq/b.glb", "b");
  BatchRequest request;
  request.inputs = {folder / "in"};
  request.out_dir = folder / "in/out/new";
  CHECK(run(request).count(Outcome::changed) == 2);
  CHECK(folder.get("in/out/new/a.glb") == "a+");
  CHECK(folder.get("in/out/new/sq/b.glb") == "b+");
  CHECK(folder.get("in/sq/b.glb") == "b");
  // Its own output is no input of the next run.
  CHECK(run(request).entries.size() == 2);
  // A work that only looks leaves no folders behind.
  request.out_dir = folder / "nothing";
  request.writes = false;
  run(request, [](const FileWork&, Diagnostics&) { return FileResult(); });
  CHECK(!fs::exists(folder / "nothing"));
}

TEST_CASE("pipeline batch: options and places that contradict each other begin nothing") {
  using namespace pipeline::codes;
  using Numbers = std::vector<int>;
  const TestFolder folder("batch_refused");
  for (const char* file : {"x/a.glb", "y/a.glb", "y/b.glb"}) put_in(folder, file, "text");
  BatchRequest request;
  request.inputs = {folder / "x/a.glb", folder / "y/a.glb"};
  request.out_dir = folder / "out";
  CHECK(refused(request) == Numbers{kSameOutput.number});
  request.out_dir = folder / "x";
  CHECK(refused(request) == Numbers{kSameOutput.number, kSameOutput.number});
  request.out_dir = "";
  request.backup = folder / "x";
  CHECK(refused(request) == Numbers{kSameOutput.number, kSameOutput.number});
  request.out_dir = folder / "out";
  CHECK(refused(request) == Numbers{kBadOptions.number});
  request = {};
  request.inputs = {folder / "x", folder / "y"};
  request.output = folder / "one.glb";
  CHECK(refused(request) == Numbers{kBadOptions.number});
  request.output = "";
  request.report = folder / "x/a.glb";
  CHECK(refused(request) == Numbers{kBadOptions.number});
  request.report = folder / "none/r.json";
  CHECK(refused(request) == Numbers{rigc::codes::kNoSuchFolder.number});
  request.inputs = {folder / "z*"};
  CHECK(refused(request) == Numbers{kNoInputs.number});
  CHECK(folder.get("x/a.glb") == "text");
}

TEST_CASE("pipeline batch: originals are kept, and no backup is ever overwritten") {
  const TestFolder folder("batch_backup");
  put_in(folder, "in/sq/a.glb", "old");
  put_in(folder, "in/same.glb", "same");
  REQUIRE(::chmod((folder / "in/sq/a.glb").c_str(), 0600) == 0);
  BatchRequest request;
  request.inputs = {folder / "in"};
  request.backup = folder / "in/backup";
  CHECK(run(request).exit_status() == 0);
  CHECK(folder.get("in/sq/a.glb") == "old+");
  CHECK(folder.get("in/backup/sq/a.glb") == "old");
  CHECK(!fs::exists(folder / "in/backup/same.glb"));
  struct stat status {};
  REQUIRE(::stat((folder / "in/backup/sq/a.glb").c_str(), &status) == 0);
  CHECK((status.st_mode & 0777) == 0600);
  // The file has other bytes by now.
  Batch batch = run(request);
  CHECK(batch.exit_status() == 1);
  CHECK(batch.entries[1].first_error.starts_with("RIG0083"));
  CHECK(folder.get("in/sq/a.glb") == "old+");
  CHECK(folder.get("in/backup/sq/a.glb") == "old");
  put_in(folder, "in/sq/a.glb", "old");
  CHECK(run(request).exit_status() == 0);
}

TEST_CASE("pipeline batch: interrupted and gone on with, in any order of jobs") {
  for (unsigned jobs : {1u, 3u}) {
    const TestFolder folder("batch_resume");
    for (int i = 0; i < 20; ++i)
      put_in(folder, fmt::format("in/{:02}.glb", i), i == 1 ? "bad" : "text");
    std::atomic<bool> stop{false};
    std::atomic<int> begun{0};
    BatchRequest request;
    request.inputs = {folder / "in"};
    request.report = folder / "r.json";
    request.jobs = jobs;
    request.stop = &stop;
    const auto counting = [&](const FileWork& work, Diagnostics& diagnostics) {
      if (++begun == 8) stop = true;
      return append_plus(work, diagnostics);
    };
    Diagnostics diagnostics;
    const auto first = run_batch(request, counting, diagnostics);
    REQUIRE(first);
    REQUIRE(diagnostics.errors() == 1);
    CHECK(diagnostics.all()[0].code->number == pipeline::codes::kInterrupted.number);
    const int done = begun;
    CHECK(done >= 8);
    CHECK(done <= 8 + static_cast<int>(jobs) - 1);
    CHECK(first->exit_status() == 1);
    const Json report = Json::parse(folder.get("r.json"));
    CHECK(report["interrupted"] == true);
    CHECK(report["files"].size() == begun);
    CHECK(report["totals"]["remaining"] == 20 - done);

    stop = false;
    begun = 100;
    request.resume = request.report;
    put_in(folder, "in/01.glb", "mended");
    const Batch second = run(request, counting);
    CHECK(begun == 100 + 20 - done + 1);
    CHECK(second.exit_status() == 0);
    CHECK(Json::parse(second.report)["totals"]["changed"] == 20);
    for (int i = 0; i < 20; ++i)
      CHECK(folder.get(fmt::format("in/{:02}.glb", i)) == (i == 1 ? "mended+" : "text+"));
    // Reports of other work are refused.
    request.settings = "{\"to\":\"biped@7\"}";
    CHECK(refused(request) == std::vector<int>{pipeline::codes::kNotThatReport.number});
    request.settings = "{}";
    request.command = "rebuild";
    CHECK(refused(request) == std::vector<int>{pipeline::codes::kNotThatReport.number});
    put_in(folder, "r.json", "{}");
    CHECK(refused(request) == std::vector<int>{pipeline::codes::kNotThatReport.number});
  }
}

TEST_CASE("pipeline batch: spans of what all files share are printed with their lines") {
  const TestFolder folder("batch_spans");
  put_in(folder, "a.glb", "text");
  Sources shared;
  const Span span{shared.add("biped.yaml", "rigc: 1\nwrong: 2\n"), 2, 1, 5};
  BatchRequest request;
  request.inputs = {folder.path()};
  request.sources = &shared;
  Recorder recorder;
  Diagnostics diagnostics;
  REQUIRE(run_batch(
      request,
      [&](const FileWork&, Diagnostics& own) {
        own.report(kWrong, span, "unknown key");
        return FileResult();
      },
      diagnostics, &recorder));
  CHECK(recorder.said_texts == std::vector<std::string>{"biped.yaml:2:1: error[RIG0890]: unknown "
                                                        "key\n  wrong: 2\n  ^~~~~\n"});
}
