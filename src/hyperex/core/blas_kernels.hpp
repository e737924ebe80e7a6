// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

namespace hyperex {

/// Lets OpenBLAS, where it is the BLAS of this process, use the vector instructions of this
/// processor. OpenBLAS 0.3.21 does not know some of Intel's newer ones and takes its kernels for
/// SSE3 there: a first run then takes 1.2 times as long (measured). Nothing changes where OpenBLAS
/// has chosen other kernels, where the processor has no AVX2, or where the variable
/// OPENBLAS_CORETYPE is set.
/// Returns the name of the kernels in use, "SkylakeX"; empty without OpenBLAS.
/// No other thread may be in BLAS meanwhile. Programs that link the solver run it before main().
std::string choose_blas_kernels();

/// Has OpenBLAS take the kernels of this name, whatever it has chosen. False, and nothing changes,
/// where it is not the BLAS of this process or can't choose. One that has no such kernels takes
/// others. As above, no other thread may be in BLAS meanwhile.
bool take_blas_kernels(const std::string& name);

}  // namespace hyperex
