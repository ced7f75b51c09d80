// SPDX-License-Identifier: MIT
// Values in, worlds out. Test: tests/capi/capi_test.cpp, tests/capi/running_test.cpp
#include "capi/instance.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>

#include "eval/evaluate.h"
#include "eval/values.h"

namespace rigc::capi {
namespace {

constexpr double kLargest = 1e30;
constexpr std::size_t kFrames = eval::kLanes;

/// What came through 32-bit floats is unit enough, and keeps its bits, as in a bake.
constexpr double kUnit = 1e-6;

math::Quat unit(const double* n) {
  const math::Quat q{n[0], n[1], n[2], n[3]};
  return std::abs(math::dot(q, q) - 1) <= kUnit ? q : math::normalised(q);
}

/// Whether no number is NaN or beyond a bound. Without branches, for vectors.
bool within(const double* numbers, std::size_t count, double most) {
  unsigned outside = 0;
  for (std::size_t i = 0; i < count; ++i) outside |= !(std::abs(numbers[i]) <= most) ? 1u : 0u;
  return outside == 0;
}

/// A 4 x 4 matrix by its columns; false where it does not fit, and all zeros then.
template <class Number>
bool copy_matrix(const double (&n)[12], Number* matrix) {
  constexpr double kMost = std::numeric_limits<Number>::max();
  const bool fits = within(n, 12, kMost);
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t r = 0; r < 3; ++r)
      matrix[4 * c + r] = fits ? static_cast<Number>(n[3 * c + r]) : Number(0);
    matrix[4 * c + 3] = fits && c == 3 ? Number(1) : Number(0);
  }
  return fits;
}

bool is_finite(const math::Trs& t) {
  const double numbers[] = {t.translation.x, t.translation.y, t.translation.z, t.rotation.x,
                            t.rotation.y,    t.rotation.z,    t.rotation.w,    t.scale.x,
                            t.scale.y,       t.scale.z};
  return std::all_of(std::begin(numbers), std::end(numbers),
                     [](double x) { return std::isfinite(x); });
}

rigc_trs plain(const math::Trs& t) {
  return {{t.translation.x, t.translation.y, t.translation.z},
          {t.rotation.x, t.rotation.y, t.rotation.z, t.rotation.w},
          {t.scale.x, t.scale.y, t.scale.z}};
}

}  // namespace

Instance::Instance(const Program& program) : program_(program), instance_(program.program) {}

// Values.

void Instance::put(std::size_t input, std::size_t first, std::size_t end, const double* values) {
  double* rows = instance_.input(input);
  const auto width = static_cast<int>(program_.inputs[input].width);
  math::Quat q;
  if (width == 4) {
    q = unit(values);
    values = &q.x;
  }
  for (std::size_t lane = first; lane < end; ++lane)
    eval::set_lane(rows, static_cast<int>(lane), values, width);
}

rigc_status Instance::check_values(const Input& input, const double* values) {
  for (std::uint32_t i = 0; i < input.width; ++i) {
    if (std::abs(values[i]) <= kLargest) continue;  // written so that NaN fails
    return fail(RIGC_ERROR_VALUE,
                "number %u for channel %u of control %u is not finite or beyond 1e30", i,
                input.channel.channel, input.channel.control);
  }
  return RIGC_OK;
}

rigc_status Instance::check_frame(std::uint32_t frame) {
  if (frame < kFrames) return RIGC_OK;
  return fail(RIGC_ERROR_INDEX, "there is no frame %u: a block has %zu", frame, kFrames);
}

rigc_status Instance::set(std::uint32_t frame, rigc_channel channel, const double* values) {
  const Rig& rig = *program_.rig;
  const Channel* found = rig.channel(channel.control, channel.channel);
  if (!found)
    return fail(RIGC_ERROR_INDEX, "there is no channel %u of control %u", channel.channel,
                channel.control);
  const int input =
      program_.input_of_channel[static_cast<std::size_t>(found - rig.channels.data())];
  if (input < 0)
    return fail(RIGC_ERROR_SELECTION, "channel %u of control %u is no input of the program",
                channel.channel, channel.control);
  const auto index = static_cast<std::size_t>(input);
  const bool all = frame == RIGC_ALL_FRAMES;
  rigc_status status = all ? RIGC_OK : check_frame(frame);
  if (status == RIGC_OK) status = check_values(program_.inputs[index], values);
  if (status != RIGC_OK) return status;
  put(index, all ? 0 : frame, all ? kFrames : frame + 1, values);
  return RIGC_OK;
}

rigc_status Instance::set_rows(std::size_t frames, const double* values) {
  if (frames > kFrames) return check_frame(static_cast<std::uint32_t>(frames - 1));
  const std::vector<Input>& inputs = program_.inputs;
  const bool good = within(values, frames * program_.input_width, kLargest);
  for (std::size_t frame = 0; !good && frame < frames; ++frame) {
    for (const Input& input : inputs) {
      const rigc_status status =
          check_values(input, values + frame * program_.input_width + input.offset);
      if (status != RIGC_OK) return status;
    }
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    for (std::size_t frame = 0; frame < frames; ++frame)
      put(i, frame, frame + 1, values + frame * program_.input_width + inputs[i].offset);
  }
  return RIGC_OK;
}

rigc_status Instance::reset() {
  for (std::size_t i = 0; i < program_.inputs.size(); ++i) {
    const rigc_channel& channel = program_.inputs[i].channel;
    const double* values = program_.rig->channel(channel.control, channel.channel)->info.value;
    for (int lane = 0; lane < eval::kLanes; ++lane)
      eval::set_lane(instance_.input(i), lane, values, static_cast<int>(program_.inputs[i].width));
  }
  return RIGC_OK;
}

rigc_status Instance::run() {
  instance_.run();
  return RIGC_OK;
}

// Worlds.

math::Affine Instance::world(int output, std::uint32_t frame) const {
  double n[12];
  eval::get_lane(instance_.output(static_cast<std::size_t>(output)), static_cast<int>(frame), n,
                 12);
  return eval::affine_from(n);
}

template <class Number>
rigc_status Instance::read(std::size_t output, std::uint32_t frame, Number* matrix) {
  double n[12];
  eval::get_lane(instance_.output(output), static_cast<int>(frame), n, 12);
  if (copy_matrix(n, matrix)) return RIGC_OK;
  return fail(RIGC_ERROR_NOT_FINITE, "the matrix of joint %u is not finite in frame %u",
              program_.joints[output], frame);
}

template <class Number>
rigc_status Instance::read_block(std::size_t output, std::size_t frames, std::size_t stride,
                                 Number* matrices) {
  const double* rows = instance_.output(output);
  rigc_status result = RIGC_OK;
  if (!within(rows, 12 * kFrames, std::numeric_limits<Number>::max())) {
    for (std::size_t frame = 0; frame < frames; ++frame) {
      const rigc_status one =
          read(output, static_cast<std::uint32_t>(frame), matrices + frame * stride);
      if (one != RIGC_OK) result = one;
    }
    return result;
  }
  for (std::size_t frame = 0; frame < frames; ++frame) {
    Number* matrix = matrices + frame * stride;
    for (std::size_t c = 0; c < 4; ++c) {
      for (std::size_t r = 0; r < 3; ++r)
        matrix[4 * c + r] = static_cast<Number>(rows[(3 * c + r) * kFrames + frame]);
      matrix[4 * c + 3] = c == 3 ? Number(1) : Number(0);
    }
  }
  return result;
}

int Instance::output_of(std::uint32_t joint, rigc_status& status) {
  if (joint >= program_.output_of_joint.size()) {
    status = fail(RIGC_ERROR_INDEX, "there is no joint %u: the rig has %zu", joint,
                  program_.output_of_joint.size());
    return -1;
  }
  const int output = program_.output_of_joint[joint];
  if (output < 0) status = fail(RIGC_ERROR_SELECTION, "joint %u is none of the program's", joint);
  return output;
}

template <class Number>
rigc_status Instance::get_world(std::uint32_t frame, std::uint32_t joint, Number* matrix) {
  rigc_status status = check_frame(frame);
  if (status != RIGC_OK) return status;
  const int output = output_of(joint, status);
  return output < 0 ? status : read(static_cast<std::size_t>(output), frame, matrix);
}

template <class Number>
rigc_status Instance::get_worlds(std::uint32_t frame, Number* matrices) {
  rigc_status status = check_frame(frame);
  if (status != RIGC_OK) return status;
  for (std::size_t i = 0; i < program_.joints.size(); ++i) {
    const rigc_status one = read(i, frame, matrices + 16 * i);
    if (one != RIGC_OK) status = one;
  }
  return status;
}

rigc_status Instance::get_local(std::uint32_t frame, std::uint32_t joint, rigc_trs& local) {
  rigc_status status = check_frame(frame);
  if (status != RIGC_OK) return status;
  const int output = output_of(joint, status);
  if (output < 0) return status;
  const int base = program_.base_outputs[static_cast<std::size_t>(output)];
  const math::Affine& between = program_.rig->joints[joint].between;
  const math::Affine parent = base < 0 ? between : world(base, frame) * between;
  const math::Trs trs = math::decompose(math::inverse(parent) * world(output, frame));
  if (is_finite(trs)) {
    local = plain(trs);
    return RIGC_OK;
  }
  local = plain({});
  return fail(RIGC_ERROR_NOT_FINITE, "joint %u is not finite in frame %u", joint, frame);
}

template <class Number>
rigc_status Instance::evaluate(std::size_t frames, const double* inputs, Number* matrices) {
  rigc_status result = RIGC_OK;
  const std::size_t width = program_.joints.size() * 16;
  for (std::size_t first = 0; first < frames; first += kFrames) {
    const std::size_t count = std::min(frames - first, kFrames);
    const rigc_status set = set_rows(count, inputs + first * program_.input_width);
    if (set != RIGC_OK) return set;
    instance_.run();
    for (std::size_t i = 0; i < program_.joints.size(); ++i) {
      const rigc_status got = read_block(i, count, width, matrices + first * width + 16 * i);
      if (got != RIGC_OK) result = got;
    }
  }
  return result;
}

// std::vsnprintf of integers allocates nothing.
rigc_status Instance::fail(rigc_status status, const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(message_, sizeof message_, format, arguments);
  va_end(arguments);
  return status;
}

template rigc_status Instance::get_world(std::uint32_t, std::uint32_t, double*);
template rigc_status Instance::get_world(std::uint32_t, std::uint32_t, float*);
template rigc_status Instance::get_worlds(std::uint32_t, double*);
template rigc_status Instance::get_worlds(std::uint32_t, float*);
template rigc_status Instance::evaluate(std::size_t, const double*, double*);
template rigc_status Instance::evaluate(std::size_t, const double*, float*);

}  // namespace rigc::capi
