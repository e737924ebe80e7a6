// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace hyperex {

/// Call it before long work, while no file is half written: makes OpenBLAS allocate the memory, and
/// OpenMP start the threads, that they keep, where this process has loaded them. Throws
/// std::runtime_error, in one sentence, where this process may not take 768 MiB (ulimit -v),
/// measured to be enough for a coarse face: libraries that find no memory while they work wait for
/// ever or end the program.
void take_library_memory();

/// Returns freed memory to the system. For use after large results were freed that will not be
/// computed again soon. Some milliseconds per GiB; does nothing where the C library has no such
/// call.
void give_back_freed_memory();

}  // namespace hyperex
