/* SPDX-License-Identifier: MIT */
/* evaluate RIG.glb: lifts the left hand of a rig by 5 cm and prints where its wrist is. */
#include <rigc_eval.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void check(rigc_status status, const rigc_diagnostics* wrong) {
  if (status == RIGC_OK) return;
  fprintf(stderr, "%s\n%s", rigc_status_text(status), rigc_diagnostics_text(wrong));
  exit(1);
}

int main(int argc, char** argv) {
  static char bytes[1 << 24];
  FILE* file = argc == 2 ? fopen(argv[1], "rb") : NULL;
  if (!file) return 2;
  size_t size = fread(bytes, 1, sizeof bytes, file);
  fclose(file);

  rigc_diagnostics* wrong = rigc_diagnostics_create();
  rigc_rig* rig = NULL;
  check(rigc_rig_open(bytes, size, NULL, wrong, &rig), wrong);

  /* Which controls, channels and joints those are. A program keeps their identities. */
  rigc_rig_info info = {.struct_size = sizeof info};
  check(rigc_rig_get_info(rig, &info), NULL);
  rigc_channel inputs[2] = {{0, RIGC_TRANSLATION}, {0, 0}}; /* of the hand; its IK/FK switch */
  for (uint32_t c = 0; c < info.control_count; ++c) {
    rigc_control_info control = {.struct_size = sizeof control};
    check(rigc_rig_get_control(rig, c, &control), NULL);
    if (strcmp(control.local, "arm_l") != 0) continue;
    if (strcmp(control.role, "ik") == 0) inputs[0].control = c;
    if (rigc_rig_find_channel(rig, c, "ik_fk", &inputs[1].channel) == RIGC_OK) inputs[1].control = c;
  }
  uint32_t wrist = 0;
  for (uint32_t j = 0; j < info.joint_count; ++j) {
    rigc_joint_info joint = {.struct_size = sizeof joint};
    check(rigc_rig_get_joint(rig, j, &joint), NULL);
    if (strcmp(joint.local, "arm_l") == 0 && strcmp(joint.label, "wrist") == 0) wrist = j;
  }

  /* Nothing else changes or is wanted: what does not depend on it is computed once, here. */
  rigc_program_options options = {sizeof options, inputs, 2, &wrist, 1};
  rigc_program* program = NULL;
  check(rigc_program_create(rig, &options, wrong, &program), wrong);
  rigc_instance* instance = NULL; /* one for each thread */
  check(rigc_instance_create(program, &instance), NULL);

  const double rows[] = {0, 0, 0, 1, 0, 0.05, 0, 1}; /* two frames of translation and ik_fk */
  double worlds[2 * 16];
  if (rigc_instance_evaluate(instance, 2, rows, worlds) != RIGC_OK)
    fprintf(stderr, "%s\n", rigc_instance_message(instance));
  for (const double* m = worlds; m < worlds + 32; m += 16)
    printf("wrist at %.4f %.4f %.4f\n", m[12], m[13], m[14]);

  rigc_instance_destroy(instance);
  rigc_program_destroy(program);
  rigc_rig_destroy(rig);
  rigc_diagnostics_destroy(wrong);
  return 0;
}
