// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Placed before a function, compiles it for each kind of vector unit; the best version is selected
/// when the program starts. Sanitizers get one version, as the instrumented selection would run
/// before they are initialised. Only [[gnu::always_inline]] functions are inlined into clones:
/// std::min is not.
#if defined(__x86_64__) && defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define HX_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define HX_CLONES
#endif
