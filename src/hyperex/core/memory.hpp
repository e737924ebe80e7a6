// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace hyperex {

/// Call it before long work, while no file is half written: makes OpenBLAS allocate the memory that
/// it keeps, for as many threads as compute at once, and OpenMP start its threads, where this
/// process has loaded them. Libraries that find no memory while they work wait for ever or end the
/// program. Throws std::runtime_error, in one sentence, where this process may not take that memory
/// (128 MiB a thread, touched only where it is used) and the 512 MiB that a coarse face takes
/// besides, measured (ulimit -v).
void take_library_memory();

/// Returns freed memory to the system. For use after large results were freed that will not be
/// computed again soon. Some milliseconds per GiB; does nothing where the C library has no such
/// call.
void give_back_freed_memory();

/// MemAvailable of /proc/meminfo, or less if a control group or an address-space limit allows less.
/// 4 GiB if none of these is known.
double available_memory_bytes();

}  // namespace hyperex
