# Writes a .cpp with the contents of text files, so that the program carries them with it.
#   cmake -D OUTPUT=files.cpp -D HEADERS=sim/report/files.hpp -D NAMESPACE=mckibben::report
#         -D NAMES=a;b -D FILES=/path/a.js;/path/b.css -P embed.cmake
# makes  namespace mckibben::report { extern const std::string_view a = ..., b = ...; }
set(source "")
foreach(header IN LISTS HEADERS)
  string(APPEND source "#include <${header}>\n")
endforeach()
string(APPEND source "\nnamespace ${NAMESPACE} {\n")
foreach(name file IN ZIP_LISTS NAMES FILES)
  file(READ "${file}" text)
  string(APPEND source "const std::string_view ${name} = R\"embedded(${text})embedded\";\n")
endforeach()
file(WRITE "${OUTPUT}" "${source}}  // namespace ${NAMESPACE}\n")
