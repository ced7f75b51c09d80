// SPDX-License-Identifier: MIT
// Hostile files: valid models to damage, the damage, and the program that must refuse them. What
// is refused, and where it is said to be wrong, stands in tables in the tests of this folder.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace rigc::test {

/// A valid model with one buffer, before it is damaged. Words in braces stand for what differs
/// from model to model: `/nodes/{joint}/rotation`.
struct Victim {
  std::string name;
  nlohmann::ordered_json json;
  std::string bin;
  std::map<std::string, std::string> words;

  std::string expand(std::string text) const;
  /// Offset in `bin` of an element of an accessor.
  std::size_t offset_of(const std::string& accessor_word, std::size_t element) const;
};

/// Models with a skin and a clip: small ones of the corpus, or where it is absent one of our own.
const std::vector<Victim>& skinned_victims();
/// Every small .glb of the corpus, whatever is in it; the one of our own where it is absent.
const std::vector<Victim>& binary_victims();
/// The one of our own: two joints, a skin, a mesh, a clip.
Victim small_victim();
/// A file that rigc wrote: a rig of the test's own template with a clip on one of its controls.
const Victim& rig_victim();

/// A value that takes the place of another, or is added: any text, JSON or not.
struct Change {
  const char* at;     ///< JSON pointer; "" is the whole text
  const char* value;  ///< null: what is there is taken away
};

struct Damaged {
  std::string json;
  std::size_t value_at = 0;  ///< where the last change's value begins in the JSON
};
Damaged damaged(const Victim& victim, const std::vector<Change>& changes);

std::string glb(std::string json, std::string bin);
std::string gltf(const Victim& victim);
void write_file(const std::filesystem::path& path, const std::string& bytes);
std::string repeated(const std::string& text, std::size_t count);
std::string floats(const std::vector<float>& values);

/// What rigc is asked to do with the file.
enum class Ask { inspect, check, build, bake, query };

/// What it must say: `place` is what stands between the file's name and the code.
struct Answer {
  int code;
  std::string place;
  int status = 1;
  bool accepted = false;  ///< status 0 and an output instead
};

/// An empty folder for damaged files of one test.
std::filesystem::path broken_folder(const std::string& name);

/// Runs rigc on a file with little memory and time, and checks its answer: exit status, the first
/// diagnostic, no crash, nothing written.
void expect(Ask ask, const std::filesystem::path& file, const Answer& answer);

/// One row of a table of damages.
struct Row {
  const char* name;
  Change change;
  int code;
  const char* place = "";  ///< "": where the change is; "@5": 5 bytes behind the value's begin
  Ask ask = Ask::inspect;
};
/// Damages the victim, writes it as a .glb and expects the row's answer.
void expect(const Row& row, const Victim& victim, const std::filesystem::path& folder);
/// Every row, each with another of the skinned victims.
void expect(const std::vector<Row>& rows, const std::string& folder);

}  // namespace rigc::test
