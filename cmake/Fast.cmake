# Compiles several sources of a target as one, so that headers are parsed once for all of them: the tree compiles in less
# than half the time. UMBRAMETER_FAST_BUILD=OFF compiles each source alone, which proves that it includes what it needs.
option(UMBRAMETER_FAST_BUILD "Compile sources in groups" ON)

# Names in anonymous namespaces must differ within a target.
function(umbrameter_fast target sources_of_a_group)
  if(UMBRAMETER_FAST_BUILD)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${sources_of_a_group})
  endif()
endfunction()

# For code that hardly computes: the command line, texts and pages, the tests' side of a comparison. It compiles in two
# thirds of the time.
function(umbrameter_lightly_optimised target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()
