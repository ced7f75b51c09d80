// SPDX-License-Identifier: MIT
// Spans of time. Test: tests/base/trace_test.cpp
#include "base/trace.h"

#include <algorithm>
#include <chrono>

namespace rigc::trace {
namespace {

std::int64_t clock_nanoseconds() {
  using std::chrono::nanoseconds, std::chrono::steady_clock;
  return std::chrono::duration_cast<nanoseconds>(steady_clock::now().time_since_epoch()).count();
}

}  // namespace

namespace detail {

constinit thread_local Attached* attached = nullptr;

}  // namespace detail

Recorder::Recorder(std::size_t most) : most_(most), start_(clock_nanoseconds()) {}

std::int64_t Recorder::now() const { return clock_nanoseconds() - start_; }

std::vector<ThreadEvents> Recorder::threads() const {
  const std::lock_guard lock(mutex_);
  std::vector<ThreadEvents> out = threads_;
  std::stable_sort(out.begin(), out.end(), [](const ThreadEvents& a, const ThreadEvents& b) {
    return a.number != b.number ? a.number < b.number : a.begin < b.begin;
  });
  return out;
}

Attach::Attach(Recorder* recorder)
    : before_(detail::attached),
      own_(recorder ? std::optional(detail::Attached{*recorder, {}, 0}) : std::nullopt) {
  if (own_) {
    const std::lock_guard lock(recorder->mutex_);
    while (!recorder->numbers_.insert(own_->thread.number).second) ++own_->thread.number;
    own_->thread.begin = recorder->now();
  }
  detail::attached = own_ ? &*own_ : nullptr;
}

Attach::~Attach() {
  detail::attached = before_;
  if (!own_) return;
  Recorder& recorder = own_->recorder;
  own_->thread.end = recorder.now();
  const std::lock_guard lock(recorder.mutex_);
  recorder.numbers_.erase(own_->thread.number);
  recorder.threads_.push_back(std::move(own_->thread));
}

Recorder* current() { return detail::attached ? &detail::attached->recorder : nullptr; }

std::vector<std::string> open_spans() {
  if (!detail::attached) return {};
  const std::vector<Event>& events = detail::attached->thread.events;
  std::size_t depth = detail::attached->depth;
  std::vector<std::string> names(depth);
  for (std::size_t i = events.size(); i-- > 0 && depth > 0;)
    if (events[i].depth == depth - 1) names[--depth] = events[i].name;
  return names;
}

void Span::begin(std::string_view name, std::string_view category, std::string_view key,
                 std::string_view value) {
  ThreadEvents& thread = attached_->thread;
  if (thread.events.size() >= attached_->recorder.most_) {
    ++thread.left_out;
    attached_ = nullptr;
    return;
  }
  index_ = thread.events.size();
  Event& event = thread.events.emplace_back();
  event.name = name;
  event.category = category;
  event.key = key;
  event.value = value;
  event.depth = attached_->depth++;
  event.begin = attached_->recorder.now();
}

void Span::end() {
  attached_->thread.events[index_].end = attached_->recorder.now();
  --attached_->depth;
}

}  // namespace rigc::trace
