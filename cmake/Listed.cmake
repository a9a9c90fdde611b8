# A header that lists techniques or metrics decides what is built: a file that goes with one of them needs no line
# elsewhere.

# For each line of the file `list` that the regular expression matches, the files that exist: umbrameter_listed(OUT LIST
# REGEX PATTERN...), where REGEX captures a name and @ in a pattern stands for it. Paths are relative to this folder.
function(umbrameter_listed out list regex)
  get_filename_component(list ${list} ABSOLUTE)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${list})
  file(STRINGS ${list} lines REGEX "${regex}")
  set(files)
  foreach(line IN LISTS lines)
    string(REGEX MATCH "${regex}" matched "${line}")
    foreach(pattern ${ARGN})
      string(REPLACE "@" "${CMAKE_MATCH_1}" file ${pattern})
      if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${file})
        list(APPEND files ${file})
      endif()
    endforeach()
  endforeach()
  set(${out} ${files} PARENT_SCOPE)
endfunction()
