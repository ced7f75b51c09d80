// SPDX-License-Identifier: MIT
// Law 1 for evaluation: the same bits whatever the lane, the block, the instruction set, the
// compiler and the machine. Digests of all joints of shipped templates over thousands of frames are
// compared with those of expected_digests.txt, which `RIGC_WRITE_DIGESTS=1 motion_tests` writes
// anew.
#include <doctest/doctest.h>

#include <bit>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "motion/moving_helpers.h"
#include "tests/math/random.h"

namespace rigc {
namespace {

using test::Keyable;
using test::Moving;

const char* const kTemplates[] = {"biped.yaml", "biped_tail.yaml", "hand.yaml",
                                  "prop.yaml",  "quadruped.yaml",  "winged.yaml"};
constexpr std::size_t kFrames = 2000;
const std::string kExpected = std::string(RIGC_SOURCE_DIR) + "/tests/motion/expected_digests.txt";

// Random keys for every frame: near rest, anywhere, and at the corners (no scale, half turns, goals
// on their roots).
void random_key(const Keyable& keyable, std::size_t index, std::size_t frame,
                std::vector<double>& numbers) {
  test::Random random(index * 1000003 + frame);
  for (int i = 0; i < 3; ++i) random.bits();
  const bool far = random.chance(30);
  if (keyable.what == Keyable::What::rotation) {
    const math::Quat q = far ? random.rotation() : math::from_euler_degrees(random.vector(40));
    numbers = random.chance(3) ? std::vector<double>{1, 0, 0, 0}
                               : std::vector<double>{q.x, q.y, q.z, q.w};
  } else if (keyable.what == Keyable::What::number) {
    numbers[0] = keyable.low + (keyable.high - keyable.low) * random.between(0, 1);
    if (random.chance(20)) numbers[0] = random.chance(50) ? keyable.low : keyable.high;
  } else {
    const bool scale = keyable.what == Keyable::What::scale;
    const math::Vec3 by = random.vector(far ? 1 : 0.1);
    const math::Vec3 v = math::Vec3{numbers[0], numbers[1], numbers[2]} + by;
    numbers = random.chance(scale ? 1 : 3) ? std::vector<double>{0, 0, 0}
                                           : std::vector<double>{v.x, v.y, v.z};
  }
}

using Worlds = std::vector<std::vector<double>>;

Worlds worlds_of(const Moving& rig, std::size_t shift = 0) {
  return rig.worlds(
      kFrames,
      [&](std::size_t index, std::size_t frame, std::vector<double>& numbers) {
        random_key(rig.keyables()[index], index, frame, numbers);
      },
      shift);
}

// FNV-1a over the bits of all numbers.
std::uint64_t digest_of(const Worlds& worlds) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const auto& frame : worlds) {
    for (const double number : frame) {
      const auto bits = std::bit_cast<std::uint64_t>(number);
      for (int byte = 0; byte < 8; ++byte) {
        hash ^= (bits >> (8 * byte)) & 0xff;
        hash *= 0x100000001b3u;
      }
    }
  }
  return hash;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
  return true;
}

bool same_bits(const Worlds& a, const Worlds& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t f = 0; f < a.size(); ++f)
    if (!same_bits(a[f], b[f])) return false;
  return true;
}

std::map<std::string, std::string> expected() {
  std::ifstream file(kExpected);
  REQUIRE_MESSAGE(file, kExpected);
  std::map<std::string, std::string> digests;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string name, digest;
    if (line.empty() || line[0] == '#') continue;
    words >> name >> digest;
    digests[name] = digest;
  }
  return digests;
}

TEST_CASE("motion digests: those of every compiler, instruction set and machine") {
  std::ostringstream written;
  written << "# Digests of all joints' worlds over " << kFrames
          << " frames of random keys (tests/motion/digest_test.cpp).\n";
  const bool write = std::getenv("RIGC_WRITE_DIGESTS") != nullptr;
  const auto wanted = write ? std::map<std::string, std::string>{} : expected();
  for (const char* file : kTemplates) {
    const Worlds worlds = worlds_of(Moving(file));
    for (const auto& frame : worlds)
      for (const double number : frame) REQUIRE(std::isfinite(number));
    char digest[17];
    std::snprintf(digest, sizeof digest, "%016llx",
                  static_cast<unsigned long long>(digest_of(worlds)));
    written << file << " " << digest << "\n";
    const auto found = wanted.find(file);
    CAPTURE(std::string(file));
    if (!write) CHECK((found == wanted.end() ? "none" : found->second) == digest);
  }
  if (write) std::ofstream(kExpected) << written.str();
}

TEST_CASE("motion digests: the same in every lane and block") {
  for (const char* file : kTemplates) {
    const Moving rig(file);
    const Worlds plain = worlds_of(rig);
    for (std::size_t shift = 1; shift < static_cast<std::size_t>(eval::kLanes); ++shift) {
      CAPTURE(std::string(file));
      CAPTURE(shift);
      CHECK(same_bits(worlds_of(rig, shift), plain));
    }
  }
}

// Frames in any order: each finds other frames in its block and other values left in registers.
TEST_CASE("motion digests: the same whatever was evaluated before and beside") {
  for (const char* file : kTemplates) {
    const Moving rig(file);
    const Worlds plain = worlds_of(rig);
    const std::size_t stride = 1009;  // a prime: every frame once
    const Worlds shuffled =
        rig.worlds(kFrames, [&](std::size_t index, std::size_t frame, std::vector<double>& n) {
          random_key(rig.keyables()[index], index, frame * stride % kFrames, n);
        });
    std::size_t different = 0;
    for (std::size_t f = 0; f < kFrames; ++f)
      different += !same_bits(shuffled[f], plain[f * stride % kFrames]);
    CHECK_MESSAGE(different == 0, file, ": ", different);
  }
}

}  // namespace
}  // namespace rigc
