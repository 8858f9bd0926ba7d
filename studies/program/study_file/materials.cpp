#include "studies/program/study_file/materials.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace dovetail::studies {

namespace {

constexpr std::array<NamedMaterial, 5> kMaterials{{
    {.name = "Ti-6Al-4V",
     .at_20_c = {.youngs_modulus = 114e9, .poisson_ratio = 0.33, .density = 4430},
     .source = "annealed; Materials Properties Handbook: Titanium Alloys, ASM International 1994"},
    {.name = "Ti-6Al-2Sn-4Zr-2Mo",
     .at_20_c = {.youngs_modulus = 114e9, .poisson_ratio = 0.325, .density = 4540},
     .source = "duplex annealed; Materials Properties Handbook: Titanium Alloys, ASM International 1994"},
    {.name = "Inconel 718",
     .at_20_c = {.youngs_modulus = 200e9, .poisson_ratio = 0.294, .density = 8220},
     .source = "aged; Special Metals, publication SMC-045"},
    {.name = "17-4PH",
     .at_20_c = {.youngs_modulus = 196e9, .poisson_ratio = 0.272, .density = 7800},
     .source = "condition H900; AK Steel, product data sheet 17-4 PH"},
    {.name = "X20Cr13",
     .at_20_c = {.youngs_modulus = 215e9, .poisson_ratio = 0.3, .density = 7700},
     .source = "quenched and tempered; EN 10088-1, which gives no Poisson ratio"},
}};

bool same_letters(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  return std::ranges::equal(a, b, {}, lower, lower);
}

}  // namespace

std::span<const NamedMaterial> named_materials() {
  return kMaterials;
}

const NamedMaterial* find_material(std::string_view name) {
  const auto found =
      std::ranges::find_if(kMaterials, [name](const NamedMaterial& one) { return same_letters(one.name, name); });
  return found == kMaterials.end() ? nullptr : &*found;
}

}  // namespace dovetail::studies
