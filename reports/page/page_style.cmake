# Makes page_style.cpp from page.css. The policy allows the style by its hash, which must be of the very bytes embedded.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/page.css)
file(READ ${CMAKE_CURRENT_LIST_DIR}/page.css page_css)
string(SHA256 page_css_hash "${page_css}")
configure_file(${CMAKE_CURRENT_LIST_DIR}/page_style.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/page_style.cpp @ONLY)
