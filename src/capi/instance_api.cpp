// SPDX-License-Identifier: MIT
// The functions of rigc_eval.h for instances. Test: tests/capi/capi_test.cpp
#include "capi/handles.h"

using namespace rigc;
using namespace rigc::capi;

namespace {

/// Work on an instance, where none of the pointers that it needs is null.
template <class Work>
rigc_status with(rigc_instance* instance, bool complete, const Work& work) noexcept {
  if (!instance) return RIGC_ERROR_ARGUMENT;
  if (!complete) return instance->instance.null_argument();
  return guarded([&] { return work(instance->instance); });
}

/// Whether rows of inputs are there, or none are needed.
bool has_rows(const rigc_instance* instance, const double* rows) {
  return rows || (instance && instance->program->input_width == 0);
}

}  // namespace

uint32_t rigc_block_frames(void) { return eval::kLanes; }

rigc_status rigc_instance_create(const rigc_program* program, rigc_instance** instance) {
  if (!instance) return RIGC_ERROR_ARGUMENT;
  *instance = nullptr;
  if (!program) return RIGC_ERROR_ARGUMENT;
  return guarded([&] {
    *instance = new rigc_instance{program->program, Instance(*program->program)};
    return RIGC_OK;
  });
}

void rigc_instance_destroy(rigc_instance* instance) { delete instance; }

const char* rigc_instance_message(const rigc_instance* instance) {
  return instance ? instance->instance.message() : "";
}

rigc_status rigc_instance_set(rigc_instance* instance, uint32_t frame, uint32_t control,
                              uint32_t channel, const double* values) {
  return with(instance, values, [&](Instance& it) {
    return it.set(frame, {control, channel}, values);
  });
}

rigc_status rigc_instance_set_rows(rigc_instance* instance, uint32_t frames, const double* values) {
  return with(instance, has_rows(instance, values),
              [&](Instance& it) { return it.set_rows(frames, values); });
}

rigc_status rigc_instance_reset(rigc_instance* instance) {
  return with(instance, true, [](Instance& it) { return it.reset(); });
}

rigc_status rigc_instance_run(rigc_instance* instance) {
  return with(instance, true, [](Instance& it) { return it.run(); });
}

rigc_status rigc_instance_get_world(rigc_instance* instance, uint32_t frame, uint32_t joint,
                                    double matrix[16]) {
  return with(instance, matrix, [&](Instance& it) { return it.get_world(frame, joint, matrix); });
}

rigc_status rigc_instance_get_world_f(rigc_instance* instance, uint32_t frame, uint32_t joint,
                                      float matrix[16]) {
  return with(instance, matrix, [&](Instance& it) { return it.get_world(frame, joint, matrix); });
}

rigc_status rigc_instance_get_worlds(rigc_instance* instance, uint32_t frame, double* matrices) {
  return with(instance, matrices, [&](Instance& it) { return it.get_worlds(frame, matrices); });
}

rigc_status rigc_instance_get_worlds_f(rigc_instance* instance, uint32_t frame, float* matrices) {
  return with(instance, matrices, [&](Instance& it) { return it.get_worlds(frame, matrices); });
}

rigc_status rigc_instance_get_local(rigc_instance* instance, uint32_t frame, uint32_t joint,
                                    rigc_trs* local) {
  return with(instance, local, [&](Instance& it) { return it.get_local(frame, joint, *local); });
}

rigc_status rigc_instance_evaluate(rigc_instance* instance, size_t frames, const double* inputs,
                                   double* matrices) {
  return with(instance, has_rows(instance, inputs) && matrices,
              [&](Instance& it) { return it.evaluate(frames, inputs, matrices); });
}

rigc_status rigc_instance_evaluate_f(rigc_instance* instance, size_t frames, const double* inputs,
                                     float* matrices) {
  return with(instance, has_rows(instance, inputs) && matrices,
              [&](Instance& it) { return it.evaluate(frames, inputs, matrices); });
}
