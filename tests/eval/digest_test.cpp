// SPDX-License-Identifier: MIT
// Law 1 for kernels: the same bits on every machine. Digests of what each kernel of the table gives
// for thousands of random and hostile registers are compared with those of expected_digests.txt,
// which every compiler and every instruction set must give; `RIGC_WRITE_DIGESTS=1 eval_tests`
// writes it anew.
#include <doctest/doctest.h>

#include <bit>
#include <cstdlib>
#include <fstream>
#include <map>

#include "tests/eval/wild.h"

namespace rigc {
namespace {

using eval::Op;
using test::Arguments;
using test::Job;
using test::Numbers;
using test::Size;

const std::string kExpected = std::string(RIGC_SOURCE_DIR) + "/tests/eval/expected_digests.txt";

constexpr std::uint64_t kFnvStart = 0xcbf29ce484222325u, kFnvPrime = 0x100000001b3u;

// By the kernel's name: another place in the table changes no digest.
std::uint64_t seed_of(Op op) {
  std::uint64_t hash = kFnvStart;
  for (const char c : eval::row(op).name) hash = (hash ^ static_cast<unsigned char>(c)) * kFnvPrime;
  return hash;
}

// FNV-1a over the bits of all results.
std::uint64_t digest_of(Op op) {
  std::uint64_t hash = kFnvStart;
  for (const Size size : {Size::sane, Size::in_range}) {
    test::Random random(seed_of(op) + static_cast<std::uint64_t>(size));
    test::Wild wild(random, size);
    for (int i = 0; i < 500; ++i) {
      const Job job = test::job_of(op, wild);
      std::vector<Arguments> lanes;
      for (int lane = 0; lane < eval::kLanes; ++lane) lanes.push_back(wild.arguments(job));
      for (const Numbers& numbers : test::run_kernel(op, lanes, job.data, job.width)) {
        for (const double number : numbers) {
          const auto bits = std::bit_cast<std::uint64_t>(number);
          for (int byte = 0; byte < 8; ++byte) {
            hash ^= (bits >> (8 * byte)) & 0xff;
            hash *= kFnvPrime;
          }
        }
      }
    }
  }
  return hash;
}

TEST_CASE("eval digests: every kernel's bits are those of every compiler and instruction set") {
  const bool write = std::getenv("RIGC_WRITE_DIGESTS") != nullptr;
  std::map<std::string, std::string> wanted, got;
  test::for_every_op([&](Op op) {
    char digest[17];
    std::snprintf(digest, sizeof digest, "%016llx", static_cast<unsigned long long>(digest_of(op)));
    got[std::string(eval::row(op).name)] = digest;
  });
  if (write) {
    std::ofstream file(kExpected);
    file << "Digests of each kernel's results (tests/eval/digest_test.cpp).\n";
    for (const auto& [name, digest] : got) file << name << " " << digest << "\n";
    return;
  }
  std::ifstream file(kExpected);
  REQUIRE_MESSAGE(file, kExpected);
  std::string heading, name, digest;
  std::getline(file, heading);
  while (file >> name >> digest) wanted[name] = digest;
  for (const auto& one : got)
    CHECK_MESSAGE(wanted[one.first] == one.second, one.first, " gives ", one.second);
  CHECK(wanted.size() == got.size());
}

}  // namespace
}  // namespace rigc
