#pragma once

namespace dovetail::numerics {

/// Prepares a program that evaluates candidates; call it first in main(), with its argv.
/// - OpenBLAS: one thread. More would only compete with candidates side by side, and one gives the same digits whatever
///   the number of cores. And kernels fit for the processor: OpenBLAS chooses them by the processor's model when it is
///   loaded and takes its oldest for models newer than itself, several times as slow. Only the variable
///   OPENBLAS_CORETYPE can say otherwise, so the program is started again with it, once; a value that the user has set
///   stays.
/// - Memory: what a candidate frees is kept for the next one. Factors and matrices of a sector are some 100 MB each;
///   returned to the system, every page of them would be cleared anew.
void prepare_process(char** arguments);

/// The same but for the kernels, of a library in a program that is not ours.
/// @return whether OpenBLAS took kernels that are too old for the processor
bool prepare_library();

}  // namespace dovetail::numerics
