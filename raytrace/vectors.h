// Functions that are compiled for several generations of vector units. For raytrace/*.cpp alone.
#pragma once

#include <cstddef>  // defines __GLIBC__, whose loader chooses the version

/// Attribute of a function: it is compiled once for each of these processors, and the best version is chosen when the
/// program starts. All versions do the same operations in the same order, without fused multiply-add, so that results
/// do not depend on the processor. Not with sanitizers, which are not initialised when the choice is made.
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define UMBRAMETER_VECTORS __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define UMBRAMETER_VECTORS
#endif

/// Attribute of a function called by one of the above: it is compiled with its caller, for the same processor.
#define UMBRAMETER_IN_VECTORS [[gnu::always_inline]] inline
