// SPDX-License-Identifier: MIT
// Loops over threads: every item once, no more threads than were asked for, exceptions.
#include "base/threads.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

using rigc::Threads;

namespace {

/// Counts how many are at work at a time.
class Crowd {
 public:
  void enter() {
    const int now = ++inside_;
    int most = most_;
    while (most < now && !most_.compare_exchange_weak(most, now)) {
    }
  }
  void leave() { --inside_; }
  int most() const { return most_; }

 private:
  std::atomic<int> inside_{0}, most_{0};
};

}  // namespace

TEST_CASE("threads: every item is worked on once") {
  for (const unsigned jobs : {1u, 2u, 3u, 8u})
    for (const std::size_t count : {0u, 1u, 2u, 7u, 1000u}) {
      CAPTURE(jobs);
      CAPTURE(count);
      Threads threads(jobs);
      CHECK(threads.jobs() == jobs);
      std::vector<int> done(count, 0);
      threads.for_each(count, [&](std::size_t i) { ++done[i]; });
      CHECK(std::count(done.begin(), done.end(), 1) == static_cast<std::ptrdiff_t>(count));
    }
}

TEST_CASE("threads: no jobs are as many as there are processors, and there is a most") {
  CHECK(Threads(0).jobs() == std::max(1u, std::thread::hardware_concurrency()));
  CHECK(Threads(1000000).jobs() == 256);
}

TEST_CASE("threads: items overlap where two are at work, and come in order where one is") {
  Threads two(2);
  std::atomic<int> there{0};
  two.for_each(2, [&](std::size_t) {
    ++there;
    while (there < 2) std::this_thread::yield();  // ends only where both are here
  });
  CHECK(there == 2);
  Threads one(1);
  std::vector<std::size_t> order;
  one.for_each(5, [&](std::size_t i) { order.push_back(i); });
  CHECK(order == std::vector<std::size_t>{0, 1, 2, 3, 4});
}

TEST_CASE("threads: loops in loops never have more threads than were asked for") {
  for (const unsigned jobs : {1u, 3u}) {
    Threads threads(jobs);
    Crowd crowd;
    std::atomic<int> done{0};
    threads.for_each(6, [&](std::size_t) {
      threads.for_each(50, [&](std::size_t) {
        crowd.enter();
        std::this_thread::yield();
        ++done;
        crowd.leave();
      });
    });
    CHECK(done == 300);
    CHECK(crowd.most() <= static_cast<int>(jobs));
  }
}

TEST_CASE("threads: those that come free help with a loop that has begun") {
  Threads threads(2);
  std::mutex mutex;
  std::set<std::thread::id> inner;
  std::atomic<bool> short_done{false};
  threads.for_each(2, [&](std::size_t outer) {
    if (outer == 1) {
      short_done = true;
      return;
    }
    while (!short_done) std::this_thread::yield();
    std::atomic<bool> helped{false};
    const auto mine = std::this_thread::get_id();
    // Goes on until a second thread has had an item.
    while (!helped)
      threads.for_each(64, [&](std::size_t) {
        const std::lock_guard lock(mutex);
        inner.insert(std::this_thread::get_id());
        if (std::this_thread::get_id() != mine) helped = true;
      });
  });
  CHECK(inner.size() >= 2);
}

TEST_CASE("threads: the exception of the lowest item comes out, and the loop ends") {
  for (const unsigned jobs : {1u, 4u}) {
    Threads threads(jobs);
    std::atomic<int> begun{0};
    std::string said;
    try {
      threads.for_each(100000, [&](std::size_t i) {
        ++begun;
        if (i >= 10) throw std::runtime_error(std::to_string(i));
      });
    } catch (const std::runtime_error& error) {
      said = error.what();
    }
    CHECK(said == "10");
    CHECK(begun < 100000);
    // It can be used again.
    std::atomic<int> after{0};
    threads.for_each(20, [&](std::size_t) { ++after; });
    CHECK(after == 20);
  }
}
