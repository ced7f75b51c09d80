// SPDX-License-Identifier: MIT
// Emitting, folding, and finding what is there already. Test: tests/eval/emitter_test.cpp
#include "eval/emitter.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <utility>

#include "eval/similarity.h"
#include "eval/simplify.h"
#include "eval/values.h"

namespace rigc::eval {

namespace {

constexpr std::uint32_t kNone = UINT32_MAX;

std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) {
  hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
  return hash ^ (hash >> 32);
}

// Bits, so that 0 and -0 stay apart.
bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

}  // namespace

std::uint32_t Emitter::hash_of(const Definition& d) const {
  std::uint64_t hash =
      mixed(static_cast<std::uint64_t>(d.source) * 256 + static_cast<std::uint64_t>(d.op), d.width);
  for (const Operand& a : arguments(d))
    hash = mixed(mixed(hash, a.value), (std::uint64_t{a.offset} << 32) + a.width);
  for (const double n : data(d)) hash = mixed(hash, std::bit_cast<std::uint64_t>(n));
  return static_cast<std::uint32_t>(hash);
}

bool Emitter::same(const Definition& a, const Definition& b) const {
  return a.source == b.source && a.op == b.op && a.width == b.width &&
         std::ranges::equal(arguments(a), arguments(b)) &&
         std::ranges::equal(data(a), data(b), same_bits);
}

void Emitter::grow() {
  std::vector<Slot> larger(index_.size() * 2);
  const std::size_t mask = larger.size() - 1;
  for (const Slot& slot : index_) {
    if (slot.value == kNone) continue;
    std::size_t at = slot.hash & mask;
    while (larger[at].value != kNone) at = (at + 1) & mask;
    larger[at] = slot;
  }
  index_ = std::move(larger);
}

std::span<const Operand> Emitter::arguments(const Definition& d) const {
  return std::span(arguments_).subspan(d.first_argument, d.argument_count);
}

std::span<const double> Emitter::data(const Definition& d) const {
  return std::span(data_).subspan(d.data, d.data_count);
}

std::span<const double> Emitter::numbers(const Operand& constant) const {
  assert(is_constant(constant));
  return data(definition(constant)).subspan(constant.offset, constant.width);
}

math::Affine Emitter::matrix(const Operand& constant) const {
  return affine_from(numbers(constant).data());
}

std::uint32_t Emitter::unify() {
  const auto newest = static_cast<std::uint32_t>(values_.size() - 1);
  const Definition& d = values_.back();
  const std::uint32_t hash = hash_of(d);
  if (2 * (indexed_ + 1) > index_.size()) grow();
  const std::size_t mask = index_.size() - 1;
  std::size_t at = hash & mask;
  for (; index_[at].value != kNone; at = (at + 1) & mask) {
    if (index_[at].hash != hash || !same(values_[index_[at].value], d)) continue;
    arguments_.resize(d.first_argument);
    data_.resize(d.data);
    values_.pop_back();
    return index_[at].value;
  }
  index_[at] = {hash, newest};
  ++indexed_;
  return newest;
}

Operand Emitter::constant(std::span<const double> numbers) {
  Definition d;
  d.width = d.data_count = static_cast<std::uint32_t>(numbers.size());
  d.first_argument = static_cast<std::uint32_t>(arguments_.size());
  d.data = static_cast<std::uint32_t>(data_.size());
  data_.insert(data_.end(), numbers.begin(), numbers.end());
  values_.push_back(d);
  return whole(unify());
}

Operand Emitter::constant_matrix(const math::Affine& a) { return constant(columns_of(a)); }

Operand Emitter::input(std::span<const double> initial) {
  Definition d;
  d.source = Source::input;
  d.width = d.data_count = static_cast<std::uint32_t>(initial.size());
  d.first_argument = static_cast<std::uint32_t>(arguments_.size());
  d.data = static_cast<std::uint32_t>(data_.size());
  data_.insert(data_.end(), initial.begin(), initial.end());
  values_.push_back(d);
  return whole(static_cast<std::uint32_t>(values_.size() - 1));
}

Operand Emitter::fold(Op op, std::span<const Operand> arguments, std::span<const double> table,
                      std::uint32_t width) {
  std::vector<Register> places;
  registers_.clear();
  for (const Operand& operand : arguments) {
    places.push_back({static_cast<std::uint32_t>(registers_.size() / kLanes), operand.width});
    for (const double number : numbers(operand))
      registers_.insert(registers_.end(), kLanes, number);
  }
  const Register out{static_cast<std::uint32_t>(registers_.size() / kLanes), width};
  registers_.resize(registers_.size() + static_cast<std::size_t>(width) * kLanes);
  row(op).kernel({registers_.data(), out, places.data(), static_cast<std::uint32_t>(places.size()),
                  table.data()});
  std::vector<double> results;
  for (std::uint32_t i = 0; i < width; ++i)
    results.push_back(registers_[static_cast<std::size_t>(out.row + i) * kLanes]);
  return constant(results);
}

Operand Emitter::emit(Op op, std::span<const Operand> arguments, std::span<const double> table,
                      std::uint32_t width, std::uint32_t node) {
  assert(row(op).arguments < 0 || row(op).arguments == static_cast<int>(arguments.size()));
  if (std::ranges::all_of(arguments, [&](const Operand& a) { return is_constant(a); }))
    return fold(op, arguments, table, width);
  if (const auto known = simplified(*this, op, arguments, node)) return *known;
  Definition d;
  d.source = Source::computed;
  d.op = op;
  d.width = width;
  d.first_argument = static_cast<std::uint32_t>(arguments_.size());
  d.argument_count = static_cast<std::uint32_t>(arguments.size());
  d.data = static_cast<std::uint32_t>(data_.size());
  d.data_count = static_cast<std::uint32_t>(table.size());
  d.node = node;
  arguments_.insert(arguments_.end(), arguments.begin(), arguments.end());
  data_.insert(data_.end(), table.begin(), table.end());
  values_.push_back(d);
  const Factor factor = factor_of_newest();
  const bool moderate = factor.number >= kLeastScale && factor.number <= kMostScale;
  values_.back().factor = moderate ? factor : Factor{};
  return whole(unify());
}

}  // namespace rigc::eval
