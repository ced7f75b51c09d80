// SPDX-License-Identifier: MIT
// The humanoids of the corpus. Test: tests/pipeline/humanoids_test.cpp
#include "support/corpus.h"

namespace rigc::test {

const std::vector<Humanoid>& humanoids() {
  static const std::vector<Humanoid> kHumanoids = {
      {"mixamo_Xbot_blender/Xbot.glb", "", "mixamo", 67},
      {"max_RiggedElf/RiggedElf.gltf", "", "mixamo", 25},
      {"maya_Elf/elf.gltf", "", "mixamo", 22},
      {"rpm_avatar_a/646d9dcdc8a5f5bddbfac913.glb", "", "ready_player_me", 67},
      {"vrm0_catbot_unigltf/catbot.vrm", "", "vrm", 54},
      {"vrm1_Example/Example.vrm", "", "vrm", 53},
      {"gdquest_mannequiny/mannequiny-0.3.0.glb", "", "unreal", 45},
      {"khronos_CesiumMan/CesiumMan.glb", "cesium_man.yaml", "cesium_man", 19},
      {"godot_player/player.glb", "player.yaml", "player", 16},
      {"sketchbook_boxman/boxman.glb", "boxman.yaml", "boxman", 13},
      {"gltftransform_RobotExpressive_quant/RobotExpressive.glb", "robot_expressive.yaml",
       "robot_expressive", 41},
  };
  return kHumanoids;
}

}  // namespace rigc::test
