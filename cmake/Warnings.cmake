# Warnings and sanitizers of our own targets, linked PRIVATE; never a global flag.
add_library(umbrameter_warnings INTERFACE)
target_compile_options(umbrameter_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wnon-virtual-dtor -Wold-style-cast
  -Wcast-align -Woverloaded-virtual -Wnull-dereference -Wimplicit-fallthrough
  $<$<BOOL:${UMBRAMETER_WERROR}>:-Werror>)
if(UMBRAMETER_SANITIZE)
  # GCC's flow analysis is thrown off by the instrumentation: it suspects <regex> of uninitialised reads and strings of
  # null pointers.
  target_compile_options(umbrameter_warnings INTERFACE
    -fsanitize=${UMBRAMETER_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized;-Wno-null-dereference>)
  target_link_options(umbrameter_warnings INTERFACE -fsanitize=${UMBRAMETER_SANITIZE})
endif()
