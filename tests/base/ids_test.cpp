// SPDX-License-Identifier: MIT
// Tests of src/base/ids.h: fixed hash values, text forms that read back.
#include "base/ids.h"

#include <doctest/doctest.h>

#include <random>

using namespace rigc;

TEST_CASE("base ids: the hash is XXH3-64 with seed 0 and never changes") {
  CHECK(hash64("") == 0x2d06800538d394c2u);
  CHECK(hex16(hash64("biped/hips")) == "d90efa4d0b164e26");
  CHECK(hex16(hash64(std::string(1000, 'x'))) == "c0a4877b962cba82");
}

TEST_CASE("base ids: hex digits") {
  CHECK(hex16(0) == "0000000000000000");
  CHECK(hex16(0x0123456789abcdefu) == "0123456789abcdef");
  CHECK(parse_hex16("0123456789ABCDEF") == 0x0123456789abcdefu);
  for (const char* bad : {"", "0", "0123456789abcde", "0123456789abcdef0", "-123456789abcdef",
                          "+123456789abcdef", "0x23456789abcdef", "0123456789abcdeg"})
    CHECK_MESSAGE(!parse_hex16(bad), bad);
}

TEST_CASE("base ids: joint keys") {
  CHECK(to_text(JointKey{0xabc, 0}) == "0000000000000abc");
  CHECK(to_text(JointKey{0xabc, 2}) == "0000000000000abc+2");
  CHECK(parse_joint_key("0000000000000abc+2") == JointKey{0xabc, 2});
  for (const char* bad :
       {"0000000000000abc+", "0000000000000abc+0", "0000000000000abc+02", "abc",
        "0000000000000abc 2", "0000000000000abc+-2", "0000000000000abc+4294967296"})
    CHECK_MESSAGE(!parse_joint_key(bad), bad);
}

TEST_CASE("base ids: identities read back as they were") {
  std::mt19937_64 random(7);
  const char* words[] = {"", "fk", "ik_fk_limb", "main-2"};
  for (int i = 0; i < 2000; ++i) {
    const auto key = [&] {
      const std::uint64_t uid = random() % 3 == 0 ? 0 : random();
      return JointKey{uid, static_cast<std::uint32_t>(random() % 3)};
    };
    Identity identity;
    identity.rig = static_cast<std::uint32_t>(random());
    identity.owner = key();
    identity.holder = key();
    identity.command = words[random() % 4];
    identity.role = words[random() % 4];
    identity.counter = static_cast<std::uint32_t>(random() % 3);
    CHECK(parse_identity(to_text(identity)) == identity);
  }
  CHECK(to_text(Identity{3, {0xa, 0}, {}, "", "", 0}) == "3:000000000000000a");
  CHECK(to_text(Identity{3, {0xa, 1}, {0xb, 0}, "ik", "pole", 2}) ==
        "3:000000000000000a+1:000000000000000b:ik:pole:2");
}

TEST_CASE("base ids: texts that are no identity") {
  for (const char* bad :
       {"", ":", "1", "1:", "x:000000000000000a", "01:000000000000000a", "-1:000000000000000a",
        "1:000000000000000A", "1:000000000000000a:", "1:000000000000000a:000000000000000b:c:r",
        "1:000000000000000a:000000000000000b:c:r:", "1:000000000000000a:000000000000000b:c:r:00",
        "1:000000000000000a:000000000000000b:c:r:0:1",
        "1:000000000000000a:000000000000000b:\xff:r:0", "1:000000000000000a:0000000000000000:::0"})
    CHECK_MESSAGE(!parse_identity(bad), bad);
}
