#pragma once

// Loops that are compiled once more for processors with AVX2. They hold no call that is shared with other code, and
// contraction is off, so every processor computes the same bits. Sanitizers start too late for the choice at load time.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define CONCHOID_WIDE_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define CONCHOID_WIDE_CLONES
#endif
/// Of what such loops call.
#define CONCHOID_INTO_CLONES __attribute__((always_inline)) inline
