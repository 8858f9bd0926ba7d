#include "numerics/process.hpp"

#include <cblas.h>
#include <malloc.h>
#include <unistd.h>

#include <cstdlib>
#include <limits>
#include <string_view>

namespace dovetail::numerics {

namespace {

/// Better kernels than those OpenBLAS took, or null.
const char* better_kernels() {
#if defined(__x86_64__)
  if (std::string_view(openblas_get_corename()) != "Prescott") return nullptr;
  if (__builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq")) return "SkylakeX";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "Haswell";
#endif
  return nullptr;
}

}  // namespace

void prepare_process(char** arguments) {
  constexpr const char* kVariable = "OPENBLAS_CORETYPE";
  const char* kernels = std::getenv(kVariable) == nullptr ? better_kernels() : nullptr;
  // Where that fails the slow kernels do.
  if (kernels != nullptr && ::setenv(kVariable, kernels, 0) == 0) ::execv("/proc/self/exe", arguments);
  prepare_library();
}

bool prepare_library() {
  openblas_set_num_threads(1);
  // Memory is kept from candidate to candidate; what is larger than this is given back, else the matrices of a large
  // sector leave holes as large as its factor. Of a sector of 180 000 unknowns the peak is 2.93 GiB with 64 MiB here,
  // 3.13 with 128, and with 32 fresh pages cost 3 s of a minute. Without effect under allocators other than that of
  // the GNU library.
  ::mallopt(M_MMAP_THRESHOLD, 1 << 26);
  ::mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  return better_kernels() != nullptr;
}

}  // namespace dovetail::numerics
