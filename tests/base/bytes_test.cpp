// SPDX-License-Identifier: MIT
// Bytes in memory and in files: parts of parts, files that change while they are open, copies
// between file systems.
#include "base/bytes.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <random>

#include "base/codes.h"
#include "base/files.h"
#include "files_helpers.h"

using namespace rigc;
using rigc::test::TestFolder;

namespace {

/// Bytes without a pattern; above 64 KB a file of them stays open.
std::string noise(std::size_t size) {
  std::mt19937_64 random(size);
  std::string bytes;
  while (bytes.size() < size) bytes += static_cast<char>(random());
  return bytes;
}

std::string text(const Bytes& bytes) {
  Diagnostics diagnostics;
  const auto read = bytes.text(diagnostics);
  REQUIRE(read);
  return *read;
}

Bytes opened(const std::string& path) {
  Diagnostics diagnostics;
  const auto bytes = Bytes::open(path, 1 << 30, diagnostics);
  REQUIRE(bytes);
  return *bytes;
}

int only_error(const Diagnostics& diagnostics) {
  REQUIRE(diagnostics.errors() == 1);
  return diagnostics.all().front().code->number;
}

constexpr std::size_t kBig = 300'000;

}  // namespace

TEST_CASE("base bytes: memory that is kept, and memory that somebody else keeps") {
  CHECK(Bytes().empty());
  CHECK(text(Bytes()) == "");
  const std::string kept = "kept by the caller";
  CHECK(Bytes(kept).memory().data() == kept.data());
  Bytes copy;
  {
    const Bytes owned(noise(100));
    copy = owned.part(10, 50);
  }
  CHECK(text(copy) == noise(100).substr(10, 50));
  const Bytes moved = std::move(copy);
  CHECK(text(moved.part(40)) == noise(100).substr(50, 10));
}

TEST_CASE("base bytes: parts are the same in memory and in files of any size") {
  const TestFolder folder("bytes");
  std::mt19937_64 random(3);
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1}, std::size_t{65536}, std::size_t{65537}, kBig}) {
    const std::string all = noise(size);
    folder.put("a", all);
    const Bytes file = opened(folder / "a");
    CHECK((file.file() != nullptr) == (size > 65536));
    CHECK(text(file) == all);
    for (int i = 0; i < 50; ++i) {
      const std::uint64_t begin = random() % (size + 2), length = random() % (size + 2);
      const std::uint64_t inner = random() % (size + 2);
      const std::string expected = begin > size ? "" : all.substr(begin, length);
      CHECK(text(file.part(begin, length)) == expected);
      CHECK(text(file.part(begin, length).part(inner)) ==
            (inner > expected.size() ? "" : expected.substr(inner)));
    }
  }
}

TEST_CASE("base bytes: what is no file, and what is too large, is not opened") {
  const TestFolder folder("bytes_refused");
  folder.put("a", noise(kBig));
  Diagnostics large, none, special;
  CHECK_FALSE(Bytes::open(folder / "a", kBig - 1, large));
  CHECK(only_error(large) == codes::kFileTooLarge.number);
  CHECK_FALSE(Bytes::open(folder / "b", kBig, none));
  CHECK(only_error(none) == codes::kCannotRead.number);
  CHECK_FALSE(Bytes::open(folder.path(), kBig, special));
  CHECK(only_error(special) == codes::kNotRegularFile.number);
}

TEST_CASE("base bytes: a file that shrinks is an error, one that is replaced is the old one") {
  const TestFolder folder("bytes_changed");
  folder.put("a", noise(kBig));
  const Bytes file = opened(folder / "a");
  std::filesystem::resize_file(folder / "a", kBig / 2);
  Diagnostics diagnostics;
  CHECK_FALSE(file.text(diagnostics));
  CHECK(only_error(diagnostics) == codes::kFileChanged.number);
  CHECK(diagnostics.file_system_refused());

  folder.put("b", noise(kBig));
  const Bytes replaced = opened(folder / "b");
  folder.put("c", noise(kBig + 1));
  std::filesystem::rename(folder / "c", folder / "b");
  CHECK(text(replaced) == noise(kBig));
}

TEST_CASE("base bytes: parts of files are written between other pieces") {
  const TestFolder folder("bytes_written");
  const std::string all = noise(kBig);
  folder.put("a", all);
  const Bytes file = opened(folder / "a");
  Diagnostics diagnostics;
  REQUIRE(write_file(folder / "b", {"head", file.part(7, 100'000), "", file.part(200'000), "tail"},
                     diagnostics));
  CHECK(folder.get("b") == "head" + all.substr(7, 100'000) + all.substr(200'000) + "tail");
  // Over the file that the bytes come from, too.
  REQUIRE(write_file(folder / "a", {file, "more"}, diagnostics));
  CHECK(folder.get("a") == all + "more");
  CHECK(folder.count() == 2);
}

TEST_CASE("base bytes: nothing is written from a file that changed") {
  const TestFolder folder("bytes_unwritten");
  const auto write = [&](auto&& change) {
    folder.put("a", noise(kBig));
    folder.put("b", "old");
    std::filesystem::last_write_time(
        folder / "a", std::filesystem::file_time_type::clock::now() - std::chrono::hours(1));
    const Bytes file = opened(folder / "a");
    change();
    Diagnostics diagnostics;
    CHECK_FALSE(write_file(folder / "b", {"head", file}, diagnostics));
    CHECK(only_error(diagnostics) == codes::kFileChanged.number);
    CHECK(folder.get("b") == "old");
    CHECK(folder.count() == 2);
  };
  write([&] { std::filesystem::resize_file(folder / "a", kBig - 1); });
  write([&] { std::filesystem::resize_file(folder / "a", 0); });
  write([&] { std::ofstream(folder / "a", std::ios::app) << "longer"; });
  write([&] {
    std::fstream in_place(folder / "a", std::ios::in | std::ios::out | std::ios::binary);
    in_place.seekp(kBig / 2);
    in_place << "other bytes";
  });
}

TEST_CASE("base bytes: a file large enough to be sent to the disk while it is written") {
  const TestFolder folder("bytes_large");
  const std::string all = noise(1 << 20);
  folder.put("a", all);
  const Bytes file = opened(folder / "a");
  std::vector<Bytes> pieces;
  for (int i = 0; i < 20; ++i) pieces.insert(pieces.end(), {file, Bytes(all)});
  Diagnostics diagnostics;
  REQUIRE(write_file(folder / "b", pieces, diagnostics));
  const Bytes written = opened(folder / "b");
  REQUIRE(written.size() == 40 * all.size());
  for (std::uint64_t i = 0; i < 40; ++i)
    CHECK(text(written.part(i * all.size(), all.size())) == all);
}

TEST_CASE("base bytes: copies between file systems") {
  const std::string memory = "/dev/shm/rigc_bytes_test_" + std::to_string(::getpid());
  const std::string all = noise(kBig);
  if (!(std::ofstream(memory, std::ios::binary) << all)) {
    MESSAGE("no /dev/shm here");
    return;
  }
  const TestFolder folder("bytes_between");
  const Bytes file = opened(memory);
  Diagnostics diagnostics;
  CHECK(write_file(folder / "a", {file.part(1), file}, diagnostics));
  CHECK(folder.get("a") == all.substr(1) + all);
  std::filesystem::remove(memory);
}
