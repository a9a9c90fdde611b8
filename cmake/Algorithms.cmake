# As a script: writes a source with a hash of the files that decide what is measured. Machines whose programs were built
# from equal files can share a sweep, whatever compiled them.
# cmake -D root=FOLDER -D output=SOURCE -P Algorithms.cmake -- FILE...
set(is_file FALSE)
set(all)
math(EXPR last "${CMAKE_ARGC} - 1")
foreach(i RANGE ${last})
  set(word "${CMAKE_ARGV${i}}")
  if(is_file)
    file(SHA256 "${word}" hash)
    file(RELATIVE_PATH name ${root} "${word}")
    list(APPEND all "${name} ${hash}")
  elseif(word STREQUAL "--")
    set(is_file TRUE)
  endif()
endforeach()
list(SORT all)
string(SHA256 hash "${all}")
string(SUBSTRING ${hash} 0 32 hash)
file(CONFIGURE OUTPUT ${output} CONTENT "namespace umbrameter {
extern const char* const algorithms_hash;
const char* const algorithms_hash = \"${hash}\";
}
")
