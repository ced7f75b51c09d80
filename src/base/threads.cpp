// SPDX-License-Identifier: MIT
// Loops over threads. A thread lives as long as its loop has items: beginning one costs as much as
// evaluating a few blocks of frames. Test: tests/base/threads_test.cpp
#include "base/threads.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "base/trace.h"

namespace rigc {
namespace {

constexpr unsigned kMostJobs = 256;

unsigned job_count(unsigned wanted) {
  return std::clamp(wanted != 0 ? wanted : std::thread::hardware_concurrency(), 1u, kMostJobs);
}

}  // namespace

class Threads::Loop {
 public:
  Loop(Threads& threads, std::size_t count, const std::function<void(std::size_t)>& work)
      : threads_(threads), count_(count), work_(work) {}

  void run() {
    while (work_on_next([this] { recruit(); })) {
    }
    for (std::thread& helper : helpers_) helper.join();
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  /// Before each item, because threads of other loops come free.
  void recruit() {
    while (!refused_ && next_ < count_ && helpers_.size() + 1 < count_ && threads_.take_spare()) {
      try {
        helpers_.emplace_back([this] { help(); });
      } catch (const std::exception&) {
        refused_ = true;  // no more threads to be had: those that are there do it all
        ++threads_.spare_;
      }
    }
  }

  void help() {
    const trace::Attach attach(recorder_);
    help_inside(0);
    ++threads_.spare_;
  }

  /// Inside the stages that the loop is in, from `stage` on.
  void help_inside(std::size_t stage) {
    if (stage < stages_.size()) {
      const trace::Span span(stages_[stage], trace::kHelp);
      return help_inside(stage + 1);
    }
    while (work_on_next([] {})) {
    }
  }

  template <class Before>
  bool work_on_next(Before before) {
    const std::size_t index = next_++;
    if (index >= count_) return false;
    before();
    try {
      work_(index);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_ || index < failed_) {
        failure_ = std::current_exception();
        failed_ = index;
      }
      next_ = count_;
    }
    return true;
  }

  Threads& threads_;
  const std::size_t count_;
  const std::function<void(std::size_t)>& work_;
  trace::Recorder* const recorder_ = trace::current();
  const std::vector<std::string> stages_ = trace::open_spans();
  std::atomic<std::size_t> next_{0};
  std::vector<std::thread> helpers_;
  bool refused_ = false;  // by the system: another thread
  std::mutex mutex_;
  std::exception_ptr failure_;
  std::size_t failed_ = 0;
};

Threads::Threads(unsigned jobs) : jobs_(job_count(jobs)), spare_(jobs_ - 1) {}

bool Threads::take_spare() {
  unsigned spare = spare_;
  while (spare > 0)
    if (spare_.compare_exchange_weak(spare, spare - 1)) return true;
  return false;
}

void Threads::for_each(std::size_t count, const std::function<void(std::size_t)>& work) {
  Loop(*this, count, work).run();
}

}  // namespace rigc
