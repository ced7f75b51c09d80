// SPDX-License-Identifier: MIT
// When a transfer looks at a clip: at the keys of its joints. Test: tests/bake/transfer_test.cpp
#pragma once

#include <optional>
#include <vector>

#include "bake/transfer.h"
#include "bake/transfer_targets.h"

namespace rigc::bake {

/// Whether every curve on joints holds its value from key to key.
bool only_steps(const std::vector<Aim>& aims);

/// Seconds as frame_times() gives them, of the joints' keys alone. Where a line between keys is not
/// what plays there are more: right before each step and, where no tolerance asks for what is
/// needed, along cubic curves. `width`: numbers that are kept for each frame.
std::optional<std::vector<double>> transfer_times(const std::vector<Aim>& aims,
                                                  const TransferOptions& options, std::size_t width,
                                                  Diagnostics& diagnostics);

}  // namespace rigc::bake
