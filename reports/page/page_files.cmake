# Makes page_files.cpp from the style sheet and the templates. The policy allows the style by its hash, which must be of
# the very bytes embedded.
set(page_files "")
foreach(file page.css templates/figure.html templates/page.html templates/table.html)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/${file})
  file(READ ${CMAKE_CURRENT_LIST_DIR}/${file} text)
  string(APPEND page_files "  if (name == \"${file}\") return R\"~~~(${text})~~~\";\n")
endforeach()
file(SHA256 ${CMAKE_CURRENT_LIST_DIR}/page.css page_css_hash)
string(REGEX REPLACE "(..)" "\\\\x\\1" page_css_hash "${page_css_hash}")
configure_file(${CMAKE_CURRENT_LIST_DIR}/page_files.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/page_files.cpp @ONLY)
