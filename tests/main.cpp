#include <gmock/gmock.h>

#include "numerics/blas.hpp"

// Of every test program.
int main(int argc, char** argv) {
  dovetail::numerics::prepare_blas(argv);
  testing::InitGoogleMock(&argc, argv);
  return RUN_ALL_TESTS();
}
