// SPDX-License-Identifier: MIT
// The C ABI under callers that are wrong and bytes that are damaged: a status and a text, nothing
// else happens.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

#include "capi/capi_helpers.h"
#include "math/random.h"

namespace rigc::capi::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

rigc_status try_open(const std::string& bytes, rigc_diagnostics* diagnostics) {
  rigc_rig* rig = nullptr;
  const rigc_status status = rigc_rig_open(bytes.data(), bytes.size(), nullptr, diagnostics, &rig);
  CHECK((status == RIGC_OK) == (rig != nullptr));
  rigc_rig_destroy(rig);
  return status;
}

rigc_status try_program(const rigc_rig* rig, const rigc_program_options& options) {
  rigc_program* program = nullptr;
  const rigc_status status = rigc_program_create(rig, &options, nullptr, &program);
  CHECK((status == RIGC_OK) == (program != nullptr));
  rigc_program_destroy(program);
  return status;
}

}  // namespace

TEST_CASE("capi hostile: bytes that are cut are refused with a code") {
  const DiagnosticsHandle diagnostics(rigc_diagnostics_create());
  for (std::size_t size = 0; size < biped().size(); size += 1 + size / 3) {
    CAPTURE(size);
    CHECK(try_open(biped().substr(0, size), diagnostics.get()) == RIGC_ERROR_RIG);
    CHECK(std::string(rigc_diagnostics_text(diagnostics.get())).find("error[RIG0") !=
          std::string::npos);
    REQUIRE(rigc_diagnostics_count(diagnostics.get()) > 0);
    auto first = sized<rigc_diagnostic>();
    REQUIRE(rigc_diagnostics_get(diagnostics.get(), 0, &first) == RIGC_OK);
    CHECK(first.code > 0);
    CHECK(first.is_error == 1);
    CHECK(std::string(first.place).starts_with("memory"));
    CHECK(std::string(first.message) != "");
  }
  rigc_rig* rig = nullptr;
  CHECK(rigc_rig_open(nullptr, 0, nullptr, diagnostics.get(), &rig) == RIGC_ERROR_RIG);
  CHECK(try_open(biped(), diagnostics.get()) == RIGC_OK);  // and it forgets what it had to say
  CHECK(rigc_diagnostics_count(diagnostics.get()) == 0);
  CHECK(std::string(rigc_diagnostics_text(diagnostics.get())) == "");
}

TEST_CASE("capi hostile: damaged bytes are refused, or are a rig that can be evaluated") {
  rigc::test::Random random(7);
  const std::string text = biped_text();
  for (int round = 0; round < 60; ++round) {
    std::string bytes = text;
    for (std::size_t i = 0, changes = 1 + random.below(3); i < changes; ++i) {
      const std::size_t at = random.below(bytes.size());
      bytes[at] = "0123456789{}[],:\"-e."[random.below(20)];
    }
    rigc_rig* opened = nullptr;
    rigc_program* compiled = nullptr;
    const rigc_status status = rigc_rig_open(bytes.data(), bytes.size(), nullptr, nullptr, &opened);
    const RigHandle rig(opened);
    if (!rig) {
      CHECK((status == RIGC_ERROR_RIG || status == RIGC_ERROR_INDEX));
      continue;
    }
    if (rigc_program_create(rig.get(), nullptr, nullptr, &compiled) != RIGC_OK) continue;
    const ProgramHandle all(compiled);
    const InstanceHandle one = instance(all.get());
    CHECK(rigc_instance_run(one.get()) == RIGC_OK);
    std::vector<double> matrices(rigc_program_joint_count(all.get()) * 16);
    rigc_instance_get_worlds(one.get(), 0, matrices.data());
    for (const double number : matrices) CHECK(std::isfinite(number));
  }
}

TEST_CASE("capi hostile: a rig that cannot be evaluated is refused with the line that made it") {
  // The first joint of the skeleton follows itself.
  std::string text = biped_text();
  const std::string connection = R"("inputs":[["translate",)";
  const std::size_t at = text.find(connection) + connection.size();
  REQUIRE(at > connection.size());
  text.replace(at, text.find(',', at) - at, "0");
  const RigHandle rig = open(text);
  const DiagnosticsHandle diagnostics(rigc_diagnostics_create());
  rigc_program* program = nullptr;
  REQUIRE(rigc_program_create(rig.get(), nullptr, diagnostics.get(), &program) == RIGC_ERROR_RIG);
  CHECK(program == nullptr);
  auto first = sized<rigc_diagnostic>();
  REQUIRE(rigc_diagnostics_get(diagnostics.get(), 0, &first) == RIGC_OK);
  CHECK(first.code == 560);
  CHECK(std::string(first.place).find(".yaml:") != std::string::npos);
}

TEST_CASE("capi hostile: a file without a rig, or without that many") {
  const std::string empty = R"({"asset":{"version":"2.0"}})";
  CHECK(try_open(empty, nullptr) == RIGC_ERROR_INDEX);
  auto options = sized<rigc_open_options>();
  options.rig = 1;
  rigc_rig* rig = nullptr;
  CHECK(rigc_rig_open(biped().data(), biped().size(), &options, nullptr, &rig) == RIGC_ERROR_INDEX);
  CHECK(rig == nullptr);
}

TEST_CASE("capi hostile: null pointers") {
  rigc_rig* no_rig = nullptr;
  rigc_program* no_program = nullptr;
  rigc_instance* no_instance = nullptr;
  std::uint32_t number = 0;
  rigc_channel channel = {};
  rigc_trs trs;
  double numbers[16] = {};
  float floats[16] = {};
  CHECK(rigc_rig_open("x", 1, nullptr, nullptr, nullptr) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_rig_open(nullptr, 1, nullptr, nullptr, &no_rig) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_rig_get_info(nullptr, nullptr) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_rig_get_control(nullptr, 0, nullptr) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_rig_get_channel(nullptr, 0, 0, nullptr) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_rig_get_joint(nullptr, 0, nullptr) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_rig_find_control(nullptr, "", &number) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_rig_find_joint(nullptr, "", &number) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_rig_find_channel(nullptr, 0, "", &number) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_program_create(nullptr, nullptr, nullptr, &no_program) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_program_create(nullptr, nullptr, nullptr, nullptr) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_program_input_count(nullptr) == 0);
  CHECK(rigc_program_joint_count(nullptr) == 0);
  CHECK(rigc_program_input_width(nullptr) == 0);
  CHECK(rigc_program_get_input(nullptr, 0, &channel, nullptr) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_program_get_joint(nullptr, 0, &number) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_instance_create(nullptr, &no_instance) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_instance_create(nullptr, nullptr) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_instance_run(nullptr) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_instance_reset(nullptr) == RIGC_ERROR_ARGUMENT);
  CHECK(std::string(rigc_instance_message(nullptr)) == "");
  CHECK(rigc_diagnostics_count(nullptr) == 0);
  CHECK(std::string(rigc_diagnostics_text(nullptr)) == "");
  CHECK(rigc_diagnostics_get(nullptr, 0, nullptr) == RIGC_ERROR_ARGUMENT);
  rigc_diagnostics_destroy(nullptr);
  rigc_instance_destroy(nullptr);

  const RigHandle rig = open(biped());
  const ProgramHandle all = program(rig.get());
  const InstanceHandle one = instance(all.get());
  CHECK(rigc_rig_get_info(rig.get(), nullptr) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_rig_find_control(rig.get(), nullptr, &number) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_rig_find_joint(rig.get(), "x", nullptr) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_rig_find_channel(rig.get(), 0, nullptr, &number) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_program_get_input(all.get(), 0, nullptr, nullptr) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_program_get_joint(all.get(), 0, nullptr) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_instance_set(one.get(), 0, 0, 0, nullptr) == RIGC_ERROR_ARGUMENT);
  CHECK(std::string(rigc_instance_message(one.get())) == "an argument is null");
  CHECK(rigc_instance_set_rows(one.get(), 1, nullptr) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_instance_get_world(one.get(), 0, 0, nullptr) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_instance_get_world_f(one.get(), 0, 0, nullptr) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_instance_get_worlds(one.get(), 0, nullptr) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_instance_get_worlds_f(one.get(), 0, nullptr) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_instance_get_local(one.get(), 0, 0, nullptr) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_instance_evaluate(one.get(), 1, nullptr, numbers) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_instance_evaluate_f(one.get(), 1, numbers, nullptr) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_instance_get_local(nullptr, 0, 0, &trs) == RIGC_ERROR_ARGUMENT);
  CHECK(rigc_instance_get_world_f(nullptr, 0, 0, floats) == RIGC_ERROR_ARGUMENT);
}

TEST_CASE("capi hostile: numbers of what is not there") {
  const RigHandle rig = open(biped());
  const ProgramHandle all = program(rig.get());
  const InstanceHandle one = instance(all.get());
  const rigc_rig_info info = info_of(rig.get());
  auto control = sized<rigc_control_info>();
  auto channel = sized<rigc_channel_info>();
  auto joint = sized<rigc_joint_info>();
  std::uint32_t number = 77;
  rigc_channel at = {};
  rigc_trs trs;
  const double values[4] = {0, 0, 0, 1};
  double matrix[16];
  for (const std::uint32_t wrong : {info.control_count, UINT32_MAX}) {
    CHECK(rigc_rig_get_control(rig.get(), wrong, &control) == RIGC_ERROR_INDEX);
    CHECK(rigc_rig_get_channel(rig.get(), wrong, 0, &channel) == RIGC_ERROR_INDEX);
    CHECK(rigc_rig_get_channel(rig.get(), 0, wrong, &channel) == RIGC_ERROR_INDEX);
    CHECK(rigc_rig_find_channel(rig.get(), wrong, "rotation", &number) == RIGC_ERROR_INDEX);
    CHECK(rigc_instance_set(one.get(), 0, wrong, 0, values) == RIGC_ERROR_INDEX);
    CHECK(rigc_instance_set(one.get(), 0, 0, wrong, values) == RIGC_ERROR_INDEX);
    CHECK(rigc_rig_get_joint(rig.get(), wrong, &joint) == RIGC_ERROR_INDEX);
    CHECK(rigc_instance_get_world(one.get(), 0, wrong, matrix) == RIGC_ERROR_INDEX);
    CHECK(rigc_instance_get_local(one.get(), 0, wrong, &trs) == RIGC_ERROR_INDEX);
    CHECK(rigc_program_get_input(all.get(), wrong + 1000, &at, nullptr) == RIGC_ERROR_INDEX);
    CHECK(rigc_program_get_joint(all.get(), wrong, &number) == RIGC_ERROR_INDEX);
  }
  CHECK(rigc_rig_find_control(rig.get(), "nobody", &number) == RIGC_ERROR_INDEX);
  CHECK(rigc_rig_find_joint(rig.get(), "", &number) == RIGC_ERROR_INDEX);
  CHECK(rigc_rig_find_channel(rig.get(), 0, "nothing", &number) == RIGC_ERROR_INDEX);
  CHECK(number == 77);
  const std::uint32_t hand = control_of(rig.get(), "arm_l", "ik");
  CHECK(rigc_instance_set(one.get(), 8, hand, RIGC_ROTATION, values) == RIGC_ERROR_INDEX);
  CHECK(std::string(rigc_instance_message(one.get())) == "there is no frame 8: a block has 8");
  CHECK(rigc_instance_get_world(one.get(), 8, 0, matrix) == RIGC_ERROR_INDEX);
  CHECK(rigc_instance_get_worlds(one.get(), RIGC_ALL_FRAMES, matrix) == RIGC_ERROR_INDEX);
  CHECK(rigc_instance_set_rows(one.get(), 9, values) == RIGC_ERROR_INDEX);
  CHECK(rigc_instance_set(one.get(), 0, hand, RIGC_SCALE, values) == RIGC_ERROR_SELECTION);
}

TEST_CASE("capi hostile: selections that cannot be") {
  const RigHandle rig = open(biped());
  const std::uint32_t hand = control_of(rig.get(), "arm_l", "ik");
  const rigc_channel twice[] = {{hand, RIGC_ROTATION}, {hand, RIGC_ROTATION}};
  const rigc_channel locked[] = {{hand, RIGC_SCALE}};
  const rigc_channel absent[] = {{hand, 99}};
  const std::uint32_t joints[] = {3, 3}, no_joint[] = {UINT32_MAX}, one_joint[] = {3};
  auto options = sized<rigc_program_options>();
  options.inputs = twice;
  options.input_count = 2;
  CHECK(try_program(rig.get(), options) == RIGC_ERROR_ARGUMENT);
  options.input_count = SIZE_MAX;
  CHECK(try_program(rig.get(), options) == RIGC_ERROR_ARGUMENT);
  options.input_count = 1;
  CHECK(try_program(rig.get(), options) == RIGC_OK);
  options.inputs = locked;
  CHECK(try_program(rig.get(), options) == RIGC_ERROR_SELECTION);
  options.inputs = absent;
  CHECK(try_program(rig.get(), options) == RIGC_ERROR_INDEX);
  options.inputs = nullptr;
  CHECK(try_program(rig.get(), options) == RIGC_ERROR_ARGUMENT);
  options.input_count = 0;
  options.joints = joints;
  options.joint_count = 2;
  CHECK(try_program(rig.get(), options) == RIGC_ERROR_ARGUMENT);
  options.joints = no_joint;
  options.joint_count = 1;
  CHECK(try_program(rig.get(), options) == RIGC_ERROR_INDEX);
  options.joints = one_joint;
  const ProgramHandle few = program(rig.get(), &options);
  const InstanceHandle one = instance(few.get());
  double matrix[16];
  CHECK(rigc_instance_get_world(one.get(), 0, 4, matrix) == RIGC_ERROR_SELECTION);
  CHECK(std::string(rigc_instance_message(one.get())) == "joint 4 is none of the program's");
  options.struct_size = 4;
  CHECK(try_program(rig.get(), options) == RIGC_ERROR_ARGUMENT);
}

TEST_CASE("capi hostile: structs of older and newer callers") {
  const RigHandle rig = open(biped());
  rigc_control_info info;
  std::memset(&info, 0x55, sizeof info);
  info.struct_size = offsetof(rigc_control_info, name);  // knows only the identity
  const char* const untouched = info.name;
  REQUIRE(rigc_rig_get_control(rig.get(), 0, &info) == RIGC_OK);
  CHECK(info.struct_size == offsetof(rigc_control_info, name));
  CHECK(info.identity == std::string(control_at(rig.get(), 0).identity));
  CHECK(info.name == untouched);
  info.struct_size = 0;
  CHECK(rigc_rig_get_control(rig.get(), 0, &info) == RIGC_ERROR_ARGUMENT);
  struct Newer {
    rigc_rig_info known;
    std::uint64_t unknown;
  } newer = {};
  newer.known.struct_size = sizeof newer;
  newer.unknown = 42;
  REQUIRE(rigc_rig_get_info(rig.get(), &newer.known) == RIGC_OK);
  CHECK(newer.known.joint_count > 0);
  CHECK(newer.unknown == 42);
}

TEST_CASE("capi hostile: values that are no numbers are refused and change nothing") {
  const RigHandle rig = open(biped());
  const ProgramHandle all = program(rig.get());
  const InstanceHandle one = instance(all.get());
  const std::uint32_t hand = control_of(rig.get(), "arm_l", "ik");
  const std::size_t numbers = rigc_program_joint_count(all.get()) * 16;
  std::vector<double> before(numbers), after(numbers);
  REQUIRE(rigc_instance_run(one.get()) == RIGC_OK);
  REQUIRE(rigc_instance_get_worlds(one.get(), 0, before.data()) == RIGC_OK);
  for (const double wrong : {kNan, kInfinity, -kInfinity, 1.1e30, -1e300}) {
    const double values[4] = {0.1, 0.2, wrong, 0};
    CHECK(rigc_instance_set(one.get(), RIGC_ALL_FRAMES, hand, RIGC_TRANSLATION, values) ==
          RIGC_ERROR_VALUE);
    CHECK(std::string(rigc_instance_message(one.get())).starts_with("number 2 for channel 0"));
    CHECK(rigc_instance_set(one.get(), 0, hand, RIGC_ROTATION, values) == RIGC_ERROR_VALUE);
    auto rows = random_rows(rig.get(), all.get(), 2, 5);
    rows.back() = wrong;
    CHECK(rigc_instance_set_rows(one.get(), 2, rows.data()) == RIGC_ERROR_VALUE);
    CHECK(rigc_instance_evaluate(one.get(), 2, rows.data(), after.data()) == RIGC_ERROR_VALUE);
  }
  REQUIRE(rigc_instance_run(one.get()) == RIGC_OK);
  REQUIRE(rigc_instance_get_worlds(one.get(), 0, after.data()) == RIGC_OK);
  CHECK(before == after);
}

TEST_CASE("capi hostile: quaternions of any length are rotations") {
  const RigHandle rig = open(biped());
  const ProgramHandle all = program(rig.get());
  const InstanceHandle one = instance(all.get());
  const std::uint32_t head = control_of(rig.get(), "head", "control");
  const std::size_t numbers = rigc_program_joint_count(all.get()) * 16;
  const auto worlds = [&](double x, double y, double z, double w) {
    const double q[] = {x, y, z, w};
    std::vector<double> out(numbers);
    REQUIRE(rigc_instance_set(one.get(), 0, head, RIGC_ROTATION, q) == RIGC_OK);
    REQUIRE(rigc_instance_run(one.get()) == RIGC_OK);
    REQUIRE(rigc_instance_get_worlds(one.get(), 0, out.data()) == RIGC_OK);
    return out;
  };
  CHECK(worlds(0, 0, 0, 0) == worlds(0, 0, 0, 1));
  CHECK(worlds(0, 0, 0, 0) != worlds(0, 0, 0.6, 0.8));
  CHECK(worlds(0, 0, 3, 4) == worlds(0, 0, 0.6, 0.8));
  CHECK(worlds(0, 0, 0x3p-60, 0x4p-60) == worlds(0, 0, 0.6, 0.8));
}

TEST_CASE("capi hostile: values too large for their products give zeros and a status, no NaN") {
  // Twelve controls one under another, each as large as it may be.
  const RigHandle rig = open(tower());
  const ProgramHandle all = program(rig.get());
  const InstanceHandle one = instance(all.get());
  std::vector<double> row;
  for (std::uint32_t i = 0; i < rigc_program_input_count(all.get()); ++i) {
    rigc_channel at = {};
    REQUIRE(rigc_program_get_input(all.get(), i, &at, nullptr) == RIGC_OK);
    const rigc_channel_info info = channel_at(rig.get(), at.control, at.channel);
    for (std::uint32_t c = 0; c < info.width; ++c)
      row.push_back(at.channel == RIGC_SCALE ? 1e30 : info.value[c]);
  }
  const std::uint32_t joints = rigc_program_joint_count(all.get());
  std::vector<double> matrices(std::size_t{16} * joints, 5);
  std::vector<float> floats(matrices.size(), 5);
  CHECK(rigc_instance_evaluate(one.get(), 1, row.data(), matrices.data()) == RIGC_ERROR_NOT_FINITE);
  CHECK(std::string(rigc_instance_message(one.get())).find("is not finite") != std::string::npos);
  CHECK(matrices[0] == 1e30);
  CHECK(std::count(matrices.end() - 16, matrices.end(), 0) == 16);
  for (const double number : matrices) CHECK(std::isfinite(number));
  CHECK(rigc_instance_evaluate_f(one.get(), 1, row.data(), floats.data()) == RIGC_ERROR_NOT_FINITE);
  CHECK(floats[0] == 1e30f);
  for (const float number : floats) CHECK(std::isfinite(number));
  rigc_trs local;
  rigc_status last = RIGC_OK;
  for (std::uint32_t joint = 0; joint < joints; ++joint) {
    last = rigc_instance_get_local(one.get(), 0, joint, &local);
    CHECK(std::isfinite(local.translation[0] + local.rotation[3] + local.scale[2]));
  }
  CHECK(last == RIGC_ERROR_NOT_FINITE);
}

TEST_CASE("capi hostile: every status has a text") {
  for (rigc_status status = RIGC_OK; status <= RIGC_ERROR_INTERNAL; ++status)
    CHECK(std::string(rigc_status_text(status)) != "no status of this library");
  CHECK(std::string(rigc_status_text(-1)) == "no status of this library");
}

}  // namespace rigc::capi::test
