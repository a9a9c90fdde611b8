# Warnings and sanitizers of our own targets, linked PRIVATE; never a global flag.
add_library(umbrameter_warnings INTERFACE)
target_compile_options(umbrameter_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wnon-virtual-dtor -Wold-style-cast
  -Wcast-align -Woverloaded-virtual -Wimplicit-fallthrough
  $<$<BOOL:${UMBRAMETER_WERROR}>:-Werror>
  # In a group of sources a local name may be that of a constant in another source, and a class in a source may have members
  # of types in the source's anonymous namespace: both are right. GCC 12's flow analysis, with more to inline, suspects the
  # standard library. All of this is checked where each source is compiled alone (dev).
  "$<IF:$<BOOL:${UMBRAMETER_FAST_BUILD}>,-Wno-subobject-linkage;-Wno-restrict;-Wno-maybe-uninitialized,-Wshadow;-Wnull-dereference>")
if(UMBRAMETER_SANITIZE)
  # GCC's flow analysis is thrown off by the instrumentation: it suspects <regex> of uninitialised reads and strings of
  # null pointers.
  target_compile_options(umbrameter_warnings INTERFACE
    -fsanitize=${UMBRAMETER_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized;-Wno-null-dereference>)
  target_link_options(umbrameter_warnings INTERFACE -fsanitize=${UMBRAMETER_SANITIZE})
endif()
