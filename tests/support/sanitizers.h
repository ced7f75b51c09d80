// SPDX-License-Identifier: MIT
// Which sanitizers a test is compiled with. Test: tests/hostile, tests/capi, which use it
#pragma once

// gcc says so by macros, clang by features.
#ifdef __has_feature
#define RIGC_HAS_FEATURE(feature) __has_feature(feature)
#else
#define RIGC_HAS_FEATURE(feature) 0
#endif

#if defined(__SANITIZE_ADDRESS__) || RIGC_HAS_FEATURE(address_sanitizer)
#define RIGC_HAS_ADDRESS_SANITIZER 1
#else
#define RIGC_HAS_ADDRESS_SANITIZER 0
#endif

#if defined(__SANITIZE_THREAD__) || RIGC_HAS_FEATURE(thread_sanitizer)
#define RIGC_HAS_THREAD_SANITIZER 1
#else
#define RIGC_HAS_THREAD_SANITIZER 0
#endif
