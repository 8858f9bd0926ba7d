#include "studies/program/study_file/study_template.hpp"

#include <string_view>
#include <utility>

#include "optimizer/problem/optimizer_options.hpp"
#include "optimizer/responses/response_table.hpp"
#include "optimizer/scene/scene.hpp"
#include "optimizer/scene/scene_kind.hpp"
#include "studies/program/study_file/export.hpp"
#include "studies/program/study_file/key_words.hpp"

namespace dovetail::studies {
namespace {

using optimizer::Scene;

template <class S>
std::string value_text(const S& object, const Field<S>& field) {
  if (const std::optional<std::string> text = text_in(object, field)) return '"' + *text + '"';
  if (const auto* truth = std::get_if<bool S::*>(&field.member)) return object.*(*truth) ? "true" : "false";
  if (const auto* whole = std::get_if<int S::*>(&field.member)) return std::to_string(object.*(*whole));
  return shortest(value_in_file_unit(object, field));
}

std::string joined(const std::vector<std::string_view>& words) {
  std::string text;
  for (const std::string_view word : words) {
    if (!text.empty()) text += " | ";
    text += word;
  }
  return text;
}

/// "mm, > 0 and <= 1000, required": what the key may be.
template <class S>
std::string allowed(const Field<S>& field) {
  std::vector<std::string> parts;
  if (const std::string unit = unit_of_key(field.key); !unit.empty()) parts.push_back(unit);
  if (!choices_of(field).empty()) parts.push_back(joined(choices_of(field)));
  const bool number = !is_text(field) && !std::holds_alternative<bool S::*>(field.member);
  if (number && (std::isfinite(field.range.lower) || std::isfinite(field.range.upper)))
    parts.push_back(field.range.phrase().substr(std::string("must be ").size()));
  if (field.required) parts.push_back("required");
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

// Given, it would not be chosen for the study any more.
constexpr std::string_view kChosen = "prestress";

/// Comment and assignment of each field; `mark` is put before the assignment ("# " leaves it to its default).
template <class S>
std::string lines(const S& object, std::span<const Field<S>> fields, const std::string& mark = "") {
  std::string text;
  for (const Field<S>& field : fields) {
    const std::string may_be = allowed(field);
    text += "# " + capitalised(field.help) + (field.help.ends_with('.') ? "" : ".") +
            (may_be.empty() ? "" : " (" + may_be + ")") + "\n";
    text += (field.key == kChosen ? "# " : mark) + std::string(field.key) + " = " + value_text(object, field) + "\n";
  }
  return text;
}

std::string header(const std::string& section, const std::string& comment) {
  return "\n# " + comment + "\n[" + section + "]\n";
}

std::string header(const std::string& section) {
  return header(section, std::string(key_words(section).words));
}

/// What differs from the defaults, which are those of a section.
Scene scene_of(Template kind) {
  Scene scene;
  if (kind != Template::sector) return scene;
  // Those of a section would make some 400 000 unknowns.
  scene.kind = &optimizer::kSector;
  for (const auto& [key, value] :
       {std::pair{"mesh.flank_elements", 8.0}, std::pair{"mesh.fillet_fraction", 0.5},
        std::pair{"mesh.bulk_size_mm", 10.0}, std::pair{"mesh.aerofoil_elements", 10.0},
        std::pair{"mesh.blend_fraction", 0.8}, std::pair{"mesh.growth", 0.4}, std::pair{"mesh.slot_elements", 8.0}})
    optimizer::set_parameter(scene, key, value);
  return scene;
}

std::string scene_sections(Template kind) {
  Scene scene = scene_of(kind);
  scene.disk = scene.blade;
  const auto flanks = option_table<geometry::FlankParameters>();
  std::string text = header("scene");
  text += lines(type_of(scene), option_table<optimizer::SceneType>()) +
          lines(scene.loading, optimizer::scene_loading_fields());
  text += header("geometry");
  text += lines(scene.geometry, option_table<geometry::ProfileParameters>());
  text += "\n# What only a sector in space has; a plane section leaves it aside.\n";
  text += lines(scene.solid, option_table<geometry::SolidParameters>());
  text += "\n# Both flanks; a section [geometry.left] or [geometry.right] with the same keys overrides one of them.\n";
  text += lines(scene.geometry.flanks.front(), flanks);
  text += header("limits");
  text += lines(scene.limits, option_table<geometry::FeasibilityLimits>());
  text += header("material.blade",
                 "Ti-6Al-4V, annealed. Instead of numbers, or before some of them: grade = \"NAME\" (see `dovetail "
                 "materials`).\n# The disk's material is the blade's unless [material.disk] differs.");
  text += lines(scene.blade, option_table<fem::Material>());
  text += "\n[material.disk]\n" + lines(scene.disk, option_table<fem::Material>(), "# ");
  text += header("contact");
  optimizer::visit_contact_tables(scene.contact,
                                  [&]<class S>(std::string_view, const S& object, std::span<const Field<S>> fields) {
                                    text += lines(object, fields);
                                  });
  text += header("loading");
  text += lines(scene.loading, optimizer::loading_fields());
  text += header("mesh");
  text += lines(scene.mesh, option_table<geometry::MeshSizes>());
  text += "\n# Along the slot, and of the contact on it.\n";
  text += lines(scene.solid_mesh, option_table<geometry::SolidSizes>());
  text += header("solver");
  text += lines(scene.solver, option_table<optimizer::SolverSettings>());
  return text;
}

std::string response_list() {
  std::string text;
  for (const std::string& name : optimizer::response_names())
    text += "#   " + name + ": " + std::string(optimizer::find_response(name)->help) + "\n";
  return text;
}

constexpr std::string_view kVariables = R"(
# What the optimiser may change: any real number above by its dotted key, between two bounds in the key's unit. It
# starts from the value above, or from `start` if given.
[[variable]]
key = "geometry.flank_mismatch_um"
lower = -5
upper = 25
# start = 0

[[variable]]
key = "geometry.flank_crown_um"
lower = -3
upper = 10

[[variable]]
key = "geometry.neck_width_mm"
lower = 8
upper = 9.5

# Several keys may have one value: keys = ["...", "..."] in place of `key`. Or follow from the variables by a formula of
# their keys, with '_' in place of '.': + - * / ^, sqrt, sin (of rad), min, max, a < b ? c : d, ...
# [[linked]]
# key = "geometry.shank_width_mm"
# value = "geometry_neck_width_mm + 2.5"
)";

constexpr std::string_view kCases = R"(
# Several loads: what is different in each, by the dotted keys in quotes, and its share of the blade's life. Without
# cases there is the one load above.
[[case]]
name = "cruise"
weight = 4

[[case]]
name = "climb"
"scene.speed_rpm" = 10500
"loading.tip_force_n" = 3
)";

constexpr std::string_view kUncertain = R"(
# What is not known for certain is looked at in samples of every case: a range (lower, upper), plus_minus in the key's
# unit, or relative, a share of it; distribution = "normal" takes these two as its deviation.
[[uncertain]]
key = "contact.friction"
lower = 0.4
upper = 0.6

[[uncertain]]
key = "geometry.flank_mismatch_um"
plus_minus = 3

# Where: at all "corners" of the ranges and in the middle, at `points` of a "sobol" sequence or of "gauss" rules, or
# nowhere ("nominal").
[robust]
rule = "corners"
)";

/// The lines, each a comment.
std::string commented(std::string_view lines) {
  std::string text;
  bool begins = true, comment = false;
  for (const char c : lines) {
    if (begins) comment = c == '#' || c == '\n';
    if (begins && !comment) text += "# ";
    begins = c == '\n';
    text += c;
  }
  return text;
}

constexpr std::string_view kObjectiveWords = R"(
# What is wanted. One [[objective]] is minimised. Of several with a `weight` the sum of weight * response / scale is. Of
# several without weight a front is found, the designs that no other beats in all of them; `reference` says beyond
# which value of the response a design counts nothing for its hypervolume (if not given the worst feasible one of start
# and scan). `aim` may be "min" (if not given), "max", "zero" or a number to come near to. Objectives and limits count the worst case unless they say
# over = "mean", "sum" or the name of one.
# The responses, SI units:
)";

constexpr std::string_view kObjective = R"([[objective]]
response = "asymptotic_wear_volume_m3"
weight = 1
# scale = 1e-9
)";

constexpr std::string_view kFront = R"([[objective]]
response = "asymptotic_wear_volume_m3"
reference = 1e-9

[[objective]]
response = "mass_kg"
)";

constexpr std::string_view kLimits = R"(
# What has to hold: an upper or a lower limit on a response, or both, in its SI unit. How far it is broken counts over
# the limit, or over `scale`, which a limit of 0 needs.
[[constraint]]
response = "contact_pressure_mean_pa"
upper = 300e6
# scale = 300e6

[[constraint]]
response = "post_width_m"
lower = 4e-3
)";

std::string problem_sections(Template kind) {
  const bool robust = kind == Template::robust;
  std::string text(kVariables);
  text += robust ? std::string(kCases) : commented(kCases);
  if (robust) text += kUncertain;
  text += std::string(kObjectiveWords) + response_list();
  text += kind == Template::front ? kFront : kObjective;
  return text.append(kLimits);
}

optimizer::OptimizerOptions optimizer_of(Template kind) {
  optimizer::OptimizerOptions options;
  if (kind == Template::front) options.algorithm = optimizer::Algorithm::nsga2;
  return options;
}

}  // namespace

std::string capitalised(std::string_view help) {
  std::string text(help);
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::string study_template(const std::string& title, Template kind) {
  std::string text =
      "# A study of dovetail. Check it with `dovetail check`, compute the design it describes with `dovetail "
      "evaluate`,\n"
      "# optimise with `dovetail run`. Every key ends with the unit it is written in. Keys marked `required` must be\n"
      "# given; all others may be left out and then have the value shown here.\n"
      "title = \"" +
      title +
      "\"\n# Folder of its results below `results`, where `run` is given none (if not given, the name of this file).\n"
      "# name = \"mine\"\n";
  text += scene_sections(kind) + problem_sections(kind);
  text += header("optimizer");
  text += lines(optimizer_of(kind), option_table<optimizer::OptimizerOptions>());
  text += header("export", std::string(key_words("export").words) + " Formats: " + export_formats() + ".");
  text += "formats = [\"dxf\"]\n";
  return text;
}

}  // namespace dovetail::studies
