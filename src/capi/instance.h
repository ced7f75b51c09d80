// SPDX-License-Identifier: MIT
// The registers of one thread behind the C ABI. Nothing here allocates after the constructor.
// Test: tests/capi/capi_test.cpp, tests/capi/running_test.cpp
#pragma once

#include "capi/program.h"

namespace rigc::capi {

class Instance {
 public:
  explicit Instance(const Program& program);

  rigc_status set(std::uint32_t frame, rigc_channel channel, const double* values);
  rigc_status set_rows(std::size_t frames, const double* values);
  rigc_status reset();
  rigc_status run();

  /// `Number` is double or float.
  template <class Number>
  rigc_status get_world(std::uint32_t frame, std::uint32_t joint, Number* matrix);
  template <class Number>
  rigc_status get_worlds(std::uint32_t frame, Number* matrices);
  rigc_status get_local(std::uint32_t frame, std::uint32_t joint, rigc_trs& local);
  template <class Number>
  rigc_status evaluate(std::size_t frames, const double* inputs, Number* matrices);

  /// A null pointer, which is what every function of rigc_eval.h looks for first.
  rigc_status null_argument() { return fail(RIGC_ERROR_ARGUMENT, "an argument is null"); }
  const char* message() const { return message_; }

 private:
  rigc_status fail(rigc_status status, const char* format, ...)
      __attribute__((format(printf, 3, 4)));
  rigc_status check_frame(std::uint32_t frame);
  rigc_status check_values(const Input& input, const double* values);
  /// Index among the program's outputs, or below zero where that was reported.
  int output_of(std::uint32_t joint, rigc_status& status);
  void put(std::size_t input, std::size_t first, std::size_t end, const double* values);
  math::Affine world(int output, std::uint32_t frame) const;
  template <class Number>
  rigc_status read(std::size_t output, std::uint32_t frame, Number* matrix);
  /// Frames 0 to `frames` - 1, `stride` numbers from one to the next.
  template <class Number>
  rigc_status read_block(std::size_t output, std::size_t frames, std::size_t stride,
                         Number* matrices);

  const Program& program_;
  eval::Instance instance_;
  char message_[160] = "";
};

}  // namespace rigc::capi
