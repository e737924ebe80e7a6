// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace hyperex {

/// Keeps OpenBLAS, where it is the BLAS of this process, to one thread from now on. The blocks of a
/// factor are small: a second thread gains nothing on a free machine, and on a busy one its
/// spinning makes a step ten times slower (measured: 114 against 14 ms).
void keep_blas_to_one_thread();

/// While it lives, OpenMP's loops in libraries that this thread calls run on this thread alone.
/// CHOLMOD requests four threads on any machine, which for matrices of a thousand rows spend their
/// time spinning (measured: 9 against 5 ms for a frame's fit).
class OneOpenMpThread {
 public:
  OneOpenMpThread();
  ~OneOpenMpThread();
  OneOpenMpThread(const OneOpenMpThread&) = delete;
  OneOpenMpThread& operator=(const OneOpenMpThread&) = delete;

 private:
  int levels_before_ = -1;  // unknown
};

}  // namespace hyperex
