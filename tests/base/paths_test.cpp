// SPDX-License-Identifier: MIT
// Tests of paths and folders in src/base/files.h.
#include <doctest/doctest.h>
#include <stdlib.h>

#include "base/files.h"
#include "base/files_helpers.h"

using namespace rigc;
using test::TestFolder;

TEST_CASE("base paths: parts of paths") {
  CHECK(folder_of("a/b.yaml") == "a");
  CHECK(folder_of("b.yaml") == ".");
  CHECK(folder_of("/x") == "/");
  CHECK(folder_of("a//b") == "a");
  CHECK(folder_of("//b") == "/");
  CHECK(join_path("a", "b") == "a/b");
  CHECK(join_path("a/", "b") == "a/b");
  CHECK(join_path(".", "b") == "b");
  CHECK(join_path("", "b") == "b");
  CHECK(join_path("a", "/b") == "/b");
  CHECK(stem_of("a/biped.yaml") == "biped");
  CHECK(stem_of("a.b/c") == "c");
  CHECK(stem_of("x.tar.gz") == "x.tar");
  CHECK(stem_of(".hidden") == ".hidden");
}

TEST_CASE("base paths: what exists") {
  const TestFolder folder("exists");
  folder.put("b", "");
  folder.put("a", "");
  folder.put(".a.rigc-12-3.tmp", "");
  std::filesystem::create_directory(folder / "C");
  CHECK(file_exists(folder / "a"));
  CHECK(!file_exists(folder / "C"));
  CHECK(!file_exists(folder / "none"));
  CHECK(!file_exists(folder / std::string("a\0", 2)));
  CHECK(folder_exists(folder / "C"));
  CHECK(!folder_exists(folder / "a"));
  CHECK(list_folder(folder.path()) == std::vector<std::string>{"C", "a", "b"});
  CHECK(list_folder(folder / "none").empty());
}

TEST_CASE("base paths: confined to a folder") {
  const TestFolder outer("confine");
  std::filesystem::create_directories(outer / "in/sub");
  outer.put("in/a", "");
  outer.put("secret", "");
  outer.put("in2", "");
  std::filesystem::create_symlink("../secret", outer / "in/out");
  std::filesystem::create_symlink("../not_there", outer / "in/dangling");
  std::filesystem::create_symlink("..", outer / "in/up");
  std::filesystem::create_symlink("sub/../a", outer / "in/inner");
  std::filesystem::create_symlink("loop", outer / "in/loop");
  std::filesystem::create_symlink("in", outer / "alias");
  const std::string in = outer / "in", real = std::filesystem::canonical(in).string();
  CHECK(confine(in, "a") == real + "/a");
  CHECK(confine(in, "./sub/../a") == real + "/a");
  CHECK(confine(in, "inner") == real + "/a");
  CHECK(confine(in, "sub/new.bin") == real + "/sub/new.bin");
  CHECK(confine(in, real + "/a") == real + "/a");
  CHECK(confine(outer / "alias", "a") == real + "/a");
  for (const std::string& path :
       {std::string("../secret"), std::string("out"), std::string("dangling"),
        std::string("up/secret"), std::string("/etc/passwd"), std::string("sub/../../in2"),
        std::string("../in2"), std::string("loop"), std::string(), std::string("a\0b", 3),
        std::string("../../../../../..")})
    CHECK_MESSAGE(!confine(in, path), path);
  CHECK(!confine(outer / "none", "a"));
  CHECK(confine("/", "etc") == "/etc");
}

TEST_CASE("base paths: the folders of the program and of its data") {
  CHECK(folder_exists(executable_folder()));
  const char* const before = ::getenv("RIGC_DATA");
  const std::string saved = before ? before : "";
  ::setenv("RIGC_DATA", "/some/where", 1);
  CHECK(data_folder() == "/some/where");
  ::unsetenv("RIGC_DATA");
  const std::string found = data_folder();
  if (file_exists(RIGC_SOURCE_DIR "/templates/biped.yaml"))
    CHECK(folder_exists(found + "/templates"));
  if (before) ::setenv("RIGC_DATA", saved.c_str(), 1);
}

TEST_CASE("base paths: a folder that cannot be listed is an error where that is wanted") {
  const test::TestFolder folder("listing");
  folder.put("b", "");
  folder.put("a", "");
  Diagnostics diagnostics;
  CHECK(list_folder(folder.path(), diagnostics) == std::vector<std::string>{"a", "b"});
  CHECK(diagnostics.ok());
  CHECK(!list_folder(folder / "none", diagnostics));
  CHECK(!list_folder(folder / "a", diagnostics));
  CHECK(diagnostics.errors() == 2);
  CHECK(diagnostics.file_system_refused());
}

TEST_CASE("base paths: equal resolved paths name the same file") {
  const test::TestFolder folder("resolved");
  folder.put("a", "");
  std::filesystem::create_symlink("a", folder / "link");
  std::filesystem::create_symlink("loop", folder / "loop");
  CHECK(resolved_path(folder / "link") == resolved_path(folder / "x/../a"));
  CHECK(resolved_path(folder / "later") != resolved_path(folder / "a"));
  CHECK(!resolved_path(folder / "loop"));
}
