// SPDX-License-Identifier: MIT
// The catalogue: every descriptor and shape that this run of rigc knows; built-in ones are compiled
// in and made when first asked for. Test: tests/catalog/catalogue_test.cpp
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "catalog/descriptor.h"
#include "catalog/shape.h"

namespace rigc::catalog {

class Catalogue {
 public:
  Catalogue();  ///< the built-in modules and shapes
  ~Catalogue();
  Catalogue(Catalogue&&) noexcept;
  Catalogue& operator=(Catalogue&&) noexcept;

  /// Adds every *.yaml of a folder (--modules, RIGC_MODULES), sorted by name; a name that exists
  /// already is an error.
  bool add_folder(const std::string& path, Diagnostics& diagnostics);

  const Descriptor* find(std::string_view module) const;
  const Shape* find_shape(std::string_view name) const;
  std::vector<std::string> modules() const;  ///< names, sorted
  std::vector<std::string> shapes() const;   ///< names, sorted

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rigc::catalog
