// SPDX-License-Identifier: MIT
// Tests of src/base/trace.h: spans, threads, the trace file and the table.
#include "base/trace.h"

#include <doctest/doctest.h>

#include <atomic>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/text.h"
#include "base/threads.h"

using namespace rigc;
using trace::Attach;
using trace::Recorder;
using trace::Span;
using trace::ThreadEvents;

namespace {

/// A stage with two commands of one module and one of another inside, then a stage of its own.
std::vector<ThreadEvents> record(std::size_t most = 1000) {
  Recorder recorder(most);
  {
    const Attach attach(&recorder);
    {
      const Span run("run commands");
      const Span first("main", "control", "joint", "hips");
    }
    {
      const Span run("run commands");
      { const Span again("main", "control", "joint", "he\"ad\x1b\xff"); }
      { const Span other("fk", "fk_chain"); }
    }
    const Span write("write");
  }
  return recorder.threads();
}

/// The numbers of a row of the table: milliseconds, share, count where it has one.
std::vector<std::string> row(const std::string& table, const std::string& name) {
  for (const std::string_view line : split(table, '\n')) {
    if (!starts_with(line, name + " ")) continue;
    std::vector<std::string> words;
    for (const std::string_view word : split(line.substr(name.size()), ' '))
      if (!word.empty()) words.emplace_back(word);
    return words;
  }
  return {};
}

}  // namespace

TEST_CASE("base trace: without a recorder nothing is recorded") {
  CHECK(trace::current() == nullptr);
  const Attach attach(nullptr);
  const Span span("work");
  CHECK(trace::current() == nullptr);
}

TEST_CASE("base trace: spans have what they were given and lie inside those around them") {
  const std::vector<ThreadEvents> threads = record();
  REQUIRE(threads.size() == 1);
  const auto& events = threads[0].events;
  REQUIRE(events.size() == 6);
  CHECK(events[1].name == "main");
  CHECK(events[1].category == "control");
  CHECK(events[1].key == "joint");
  CHECK(events[1].value == "hips");
  const std::size_t depths[] = {0, 1, 0, 1, 1, 0};
  const std::size_t around[] = {0, 0, 2, 2, 2, 5};
  for (std::size_t i = 0; i < events.size(); ++i) {
    CHECK(events[i].depth == depths[i]);
    CHECK(events[i].begin >= events[around[i]].begin);
    CHECK(events[i].end >= events[i].begin);
    CHECK(events[i].end <= events[around[i]].end);
    CHECK(events[i].begin >= threads[0].begin);
    CHECK(events[i].end <= threads[0].end);
    if (i > 0) CHECK(events[i].begin >= events[i - 1].begin);
  }
}

TEST_CASE("base trace: an inner attachment takes the spans and gives them back") {
  Recorder outer, inner;
  {
    const Attach attach(&outer);
    {
      const Attach other(&inner);
      CHECK(trace::current() == &inner);
      const Span span("inner");
    }
    const Span span("outer");
  }
  CHECK(trace::current() == nullptr);
  REQUIRE(outer.threads().size() == 1);
  REQUIRE(outer.threads()[0].events.size() == 1);
  CHECK(outer.threads()[0].events[0].name == "outer");
  CHECK(inner.threads()[0].events[0].name == "inner");
}

TEST_CASE("base trace: threads that run together have numbers and spans of their own") {
  Recorder recorder;
  constexpr unsigned kThreads = 4;
  {
    const Attach attach(&recorder);
    Recorder* const shared = trace::current();
    std::atomic<unsigned> attached{0};
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < kThreads; ++i)
      threads.emplace_back([&, shared] {
        const Attach own(shared);
        for (++attached; attached < kThreads;) std::this_thread::yield();
        for (unsigned k = 0; k < 100; ++k) const Span span("work");
      });
    for (std::thread& thread : threads) thread.join();
    std::thread([shared] { const Attach own(shared); }).join();  // takes a number that is free
  }
  const std::vector<ThreadEvents> threads = recorder.threads();
  REQUIRE(threads.size() == kThreads + 2);
  const unsigned numbers[] = {0, 1, 1, 2, 3, 4};
  const std::size_t spans[] = {0, 100, 0, 100, 100, 100};
  for (std::size_t i = 0; i < threads.size(); ++i) {
    CHECK(threads[i].number == numbers[i]);
    CHECK(threads[i].events.size() == spans[i]);
  }
  CHECK(trace::as_table(threads).find("total of 5 threads") != std::string::npos);
}

TEST_CASE("base trace: a thread that helps is in the stages of the loop that it helps") {
  Recorder recorder;
  {
    const Attach attach(&recorder);
    { const Span before("before"); }
    const Span outer("outer"), inner("inner");
    std::atomic<unsigned> begun{0};
    Threads threads(2);
    threads.for_each(2, [&](std::size_t) {
      for (++begun; begun < 2;) std::this_thread::yield();  // one item for each thread
      const Span span("work");
    });
  }
  const std::vector<ThreadEvents> threads = recorder.threads();
  REQUIRE(threads.size() == 2);
  const auto& events = threads[1].events;
  REQUIRE(events.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) CHECK(events[i].depth == i);
  CHECK(events[0].name == "outer");
  CHECK(events[1].name == "inner");
  CHECK(events[1].category == trace::kHelp);
  const std::string table = trace::as_table(threads);
  CHECK(row(table, "  inner").back() == "1");
  CHECK(row(table, "    work").back() == "2");
}

TEST_CASE("base trace: beyond the limit spans are counted") {
  const std::vector<ThreadEvents> threads = record(4);
  CHECK(threads[0].events.size() == 4);
  CHECK(threads[0].left_out == 2);
  CHECK(trace::as_table(threads).find("2 spans more were not kept") != std::string::npos);
  CHECK(trace::as_table(record()).find("not kept") == std::string::npos);
}

TEST_CASE("base trace: the file is a Chrome trace") {
  std::vector<ThreadEvents> threads = record();
  threads.push_back(threads[0]);
  threads[1].number = 3;
  threads[0].events[0].begin = 1'234'567;
  threads[0].events[0].end = 2'000'000'000;
  const auto document = nlohmann::json::parse(trace::as_json(threads, {{"machine", "\"loom\""}}));
  CHECK(document["otherData"] == nlohmann::json{{"machine", "\"loom\""}});
  const auto& events = document["traceEvents"];
  REQUIRE(events.size() == 1 + 2 * (1 + 6));
  CHECK(events[0]["name"] == "process_name");
  CHECK(events[1]["args"]["name"] == "main");
  CHECK(events[2]["ph"] == "X");
  CHECK(events[2]["name"] == "run commands");
  CHECK(events[2]["ts"] == 1234.567);
  CHECK(events[2]["dur"] == 1998765.433);
  CHECK(events[2]["tid"] == 0);
  CHECK_FALSE(events[2].contains("args"));
  CHECK(events[5]["cat"] == "control");
  CHECK(events[5]["args"]["joint"] == "he\"ad\\x1b\\xff");
  CHECK(events[8]["args"]["name"] == "job 3");
  CHECK(events[9]["tid"] == 3);
  CHECK(nlohmann::json::parse(trace::as_json({}))["traceEvents"].size() == 1);
}

TEST_CASE("base trace: the table adds up stages and modules") {
  std::vector<ThreadEvents> threads(2);
  threads[0].end = 30'000'000;
  threads[0].events = {{"read", "stage", "", "", 0, 10'000'000, 0},
                       {"open", "stage", "", "", 0, 4'000'000, 1},
                       {"run", "stage", "", "", 10'000'000, 20'000'000, 0},
                       {"main", "control", "joint", "a", 10'000'000, 13'000'000, 1},
                       {"resolve", "stage", "", "", 10'000'000, 11'000'000, 2},
                       {"hand", "control", "joint", "b", 13'000'000, 14'000'000, 1},
                       {"fk", "fk_chain", "", "", 14'000'000, 20'000'000, 1},
                       {"open", "stage", "", "", 20'000'000, 21'000'000, 0}};
  threads[1].number = 1;
  threads[1].begin = 10'000'000;
  threads[1].end = 20'000'000;
  threads[1].events = {{"read", "stage", "", "", 10'000'000, 15'000'000, 0}};
  const std::string table = trace::as_table(threads);
  INFO(table);
  using Words = std::vector<std::string>;
  CHECK(row(table, "read") == Words{"15.00", "37.5%", "2"});
  CHECK(row(table, "  open") == Words{"4.00", "10.0%", "1"});
  CHECK(row(table, "open") == Words{"1.00", "2.5%", "1"});
  CHECK(row(table, "run") == Words{"10.00", "25.0%", "1"});
  CHECK(row(table, "other") == Words{"14.00", "35.0%"});
  CHECK(row(table, "total of 2 threads") == Words{"40.00", "100.0%"});
  CHECK(row(table, "fk_chain") == Words{"6.00", "15.0%", "1"});
  CHECK(row(table, "control") == Words{"4.00", "10.0%", "2"});
  CHECK(table.find("fk_chain") < table.find("control"));
  CHECK(table.find("resolve") == std::string::npos);
}
