// Work on many numbers at once, compiled for several generations of vector units. For raytrace/*.cpp alone.
#pragma once

#include <cstddef>  // any standard header tells whether this is glibc, which can make the choice

/// Before a function: it is compiled once for each of these processors, and the program takes the best that it may when
/// it starts. All do the same operations in the same order, so that results do not depend on the processor: files that
/// use it are compiled without contraction of products and sums. Sanitizers are not ready when the choice is made.
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define UMBRAMETER_VECTORS __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define UMBRAMETER_VECTORS
#endif

/// Before what such a function calls: it is compiled with its caller, for the same processor.
#define UMBRAMETER_IN_VECTORS [[gnu::always_inline]] inline
