// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Before a function: compiled for each kind of vector unit, the best picked when the program
/// starts. That is before a sanitizer has set itself up, and what picks is instrumented too, so
/// sanitizers get one version. Calls into other functions are not inlined into clones, std::min
/// among them; what is [[gnu::always_inline]] is.
#if defined(__x86_64__) && defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define HX_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define HX_CLONES
#endif
