# A header that lists techniques decides what is built: a file that goes with one of its includes needs no line elsewhere.

# Of each header of its own folder that `manifest` (folder/file.h) includes, the files that exist with the same name:
# umbrameter_listed(OUT shadow/technique.h shadow/@.cpp), where @ stands for the name. Paths are relative to this folder.
function(umbrameter_listed out manifest)
  set(manifest_path ${PROJECT_SOURCE_DIR}/techniques/${manifest})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${manifest_path})
  get_filename_component(folder ${manifest} DIRECTORY)
  file(STRINGS ${manifest_path} includes REGEX "^#include \"techniques/${folder}/")
  set(files)
  foreach(include ${includes})
    string(REGEX REPLACE ".*/([a-z_0-9]+)\\.h\"$" "\\1" name ${include})
    foreach(pattern ${ARGN})
      string(REPLACE "@" ${name} file ${pattern})
      if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${file})
        list(APPEND files ${file})
      endif()
    endforeach()
  endforeach()
  set(${out} ${files} PARENT_SCOPE)
endfunction()
