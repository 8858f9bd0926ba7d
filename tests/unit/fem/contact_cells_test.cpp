#include "fem/contact_cells.hpp"

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "fem/flank_trace.hpp"
#include "fem/sector_system.hpp"
#include "tests/unit/fem/structured_mesh.hpp"

namespace dovetail::fem {
namespace {

SectorMesh traced() {
  return with_trace(testing::toothed_sector(3, 2, 2, 7, false));
}

std::vector<FlankCells> cells_of(const SectorMesh& trace, const std::vector<double>& across) {
  return std::vector<FlankCells>(trace.flanks.size(), {.along = {0, 1}, .across = {across}});
}

TEST(FlankTrace, HasANodeAtEveryPairOfASection) {
  const SectorMesh sector = testing::toothed_sector(3, 2, 2, 7, false);
  const SectorMesh trace = with_trace(sector);
  for (std::size_t f = 0; f < sector.flanks.size(); ++f) {
    const Flank& flank = trace.flanks[f];
    ASSERT_EQ(flank.contact_count(), static_cast<int>(sector.flanks[f].pairs.size()));
    EXPECT_EQ(Eigen::MatrixXd(flank.interpolation),
              Eigen::MatrixXd::Identity(flank.contact_count(), flank.contact_count()));
    const TraceLines lines = trace_lines(flank);
    ASSERT_EQ(std::ssize(lines.across), flank.contact_count());
    EXPECT_EQ(lines.across.front(), 0);
    EXPECT_EQ(lines.across.back(), 1);
    EXPECT_TRUE(std::is_sorted(lines.across.begin(), lines.across.end()));
  }
}

// Three-node edges carry quadratic displacements: their means over a cell, whose ends lie anywhere, are exact.
TEST(ContactCells, AverageQuadraticsExactly) {
  const SectorMesh trace = traced();
  const std::vector<double> ends{0, 0.17, 0.5, 0.61, 1};
  const ContactCells cells = contact_cells(trace, cells_of(trace, ends));
  const std::vector<double> at = trace_lines(trace.flanks[0]).across;
  Eigen::VectorXd values = Eigen::VectorXd::Zero(cells.average.cols());
  for (std::size_t k = 0; k < at.size(); ++k) values(static_cast<Eigen::Index>(k)) = 2 - at[k] + 3 * at[k] * at[k];
  const Eigen::VectorXd means = cells.average * values;
  const auto integral = [](double s) { return 2 * s - s * s / 2 + s * s * s; };
  for (std::size_t k = 0; k + 1 < ends.size(); ++k)
    EXPECT_NEAR(means(static_cast<Eigen::Index>(k)),
                (integral(ends[k + 1]) - integral(ends[k])) / (ends[k + 1] - ends[k]), 1e-13);
}

TEST(ContactCells, ShareTheFlankAmongThem) {
  const SectorMesh trace = traced();
  const ContactCells cells = contact_cells(trace, cells_of(trace, {0, 0.3, 0.45, 1}));
  const ContactSurface surface = contact_surface(trace);
  EXPECT_NEAR(cells.area.sum(), surface.area.sum(), 1e-13 * surface.area.sum());
  EXPECT_NEAR(cells.area(1) / cells.area(0), 0.5, 1e-12);
  // A uniform pressure on the cells is the same on the trace.
  const Eigen::VectorXd force = cells.average.transpose() * cells.area;
  EXPECT_LT((force - surface.area).norm(), 1e-12 * surface.area.norm());
}

TEST(ContactCells, LieInStripsInTheirOrder) {
  const SectorMesh trace = traced();
  const ContactCells cells = contact_cells(trace, cells_of(trace, {0, 0.3, 0.45, 1}));
  const std::vector<CellStrip> strips = cells.strips();
  ASSERT_EQ(strips.size(), trace.flanks.size());
  std::size_t first = 0;
  for (std::size_t s = 0; s < strips.size(); ++s) {
    EXPECT_EQ(strips[s].first, first);
    for (std::size_t k = 0; k < strips[s].count(); ++k, ++first) {
      const auto cell = static_cast<Eigen::Index>(first);
      EXPECT_EQ(cells.strip(cell), static_cast<int>(s));
      EXPECT_EQ(cells.flank(cell), static_cast<int>(strips[s].flank));
    }
    EXPECT_NEAR(strips[s].length(1), 0.15, 1e-15);
    EXPECT_NEAR(strips[s].middle(0), 0.15, 1e-15);
  }
  EXPECT_EQ(static_cast<Eigen::Index>(first), cells.count());
}

TEST(ContactCells, RefuseEndsThatDoNotRiseFromZeroToOne) {
  const SectorMesh trace = traced();
  for (const std::vector<double>& wrong : {std::vector<double>{0, 0.5}, std::vector<double>{0.1, 1},
                                           std::vector<double>{0, 0.5, 0.5, 1}, std::vector<double>{}})
    EXPECT_THROW((void)contact_cells(trace, cells_of(trace, wrong)), InputError);
  EXPECT_THROW((void)contact_cells(trace, {}), InputError);
}

}  // namespace
}  // namespace dovetail::fem
