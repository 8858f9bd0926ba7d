// The tables of the structs of a scene that have no room of their own.
#include "optimizer/scene/scene_kind.hpp"

#include <array>
#include <map>
#include <numbers>

namespace dovetail {

/// What a study file may choose from.
template <class Kind>
static std::vector<std::string_view> names_of(std::span<const Kind* const> kinds) {
  std::vector<std::string_view> names;
  for (const Kind* kind : kinds) names.push_back(kind->name);
  return names;
}

template <>
std::span<const Field<fem::Material>> option_table<fem::Material>() {
  using M = fem::Material;
  static const std::array<Field<M>, 3> table{
      Field<M>{.key = "youngs_modulus_gpa",
               .member = &M::youngs_modulus,
               .si_per_unit = 1e9,
               .range = kPositive,
               .help = "Young's modulus"},
      Field<M>{.key = "poisson_ratio",
               .member = &M::poisson_ratio,
               .range = {.lower = 0, .upper = 0.5, .upper_open = true},
               .help = "Poisson's ratio"},
      Field<M>{.key = "density_kg_m3", .member = &M::density, .range = kPositive, .help = "mass density"}};
  return table;
}

// The softest asperities would give way by a tenth of a metre under 100 MPa. Springs much stiffer than the upper end
// are rigid, and lose the structure's own stiffness to rounding.
constexpr Range kInterface{.lower = 1e9, .upper = 1e20, .zero = "rigid"};

template <>
std::span<const Field<optimizer::ContactProperties>> option_table<optimizer::ContactProperties>() {
  using C = optimizer::ContactProperties;
  static const std::string laws = [] {
    std::string text = "what wears";
    for (const contact::WearLaw* law : contact::wear_laws())
      text += "; " + std::string(law->name) + ": " + std::string(law->meaning);
    return text;
  }();
  static const std::array<Field<C>, 4> table{
      Field<C>{.key = "friction",
               .member = &C::friction,
               .range = {.lower = 0, .upper = 2},
               .help = "Coulomb coefficient of friction of the flanks"},
      Field<C>{.key = "wear_law", .member = &C::wear_law, .help = laws, .choices = names_of(contact::wear_laws())},
      Field<C>{.key = "normal_stiffness_n_per_m3",
               .member = &C::normal_stiffness,
               .range = kInterface,
               .help = "of rough flanks, in series with their contact"},
      Field<C>{.key = "tangential_stiffness_n_per_m3",
               .member = &C::tangential_stiffness,
               .range = kInterface,
               .help = "the same along the flanks; 0: rigid"}};
  return table;
}

template <>
std::span<const Field<optimizer::Loading>> option_table<optimizer::Loading>() {
  using L = optimizer::Loading;
  static const std::array<Field<L>, 6> table{
      Field<L>{.key = "speed_rpm",
               .member = &L::speed,
               .si_per_unit = std::numbers::pi / 30,
               .range = kPositive,
               .help = "rotation speed, revolutions per minute",
               .required = true},
      Field<L>{.key = "nodal_diameter",
               .member = &L::nodal_diameter,
               .range = kNonNegative,
               .help = "nodal diameters of the vibration around the disk"},
      Field<L>{.key = "mode",
               .member = &L::mode,
               .range = {.lower = 1, .upper = 100},
               .help = "which mode of that nodal diameter is excited, counted from 1 (glued flanks)"},
      Field<L>{.key = "tip_force_n",
               .member = &L::tip_force,
               .range = kPositive,
               .help = "amplitude of the tangential force on the aerofoil's tip",
               .required = true},
      Field<L>{.key = "damping_ratio",
               .member = &L::damping_ratio,
               .range = {.lower = 0, .upper = 1, .lower_open = true, .upper_open = true},
               .help = "modal damping ratio, friction not counted"},
      Field<L>{.key = "follow",
               .member = &L::follow,
               .help = "what drives the wear; fixed: the unworn resonance, resonance: that of the joint as it wears"}};
  return table;
}

template <>
std::span<const Field<optimizer::SolverSettings>> option_table<optimizer::SolverSettings>() {
  using S = optimizer::SolverSettings;
  static const std::array<Field<S>, 14> table{
      Field<S>{.key = "harmonics",
               .member = &S::harmonics,
               .range = {.lower = 1, .upper = 200},
               .help = "harmonics of the periodic motion"},
      Field<S>{.key = "samples",
               .member = &S::samples,
               .range = {.lower = 8, .upper = 65536},
               .help = "instants per period at which the contact is marched"},
      Field<S>{.key = "modes",
               .member = &S::modes,
               .range = {.lower = 1, .upper = 500},
               .help = "free-interface modes kept in the reduced model"},
      Field<S>{.key = "tolerance",
               .member = &S::tolerance,
               .range = {.lower = 1e-14, .upper = 1e-2},
               .help = "relative residual at which a steady state counts as converged"},
      Field<S>{.key = "solver",
               .member = &S::solver,
               .help = "algorithm for the nonlinear equations; auto: Newton, then other pseudo-penalties and "
                       "neighbouring problems where it fails; powell: hybrid Powell with the exact Jacobian; "
                       "powell_fd: with finite differences, for comparison"},
      Field<S>{.key = "pseudo_penalty_n_per_m",
               .member = &S::pseudo_penalty,
               .range = kNonNegative,
               .help = "pseudo-penalty of all contact nodes; 0: from the model, the local contact stiffness"},
      Field<S>{.key = "pseudo_penalty_normal_n_per_m",
               .member = &S::pseudo_penalty_normal,
               .range = kNonNegative,
               .help = "pseudo-penalty in the normal direction alone; 0: that of all contact nodes"},
      Field<S>{.key = "resonance_tolerance",
               .member = &S::resonance_tolerance,
               .range = {.lower = 1e-8, .upper = 1e-4},
               .help = "relative accuracy of the frequency of a resonance"},
      Field<S>{.key = "history_tolerance",
               .member = &S::history_tolerance,
               .range = {.lower = 1e-6, .upper = 1e-2},
               .help = "local error per step of the wear history that settles a doubtful worn state, relative to the "
                       "largest depth; part of its error bars where it decides"},
      Field<S>{.key = "prestress",
               .member = &S::prestress,
               .help =
                   "how the stress of the preload stiffens the vibrating structure; own: assembled for each design and "
                   "case, cases: for each design, with one friction for all cases: that of the first (of the middle of "
                   "its range where friction is a variable), shared: that of flanks without gaps for all designs with "
                   "one mesh, with what a design's own adds to first order. Unless given shared where no variable "
                   "changes the mesh; cases where that halves the matrices of a design and friction is no variable; "
                   "shared where that leaves a third of them; else own. Sectors too large to be shared assemble their "
                   "own"},
      Field<S>{.key = "accuracy",
               .member = &S::accuracy,
               .range = {.lower = kAccuracyRange.lower, .upper = kAccuracyRange.upper, .zero = "as given"},
               .help = "bar over value of every response that objective and limits name, for which those of mesh, "
                       "harmonics, samples, modes, resonance_tolerance and history_tolerance are chosen that the file "
                       "does not give; "
                       "0: all stay as given"},
      Field<S>{.key = "accuracy_work",
               .member = &S::accuracy_work,
               .range = kNonNegative,
               .help = "work up to which another round of choosing settings for an accuracy begins, in evaluations "
                       "without bars at the file's settings (the bars of each round come on top); 0: no limit"},
      Field<S>{.key = "max_jacobians",
               .member = &S::max_jacobians,
               .range = kNonNegative,
               .help = "work of one evaluation, in Jacobians of all contact nodes at these harmonics; 0: no limit"},
      Field<S>{.key = "time_limit_s",
               .member = &S::time_limit,
               .range = kNonNegative,
               .help = "seconds for the contact of one evaluation; repeated runs may then differ; 0: none"}};
  return table;
}

template <>
std::span<const Field<optimizer::SceneType>> option_table<optimizer::SceneType>() {
  using S = optimizer::SceneType;
  static const std::string help = [] {
    std::string text = "what is modelled";
    for (const optimizer::SceneKind* kind : optimizer::scene_kinds())
      text += (text.find(';') == text.npos ? "; " : ", ") + std::string(kind->name) + ": " + std::string(kind->meaning);
    return text;
  }();
  static const std::array<Field<S>, 1> table{Field<S>{.key = "type",
                                                      .member = &S::type,
                                                      .help = help,
                                                      .required = true,
                                                      .choices = names_of(optimizer::scene_kinds())}};
  return table;
}

}  // namespace dovetail

namespace dovetail::optimizer {

std::span<const Field<contact::WearNumbers>> wear_fields(const contact::WearLaw& law) {
  using Fields = std::vector<Field<contact::WearNumbers>>;
  static const std::map<std::string_view, Fields> tables = [] {
    std::map<std::string_view, Fields> fields;
    for (const contact::WearLaw* of : contact::wear_laws())
      for (const contact::WearParameter& p : of->parameters) {
        const Field<contact::WearNumbers> field{.key = p.key, .member = p.number, .range = p.range, .help = p.help};
        fields[of->name].push_back(field);
      }
    return fields;
  }();
  return tables.at(law.name);
}

std::span<const SceneKind* const> scene_kinds() {
  static constexpr std::array kKinds{&kSection, &kSector};
  return kKinds;
}

const SceneKind* find_scene_kind(std::string_view name) {
  for (const SceneKind* kind : scene_kinds())
    if (kind->name == name) return kind;
  return nullptr;
}

}  // namespace dovetail::optimizer
