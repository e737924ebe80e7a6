// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace hyperex {

/// Before long work, while nothing is half written: lets OpenBLAS take the memory, and OpenMP the
/// threads, that they keep, where they are in this process. Throws std::runtime_error, in one
/// sentence, where this process may not take 768 MiB (ulimit -v), measured to be enough for a
/// coarse face: libraries that find no memory while they work wait for ever or end the program.
void take_library_memory();

/// Gives back to the system what was freed: after large results have gone that will not be computed
/// again at once. Some milliseconds a GiB; does nothing where the C library has no such call.
void give_back_freed_memory();

}  // namespace hyperex
