#pragma once

#include <algorithm>
#include <concepts>

#include "optimizer/journal/record_fields.hpp"
#include "studies/report/record/run_record.hpp"

/// The fields of all that a results file holds; see results_file.hpp. A name with a slash lies in a group further down,
/// an empty one in the group of its owner.
namespace dovetail::report {

template <class T, class... Others>
concept OneOf = (std::same_as<T, Others> || ...);

/// A field that is a table [rows, columns], row by row.
template <class R>
struct TableField {
  const char* name;
  Numbers R::*member;
  std::size_t (*columns)(const R&);
};

/// Lists of these are kept column by column, in one data set for each field; of others each has a group 0, 1, ...
template <class R>
inline constexpr bool kInColumns =
    OneOf<R, optimizer::DesignVariable, optimizer::ObjectiveTerm, optimizer::ResponseConstraint, optimizer::KeyChange,
          EvaluationRecord, geometry::Edge, fem::Region>;

}  // namespace dovetail::report

namespace dovetail::optimizer {

template <>
inline constexpr auto kFields<DesignVariable> =
    std::tuple{RecordField{"key", &DesignVariable::key}, RecordField{"lower", &DesignVariable::lower},
               RecordField{"upper", &DesignVariable::upper}, RecordField{"start", &DesignVariable::start},
               RecordField{"also", &DesignVariable::also, true}};

template <>
inline constexpr auto kFields<ObjectiveTerm> = std::tuple{RecordField{"response", &ObjectiveTerm::response},
                                                          RecordField{"weight", &ObjectiveTerm::weight},
                                                          RecordField{"scale", &ObjectiveTerm::scale},
                                                          RecordField{"absolute", &ObjectiveTerm::absolute},
                                                          RecordField{"accuracy", &ObjectiveTerm::accuracy, true},
                                                          RecordField{"target", &ObjectiveTerm::target, true},
                                                          RecordField{"over", &ObjectiveTerm::over, true},
                                                          RecordField{"reference", &ObjectiveTerm::reference, true}};

template <>
inline constexpr auto kFields<ResponseConstraint> =
    std::tuple{RecordField{"response", &ResponseConstraint::response},
               RecordField{"lower", &ResponseConstraint::lower},
               RecordField{"upper", &ResponseConstraint::upper},
               RecordField{"scale", &ResponseConstraint::scale},
               RecordField{"absolute", &ResponseConstraint::absolute},
               RecordField{"accuracy", &ResponseConstraint::accuracy, true},
               RecordField{"over", &ResponseConstraint::over, true}};

template <>
inline constexpr auto kFields<KeyChange> =
    std::tuple{RecordField{"key", &KeyChange::key}, RecordField{"value", &KeyChange::value},
               RecordField{"times", &KeyChange::times}};

template <>
inline constexpr auto kFields<LoadCase> =
    std::tuple{RecordField{"name", &LoadCase::name}, RecordField{"weight", &LoadCase::weight},
               RecordField{"sample_of", &LoadCase::sample_of}, RecordField{"changes", &LoadCase::changes}};

template <>
inline constexpr auto kFields<geometry::Edge> =
    std::tuple{RecordField{"name", &geometry::Edge::name},       RecordField{"start_m", &geometry::Edge::start},
               RecordField{"end_m", &geometry::Edge::end},       RecordField{"center_m", &geometry::Edge::center},
               RecordField{"radius_m", &geometry::Edge::radius}, RecordField{"sweep_rad", &geometry::Edge::sweep}};

template <>
inline constexpr auto kFields<geometry::Profile> =
    std::tuple{RecordField{"blade", &geometry::Profile::blade}, RecordField{"disk", &geometry::Profile::disk}};

template <>
inline constexpr auto kFields<fem::Region> = std::tuple{
    RecordField{"name", &fem::Region::name}, RecordField{"body", &fem::Region::body},
    RecordField{"plane_stress", &fem::Region::plane_stress}, RecordField{"thickness_m", &fem::Region::thickness}};

using report::ContactRecord, report::ResponseCurve, report::NodalDiameterRecord, report::FilletRecord,
    report::HistoryRecord, report::FieldRecord, report::DesignRecord, report::EvaluationRecord,
    report::VerificationRecord, report::FinerRecord, report::DepartureRecord, report::FrontRecord, report::Provenance,
    report::RunRecord, report::TableField;

template <>
inline constexpr auto kFields<ContactRecord> =
    std::tuple{RecordField{"flank_names", &ContactRecord::flank_names},
               RecordField{"flank", &ContactRecord::flank},
               RecordField{"along_m", &ContactRecord::along_m},
               RecordField{"across_m", &ContactRecord::across_m, true},
               RecordField{"x_m", &ContactRecord::x_m},
               RecordField{"y_m", &ContactRecord::y_m},
               RecordField{"area_m2", &ContactRecord::area_m2},
               RecordField{"gap_m", &ContactRecord::gap_m},
               RecordField{"preload_pressure_pa", &ContactRecord::preload_pressure_pa},
               RecordField{"wear_rate_m_per_cycle", &ContactRecord::wear_rate_m_per_cycle},
               RecordField{"slip_m_per_cycle", &ContactRecord::slip_m_per_cycle, true},
               RecordField{"depth_m", &ContactRecord::depth_m}};

template <>
inline constexpr auto kFields<ResponseCurve> =
    std::tuple{RecordField{"frequency_hz", &ResponseCurve::frequency_hz},
               RecordField{"amplitude_m", &ResponseCurve::amplitude_m}, RecordField{"status", &ResponseCurve::status}};

template <>
inline constexpr auto kFields<NodalDiameterRecord> =
    std::tuple{RecordField{"nodal_diameter", &NodalDiameterRecord::nodal_diameter},
               RecordField{"modes", &NodalDiameterRecord::modes},
               TableField<NodalDiameterRecord>{
                   "frequency_hz", &NodalDiameterRecord::frequency_hz,
                   [](const NodalDiameterRecord& record) { return static_cast<std::size_t>(record.modes); }},
               RecordField{"status", &NodalDiameterRecord::status}};

template <>
inline constexpr auto kFields<FilletRecord> = std::tuple{RecordField{"x_m", &FilletRecord::x_m},
                                                         RecordField{"y_m", &FilletRecord::y_m},
                                                         RecordField{"von_mises_pa", &FilletRecord::von_mises_pa},
                                                         RecordField{"name", &FilletRecord::name},
                                                         RecordField{"aggregate_pa", &FilletRecord::aggregate_pa},
                                                         RecordField{"maximum_pa", &FilletRecord::maximum_pa}};

template <>
inline constexpr auto kFields<HistoryRecord> =
    std::tuple{RecordField{"cycles", &HistoryRecord::cycles},
               RecordField{"worn_volume_m3", &HistoryRecord::worn_volume_m3},
               RecordField{"depth_max_m", &HistoryRecord::depth_max_m},
               RecordField{"amplitude_m", &HistoryRecord::amplitude_m},
               RecordField{"frequency_hz", &HistoryRecord::frequency_hz},
               RecordField{"profile_states", &HistoryRecord::profile_states},
               TableField<HistoryRecord>{"profile_depth_m", &HistoryRecord::profile_depth_m,
                                         [](const HistoryRecord& record) {
                                           return record.profile_depth_m.size() /
                                                  std::max<std::size_t>(record.profile_states.size(), 1);
                                         }},
               RecordField{"status", &HistoryRecord::status},
               RecordField{"end", &HistoryRecord::end}};

template <>
inline constexpr auto kFields<FieldRecord> =
    std::tuple{RecordField{"mesh", &FieldRecord::mesh},
               TableField<FieldRecord>{
                   "fields/displacement_m", &FieldRecord::displacement_m,
                   [](const FieldRecord& record) { return static_cast<std::size_t>(record.mesh.dimensions()); }},
               RecordField{"fields/von_mises_pa", &FieldRecord::von_mises_pa},
               RecordField{"fields/flank_nodes", &FieldRecord::flank_nodes, true},
               RecordField{"fields/flank_cells", &FieldRecord::flank_cells, true},
               RecordField{"fields/mode_frequency_hz", &FieldRecord::mode_frequency_hz, true},
               RecordField{"fields/mode_shapes", &FieldRecord::mode_shapes, true}};

template <>
inline constexpr auto kFields<DesignRecord> =
    std::tuple{RecordField{"parameters", &DesignRecord::parameters},
               RecordField{"responses", &DesignRecord::responses},
               RecordField{"error_estimates", &DesignRecord::error_estimates},
               RecordField{"status", &DesignRecord::status},
               RecordField{"profile", &DesignRecord::profile},
               RecordField{"profile/finished_blade", &DesignRecord::finished_blade},
               RecordField{"contact", &DesignRecord::contact},
               RecordField{"unworn", &DesignRecord::unworn},
               RecordField{"worn", &DesignRecord::worn},
               RecordField{"glued", &DesignRecord::glued},
               RecordField{"nodal_diameters", &DesignRecord::nodal_diameters},
               RecordField{"fillets", &DesignRecord::fillets},
               RecordField{"history", &DesignRecord::history},
               RecordField{"", &DesignRecord::fields},
               RecordField{"notes", &DesignRecord::notes}};

/// The first says how many there are.
template <>
inline constexpr auto kFields<EvaluationRecord> =
    std::tuple{RecordField{"phase", &EvaluationRecord::phase},
               RecordField{"x", &EvaluationRecord::x},
               RecordField{"status", &EvaluationRecord::status},
               RecordField{"feasible", &EvaluationRecord::feasible},
               RecordField{"objective", &EvaluationRecord::objective},
               RecordField{"violation", &EvaluationRecord::violation},
               RecordField{"constraints", &EvaluationRecord::constraints},
               RecordField{"seconds", &EvaluationRecord::seconds},
               RecordField{"messages", &EvaluationRecord::messages},
               RecordField{"responses", &EvaluationRecord::responses},
               RecordField{"error_estimates", &EvaluationRecord::error_estimates},
               RecordField{"rules", &EvaluationRecord::rules}};

/// Also a line of a run's verification.jsonl.
template <>
inline constexpr auto kFields<VerificationRecord> =
    std::tuple{RecordField{"evaluation", &VerificationRecord::evaluation},
               RecordField{"status", &VerificationRecord::status},
               RecordField{"follow", &VerificationRecord::follow},
               RecordField{"load_case", &VerificationRecord::load_case, true},
               RecordField{"flank_elements", &VerificationRecord::flank_elements},
               RecordField{"harmonics", &VerificationRecord::harmonics},
               RecordField{"samples", &VerificationRecord::samples},
               RecordField{"direct_solves", &VerificationRecord::direct_solves},
               RecordField{"history_solves", &VerificationRecord::history_solves},
               RecordField{"frequency_hz", &VerificationRecord::frequency_hz},
               RecordField{"search_volume_m3", &VerificationRecord::search_volume_m3},
               RecordField{"search_bar_m3", &VerificationRecord::search_bar_m3},
               RecordField{"search_depth_m", &VerificationRecord::search_depth_m},
               RecordField{"direct_volume_m3", &VerificationRecord::direct_volume_m3},
               RecordField{"direct_depth_m", &VerificationRecord::direct_depth_m},
               RecordField{"history_volume_m3", &VerificationRecord::history_volume_m3},
               RecordField{"history_depth_m", &VerificationRecord::history_depth_m},
               RecordField{"history_bar_m3", &VerificationRecord::history_bar_m3},
               RecordField{"profile_difference", &VerificationRecord::profile_difference},
               RecordField{"cycles", &VerificationRecord::cycles},
               RecordField{"seconds", &VerificationRecord::seconds},
               RecordField{"flank_names", &VerificationRecord::flank_names},
               RecordField{"flank", &VerificationRecord::flank},
               RecordField{"along_m", &VerificationRecord::along_m},
               RecordField{"across_m", &VerificationRecord::across_m, true},
               RecordField{"search_profile_m", &VerificationRecord::search_profile_m},
               RecordField{"direct_profile_m", &VerificationRecord::direct_profile_m},
               RecordField{"history_profile_m", &VerificationRecord::history_profile_m}};

template <>
inline constexpr auto kFields<DepartureRecord> = std::tuple{
    RecordField{"evaluation", &DepartureRecord::evaluation}, RecordField{"departure", &DepartureRecord::departure},
    RecordField{"status", &DepartureRecord::status}, RecordField{"objective", &DepartureRecord::objective},
    RecordField{"constraints", &DepartureRecord::constraints}};

template <>
inline constexpr auto kFields<FinerRecord> = std::tuple{
    RecordField{"evaluation", &FinerRecord::evaluation}, RecordField{"flank_elements", &FinerRecord::flank_elements},
    RecordField{"status", &FinerRecord::status}, RecordField{"constraints", &FinerRecord::constraints}};

template <>
inline constexpr auto kFields<FrontRecord> = std::tuple{
    RecordField{"objectives", &FrontRecord::objectives},
    RecordField{"evaluation", &FrontRecord::evaluation},
    TableField<FrontRecord>{"values", &FrontRecord::values, [](const FrontRecord& record) { return record.columns(); }},
    TableField<FrontRecord>{"bars", &FrontRecord::bars, [](const FrontRecord& record) { return record.columns(); }},
    RecordField{"ideal", &FrontRecord::ideal},
    RecordField{"reference", &FrontRecord::reference},
    RecordField{"hypervolume", &FrontRecord::hypervolume},
    RecordField{"compromise", &FrontRecord::compromise}};

/// Besides the study's text.
template <>
inline constexpr auto kFields<Provenance> = std::tuple{RecordField{"library", &Provenance::libraries},
                                                       RecordField{"option", &Provenance::options},
                                                       RecordField{"setting", &Provenance::settings, true},
                                                       RecordField{"linked", &Provenance::linked, true},
                                                       RecordField{"program_version", &Provenance::program_version},
                                                       RecordField{"date_utc", &Provenance::date_utc},
                                                       RecordField{"compiler", &Provenance::compiler},
                                                       RecordField{"study_file", &Provenance::study_file}};

template <>
inline constexpr auto kFields<RunRecord> = std::tuple{RecordField{"name", &RunRecord::name},
                                                      RecordField{"title", &RunRecord::title},
                                                      RecordField{"wear_law", &RunRecord::wear_law, true},
                                                      RecordField{"status", &RunRecord::status},
                                                      RecordField{"message", &RunRecord::message},
                                                      RecordField{"seconds", &RunRecord::seconds},
                                                      RecordField{"provenance", &RunRecord::provenance},
                                                      RecordField{"problem", &RunRecord::problem},
                                                      RecordField{"evaluations", &RunRecord::evaluations},
                                                      RecordField{"best", &RunRecord::best},
                                                      RecordField{"least_broken", &RunRecord::least_broken},
                                                      RecordField{"baseline", &RunRecord::baseline},
                                                      RecordField{"best", &RunRecord::best_design},
                                                      RecordField{"baseline", &RunRecord::baseline_design},
                                                      RecordField{"verifications", &RunRecord::verifications, true},
                                                      RecordField{"finer", &RunRecord::finer, true},
                                                      RecordField{"departures", &RunRecord::departures, true},
                                                      RecordField{"front", &RunRecord::front}};

}  // namespace dovetail::optimizer
