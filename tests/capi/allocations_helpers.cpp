// SPDX-License-Identifier: MIT
// Counts calls of malloc and its like: in place of the C library's, or through the hook that the
// sanitizers' allocators have.
#include <errno.h>

#include <atomic>
#include <cstddef>

#include "capi/capi_helpers.h"
#include "support/sanitizers.h"

namespace {

std::atomic<bool> counting{false};
std::atomic<std::size_t> counted{0};

void count_one() {
  if (counting.load(std::memory_order_relaxed)) counted.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace

#if RIGC_HAS_ADDRESS_SANITIZER || RIGC_HAS_THREAD_SANITIZER
#include <sanitizer/allocator_interface.h>

namespace {
void on_malloc(const volatile void*, std::size_t) { count_one(); }
void on_free(const volatile void*) {}
const int installed = __sanitizer_install_malloc_and_free_hooks(on_malloc, on_free);
}  // namespace
#else
namespace {
constexpr int installed = 1;
}  // namespace

extern "C" {

void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  count_one();
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  count_one();
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  count_one();
  return __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  count_one();
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** to, std::size_t alignment, std::size_t size) {
  count_one();
  *to = __libc_memalign(alignment, size);
  return *to ? 0 : ENOMEM;
}

}  // extern "C"
#endif

namespace rigc::capi::test {

Allocations::Allocations() {
  counted = installed > 0 ? 0 : 1'000'000;  // a hook that is not there must not pass for none
  counting = true;
}
Allocations::~Allocations() { counting = false; }
std::size_t Allocations::count() const { return counted; }

}  // namespace rigc::capi::test
