// SPDX-License-Identifier: MIT
// Where the time goes: spans with a name, in each thread one inside the other, for --trace and
// --time. Where nobody listens a span costs one test of a pointer. Times go nowhere else: outputs
// do not depend on them. Test: tests/base/trace_test.cpp
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace rigc::trace {

/// Categories of spans; that of a command is its module's name.
inline constexpr std::string_view kStage = "stage";
inline constexpr std::string_view kFile = "file";

/// A thread's part in a stage that another thread began: its time counts, but it is no further
/// stage.
inline constexpr std::string_view kHelp = "help";

/// A span that was recorded. Times are nanoseconds since the recorder was made.
struct Event {
  std::string name;
  std::string category;
  std::string key, value;  ///< what it worked on: ("joint", "elbow_l"); `key` empty: nothing said
  std::int64_t begin = 0;
  std::int64_t end = 0;
  std::size_t depth = 0;  ///< spans around it
};

/// What one thread recorded while it was attached, in the order in which spans began.
struct ThreadEvents {
  unsigned number = 0;  ///< 0: the first thread; a thread that ends leaves its number to another
  std::int64_t begin = 0;
  std::int64_t end = 0;
  std::vector<Event> events;
  std::size_t left_out = 0;  ///< spans beyond the recorder's limit
};

/// Collects what threads record. Of each thread it keeps `most` spans and counts the others.
class Recorder {
 public:
  explicit Recorder(std::size_t most = 500'000);
  /// Of threads that are detached again, by number and time.
  std::vector<ThreadEvents> threads() const;

 private:
  friend class Attach;
  friend class Span;
  std::int64_t now() const;

  std::size_t most_;
  std::int64_t start_;
  mutable std::mutex mutex_;
  std::vector<ThreadEvents> threads_;
  std::set<unsigned> numbers_;  ///< of threads that are attached
};

namespace detail {

struct Attached {
  Recorder& recorder;
  ThreadEvents thread;
  std::size_t depth = 0;
};

extern constinit thread_local Attached* attached;

}  // namespace detail

/// Spans of this thread go to `recorder` as long as this lives; null: nowhere.
class Attach {
 public:
  explicit Attach(Recorder* recorder);
  ~Attach();
  Attach(const Attach&) = delete;
  Attach& operator=(const Attach&) = delete;

 private:
  detail::Attached* before_;
  std::optional<detail::Attached> own_;
};

/// Where spans of this thread go, for the threads that it starts; null: nowhere.
Recorder* current();

/// Names of the spans that are open in this thread, outermost first, for the threads that help it.
std::vector<std::string> open_spans();

/// From here to the end of the scope.
class Span {
 public:
  explicit Span(std::string_view name, std::string_view category = kStage,
                std::string_view key = {}, std::string_view value = {})
      : attached_(detail::attached) {
    if (attached_) begin(name, category, key, value);
  }
  ~Span() {
    if (attached_) end();
  }
  Span(const Span&) = delete;
  Span& operator=(const Span&) = delete;

 private:
  void begin(std::string_view name, std::string_view category, std::string_view key,
             std::string_view value);
  void end();

  detail::Attached* attached_;
  std::size_t index_ = 0;
};

/// What else is to be known of a run: ("instruction set", "avx2").
struct Fact {
  std::string name, value;
};

/// The Chrome trace event format: chrome://tracing and Perfetto open it and show the facts among
/// the metadata.
std::string as_json(const std::vector<ThreadEvents>& threads, const std::vector<Fact>& facts = {});

/// Time by stage, each below the one around it, and by module. Shares are of the time of all
/// threads.
std::string as_table(const std::vector<ThreadEvents>& threads);

}  // namespace rigc::trace
