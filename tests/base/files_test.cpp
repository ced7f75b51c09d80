// SPDX-License-Identifier: MIT
// Tests of reading and locking in src/base/files.h.
#include "base/files.h"

#include <doctest/doctest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "base/codes.h"
#include "base/files_helpers.h"

using namespace rigc;
using test::TestFolder;

namespace {

/// The code of the error that reading gives, 0 for none.
int read_code(const std::string& path, std::uint64_t limit = 1000) {
  Diagnostics diagnostics;
  const auto text = read_file(path, limit, diagnostics);
  CHECK(text.has_value() == diagnostics.ok());
  return diagnostics.ok() ? 0 : diagnostics.all()[0].code->number;
}

}  // namespace

TEST_CASE("base files: reads what is there") {
  const TestFolder folder("read");
  const std::string text("a\0b\r\n\xff", 6);
  folder.put("a", text);
  folder.put("empty", "");
  Diagnostics diagnostics;
  CHECK(read_file(folder / "a", 100, diagnostics) == text);
  CHECK(read_file(folder / "a", 6, diagnostics) == text);
  CHECK(read_file(folder / "empty", 0, diagnostics) == "");
  folder.put("big", std::string(3'000'000, 'x'));
  CHECK(read_file(folder / "big", 4'000'000, diagnostics)->size() == 3'000'000);
  CHECK(read_file("/proc/self/status", 1'000'000, diagnostics)->size() > 100);
  CHECK(diagnostics.ok());
}

TEST_CASE("base files: limits hold even where the size is unknown") {
  const TestFolder folder("limit");
  folder.put("a", "123456");
  CHECK(read_code(folder / "a", 5) == codes::kFileTooLarge.number);
  CHECK(read_code("/proc/self/status", 10) == codes::kFileTooLarge.number);
  std::filesystem::resize_file(folder / "a", std::uintmax_t{1} << 40);
  CHECK(read_code(folder / "a", 1'000'000) == codes::kFileTooLarge.number);
}

TEST_CASE("base files: only regular files are read, and nothing blocks") {
  const TestFolder folder("special");
  CHECK(read_code(folder.path()) == codes::kNotRegularFile.number);
  CHECK(read_code("/dev/null") == codes::kNotRegularFile.number);
  CHECK(read_code("/dev/zero") == codes::kNotRegularFile.number);
  REQUIRE(::mkfifo((folder / "fifo").c_str(), 0600) == 0);
  CHECK(read_code(folder / "fifo") == codes::kNotRegularFile.number);
  std::filesystem::create_symlink("fifo", folder / "to_fifo");
  CHECK(read_code(folder / "to_fifo") == codes::kNotRegularFile.number);
}

TEST_CASE("base files: a socket is not read") {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string path = "/tmp/rigc_base_test_socket_" + std::to_string(::getpid());
  path.copy(address.sun_path, sizeof address.sun_path - 1);
  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  REQUIRE(::bind(socket, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0);
  CHECK(read_code(path) == codes::kNotRegularFile.number);
  ::close(socket);
  ::unlink(path.c_str());
}

TEST_CASE("base files: paths that lead nowhere") {
  const TestFolder folder("nowhere");
  std::filesystem::create_symlink("loop", folder / "loop");
  folder.put("a", "x");
  for (const std::string& path :
       {folder / "none", folder / "loop", folder / "a/b", std::string(), std::string(5000, 'a'),
        folder / "a" + std::string(1, '\0') + "b"})
    CHECK(read_code(path) == codes::kCannotRead.number);
  Diagnostics diagnostics;
  CHECK(!read_file(folder / "none", 10, diagnostics));
  CHECK(diagnostics.file_system_refused());
  CHECK(diagnostics.all()[0].message == "cannot read: No such file or directory");
}

TEST_CASE("base files: a lock keeps others out until it is given back") {
  const TestFolder folder("lock");
  folder.put("a", "x");
  Diagnostics diagnostics;
  {
    const auto lock = FileLock::take(folder / "a", diagnostics, 0);
    REQUIRE(lock);
    Diagnostics other;
    CHECK(!FileLock::take(folder / "a", other, 30));
    REQUIRE(other.errors() == 1);
    CHECK(other.all()[0].code->number == codes::kFileLocked.number);
    CHECK(other.file_system_refused());
  }
  CHECK(FileLock::take(folder / "a", diagnostics, 0));
  CHECK(FileLock::take(folder / "not_there_yet", diagnostics, 0));
  CHECK(diagnostics.ok());
  CHECK(!FileLock::take(folder.path(), diagnostics, 0));
}

TEST_CASE("base files: no change is lost when many replace one file under its lock") {
  const TestFolder folder("many");
  folder.put("a", "0");
  std::atomic<int> failures{0};
  const auto work = [&] {
    for (int i = 0; i < 20; ++i) {
      Diagnostics diagnostics;
      const auto lock = FileLock::take(folder / "a", diagnostics, 60'000);
      const auto text = read_file(folder / "a", 100, diagnostics);
      if (!text || !write_file(folder / "a", {std::to_string(std::stoi(*text) + 1)}, diagnostics))
        ++failures;
    }
  };
  std::thread one(work), two(work), three(work);
  one.join();
  two.join();
  three.join();
  CHECK(failures == 0);
  CHECK(folder.get("a") == "60");
  CHECK(folder.count() == 1);
}
