#include <gmock/gmock.h>

#include "numerics/process.hpp"

// Of every test program.
int main(int argc, char** argv) {
  dovetail::numerics::prepare_process(argv);
  testing::InitGoogleMock(&argc, argv);
  return RUN_ALL_TESTS();
}
