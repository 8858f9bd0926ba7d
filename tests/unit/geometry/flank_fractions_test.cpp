#include "geometry/mesh/flank_fractions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/mesh/contact_grid.hpp"
#include "geometry/profile/flank_form.hpp"

namespace dovetail::geometry {
namespace {

std::vector<double> edges(const std::vector<double>& fractions) {
  std::vector<double> lengths;
  for (std::size_t k = 1; k < fractions.size(); ++k) lengths.push_back(fractions[k] - fractions[k - 1]);
  return lengths;
}

double steepest(const std::vector<double>& lengths) {
  double largest = 1;
  for (std::size_t k = 1; k < lengths.size(); ++k)
    largest = std::max({largest, lengths[k] / lengths[k - 1], lengths[k - 1] / lengths[k]});
  return largest;
}

ProfileParameters rounded(double left, double right) {
  ProfileParameters p;
  p.flank("left").edge_radius = left;
  p.flank("right").edge_radius = right;
  return p;
}

TEST(FlankFractions, AreEqualWithoutGrading) {
  EXPECT_EQ(flank_fractions({}, {.flank_elements = 7, .flank_grading = 1}), equal_fractions(7));
}

TEST(FlankFractions, GrowFromTheEndsByTheRatioAskedFor) {
  for (const double grading : {2.0, 4.0, 10.0}) {
    const std::vector<double> lengths = edges(flank_fractions({}, {.flank_elements = 100, .flank_grading = grading}));
    // An edge has the size of its middle: of 50 growing edges the first and the last are each half an edge short of
    // the ratio, which grows by the 1/50th power from one to the next.
    EXPECT_NEAR(lengths[49] / lengths[0], std::pow(grading, 49.0 / 50), 1e-4 * grading);
    for (std::size_t k = 0; k + 1 < 50; ++k)
      EXPECT_NEAR(lengths[k + 1] / lengths[k], std::pow(grading, 1.0 / 50), 1e-4) << k;
  }
}

TEST(FlankFractions, RiseAndAreTheSameFromBothEnds) {
  for (const int parts : {2, 3, 24, 97})
    for (const ProfileParameters& p : {ProfileParameters{}, rounded(5e-3, 5e-3), rounded(0, 50e-3)}) {
      const std::vector<double> fractions = flank_fractions(p, {.flank_elements = parts});
      ASSERT_EQ(fractions.size(), static_cast<std::size_t>(parts) + 1);
      EXPECT_EQ(fractions.front(), 0);
      EXPECT_EQ(fractions.back(), 1);
      for (std::size_t k = 0; k < fractions.size(); ++k)
        EXPECT_NEAR(fractions[fractions.size() - 1 - k] + fractions[k], 1, 1e-15);
      const std::vector<double> lengths = edges(fractions);
      EXPECT_GT(*std::min_element(lengths.begin(), lengths.end()), 0);
    }
}

TEST(FlankFractions, AreFineWhereARoundingBegins) {
  for (const double radius : {1e-3, 5e-3, 20e-3, 50e-3}) {
    const ProfileParameters p = rounded(radius, radius);
    const double w = rounded_length(radius) / p.flank("left").length;
    const std::vector<double> fractions = flank_fractions(p, {.flank_elements = 96});
    const std::vector<double> lengths = edges(fractions);
    for (std::size_t k = 0; k < lengths.size(); ++k)
      if (fractions[k] >= 0.3 * w && fractions[k + 1] <= 1.1 * w) {
        EXPECT_LT(lengths[k], w / 15) << radius;
      }
    EXPECT_GT(*std::max_element(lengths.begin(), lengths.end()), 1.0 / 96);
  }
}

// Worn zones end in the middle, too.
TEST(FlankFractions, LeaveTheMiddleOfARoundedFlankAsFineAsOfASharpOne) {
  for (const double radius : {1e-3, 20e-3, 50e-3})
    for (const int parts : {24, 64, 128}) {
      ProfileParameters reference;
      reference.flank("left").edge_radius = reference.flank("right").edge_radius = radius;
      MeshSizes sizes;
      sizes.flank_elements = parts;
      const std::vector<double> s = flank_fractions(reference, sizes);
      double longest = 0;
      for (std::size_t k = 0; k + 1 < s.size(); ++k) longest = std::max(longest, s[k + 1] - s[k]);
      EXPECT_LE(longest * parts, 2.5) << radius << " " << parts;
      EXPECT_GE(longest * parts, 1.5) << radius << " " << parts;
    }
}

TEST(FlankFractions, OfFewEdgesStayGentle) {
  // e^0.35 = 1.42 per edge in the continuum; the edges in the corner of the size function are cut across it.
  for (const int parts : {12, 16, 24, 48})
    for (const double radius : {1e-3, 20e-3})
      EXPECT_LT(steepest(edges(flank_fractions(rounded(radius, radius), {.flank_elements = parts}))), 1.5)
          << parts << " " << radius;
}

TEST(FlankFractions, OfACoarserGridMeetThoseOfTheMesh) {
  const std::vector<double> fine = flank_fractions({}, {.flank_elements = 12});
  EXPECT_EQ(divided_like(fine, 12), fine);
  const std::vector<double> coarse = divided_like(fine, 4);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(coarse[k], fine[3 * k]);
  const std::vector<double> odd = divided_like(fine, 8);
  EXPECT_NEAR(odd[1], (fine[1] + fine[2]) / 2, 1e-15);
  EXPECT_EQ(odd.back(), 1);
}

TEST(FlankFractions, HaveTheMiddlesOfTheirEdgesBetweenThem) {
  EXPECT_EQ(with_middles({0, 0.25, 1}), (std::vector<double>{0, 0.125, 0.25, 0.625, 1}));
}

}  // namespace
}  // namespace dovetail::geometry
