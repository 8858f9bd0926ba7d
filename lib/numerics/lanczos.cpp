#include "numerics/lanczos.hpp"

#include <Spectra/SymGEigsShiftSolver.h>

#include <algorithm>
#include <new>

namespace dovetail::numerics {

LanczosPairs lanczos(RealOperator inverse, const RealOperator& mass, const double* start,
                     const LanczosOptions& options) {
  LanczosPairs pairs;
  Spectra::SymGEigsShiftSolver<RealOperator, const RealOperator, Spectra::GEigsMode::ShiftInvert> solver(
      inverse, mass, options.count, std::min(options.vectors, inverse.rows()), 0.0);
  try {
    solver.init(start);
    solver.compute(Spectra::SortRule::LargestMagn, options.restarts, options.tolerance,
                   Spectra::SortRule::SmallestMagn);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {  // its own iterations failed
    return pairs;
  }
  pairs.values = solver.eigenvalues();
  pairs.vectors = solver.eigenvectors();
  if (!pairs.values.allFinite() || !pairs.vectors.allFinite())
    pairs.status = Status::not_finite;
  else if (pairs.values.size() == options.count)
    pairs.status = Status::converged;
  return pairs;
}

}  // namespace dovetail::numerics
