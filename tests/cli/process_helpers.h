// SPDX-License-Identifier: MIT
// Running the rigc program as its users do, and reading what it printed.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace rigc::test {

struct Outcome {
  int status = -1;             ///< exit status; 128 + signal where a signal ended it
  std::size_t peak_bytes = 0;  ///< most memory that was resident at once
  std::string out;
  std::string err;
};

/// How rigc is started: the folder it stands in, environment variables that are set for it, and
/// what it may use at most; 0: no limit.
struct Surroundings {
  std::filesystem::path folder = ".";
  std::vector<std::pair<std::string, std::string>> environment = {};
  std::size_t address_space = 0;  ///< bytes
  std::size_t cpu_seconds = 0;
};

/// Runs the program of RIGC_BINARY with these arguments and no standard input.
Outcome run_rigc(const std::vector<std::string>& arguments, const Surroundings& surroundings = {});

/// The same for another program by its path.
Outcome run_program(const std::string& binary, const std::vector<std::string>& arguments,
                    const Surroundings& surroundings = {});
/// Path of the program of RIGC_BINARY.
std::string rigc_binary();

/// A diagnostic as it was printed: `line:column RIG0123`, with the file's name and a colon before
/// it where that is not `main_file`, and `-` instead of a place that is no line.
struct Printed {
  bool error = false;
  std::string text;
};
std::vector<Printed> printed_diagnostics(const std::string& err, const std::string& main_file);

/// A new empty folder below the tests' output folder. It stays: .ci/run looks at the rigs in it.
std::filesystem::path fresh_folder(const std::string& name);

std::string file_text(const std::filesystem::path& file);
/// Lines without surrounding blanks; empty ones and those that begin with # are left out.
std::vector<std::string> lines_of(const std::string& text);
std::filesystem::path source_folder();
/// Folder of the corpus, empty where it is not there.
std::filesystem::path corpus_folder();

}  // namespace rigc::test
