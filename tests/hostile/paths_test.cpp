// SPDX-License-Identifier: MIT
// URIs of buffers that leave the model's folder or name something that is no file, and models that
// are none.
#include <doctest/doctest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "hostile/hostile_helpers.h"

using namespace rigc::test;
namespace fs = std::filesystem;

namespace {

void make_socket(const fs::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  // The path of a socket has at most 108 bytes.
  const fs::path before = fs::current_path();
  fs::current_path(path.parent_path());
  path.filename().string().copy(address.sun_path, sizeof address.sun_path - 1);
  const int descriptor = ::socket(AF_UNIX, SOCK_STREAM, 0);
  REQUIRE(descriptor >= 0);
  const int bound = ::bind(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof address);
  ::close(descriptor);
  fs::current_path(before);
  REQUIRE(bound == 0);
}

/// A folder with one of everything that is no file, and a file beside it that nobody may read.
fs::path folder_of_traps(const std::string& name) {
  const fs::path outside = broken_folder(name);
  const fs::path folder = outside / "model";
  fs::create_directories(folder / "folder");
  write_file(outside / "outside.bin", repeated("outside.", 100'000));
  write_file(folder / "short.bin", "1234");
  fs::create_symlink("../outside.bin", folder / "link_out.bin");
  fs::create_symlink("/dev/zero", folder / "device.bin");
  fs::create_symlink("loop_b.bin", folder / "loop_a.bin");
  fs::create_symlink("loop_a.bin", folder / "loop_b.bin");
  fs::create_directory_symlink("..", folder / "up");
  REQUIRE(::mkfifo((folder / "fifo.bin").c_str(), 0600) == 0);
  make_socket(folder / "socket.bin");
  return folder;
}

}  // namespace

TEST_CASE("hostile paths: URIs of buffers") {
  struct Row {
    const char* name;
    std::string uri;  ///< JSON text
    int code;
    int status = 1;
    const char* place = "#/buffers/0";
  };
  const std::string long_name = '"' + repeated("a", 100'000) + '"';
  const std::string many_steps = '"' + repeated("../", 5'000) + "etc/passwd\"";
  const Row rows[] = {
      {"up", R"("../outside.bin")", 666},
      {"up_encoded", R"("%2e%2e/outside.bin")", 666},
      {"up_slash_encoded", R"("..%2Foutside.bin")", 666},
      {"up_behind_folder", R"("folder/../../outside.bin")", 666},
      {"up_escaped_in_json", R"("\u002e\u002e\/outside.bin")", 666},
      {"up_by_link", R"("up/outside.bin")", 666},
      {"many_steps_up", many_steps, 666},
      {"link_out", R"("link_out.bin")", 666},
      {"device", R"("device.bin")", 666},
      {"loop", R"("loop_a.bin")", 666},
      {"long_name", long_name, 666},
      {"absolute", R"("/etc/passwd")", 665},
      {"absolute_device", R"("/dev/zero")", 665},
      {"host", R"("//host/share/outside.bin")", 665},
      {"file_scheme", R"("file:///etc/passwd")", 665},
      {"http_scheme", R"("http://localhost/outside.bin")", 665},
      {"windows_drive", R"("C:\\outside.bin")", 665},
      {"backslash_root", R"("\\\\host\\outside.bin")", 665},
      {"empty", R"("")", 665},
      {"percent_alone", R"("%")", 665},
      {"percent_no_hex", R"("%zz.bin")", 665},
      {"zero_byte", R"("short.bin%00.png")", 665},
      {"zero_byte_in_json", R"("short.bin\u0000.png")", 665},
      {"number", "7", 655, 1, "#/buffers/0/uri"},
      {"null", "null", 655, 1, "#/buffers/0/uri"},
      {"folder", R"("folder")", 694},
      {"own_folder", R"(".")", 694},
      {"fifo", R"("fifo.bin")", 694},
      {"socket", R"("socket.bin")", 694},
      {"missing", R"("missing.bin")", 1, 3},
      {"below_a_file", R"("short.bin/outside.bin")", 1, 3},
      {"short", R"("short.bin")", 667},
      {"data_without_comma", R"("data:application/octet-stream;base64")", 665},
      {"data_bad_base64", R"("data:application/octet-stream;base64,AA$A")", 665},
      {"data_cut_base64", R"("data:application/octet-stream;base64,AAAAA")", 665},
      {"data_padding_inside", R"("data:application/octet-stream;base64,AA==AAAA")", 665},
      {"data_stray_bits", R"("data:application/octet-stream;base64,AB==")", 665},
      {"data_short", R"("data:application/octet-stream;base64,AAAA")", 667},
      {"data_bad_percent", R"("data:,%4")", 665},
      {"data_empty", R"("data:,")", 667},
  };
  const fs::path folder = folder_of_traps("uris");
  const auto& victims = skinned_victims();
  std::size_t next = 0;
  for (const Row& row : rows) {
    const Victim& victim = victims[next++ % victims.size()];
    const fs::path file = folder / (std::string(row.name) + ".gltf");
    write_file(file, damaged(victim, {{"/buffers/0/uri", row.uri.c_str()}}).json);
    expect(next % 2 != 0 ? Ask::inspect : Ask::build, file, {row.code, row.place, row.status});
  }
  // The same in a .glb, whose other buffers are files.
  Victim victim = victims[0];
  victim.json["buffers"].push_back({{"byteLength", 4}, {"uri", "../outside.bin"}});
  write_file(folder / "second_buffer.glb", glb(victim.json.dump(), victim.bin));
  expect(Ask::inspect, folder / "second_buffer.glb", {666, "#/buffers/1"});
}

TEST_CASE("hostile paths: what is given as a model is no file") {
  const fs::path folder = folder_of_traps("models");
  for (const Ask ask : {Ask::inspect, Ask::build, Ask::bake, Ask::query}) {
    expect(ask, folder / "folder", {2, "", 3});
    expect(ask, folder / "fifo.bin", {2, "", 3});
    expect(ask, folder / "socket.bin", {2, "", 3});
    expect(ask, folder / "device.bin", {2, "", 3});
    expect(ask, folder / "loop_a.bin", {1, "", 3});
    expect(ask, folder / "missing.glb", {1, "", 3});
  }
}
