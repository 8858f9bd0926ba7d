#pragma once

#include <span>
#include <string_view>

#include "fem/material.hpp"

namespace dovetail::studies {

/// A material that a study may name instead of giving its numbers.
struct NamedMaterial {
  std::string_view name;
  fem::Material at_20_c;
  std::string_view source;
};

/// Those of blades and disks that are known by name.
[[nodiscard]] std::span<const NamedMaterial> named_materials();

/// Whatever the case of its letters; null: none of that name.
[[nodiscard]] const NamedMaterial* find_material(std::string_view name);

}  // namespace dovetail::studies
