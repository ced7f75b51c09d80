// SPDX-License-Identifier: MIT
// Every instruction set gives the bits of a kernel that computes one lane at a time, whatever
// stands in the other lanes.
#include "eval/isa.h"

#include <doctest/doctest.h>

#include <cstring>

#include "eval/evaluate.h"
#include "eval/kernels/table.h"
#include "tests/math/random.h"

namespace rigc::eval::scalar {
const KernelRow* kernels();  // kernels.cpp compiled for one lane, see tests/CMakeLists.txt
}

namespace rigc {
namespace {

using eval::Isa;
using eval::Op;
using test::Random;

TEST_CASE("eval isa: names") {
  CHECK(eval::name(Isa::baseline) == "baseline");
  CHECK(eval::name(Isa::avx2) == "avx2");
  CHECK(eval::find_isa("baseline") == Isa::baseline);
  CHECK(!eval::find_isa("sse9"));
  CHECK(!eval::find_isa(""));
  for (const Isa isa : eval::available_isas()) CHECK(eval::find_isa(eval::name(isa)) == isa);
}

// Numbers of all classes, plain ones most often.
double any_number(Random& random) {
  constexpr double kOdd[] = {0, -0.0, 1, -1, 0.5, 1e-300, -1e300, 1e9, 1e-9, 360, 90, 5e-324};
  return random.chance(15) ? kOdd[random.below(std::size(kOdd))] : random.between(-3, 3);
}

struct Shape {
  std::vector<std::uint32_t> widths;  // of the arguments
  std::uint32_t out = 1;
  std::vector<double> data;
};

void append(std::vector<double>& data, const math::Affine& a) {
  for (const math::Vec3& v : {a.linear.x, a.linear.y, a.linear.z, a.origin})
    data.insert(data.end(), {v.x, v.y, v.z});
}
void append(std::vector<double>& data, const math::Quat& q) {
  data.insert(data.end(), {q.x, q.y, q.z, q.w});
}

// Arguments and a table of an operation that a program could have.
Shape shape_of(Op op, Random& random) {
  switch (op) {
    case Op::compose:
      return {{3, 4, 3}, 12, {}};
    case Op::multiply:
      return {{12, 12}, 12, {}};
    case Op::gather:
      return {{1, 3, 12}, 16, {}};
    case Op::from_euler:
      return {{3}, 4, {}};
    case Op::to_euler:
      return {{4}, 3, {}};
    case Op::compose_rigid:
      return {{3, 4}, 12, {}};
    case Op::compose_under: {
      Shape shape{{3, 4}, 12, {1, -2, 0.5}};
      append(shape.data, random.rotation());
      return shape;
    }
    case Op::hang: {
      Shape shape{{12, 12}, 12, {}};
      append(shape.data, math::compose(random.trs(false)));
      return shape;
    }
    case Op::hang_straight:
      return {{12, 12}, 12, {1, -2, 0.5}};
    case Op::place:
      return {{12, 12, 3}, 12, {}};
    case Op::blend: {
      Shape shape{{12, 1, 12, 1}, 12, {2}};
      for (int i = 0; i < 2; ++i) append(shape.data, math::compose(random.trs(false)));
      return shape;
    }
    case Op::aim_world: {
      Shape shape{{12, 3, 12, 3, 12, 1, 12, 1}, 12, {2, static_cast<double>(random.below(3))}};
      append(shape.data, math::compose(random.trs(false)));
      return shape;
    }
    case Op::constraint: {
      Shape shape{{12, 12, 1, 12, 1}, 10, {2, random.chance(50) ? 1.0 : 0.0}};
      for (int i = 0; i < 2; ++i) append(shape.data, math::compose(random.trs(false)));
      return shape;
    }
    case Op::aim: {
      Shape shape{{12, 3, 12, 3, 12, 1, 12, 1}, 4, {2, static_cast<double>(random.below(3))}};
      append(shape.data, random.rotation());
      return shape;
    }
    case Op::ik_two_bone: {
      Shape shape{{12, 12, 12, 1, 3, 3, 3, 3, 3}, 24, {0.1, 0, 0}};
      for (int i = 0; i < 2; ++i) append(shape.data, random.rotation());
      shape.data.insert(shape.data.end(), {0, 0, 1});
      return shape;
    }
    case Op::ik_chain: {
      Shape shape{{12, 12, 12, 1, 3, 3, 3, 3}, 12, {4, random.chance(50) ? 1.0 : 0.0, 8, 0, 0, 0}};
      for (int i = 0; i < 4; ++i) append(shape.data, random.rotation());
      return shape;
    }
    case Op::limit_vector:
    case Op::limit_rotation: {
      Shape shape{{op == Op::limit_vector ? 3u : 4u}, op == Op::limit_vector ? 3u : 4u, {}};
      shape.data = {-1, -30, -1, 1, 1, 40};
      append(shape.data, random.rotation());
      shape.data.insert(shape.data.end(), {0.1, 0, 0});
      append(shape.data, random.rotation());
      shape.data.insert(shape.data.end(), {2, 0, 1});
      return shape;
    }
    case Op::remap:
      return {
          {1, 1, 1, 1, 1},
          1,
          {random.chance(50) ? 1.0 : 0.0, 4, -1, 0, 3, 0.5, 0, 1, 2, 0, 0.5, -1, 1, 0, 1, 2, 0, 0}};
    default: {
      const int count = eval::row(op).arguments;
      return {std::vector<std::uint32_t>(static_cast<std::size_t>(count), 1), 1, {}};
    }
  }
}

std::vector<double> run(eval::Kernel kernel, const Shape& shape, std::vector<double> registers) {
  std::vector<eval::Register> places;
  std::uint32_t row = 0;
  for (const std::uint32_t width : shape.widths) {
    places.push_back({row, width});
    row += width;
  }
  registers.resize((row + shape.out) * static_cast<std::size_t>(eval::kLanes), 0.0);
  kernel({registers.data(),
          {row, shape.out},
          places.data(),
          static_cast<std::uint32_t>(places.size()),
          shape.data.data()});
  return {registers.begin() + static_cast<std::ptrdiff_t>(row * eval::kLanes), registers.end()};
}

// Bits, but one NaN is another.
bool same(const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] != a[i] && b[i] != b[i]) continue;
    if (std::memcmp(&a[i], &b[i], sizeof(double)) != 0) return false;
  }
  return a.size() == b.size();
}

TEST_CASE("eval isa: the same bits for every instruction set and lane width") {
  Random random(1);
  for (std::size_t o = 0; o < static_cast<std::size_t>(Op::count); ++o) {
    const Op op = static_cast<Op>(o);
    CAPTURE(eval::row(op).name);
    for (int i = 0; i < 200; ++i) {
      const Shape shape = shape_of(op, random);
      std::size_t rows = 0;
      for (const std::uint32_t width : shape.widths) rows += width;
      std::vector<double> registers;
      for (std::size_t n = 0; n < rows * eval::kLanes; ++n) registers.push_back(any_number(random));
      const auto want = run(eval::scalar::kernels()[o].kernel, shape, registers);
      for (const Isa isa : eval::available_isas()) {
        CAPTURE(eval::name(isa));
        CHECK(same(run(eval::row(op, isa).kernel, shape, registers), want));
      }
    }
  }
}

}  // namespace
}  // namespace rigc
