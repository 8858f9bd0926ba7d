#include "tests/unit/studies/report_sample.hpp"

#include <cmath>
#include <limits>

#include "geometry/profile/flank_form.hpp"

namespace dovetail::report {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

ResponseCurve curve(double peak_hz) {
  ResponseCurve result;
  for (int i = -5; i <= 5; ++i) {
    const bool failed = i == 4;
    result.frequency_hz.push_back(peak_hz + 0.3 * i);
    result.amplitude_m.push_back(failed ? kNaN : 7e-3 / std::hypot(1.0, i));
    result.status.emplace_back(failed ? "stalled" : "converged");
  }
  return result;
}

ContactRecord contact(const geometry::Profile& profile, double depth_um) {
  ContactRecord record;
  record.flank_names = {"left", "right"};
  constexpr int kNodes = 6;
  for (int flank = 0; flank < 2; ++flank) {
    const geometry::Edge& e = geometry::edge(profile.disk, flank == 0 ? "flank_left" : "flank_right");
    const Eigen::Vector2d neck = e.start.y() > e.end.y() ? e.start : e.end;
    const Eigen::Vector2d root = e.start.y() > e.end.y() ? e.end : e.start;
    for (int i = 0; i < kNodes; ++i) {
      const double s = i / (kNodes - 1.0);
      const Eigen::Vector2d at = (1 - s) * neck + s * root;
      record.flank.push_back(flank);
      record.along_m.push_back(s * e.length());
      record.across_m.push_back(0);
      record.x_m.push_back(at.x());
      record.y_m.push_back(at.y());
      record.area_m2.push_back(4e-5);
      record.gap_m.push_back(1e-5 * s);
      record.preload_pressure_pa.push_back(8e7 + 1e7 * flank * s);
      record.wear_rate_m_per_cycle.push_back(1e-12 * (1 - s));
      record.slip_m_per_cycle.push_back(1e-6 * (1 - s));
      record.depth_m.push_back(depth_um * 1e-6 * (1 - s) * (1 - s));
    }
  }
  return record;
}

}  // namespace

DesignRecord sample_design(double depth_um) {
  DesignRecord design;
  design.status = "converged";
  design.parameters = {{"geometry.flank_mismatch_um", 3.0}, {"loading.tip_force_n", 2.0}};
  design.responses = {{"asymptotic_wear_volume_m3", 1e-10 * depth_um}, {"resonance_hz", 490.123456789}};
  design.error_estimates = {{"asymptotic_wear_volume_m3", 1e-12}, {"resonance_hz", kInf}};
  const geometry::ProfileParameters parameters;
  design.profile = geometry::build_profile(parameters);
  design.finished_blade = geometry::finished_blade(parameters);
  design.contact = contact(design.profile, depth_um);
  design.unworn = curve(490.2);
  design.worn = curve(489.9);
  design.glued = curve(490.7);
  design.nodal_diameters = {.nodal_diameter = {0, 1, 2},
                            .modes = 2,
                            .frequency_hz = {490, 2000, 491, 2010, -3.0, kNaN},
                            .status = {"converged", "converged", "stalled"}};
  design.fillets = {{.name = "blade",
                     .x_m = {0.01, 0.011},
                     .y_m = {0.2, 0.201},
                     .von_mises_pa = {5e8, 4e8},
                     .aggregate_pa = 4.9e8,
                     .maximum_pa = 5e8}};
  design.history = HistoryRecord{.status = "converged",
                                 .end = "worn_out",
                                 .cycles = {0, 1e4, 1e6},
                                 .worn_volume_m3 = {0, 1e-11, 1e-10},
                                 .depth_max_m = {0, 1e-7, 1e-6},
                                 .amplitude_m = {7e-3, 6.9e-3, 6.5e-3},
                                 .frequency_hz = {490, 490, 490},
                                 .profile_states = {0, 2},
                                 .profile_depth_m = Numbers(24, 1e-7)};
  design.fields.mesh.nodes.resize(2, 6);
  design.fields.mesh.nodes << 0, 1, 0, 0.5, 0.5, 0, 0, 0, 1, 0, 0.5, 0.5;
  design.fields.mesh.connectivity = {0, 1, 2, 3, 4, 5};
  design.fields.mesh.region = {0};
  design.fields.mesh.regions = {{.name = "blade_root", .body = 0, .thickness = 0.04, .plane_stress = false}};
  design.fields.displacement_m = Numbers(12, 1e-5);
  design.fields.von_mises_pa = {1, 2, 3, 4, 5, 6};
  design.fields.flank_nodes = {2, 5};
  design.fields.flank_cells = {0, 7};
  design.fields.mode_frequency_hz = {490.5, 2000};
  design.fields.mode_shapes = Numbers(24, 0.5);
  design.notes = {"A note about <this> design."};
  return design;
}

RunRecord sample_record() {
  RunRecord record;
  record.name = "sample";
  record.title = "A sample & its <limits>";
  record.wear_law = "energy";
  record.status = "iteration_limit";
  record.message = "the budget of evaluations is used up";
  record.seconds = 12.5;
  record.problem.space =
      optimizer::DesignSpace({{.key = "geometry.flank_mismatch_um", .lower = -5, .upper = 25, .start = 0},
                              {.key = "geometry.neck_width_mm", .lower = 8, .upper = 9, .start = 8.5}});
  record.problem.objective = {{.response = "asymptotic_wear_volume_m3"}};
  record.problem.constraints = {{.response = "peak_amplitude_m", .lower = {}, .upper = 8e-3}};
  const auto evaluation = [](double volume, double amplitude, Numbers x) {
    EvaluationRecord e;
    e.x = std::move(x);
    e.phase = "cobyla";
    e.status = "converged";
    e.objective = volume;
    e.constraints = {(amplitude - 8e-3) / 8e-3};
    e.feasible = e.constraints.front() <= 0;
    e.violation = std::max(0.0, e.constraints.front());
    e.seconds = 1.5;
    e.responses = {{"asymptotic_wear_volume_m3", volume}, {"peak_amplitude_m", amplitude}};
    e.error_estimates = {{"asymptotic_wear_volume_m3", 0.02 * volume}};
    e.rules = {{"post_width_m", -0.4}};
    return e;
  };
  record.evaluations = {evaluation(8e-10, 7e-3, {0, 8.5}),
                        evaluation(2e-10, 9e-3, {20, 8.7}),
                        {},
                        evaluation(1e-10, 7.99e-3, {11.25, 9})};
  record.evaluations[0].phase = "start";
  EvaluationRecord& failed = record.evaluations[2];
  failed.x = {25, 8};
  failed.phase = "cobyla";
  failed.status = "infeasible";
  failed.objective = kNaN;
  failed.constraints = {kNaN};
  failed.violation = kInf;
  failed.rules = {{"post_width_m", 0.1}, {"neck_straight", -0.0}};
  failed.messages = {"The post is too thin & <breaks>.", "Another."};
  record.baseline = 0;
  record.best = 3;
  record.baseline_design = sample_design(5);
  record.best_design = sample_design(1);
  record.verifications = {{.evaluation = 1,
                           .status = "converged",
                           .follow = "fixed",
                           .load_case = "cruise",
                           .flank_elements = 32,
                           .harmonics = 11,
                           .samples = 256,
                           .direct_solves = 8,
                           .history_solves = 61,
                           .frequency_hz = 490.1,
                           .search_volume_m3 = 1.1e-10,
                           .search_bar_m3 = 1e-12,
                           .search_depth_m = 1.2e-6,
                           .direct_volume_m3 = 1.2e-10,
                           .direct_depth_m = 1.3e-6,
                           .history_volume_m3 = 1.206e-10,
                           .history_depth_m = 1.31e-6,
                           .history_bar_m3 = 2e-13,
                           .profile_difference = 0.01,
                           .cycles = 3e6,
                           .seconds = 4,
                           .flank_names = {"left", "right"},
                           .flank = {0, 0, 1, 1},
                           .along_m = {0, 5e-3, 0, 5e-3},
                           .across_m = {0, 0, 0, 0},
                           .search_profile_m = {1.2e-6, 0, 1.2e-6, 0},
                           .direct_profile_m = {1.3e-6, 0, 1.3e-6, 0},
                           .history_profile_m = {1.31e-6, 0, 1.31e-6, 0}}};
  record.departures = {{.evaluation = 3,
                        .departure = "friction -40 %",
                        .status = "converged",
                        .objective = 1.3e-10,
                        .constraints = {0.02}},
                       {.evaluation = 0,
                        .departure = "friction -40 %",
                        .status = "unworn_resonance: no_bracket",
                        .objective = kNaN,
                        .constraints = {kNaN}}};
  record.finer = {{.evaluation = 3, .flank_elements = 32, .status = "converged", .constraints = {-0.01}},
                  {.evaluation = 3, .flank_elements = 64, .status = "infeasible", .constraints = {kNaN}}};
  record.provenance = {.program_version = "0.1.0",
                       .date_utc = "2025-01-02T03:04:05Z",
                       .compiler = "g++ 12",
                       .libraries = {{"Eigen", "3.4.0"}},
                       .options = {{"algorithm", "cobyla"}, {"note", ""}},
                       .settings = {{"solver.modes", "8, handed over with 12"}},
                       .linked = {{"geometry.shank_width_mm", "geometry_neck_width_mm + 2.5"}},
                       .study_file = "study.toml",
                       .study_text = "# <script>alert('x')</script>\n[scene]\nname = \"\u00fc\"\n"};
  return record;
}

RunRecord sample_front() {
  RunRecord record = sample_record();
  record.problem.front = true;
  record.problem.objective = {{.response = "asymptotic_wear_volume_m3", .reference = 9e-10},
                              {.response = "peak_amplitude_m"}};
  record.front = FrontRecord{.objectives = {"asymptotic_wear_volume_m3", "peak_amplitude_m"},
                             .evaluation = {3, 0},
                             .values = {1e-10, 7.99e-3, 8e-10, 7e-3},
                             .bars = {2e-12, 1e-5, kNaN, kNaN},
                             .ideal = {1e-10, 7e-3},
                             .reference = {9e-10, 8e-3},
                             .hypervolume = 1.07e-13,
                             .compromise = 0};
  return record;
}

}  // namespace dovetail::report
