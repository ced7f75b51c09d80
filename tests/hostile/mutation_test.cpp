// SPDX-License-Identifier: MIT
// Law 9 on random damage: a file is refused with a diagnostic, or what is read of it can carry a
// rig, and taking that out again gives the same bytes. Never a crash.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

#include "gltf/clips.h"
#include "gltf/rig.h"
#include "gltf/skeletons.h"
#include "hostile/hostile_helpers.h"
#include "pipeline/bake_file.h"
#include "pipeline/build.h"

using namespace rigc;
using namespace rigc::test;

namespace {

/// How many files each test damages; RIGC_MUTATIONS says otherwise for long runs.
std::size_t rounds(std::size_t usual) {
  const char* wish = std::getenv("RIGC_MUTATIONS");
  return wish ? std::strtoul(wish, nullptr, 10) : usual;
}

class Damage {
 public:
  explicit Damage(std::uint64_t seed) : random_(seed) {}

  /// A few changes of the text and of the bytes.
  std::string apply(std::string json, std::string bin) {
    const std::size_t changes = below(4) == 0 ? 2 + below(3) : 1;
    for (std::size_t i = 0; i < changes; ++i) change_text(json);
    if (below(4) == 0 && !bin.empty()) bin[below(bin.size())] = static_cast<char>(below(256));
    std::string whole = glb(json, bin);
    if (below(8) == 0) change_container(whole);
    return whole;
  }

  std::size_t below(std::size_t end) { return static_cast<std::size_t>(random_() % end); }

 private:
  void change_text(std::string& text) {
    switch (below(10)) {
      case 0:
        text[below(text.size())] = static_cast<char>(below(256));
        return;
      case 1:
      case 2:
        return swap_values(text);
      case 3: {
        const std::size_t at = below(text.size());
        const std::size_t length = below(20);
        text.erase(at, length);
        return;
      }
      default:
        return replace_value(text);
    }
  }

  /// The next value behind a random place: a scalar, or one level of a list or object.
  std::pair<std::size_t, std::size_t> value_in(const std::string& text) {
    const std::size_t begin = text.find_first_of(":,[", below(text.size())) + 1;
    if (begin == 0 || begin == text.size()) return {0, 0};
    const char first = text[begin];
    std::size_t end = begin + 1;
    if (first == '"')
      end = text.find('"', end);
    else if (first == '[' || first == '{')
      end = text.find(first == '[' ? ']' : '}', end);
    else
      return {begin, std::min(text.find_first_of(",]} :", end), text.size()) - begin};
    return {begin, std::min(end, text.size() - 1) + 1 - begin};
  }

  void replace_value(std::string& text) {
    static const char* const values[] = {"0",
                                         "1",
                                         "-1",
                                         "2",
                                         "3",
                                         "7",
                                         "1e30",
                                         "1e-320",
                                         "0.5",
                                         "null",
                                         "true",
                                         "[]",
                                         "{}",
                                         "\"\"",
                                         "[0]",
                                         "1e999",
                                         "4294967296",
                                         "-0",
                                         "65536",
                                         "5126",
                                         "9007199254740992",
                                         "\"VEC3\"",
                                         "\"rotation\"",
                                         "\"pointer\"",
                                         "[0,0,0]",
                                         "[0,0,0,0]",
                                         "\"\\u0000\"",
                                         "[1e300,0,0]"};
    const auto [begin, length] = value_in(text);
    text.replace(begin, length, values[below(std::size(values))]);
  }

  void swap_values(std::string& text) {
    auto a = value_in(text);
    auto b = value_in(text);
    if (a.first > b.first) std::swap(a, b);
    if (a.first + a.second > b.first) return;
    const std::string first = text.substr(a.first, a.second);
    const std::string second = text.substr(b.first, b.second);
    text.replace(b.first, b.second, first);
    text.replace(a.first, a.second, second);
  }

  void change_container(std::string& whole) {
    const std::size_t json = static_cast<unsigned char>(whole[12]) |
                             static_cast<std::size_t>(static_cast<unsigned char>(whole[13])) << 8 |
                             static_cast<std::size_t>(static_cast<unsigned char>(whole[14])) << 16;
    switch (below(4)) {
      case 0:
        whole.resize(below(whole.size()));
        return;
      case 1:  // chunks in the other order
        whole = whole.substr(0, 12) + whole.substr(20 + json) + whole.substr(12, 8 + json);
        return;
      case 2:
        whole[below(20)] = static_cast<char>(below(256));
        return;
      default:
        whole[20 + json + below(8)] = static_cast<char>(below(256));
    }
  }

  std::mt19937_64 random_;
};

std::string bytes_of(const gltf::Output& output) {
  Diagnostics none;
  std::string bytes;
  for (const Bytes& piece : output.pieces) bytes += piece.text(none).value_or("");
  return bytes;
}

/// A file that was read, and that its readers agree about: no result where an error was reported.
std::optional<gltf::File> read_all(const std::string& path, const std::string& bytes) {
  Diagnostics diagnostics;
  auto file = gltf::open(path, Bytes(std::string(bytes)), diagnostics);
  CHECK(file.has_value() == diagnostics.ok());
  if (!file) return std::nullopt;
  const auto clips = gltf::read_clips(*file, diagnostics);
  CHECK(clips.has_value() == diagnostics.ok());
  Diagnostics of_rigs, of_skeletons, of_posed;
  const auto rigs = gltf::read_rigs(*file, of_rigs);
  CHECK(rigs.has_value() == of_rigs.ok());
  for (const char* rest : {"bind", "nodes"}) {
    Diagnostics of_rest;
    const auto skeletons = gltf::read_skeletons(*file, rest, of_rest);
    CHECK(skeletons.has_value() == of_rest.ok());
  }
  if (!clips || !rigs) return std::nullopt;
  for (const gltf::Rig& rig : *rigs) pipeline::check_evaluates(*file, rig, of_rigs);
  return file;
}

const gltf::Rig& sample_rig() {
  static const gltf::Rig rig = [] {
    Diagnostics diagnostics;
    const Victim& victim = rig_victim();
    const auto file =
        gltf::open("rig.glb", Bytes(glb(victim.json.dump(), victim.bin)), diagnostics);
    REQUIRE(file);
    auto rigs = gltf::read_rigs(*file, diagnostics);
    REQUIRE(rigs);
    gltf::Rig sample = std::move(rigs->front());
    sample.id = 1000;
    return sample;
  }();
  return rig;
}

/// Writes a rig into a file and takes it out again.
void round_trip(const gltf::File& file, const std::string& bytes) {
  Diagnostics diagnostics;
  gltf::Patch patch(file);
  gltf::Rig rig = sample_rig();
  if (!gltf::write_rig(patch, rig, -1, diagnostics)) {
    CHECK_FALSE(diagnostics.ok());
    return;
  }
  const auto written = patch.finish(true, diagnostics);
  REQUIRE(written);
  const std::filesystem::path folder = std::filesystem::path(file.path).parent_path();
  for (const gltf::ExtraFile& extra : written->extra_files)
    write_file(folder / extra.name, extra.bytes.text(diagnostics).value_or(""));
  const auto again = gltf::open(file.path, Bytes(bytes_of(*written)), diagnostics);
  CHECK_MESSAGE(again, render(diagnostics, false));
  const auto rigs = again ? gltf::read_rigs(*again, diagnostics) : std::nullopt;
  CHECK_MESSAGE(rigs, render(diagnostics, false));
  if (!rigs) return;
  gltf::Patch strip(*again);
  CHECK(rigs->back().id == rig.id);
  gltf::strip_rig(strip, *again, rigs->back(), gltf::Strip::nothing);
  const auto stripped = strip.finish(true, diagnostics);
  REQUIRE(stripped);
  CHECK(bytes_of(*stripped) == bytes);
}

}  // namespace

TEST_CASE("hostile mutation: damaged models are refused or can carry a rig") {
  const auto& victims = binary_victims();
  const auto folder = broken_folder("mutated_models");
  const std::size_t count = rounds(600);
  std::size_t read = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Victim& victim = victims[i % victims.size()];
    const std::string bytes = Damage(i).apply(victim.json.dump(), victim.bin);
    INFO(victim.name << ", seed " << i);
    const auto file = read_all((folder / (victim.name + ".glb")).string(), bytes);
    if (!file || !file->binary) continue;
    ++read;
    if (i % 4 == 0) round_trip(*file, bytes);
  }
  CHECK(read > count / 50);
  CHECK(read < count - count / 50);
}

TEST_CASE("hostile mutation: damaged rigs are refused or bake") {
  const Victim& victim = rig_victim();
  const auto folder = broken_folder("mutated_rigs");
  const std::string json = victim.json.dump();
  const std::size_t count = rounds(400);
  std::size_t baked = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string bytes = Damage(1'000'000 + i).apply(json, victim.bin);
    INFO("seed " << i);
    if (!read_all("rig.glb", bytes)) continue;
    pipeline::BakeRequest request;
    request.file = (folder / "mutated.glb").string();
    write_file(request.file, bytes);
    Diagnostics diagnostics;
    const auto result = pipeline::bake_file(request, (folder / "out.glb").string(), diagnostics);
    CHECK(result.has_value() == diagnostics.ok());
    baked += result ? 1 : 0;
  }
  CHECK(baked > count / 50);
  CHECK(baked < count - count / 50);
}
