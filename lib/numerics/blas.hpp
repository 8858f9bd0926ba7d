#pragma once

namespace dovetail::numerics {

/// Prepares OpenBLAS for a program that evaluates candidates side by side; call it first in main(), with its argv. One
/// thread: more would only compete with the other candidates, and one gives the same digits whatever the number of
/// cores. And kernels fit for the processor: OpenBLAS chooses them by the processor's model when it is loaded and takes
/// its oldest for models newer than itself, several times as slow. Only the variable OPENBLAS_CORETYPE can say
/// otherwise, so the program is started again with it, once; a value that the user has set stays.
void prepare_blas(char** arguments);

}  // namespace dovetail::numerics
