#include "geometry/exports/inp.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

#include "core/errors.hpp"
#include "core/replace_file.hpp"
#include "geometry/exports/inp_layer.hpp"
#include "geometry/exports/inp_mesh.hpp"
#include "geometry/exports/millimetres.hpp"

namespace dovetail::geometry {

namespace {

constexpr double kMegapascal = 1e-6;       // per Pa
constexpr double kTonnePerMm3 = 1e-12;     // per kg/m^3
constexpr double kMegapascalPerMm = 1e-9;  // per Pa/m
constexpr double kCutTolerance = 1e-3;     // distance of cyclic images by the width of the sector at the bore

[[noreturn]] void refuse(const std::string& key, const std::string& value, const std::string& allowed) {
  throw InputError({.file = {}, .key = key, .value = value, .allowed = allowed});
}

/// Whether the section has to be written in space.
bool needs_layer(const fem::SectorMesh& sector, const InpOptions& options) {
  return sector.mesh.dimensions() == 2 && options.cyclic_symmetry &&
         std::any_of(options.nodal_diameters.begin(), options.nodal_diameters.end(), [](int n) { return n > 0; });
}

void require_options(const fem::SectorMesh& sector, std::span<const fem::Material> materials,
                     const InpOptions& options) {
  const auto positive = [](const char* key, double value) {
    if (!(value > 0) || !std::isfinite(value)) refuse(key, fmt::format("{}", value), "must be > 0");
  };
  for (const fem::Region& region : sector.mesh.regions)
    if (region.body < 0 || region.body >= static_cast<int>(materials.size()))
      refuse("materials", std::to_string(materials.size()), "must have one material for each body of the mesh");
  if (!(options.friction >= 0) || !std::isfinite(options.friction))
    refuse("friction", fmt::format("{}", options.friction), "must be >= 0");
  if (!(options.speed >= 0) || !std::isfinite(options.speed))
    refuse("speed", fmt::format("{}", options.speed), "must be >= 0");
  for (const fem::Region& region : sector.mesh.regions)
    if (region.plane_stress && needs_layer(sector, options))
      refuse("nodal_diameters", std::to_string(options.nodal_diameters.back()),
             "must be 0 for a section with plane-stress regions");
  positive("contact_stiffness", options.contact_stiffness);
  positive("stick_stiffness", options.stick_stiffness);
  if (options.increments < 1) refuse("increments", std::to_string(options.increments), "must be >= 1");
  if (options.modes < 1) refuse("modes", std::to_string(options.modes), "must be >= 1");
  for (const int diameter : options.nodal_diameters)
    if (diameter < 0 || 2 * diameter > sector.sectors)
      refuse("nodal_diameters", std::to_string(diameter), fmt::format("must be 0 ... {}", sector.sectors / 2));
  if (options.speed == 0 && options.nodal_diameters.empty())
    refuse("speed", "0", "must be > 0 when no nodal diameters are asked for: the deck would compute nothing");
}

/// Joins everything the finite elements of a deck need: `section` is the plane section that `sector` is one layer of,
/// or sector itself.
class Deck {
 public:
  Deck(const fem::SectorMesh& sector, const fem::SectorMesh& section, std::span<const fem::Material> materials,
       const InpOptions& options)
      : sector_(sector), section_(section), materials_(materials), options_(options) {}

  std::string text() {
    heading();
    text_ += inp_mesh(sector_, options_.joint == FlankJoint::contact);
    materials();
    if (options_.joint == FlankJoint::glued)
      glue();
    else
      contact_pairs();
    if (in_space())
      boundary_in_space();
    else
      boundary_in_plane();
    if (options_.speed > 0) static_step();
    for (const int diameter : options_.nodal_diameters) frequency_step(diameter);
    return std::move(text_);
  }

 private:
  template <class... Values>
  void line(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
    text_ += '\n';
  }

  [[nodiscard]] bool in_space() const { return sector_.mesh.dimensions() == 3; }
  [[nodiscard]] bool is_layer() const { return in_space() && section_.mesh.dimensions() == 2; }
  [[nodiscard]] bool joins_cuts() const { return options_.cyclic_symmetry && !sector_.cyclic_pairs.empty(); }

  void heading() {
    line("*HEADING");
    line("One sector of {} of a bladed disk; x tangential, y radial, z axial, axis of rotation: the z axis",
         sector_.sectors);
    line("** Units: mm, tonne, s, N, MPa. Nodes and elements carry their index plus one.");
    if (is_layer())
      line(
          "** A plane section as one layer of wedges with u_z = 0, {:.12g} thick: cyclic symmetry takes no plane "
          "elements.",
          section_.mesh.regions.front().thickness * kPerMillimetre);
    else if (in_space())
      line("** C3D15: the 18-node wedges of the computation without the nodes in the middle of rectangular faces.");
    if (options_.joint == FlankJoint::glued)
      line("** Flanks: glued, equations between matched nodes; the form of the flanks plays no part.");
    else
      line("** Flanks: contact pairs; blade nodes stand back from the disk by the initial gap of the flanks.");
    if (options_.speed > 0) line("** Speed: {:.12g} rad/s", options_.speed);
  }

  void material(const std::string& name, const fem::Material& values, double factor) {
    line("*MATERIAL,NAME={}", name);
    line("*ELASTIC\n{:.12g},{:.12g}", factor * values.youngs_modulus * kMegapascal, values.poisson_ratio);
    line("*DENSITY\n{:.12g}", factor * values.density * kTonnePerMm3);
  }

  void materials() {
    for (std::size_t body = 0; body < materials_.size(); ++body)
      material(inp_body_name(static_cast<int>(body)), materials_[body], 1.0);
    for (const fem::Region& region : section_.mesh.regions) {
      std::string name = inp_body_name(region.body);
      const double ratio = region.thickness / section_.mesh.regions.front().thickness;
      if (is_layer() && ratio != 1) {
        name = inp_name(region.name) + "_SCALED";
        line(
            "** {} is {:.12g} times as thick as the layer: as much stiffer and denser, its stresses as much too large.",
            inp_name(region.name), ratio);
        material(name, materials_[static_cast<std::size_t>(region.body)], ratio);
      }
      line("*SOLID SECTION,ELSET={},MATERIAL={}", inp_name(region.name), name);
      if (!in_space()) line("{:.12g}", region.thickness * kPerMillimetre);
    }
  }

  void glue() {
    const std::vector<bool> in_deck = inp_nodes(sector_.mesh);
    for (const fem::Flank& flank : sector_.flanks)
      for (const std::array<int, 2>& pair : flank.pairs)
        if (in_deck[static_cast<std::size_t>(pair[0])])
          for (int c = 1; c <= sector_.mesh.dimensions(); ++c) equal(pair[0], pair[1], c);
  }

  /// The first node's component follows the second's, each in its own system.
  void equal(int dependent, int leading, int component) {
    line("*EQUATION\n2\n{},{},1,{},{},-1", dependent + 1, component, leading + 1, component);
  }

  void contact_pairs() {
    line("*SURFACE INTERACTION,NAME=FLANKS");
    line("*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=LINEAR\n{:.12g}", options_.contact_stiffness * kMegapascalPerMm);
    if (options_.friction > 0)
      line("*FRICTION\n{:.12g},{:.12g}", options_.friction, options_.stick_stiffness * kMegapascalPerMm);
    for (const fem::Flank& flank : sector_.flanks) {
      line("*CONTACT PAIR,INTERACTION=FLANKS,TYPE=SURFACE TO SURFACE");
      line("{}_FACES,{}_FACES", inp_flank_name(flank, 0), inp_flank_name(flank, 1));
    }
  }

  /// In polar components a cyclic image has the same displacements.
  void boundary_in_plane() {
    line("*NSET,NSET=POLAR\nBORE,{}", joins_cuts() ? "CUT_LEFT,CUT_RIGHT" : "");
    line("*TRANSFORM,NSET=POLAR,TYPE=C\n0,0,0,0,0,1");
    const int first_held = options_.bore == fem::BoreSupport::fixed        ? 1
                           : options_.bore == fem::BoreSupport::tangential ? 2
                                                                           : 3;
    const std::set<int> bore(sector_.bore_nodes.begin(), sector_.bore_nodes.end());
    if (joins_cuts())
      for (const std::array<int, 2>& pair : sector_.cyclic_pairs)
        for (int c = 1; c < (bore.contains(pair[1]) ? first_held : 3); ++c) equal(pair[1], pair[0], c);
    if (first_held < 3 && !bore.empty()) line("*BOUNDARY\nBORE,{},2", first_held);
  }

  /// The right cut depends on the left one: its nodes may not be held, nor need they.
  void boundary_in_space() {
    if (joins_cuts()) {
      double smallest = std::numeric_limits<double>::infinity();  // m, distance of partners
      for (const std::array<int, 2>& pair : sector_.cyclic_pairs)
        smallest = std::min(smallest, (sector_.mesh.nodes.col(pair[0]) - sector_.mesh.nodes.col(pair[1])).norm());
      line("*SURFACE,NAME=CUT_LEFT_NODES,TYPE=NODE\nCUT_LEFT,");
      line("*SURFACE,NAME=CUT_RIGHT_NODES,TYPE=NODE\nCUT_RIGHT,");
      line("*TIE,NAME=CUTS,CYCLIC SYMMETRY,POSITION TOLERANCE={:.3g}\nCUT_RIGHT_NODES,CUT_LEFT_NODES",
           kCutTolerance * smallest * kPerMillimetre);
      line("*CYCLIC SYMMETRY MODEL,N={},NGRAPH=1,TIE=CUTS,ELSET=ALL\n0,0,0,0,0,1", sector_.sectors);
    }
    if (!sector_.bore_nodes.empty() && options_.bore == fem::BoreSupport::tangential)
      line("*TRANSFORM,NSET=BORE_HELD,TYPE=C\n0,0,0,0,0,1\n*BOUNDARY\nBORE_HELD,2,2");
    if (!sector_.bore_nodes.empty() && options_.bore == fem::BoreSupport::fixed) line("*BOUNDARY\nBORE_HELD,1,3");
    if (!sector_.axial_nodes.empty()) line("*BOUNDARY\nAXIAL_HELD,3,3");
  }

  /// Results for plane elements at the deck's nodes, not at those of the solids CalculiX makes of them.
  [[nodiscard]] const char* as_in_deck() const { return in_space() ? "" : ",OUTPUT=2D"; }

  void tables() {
    line("*NODE FILE{0}\nU\n*EL FILE{0}\nS", as_in_deck());
    if (options_.joint == FlankJoint::contact) line("*CONTACT FILE{}\nCDIS,CSTR", as_in_deck());
    if (!options_.tables) return;
    line("*NODE PRINT,NSET=ALL,GLOBAL=YES\nU\n*EL PRINT,ELSET=ALL\nS,COORD");
    if (options_.joint == FlankJoint::contact)
      for (const fem::Flank& flank : sector_.flanks)
        line("*CONTACT PRINT,SLAVE={}_FACES,MASTER={}_FACES\nCF", inp_flank_name(flank, 0), inp_flank_name(flank, 1));
  }

  void static_step() {
    const bool contact = options_.joint == FlankJoint::contact;
    line("*STEP{}", contact ? ",INC=10000" : "");
    line("*STATIC");
    if (contact) line("{:.12g},1", 1.0 / options_.increments);
    line("*DLOAD\nALL,CENTRIF,{:.12g},0,0,0,0,0,1", options_.speed * options_.speed);
    tables();
    line("*END STEP");
  }

  void frequency_step(int diameter) {
    const bool doubled = in_space() && joins_cuts();
    line("*STEP{}", options_.speed > 0 ? ",PERTURBATION" : "");
    line("*FREQUENCY\n{}", (doubled ? 2 : 1) * options_.modes);
    if (doubled) line("*SELECT CYCLIC SYMMETRY MODES,NMIN={0},NMAX={0}", diameter);
    // A step goes on printing what the one before asked for.
    line("*NODE PRINT,FREQUENCY=0\n*EL PRINT,FREQUENCY=0\n*NODE FILE{}\nU\n*END STEP", as_in_deck());
  }

  const fem::SectorMesh& sector_;
  const fem::SectorMesh& section_;
  std::span<const fem::Material> materials_;
  const InpOptions& options_;
  std::string text_;
};

}  // namespace

std::string inp(const fem::SectorMesh& sector, std::span<const fem::Material> materials, const InpOptions& options) {
  require_options(sector, materials, options);
  if (!needs_layer(sector, options)) return Deck(sector, sector, materials, options).text();
  return Deck(inp_layer(sector), sector, materials, options).text();
}

void write_inp(const std::filesystem::path& file, const fem::SectorMesh& sector,
               std::span<const fem::Material> materials, const InpOptions& options) {
  const std::string text = inp(sector, materials, options);
  replace_file(file, text);
}

}  // namespace dovetail::geometry
