// SPDX-License-Identifier: MIT
// Looks descriptors and shapes up by name; built-in ones are made when first asked for, once.
// Test: tests/catalog/catalogue_test.cpp
#include "catalog/catalogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>

#include "base/codes.h"
#include "base/files.h"
#include "base/text.h"
#include "catalog/builtin.h"
#include "catalog/codes.h"

namespace rigc::catalog {
namespace {

constexpr std::uint64_t kLargestFile = 4u << 20;

template <class Data>
const Data* look_up(std::span<const Data> table, std::string_view Data::*key,
                    std::string_view name) {
  const auto found = std::lower_bound(
      table.begin(), table.end(), name,
      [key](const Data& data, std::string_view wanted) { return data.*key < wanted; });
  return found != table.end() && (*found).*key == name ? &*found : nullptr;
}

/// Things made so far, by name. Pointers to them stay good.
template <class Thing>
using Made = std::map<std::string, Thing, std::less<>>;

}  // namespace

struct Catalogue::State {
  std::mutex mutex;  // jobs share a catalogue
  Made<Descriptor> descriptors;
  Made<Shape> shapes;
  std::vector<std::string> added;

  template <class Thing, class Data>
  const Thing* find(Made<Thing>& made, std::span<const Data> table, std::string_view Data::*key,
                    std::string_view name) {
    const std::lock_guard lock(mutex);
    if (const auto found = made.find(name); found != made.end()) return &found->second;
    const Data* data = look_up(table, key, name);
    return data ? &made.emplace(name, builtin::make(*data)).first->second : nullptr;
  }
};

Catalogue::Catalogue() : state_(std::make_unique<State>()) {}
Catalogue::~Catalogue() = default;
Catalogue::Catalogue(Catalogue&&) noexcept = default;
Catalogue& Catalogue::operator=(Catalogue&&) noexcept = default;

const Descriptor* Catalogue::find(std::string_view module) const {
  return state_->find(state_->descriptors, builtin::modules(), &builtin::ModuleData::module,
                      module);
}

const Shape* Catalogue::find_shape(std::string_view name) const {
  return state_->find(state_->shapes, builtin::shapes(), &builtin::ShapeData::name, name);
}

std::vector<std::string> Catalogue::modules() const {
  std::vector<std::string> names = state_->added;
  for (const builtin::ModuleData& data : builtin::modules()) names.emplace_back(data.module);
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> Catalogue::shapes() const {
  std::vector<std::string> names;
  for (const builtin::ShapeData& data : builtin::shapes()) names.emplace_back(data.name);
  return names;
}

bool Catalogue::add_folder(const std::string& path, Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.errors();
  if (!folder_exists(path)) {
    diagnostics.report(rigc::codes::kCannotRead, Place(path),
                       "the folder of modules does not exist");
    return false;
  }
  for (const std::string& name : list_folder(path)) {
    if (!ends_with(name, ".yaml")) continue;
    const std::string file = join_path(path, name);
    auto text = read_file(file, kLargestFile, diagnostics);
    if (!text) continue;
    const std::uint32_t source = diagnostics.sources().add(file, std::move(*text));
    auto descriptor = read_descriptor(source, diagnostics);
    if (!descriptor) continue;
    const std::string module = descriptor->module;
    if (find(module)) {
      diagnostics.report(codes::kDuplicateModule, Span{source, 1, 1, 1},
                         fmt::format("module {} exists already", module),
                         "give the added module another name");
      continue;
    }
    state_->descriptors.emplace(module, std::move(*descriptor));
    state_->added.push_back(module);
  }
  return diagnostics.errors() == errors;
}

}  // namespace rigc::catalog
