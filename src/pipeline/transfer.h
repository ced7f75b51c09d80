// SPDX-License-Identifier: MIT
// Transfer a file: clips on joints become clips on the controls of its rigs.
// Test: tests/pipeline/transfer_test.cpp
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bake/transfer.h"
#include "base/diagnostics.h"
#include "base/threads.h"
#include "gltf/rig.h"

namespace rigc::pipeline {

struct TransferRequest {
  std::string file;
  std::vector<std::string> clips;  ///< names or numbers; empty: all
  std::vector<std::string> limbs;  ///< GROUP=ik|fk, GROUP may be `all`; what is not named is FK
  std::string fps = "source";      ///< a number, or "source"
  /// Keys are inserted where the rig would be farther off between them, millimetres of a character
  /// of the template's size; with "source" only; 0: none.
  double tolerance_mm = 1;
  std::optional<double> start, end;
  bool strict = false;         ///< what the controls cannot say is an error
  Threads* threads = nullptr;  ///< for frames; null: the caller's thread alone
};

/// A deviation for people.
struct Off {
  double mm = 0;       ///< of a character of the template's size
  double percent = 0;  ///< of the character's height
  double degrees = 0;
  std::string joint;         ///< farthest
  double seconds = 0;        ///< when
  std::string turned_joint;  ///< most turned
  double turned_seconds = 0;
};

Off off_of(const gltf::Rig& rig, const bake::Deviation& deviation);

/// Two digits, or all of those before the point.
std::string short_number(double x);

struct TransferredClip {
  std::string name;
  bool passed_through = false;    ///< it animates no joint that a rig drives
  bake::TransferReport report;    ///< numbers of all rigs of the file
  std::vector<std::string> kept;  ///< joints that keep channels for what no control says of them
  std::vector<std::string> untouched;  ///< joints that nothing of a rig moves: as they were
  Off at_keys, between;
};

/// A limb that can be keyed in both ways.
struct TransferredLimb {
  std::string group;
  bool ik = false;
};

struct TransferredFile {
  std::vector<TransferredLimb> limbs;  ///< of all rigs
  std::vector<TransferredClip> clips;
  std::uint64_t bytes = 0;
};

std::optional<TransferredFile> transfer_file(const TransferRequest& request, const std::string& out,
                                             Diagnostics& diagnostics);

}  // namespace rigc::pipeline
