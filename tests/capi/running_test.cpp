// SPDX-License-Identifier: MIT
// Instances while they run: no allocation, many at once, and whatever the caller has done to the
// floating-point environment.
#include <doctest/doctest.h>

#include <cfenv>
#include <cmath>
#include <thread>

#include "capi/capi_helpers.h"

namespace rigc::capi::test {
namespace {

constexpr std::size_t kFrames = 41;

std::vector<double> evaluate(const rigc_program* program, const std::vector<double>& rows) {
  const InstanceHandle one = instance(program);
  std::vector<double> matrices(kFrames * rigc_program_joint_count(program) * 16);
  CHECK(rigc_instance_evaluate(one.get(), kFrames, rows.data(), matrices.data()) == RIGC_OK);
  return matrices;
}

}  // namespace

TEST_CASE("capi running: nothing allocates once an instance is there, errors neither") {
  const RigHandle rig = open(biped());
  const ProgramHandle all = program(rig.get());
  const InstanceHandle one = instance(all.get());
  const std::uint32_t hand = control_of(rig.get(), "arm_l", "ik");
  const std::uint32_t wrist = joint_of(rig.get(), "arm_l", "wrist");
  const auto rows = random_rows(rig.get(), all.get(), kFrames, 1);
  const std::size_t numbers = kFrames * rigc_program_joint_count(all.get()) * 16;
  std::vector<double> matrices(numbers);
  std::vector<float> floats(numbers);
  rigc_trs local;
  const double values[4] = {0, 0, 0, 1}, wrong[4] = {0, 0, HUGE_VAL, 0};
  rigc_status good = RIGC_OK, bad[4];
  const auto run = [&](rigc_status status) { good = good == RIGC_OK ? status : good; };

  const Allocations allocations;
  run(rigc_instance_evaluate(one.get(), kFrames, rows.data(), matrices.data()));
  run(rigc_instance_evaluate_f(one.get(), kFrames, rows.data(), floats.data()));
  run(rigc_instance_reset(one.get()));
  run(rigc_instance_set(one.get(), 3, hand, RIGC_ROTATION, values));
  run(rigc_instance_set_rows(one.get(), 8, rows.data()));
  run(rigc_instance_run(one.get()));
  run(rigc_instance_get_world(one.get(), 3, wrist, matrices.data()));
  run(rigc_instance_get_world_f(one.get(), 3, wrist, floats.data()));
  run(rigc_instance_get_worlds(one.get(), 3, matrices.data()));
  run(rigc_instance_get_local(one.get(), 3, wrist, &local));
  bad[0] = rigc_instance_set(one.get(), 3, hand, RIGC_ROTATION, wrong);
  bad[1] = rigc_instance_set(one.get(), 99, hand, RIGC_ROTATION, values);
  bad[2] = rigc_instance_get_world(one.get(), 0, UINT32_MAX, matrices.data());
  bad[3] = rigc_instance_get_world(one.get(), 0, wrist, nullptr);
  const std::size_t count = allocations.count();

  CHECK(count == 0);
  CHECK(good == RIGC_OK);
  for (const rigc_status status : bad) CHECK(status != RIGC_OK);
}

TEST_CASE("capi running: allocations are counted") {
  const RigHandle rig = open(biped());
  const ProgramHandle all = program(rig.get());
  const Allocations allocations;
  const InstanceHandle one = instance(all.get());
  CHECK(allocations.count() >= 2);  // the instance and its registers
}

TEST_CASE("capi running: threads with an instance each share a rig and a program") {
  const RigHandle rig = open(biped());
  const ProgramHandle all = program(rig.get());
  constexpr std::size_t kThreads = 6;
  std::vector<std::vector<double>> rows, alone(kThreads), together(kThreads);
  for (std::size_t i = 0; i < kThreads; ++i) {
    rows.push_back(random_rows(rig.get(), all.get(), kFrames, 10 + i));
    alone[i] = evaluate(all.get(), rows[i]);
  }
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < kThreads; ++i) {
    threads.emplace_back([&, i] {
      for (int again = 0; again < 5; ++again) together[i] = evaluate(all.get(), rows[i]);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < kThreads; ++i) CHECK(alone[i] == together[i]);
}

TEST_CASE("capi running: the caller's rounding mode neither changes anything nor is changed") {
  const RigHandle rig = open(biped());
  const ProgramHandle all = program(rig.get());
  const auto rows = random_rows(rig.get(), all.get(), kFrames, 1);
  const auto expected = evaluate(all.get(), rows);
  std::fesetround(FE_UPWARD);
  const RigHandle again = open(biped());
  const ProgramHandle compiled = program(again.get());
  const auto upward = evaluate(compiled.get(), rows);
  const int mode = std::fegetround();
  std::fesetround(FE_TONEAREST);
  CHECK(mode == FE_UPWARD);
  CHECK(upward == expected);
}

}  // namespace rigc::capi::test
