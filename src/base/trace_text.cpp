// SPDX-License-Identifier: MIT
// Recorded spans as a trace file and as a table. Test: tests/base/trace_test.cpp
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/json.h"
#include "base/text.h"
#include "base/trace.h"

namespace rigc::trace {
namespace {

constexpr int kProcess = 1;

double microseconds(std::int64_t nanoseconds) { return static_cast<double>(nanoseconds) / 1e3; }

/// What viewers show instead of a number.
void write_name(json::Writer& w, const char* what, unsigned thread, const std::string& name) {
  w.begin_object().member("name", what).member("ph", "M").member("pid", kProcess);
  w.member("tid", thread).key("args").begin_object().member("name", name).end_object().end_object();
}

void write_event(json::Writer& w, const Event& event, unsigned thread) {
  w.begin_object().member("name", printable(event.name));
  w.member("cat", printable(event.category)).member("ph", "X");
  w.member("ts", microseconds(event.begin)).member("dur", microseconds(event.end - event.begin));
  w.member("pid", kProcess).member("tid", thread);
  if (!event.key.empty())
    w.key("args").begin_object().member(event.key, printable(event.value, 1000)).end_object();
  w.end_object();
}

struct Total {
  std::int64_t nanoseconds = 0;
  std::size_t count = 0;

  void add(const Event& event) {
    nanoseconds += event.end - event.begin;
    if (event.category != kHelp) ++count;
  }
};

/// Stages of one name inside the same stages.
struct Stage {
  std::string name;
  Total total;
  std::vector<Stage> inner;

  Stage& find(const std::string& wanted) {
    for (Stage& stage : inner)
      if (stage.name == wanted) return stage;
    inner.emplace_back().name = wanted;
    return inner.back();
  }
};

struct Sums {
  Stage all;  ///< `total`: the time of all threads
  std::map<std::string, Total> modules;
  std::set<unsigned> threads;
  std::size_t left_out = 0;
};

bool is_command(const Event& event) {
  return event.category != kStage && event.category != kFile && event.category != kHelp;
}

void add_thread(const ThreadEvents& thread, Sums& sums) {
  sums.all.total.nanoseconds += thread.end - thread.begin;
  sums.threads.insert(thread.number);
  sums.left_out += thread.left_out;
  std::vector<const Event*> path;  // the events around this one, and itself
  for (const Event& event : thread.events) {
    path.resize(event.depth);
    path.push_back(&event);
    if (is_command(event)) sums.modules[event.category].add(event);
    if (std::any_of(path.begin(), path.end(), [](const Event* on) { return is_command(*on); }))
      continue;
    Stage* stage = &sums.all;
    for (const Event* on : path) stage = &stage->find(on->name);
    stage->total.add(event);
  }
}

class Table {
 public:
  explicit Table(std::int64_t whole) : whole_(whole) {}

  void head(const char* what) {
    text_ += fmt::format("{:<34}{:>10}{:>8}{:>8}\n", what, "ms", "share", "count");
  }
  void row(const std::string& name, const Total& total) {
    const double share = static_cast<double>(total.nanoseconds) /
                         static_cast<double>(std::max<std::int64_t>(whole_, 1));
    text_ += fmt::format("{:<34}{:>10.2f}{:>7.1f}%", printable(name, 60),
                         static_cast<double>(total.nanoseconds) / 1e6, 100 * share);
    text_ += total.count ? fmt::format("{:>8}\n", total.count) : "\n";
  }
  void stages(const Stage& around, std::size_t depth) {
    for (const Stage& stage : around.inner) {
      row(std::string(2 * depth, ' ') + stage.name, stage.total);
      stages(stage, depth + 1);
    }
  }
  void line(const std::string& text) { text_ += text + "\n"; }
  std::string take() { return std::move(text_); }

 private:
  std::int64_t whole_;
  std::string text_;
};

}  // namespace

std::string as_json(const std::vector<ThreadEvents>& threads, const std::vector<Fact>& facts) {
  json::Writer w;
  w.begin_object().member("displayTimeUnit", "ms").key("otherData").begin_object();
  for (const Fact& fact : facts) w.member(fact.name, fact.value);
  w.end_object().key("traceEvents").begin_array();
  write_name(w, "process_name", 0, "rigc");
  std::set<unsigned> named;
  for (const ThreadEvents& thread : threads) {
    if (named.insert(thread.number).second)
      write_name(w, "thread_name", thread.number,
                 thread.number == 0 ? "main" : fmt::format("job {}", thread.number));
    for (const Event& event : thread.events) write_event(w, event, thread.number);
  }
  return w.end_array().end_object().take() + "\n";
}

std::string as_table(const std::vector<ThreadEvents>& threads) {
  Sums sums;
  for (const ThreadEvents& thread : threads) add_thread(thread, sums);
  const std::int64_t whole = sums.all.total.nanoseconds;
  Table table(whole);
  table.head("stage");
  table.stages(sums.all, 0);
  Total other{whole, 0};
  for (const Stage& stage : sums.all.inner) other.nanoseconds -= stage.total.nanoseconds;
  table.row("other", other);
  const std::size_t count = sums.threads.size();
  table.row(count == 1 ? "total" : fmt::format("total of {} threads", count), {whole, 0});
  std::vector<std::pair<std::string, Total>> modules(sums.modules.begin(), sums.modules.end());
  std::stable_sort(modules.begin(), modules.end(), [](const auto& a, const auto& b) {
    return a.second.nanoseconds > b.second.nanoseconds;
  });
  if (!modules.empty()) table.head("module");
  for (const auto& [name, total] : modules) table.row(name, total);
  if (sums.left_out > 0) table.line(fmt::format("{} spans more were not kept", sums.left_out));
  return table.take();
}

}  // namespace rigc::trace
