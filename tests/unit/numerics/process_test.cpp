#include "numerics/process.hpp"

#include <cblas.h>
#include <gtest/gtest.h>

#include <string>

namespace dovetail::numerics {
namespace {

// Every test program prepares OpenBLAS as the program does.
TEST(Blas, TakesKernelsFitForTheProcessorAndOneThread) {
  EXPECT_EQ(openblas_get_num_threads(), 1);
#if defined(__x86_64__)
  const bool modern = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  EXPECT_FALSE(modern && std::string(openblas_get_corename()) == "Prescott");
#endif
}

}  // namespace
}  // namespace dovetail::numerics
