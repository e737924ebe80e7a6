// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

namespace hyperex {

/// Lets OpenBLAS, where it is the BLAS of this process, use the vector instructions of processors
/// that are newer than OpenBLAS itself. For those it falls back to its kernels for SSE3: a first
/// run then takes 1.2 times as long (measured). Nothing changes where OpenBLAS knows the processor,
/// where the processor has no AVX2, or where OPENBLAS_CORETYPE names the kernels.
/// Returns the name of the kernels in use, "SkylakeX"; empty without OpenBLAS.
/// No other thread may be in BLAS meanwhile. Programs that link the solver run it before main().
std::string choose_blas_kernels();

}  // namespace hyperex
