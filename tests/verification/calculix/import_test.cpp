// A joint whose matrices CalculiX wrote, imported, against CalculiX's own frequencies and the same joint of our
// elements.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <numbers>
#include <set>
#include <string>

#include "core/options.hpp"
#include "fem/assembly.hpp"
#include "fem/sector_system.hpp"
#include "geometry/exports/inp.hpp"
#include "geometry/mesh/mesh_motion.hpp"
#include "studies/program/engine/loaded_model.hpp"
#include "tests/verification/calculix/calculix.hpp"
#include "wear/asymptote/asymptote.hpp"

namespace dovetail::calculix {
namespace {

namespace fs = std::filesystem;

constexpr double kSpeed = 1047.1975511965977;  // 10 000 rpm
constexpr int kModes = 3;

/// A section with free cuts, held at the bore.
fem::SectorMesh coarse_section() {
  return geometry::mesh_sector({},
                               {.flank_elements = 8, .fillet_fraction = 0.3, .bulk_size = 6e-3, .aerofoil_elements = 8})
      .sector;
}

class ImportedFromCalculiX : public testing::Test {
 protected:
  void SetUp() override {
    if (!is_installed()) GTEST_SKIP() << "the program ccx is not installed (Debian package calculix-ccx)";
    fs::create_directories(folder_);
  }
  void TearDown() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  /// The deck without loads; flanks open, and without contact: bodies that do not know each other.
  [[nodiscard]] std::string deck(geometry::FlankJoint joint, const std::string& solver) const {
    std::string text = geometry::inp(sector_, materials_,
                                     {.joint = joint,
                                      .cyclic_symmetry = false,
                                      .bore = fem::BoreSupport::fixed,
                                      .nodal_diameters = {0},
                                      .modes = kModes});
    const std::size_t begin = text.find("*SURFACE INTERACTION");
    if (begin != std::string::npos) text.erase(begin, text.find("\n*", text.rfind("*CONTACT PAIR")) + 1 - begin);
    return text.replace(text.find("*FREQUENCY"), 10, "*FREQUENCY" + solver);
  }

  /// The pairs of nodes of both flanks, from one end to the other, with what a uniform pressure gives each of them:
  /// quadratic sides, a sixth of their length at the ends and four sixths in the middle.
  void write_joint(const std::string& name, const std::string& matrices) const {
    std::string nodes, against, normals, areas;
    for (const fem::Flank& flank : sector_.flanks) {
      const Eigen::Vector2d along = flank.tangents.col(0);
      std::map<double, std::array<int, 2>> pairs;
      for (const std::array<int, 2>& pair : flank.pairs) pairs[along.dot(sector_.mesh.nodes.col(pair[0]))] = pair;
      ASSERT_EQ(pairs.size() % 2, 1U);
      std::vector<double> place, weight(pairs.size(), 0.0);
      for (const auto& [s, pair] : pairs) place.push_back(s);
      for (std::size_t i = 0; i + 2 < place.size(); i += 2)
        for (const auto& [offset, share] : {std::pair{0, 1}, std::pair{1, 4}, std::pair{2, 1}})
          weight[i + static_cast<std::size_t>(offset)] += share * (place[i + 2] - place[i]) / 6;
      for (std::size_t i = 0; const auto& [s, pair] : pairs) {
        nodes += fmt::format("{}, ", pair[0] + 1);
        against += fmt::format("{}, ", pair[1] + 1);
        normals += fmt::format("[{}, {}], ", shortest(flank.normal(0)), shortest(flank.normal(1)));
        areas += shortest(weight[i++] * fem::body_thickness(sector_.mesh, pair[0])) + ", ";
      }
    }
    std::ofstream(folder_ / name)
        << "format = \"dovetail-structure\"\nversion = 1\n"
        << matrices
        << fmt::format(
               "[reduction]\nmodes = 80\ndamping_ratio = 0.001\n[contact]\nnodes = [{}]\nagainst = "
               "[{}]\nnormal = [{}]\narea = [{}]\n",
               nodes, against, normals, areas)
        << "gap = 0.0\nfriction = 0.5\nwear_coefficient = 1e-13\n"
        << "[[force]]\nfile = \"spin.txt\"\nharmonic = 0\ncosine = 1.0\n"
        << fmt::format(
               "[[force]]\nnode = {0}\ndirection = 1\nharmonic = 1\ncosine = 2.0\n[[output]]\nname = "
               "\"tip\"\nnode = {0}\ndirection = 1\n",
               sector_.tip_node + 1);
  }

  /// Our own matrices, as a Matrix Market file each, `factor` times as stiff, and the centrifugal load.
  void write_ours(double factor) const {
    const fem::FullMatrices full = fem::Assembler(sector_.mesh).stiffness_and_mass(sector_.mesh, materials_);
    const std::set<int> bore(sector_.bore_nodes.begin(), sector_.bore_nodes.end());
    std::vector<int> number(static_cast<std::size_t>(full.stiffness.rows()), 0);
    std::ofstream dofs(folder_ / "dofs.txt");
    int count = 0;
    for (Eigen::Index i = 0; i < full.stiffness.rows(); ++i) {
      if (bore.contains(static_cast<int>(i / 2))) continue;
      number[static_cast<std::size_t>(i)] = ++count;
      dofs << i / 2 + 1 << "." << i % 2 + 1 << "\n";
    }
    const auto write = [&](const char* name, const Eigen::SparseMatrix<double>& matrix, double scale) {
      std::string entries;
      int lines = 0;
      for (Eigen::Index column = 0; column < matrix.outerSize(); ++column)
        for (Eigen::SparseMatrix<double>::InnerIterator entry(matrix, column); entry; ++entry) {
          const int i = number[static_cast<std::size_t>(entry.row())], j = number[static_cast<std::size_t>(column)];
          if (i == 0 || j == 0 || i < j) continue;
          entries += fmt::format("{} {} {}\n", i, j, shortest(scale * entry.value()));
          ++lines;
        }
      std::ofstream(folder_ / name) << "%%MatrixMarket matrix coordinate real symmetric\n"
                                    << fmt::format("{0} {0} {1}\n", count, lines) << entries;
    };
    write("ours_stiffness.mtx", full.stiffness, factor);
    write("ours_mass.mtx", full.mass, 1);
    const Eigen::VectorXd spin = kSpeed * kSpeed * fem::centrifugal_load(full.mass, sector_.mesh);
    std::ofstream forces(folder_ / "spin.txt");
    for (Eigen::Index i = 0; i < spin.size(); ++i)
      forces << fmt::format("{}, {}, {}\n", i / 2 + 1, i % 2 + 1, shortest(spin(i)));
  }

  [[nodiscard]] studies::LoadedModel loaded(const std::string& name) const {
    return studies::load_model((folder_ / name).string(), {}, studies::SolverChoice{});
  }

  fem::SectorMesh sector_ = coarse_section();
  std::vector<fem::Material> materials_{{}, {}};
  fs::path folder_ = fs::path(testing::TempDir()) / "dovetail_import";
};

wear::Asymptote worn(const studies::LoadedModel& model, double omega) {
  return wear::asymptote(model.joint, omega, {.arbitration = wear::Arbitration::never});
}

// Frequencies: the glued model has those of CalculiX, which prints seven digits; eighty modes leave less. Wear: its
// elements are integrated with three points, ours with six, and differ in fillets: as if the structure were stiffer by
// 1e-4 (section_test). What that changes is the tolerance; measured, the difference is a hundredth of it.
TEST_F(ImportedFromCalculiX, HasItsFrequenciesAndWearsAsTheSameJointOfOurs) {
  run_in(folder_, deck(geometry::FlankJoint::contact, ",SOLVER=MATRIXSTORAGE"));
  write_ours(1);
  write_joint("theirs.toml",
              "stiffness = \"deck.sti\"\nmass = \"deck.mas\"\ndofs = \"deck.dof\"\nunits = \"mm, t, s\"\n");
  write_joint("ours.toml", "stiffness = \"ours_stiffness.mtx\"\nmass = \"ours_mass.mtx\"\ndofs = \"dofs.txt\"\n");
  const studies::LoadedModel theirs = loaded("theirs.toml"), ours = loaded("ours.toml");

  const std::vector<double> frequencies = run(deck(geometry::FlankJoint::glued, "")).frequencies.at(0);
  ASSERT_GE(frequencies.size(), static_cast<std::size_t>(kModes));
  const Eigen::VectorXd glued = theirs.joint.model->glued_frequencies();
  for (int k = 0; k < kModes; ++k)
    EXPECT_NEAR(glued(k) / (2 * std::numbers::pi) / frequencies[static_cast<std::size_t>(k)], 1, 1e-6) << k;

  const double omega = 0.9995 * ours.glued_omega;
  const wear::Asymptote expected = worn(ours, omega), found = worn(theirs, omega);
  ASSERT_EQ(expected.verdict, wear::Verdict::asymptote);
  ASSERT_EQ(found.verdict, wear::Verdict::asymptote);
  ASSERT_GT(expected.worn_volume, 0);
  write_ours(1.0001);
  const wear::Asymptote stiffer = worn(loaded("ours.toml"), omega);
  ASSERT_EQ(stiffer.verdict, wear::Verdict::asymptote);
  const double volume = std::abs(stiffer.worn_volume - expected.worn_volume);
  const double depth = (stiffer.depth - expected.depth).cwiseAbs().maxCoeff();
  RecordProperty("worn_volume", std::to_string(1e9 * expected.worn_volume));
  RecordProperty("volume_error", std::to_string((found.worn_volume - expected.worn_volume) / expected.worn_volume));
  RecordProperty("volume_tolerance", std::to_string(volume / expected.worn_volume));
  EXPECT_NEAR(found.worn_volume, expected.worn_volume, volume);
  EXPECT_LT((found.depth - expected.depth).cwiseAbs().maxCoeff(), depth);
}

}  // namespace
}  // namespace dovetail::calculix
