# cmake -DOUTPUT=file.cpp -DSCRIPT=viewer.js -P embed_script.cmake
# Writes the page's script as a string literal, with its hash, which must be of the very bytes embedded. No SCRIPT: both
# are empty.
set(text "")
set(hash "")
set(hash_length 0)
if(SCRIPT)
  file(READ ${SCRIPT} text)
  file(SHA256 ${SCRIPT} hash)
  string(REGEX REPLACE "(..)" "\\\\x\\1" hash "${hash}")
  set(hash_length 32)
endif()
file(WRITE ${OUTPUT} "#include \"reports/page/template.h\"

namespace umbrameter {

std::string_view page_script() { return R\"~~~(${text})~~~\"; }

std::string_view page_script_hash() { return {\"${hash}\", ${hash_length}}; }

}  // namespace umbrameter
")
