#include "studies/program/study_file/key_words.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "contact/wear_law.hpp"

namespace dovetail::studies {
namespace {

constexpr std::string_view kOfKey = "that of the key", kOfResponse = "that of the response";

constexpr auto kWords = std::to_array<KeyWords>({
    {"name", "Name of the study, and of its directory of results where none is given."},
    {"title", "Title of the report."},
    {"scene", "What is modelled and how it vibrates."},
    {"geometry", "Dimensions of the section of one sector; x is tangential, y radial."},
    {"geometry.left", "What the left flank has otherwise than both."},
    {"geometry.right", "What the right flank has otherwise than both."},
    {"limits", "Rules every design has to keep besides fitting together."},
    {"material.blade", "Of the blade, and of the disk where that has none of its own."},
    {"material.blade.grade", "Name of a material, in place of the numbers or before some of them."},
    {"material.disk", "Of the disk; what is not given is as of the blade."},
    {"material.disk.grade", "Name of a material, in place of the numbers or before some of them."},
    {"contact", "Friction and wear on the flanks."},
    {"loading", "What excites the blade, besides the rotation."},
    {"mesh", "Sizes of the finite elements."},
    {"solver", "Sizes and tolerances of the contact computation."},
    {"optimizer", "How the optimiser searches."},
    {"robust", "Where uncertain numbers are looked at."},
    {"variable", "What may change: numbers of the file between bounds."},
    {"variable.key", "The number that changes, by its dotted path in the file."},
    {"variable.keys", "Several numbers that have one value, in place of key."},
    {"variable.lower", "Least value.", kOfKey},
    {"variable.upper", "Largest value.", kOfKey},
    {"variable.start", "Where the search starts; if not given, the file's number.", kOfKey},
    {"linked", "Keys that follow from the variables by a formula."},
    {"linked.key", "The key that follows."},
    {"linked.value", "A formula of the variables' keys, with _ in place of the dots."},
    {"objective", "What counts: one response, or several."},
    {"objective.response", "The response."},
    {"objective.weight", "Given for each of several: one sum of weight * response / scale is minimised."},
    {"objective.scale", "What counts as one.", kOfResponse},
    {"objective.reference", "Of a front: beyond it a design counts nothing for the hypervolume.", kOfResponse},
    {"objective.absolute", "Its size counts, whatever its sign."},
    {"objective.aim", "Whether it is to be small, large, zero or near to a number.", kOfResponse},
    {"objective.over", "How several cases count: worst, mean, sum, deviation, quantile, or the name of one."},
    {"objective.accuracy", "Bar over value asked for this response, in place of solver.accuracy."},
    {"constraint", "Limits on responses."},
    {"constraint.response", "The response."},
    {"constraint.lower", "It is to be no less.", kOfResponse},
    {"constraint.upper", "It is to be no more.", kOfResponse},
    {"constraint.scale", "How far a limit is broken counts over this; if not given, over the limit.", kOfResponse},
    {"constraint.absolute", "The limit is on its size, whatever its sign."},
    {"constraint.over", "How several cases count: worst, mean, sum, deviation, quantile, or the name of one."},
    {"constraint.accuracy", "Bar over value asked for this response, in place of solver.accuracy."},
    {"case", "Several loads: what is different in each, by keys of the file in quotes."},
    {"case.name", "Name of the case."},
    {"case.weight", "Its share of the blade's life."},
    {"uncertain", "Numbers that are not known for certain; one of: lower and upper, plus_minus, relative."},
    {"uncertain.key", "The number that is not certain."},
    {"uncertain.distribution", "Even in the range, or normal with plus_minus or relative as its deviation."},
    {"uncertain.lower", "Least value.", kOfKey},
    {"uncertain.upper", "Largest value.", kOfKey},
    {"uncertain.plus_minus", "Half of the range about the file's number; of a variable about the design's.", kOfKey},
    {"uncertain.relative", "Half of the range as a share of that number."},
    {"uncertain.mean", "With plus_minus: the middle, in place of the file's number.", kOfKey},
    {"export", "Files of the best design that a run writes besides its results."},
    {"export.formats", "Their formats."},
});

constexpr auto kEndings = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"_n_per_m3", "N/m^3"},
    {"_kg_m3", "kg/m^3"},
    {"_n_per_m", "N/m"},
    {"_gpa", "GPa"},
    {"_rpm", "1/min"},
    {"_deg", "degrees"},
    {"_mm", "mm"},
    {"_um", "um"},
    {"_hz", "Hz"},
    {"_n", "N"},
    {"_s", "s"},
});

}  // namespace

KeyWords key_words(std::string_view path) {
  const auto found = std::ranges::find(kWords, path, &KeyWords::path);
  return found == kWords.end() ? KeyWords{} : *found;
}

std::string unit_of_key(std::string_view key) {
  if (const contact::WearParameter* wear = contact::find_wear_parameter(key)) return std::string(wear->unit);
  for (const auto& [ending, unit] : kEndings)
    if (key.ends_with(ending)) return std::string(unit);
  return {};
}

}  // namespace dovetail::studies
