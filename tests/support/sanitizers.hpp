// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// HYPEREX_SANITIZED is 1 where the address or thread sanitizer is compiled in. Tests that limit or
// count memory skip there: sanitizers have an allocator of their own and take more addresses than
// any limit leaves. GCC defines a macro for each, Clang answers __has_feature.
#ifdef __has_feature
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define HYPEREX_SANITIZED 1
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#undef HYPEREX_SANITIZED
#define HYPEREX_SANITIZED 1
#endif
#ifndef HYPEREX_SANITIZED
#define HYPEREX_SANITIZED 0
#endif
