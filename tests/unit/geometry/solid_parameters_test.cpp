#include "geometry/solid/solid_parameters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/solid/solid_family.hpp"
#include "tests/unit/geometry/solid_checks.hpp"

namespace dovetail::geometry {
namespace {

TEST(SolidParameters, AreInRangeByDefault) {
  EXPECT_NO_THROW((void)checked(SolidParameters{}));
  EXPECT_NO_THROW((void)checked(SolidSizes{}, MeshSizes{}));
  EXPECT_NO_THROW((void)checked(everything()));
}

TEST(SolidParameters, AreRefusedOutOfRangeWithTheirKey) {
  SolidParameters solid;
  solid.skew_angle = 50 * kRadian;
  try {
    (void)mesh_solid({}, solid, coarse_section());
    FAIL() << "no exception";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("geometry.skew_angle_deg"));
  }
}

TEST(SolidSizes, RefuseAContactGridFinerThanTheMesh) {
  const MeshSizes section{.flank_elements = 6};
  EXPECT_NO_THROW((void)checked(SolidSizes{.contact_flank_elements = 6, .contact_slot_elements = 8}, section));
  for (const auto& [sizes, key] : {std::pair{SolidSizes{.contact_flank_elements = 7}, "mesh.contact_flank_elements"},
                                   std::pair{SolidSizes{.contact_slot_elements = 9}, "mesh.contact_slot_elements"}}) {
    try {
      (void)SolidFamily({}, section, sizes);
      FAIL() << "no exception for " << key;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr(key));
      EXPECT_THAT(error.what(), ::testing::HasSubstr("not finer"));
    }
  }
}

TEST(SolidSizes, RefuseFewerThanTwoLayers) {
  EXPECT_THROW((void)SolidFamily({}, {}, {.slot_elements = 1}), InputError);
}

}  // namespace
}  // namespace dovetail::geometry
