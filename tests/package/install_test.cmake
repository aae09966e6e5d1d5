# Installs the program and the library into a folder, builds docs/library.md's example with find_package there, and makes
# the Debian package.
#   cmake -D BUILD=build/release -D SOURCE=. -D FOLDER=... -P install_test.cmake
file(REMOVE_RECURSE ${FOLDER})
set(prefix ${FOLDER}/usr)

function(do)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${FOLDER} OUTPUT_VARIABLE said ERROR_VARIABLE complained
                  RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${status}\n${said}${complained}")
  endif()
  set(said "${said}" PARENT_SCOPE)
endfunction()
function(expect what wanted)
  if(NOT "${what}" MATCHES "${wanted}")
    message(FATAL_ERROR "not as wanted, ${wanted}:\n${what}")
  endif()
endfunction()

file(MAKE_DIRECTORY ${FOLDER}/lift)
do(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
do(${prefix}/bin/mckibben --version)
expect("${said}" "^mckibben [0-9]")
foreach(file share/man/man1/mckibben.1 share/man/man1/mckibben-run.1 share/bash-completion/completions/mckibben
        share/zsh/vendor-completions/_mckibben share/mckibben/scenarios/five_loads.yaml)
  file(SIZE ${prefix}/${file} size)
  expect(${size} "[1-9][0-9][0-9]")
endforeach()
file(READ ${prefix}/share/man/man1/mckibben-run.1 page)
expect("${page}" "mckibben-run .. Simulate each load")

# The page's files, as they stand there.
file(READ ${SOURCE}/docs/library.md page)
foreach(file CMakeLists.txt lift.cpp)
  string(REGEX MATCH "title=\"${file}\"\n([^`]*)```" found "${page}")
  file(WRITE ${FOLDER}/lift/${file} "${CMAKE_MATCH_1}")
endforeach()
do(${CMAKE_COMMAND} -S ${FOLDER}/lift -B ${FOLDER}/lift/build -D CMAKE_PREFIX_PATH=${prefix} -D CMAKE_BUILD_TYPE=Release)
do(${CMAKE_COMMAND} --build ${FOLDER}/lift/build)
do(${FOLDER}/lift/build/lift)
expect("${said}" "^0\\.[12][0-9][0-9][0-9]\n$")

do(cpack --config ${BUILD}/CPackConfig.cmake -B ${FOLDER}/deb)
file(GLOB package ${FOLDER}/deb/*.deb)
do(dpkg-deb --field ${package} Depends)
foreach(library sundials udunits netcdf yaml-cpp)
  expect("${said}" "${library}")
endforeach()
do(dpkg-deb --contents ${package})
expect("${said}" "\\./usr/bin/mckibben\n")
file(REMOVE_RECURSE ${FOLDER})
