#pragma once

namespace conchoid {

/// OpenBLAS takes the kernels for Haswell on every x86 processor that runs them (AVX2 and FMA), instead of those for the
/// processor at hand: sums then have one order, and results the same bits on all of these processors. Costs some speed
/// of large products where there is AVX-512. What the environment variable OPENBLAS_CORETYPE names goes before.
///
/// A setting of the whole process: for programs, not for libraries; before other threads use BLAS. With another BLAS
/// library, an OpenBLAS made for one processor, or another processor it does nothing.
void use_common_blas_kernels();

}  // namespace conchoid
