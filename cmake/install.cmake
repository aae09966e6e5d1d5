# What `cmake --install` and the Debian package put where: the program with its manual, completion and documentation,
# the rig as a library with its headers for find_package(mckibben), the scenarios, the module for Debian's Python.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS mckibben)
install(DIRECTORY scenarios DESTINATION ${CMAKE_INSTALL_DATADIR}/mckibben)
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})

# What the program says of itself is asked when it is there.
set(said ${PROJECT_BINARY_DIR}/said)
install(CODE "execute_process(COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:mckibben> -D FOLDER=${said}
  -D VERSION=${PROJECT_VERSION} -P ${PROJECT_SOURCE_DIR}/cmake/said.cmake COMMAND_ERROR_IS_FATAL ANY)")
install(DIRECTORY ${said}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR})
install(FILES cmake/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME mckibben)

# Where the module was built, as the package does.
if(TARGET mckibben_python)
  set(module lib/python3/dist-packages/mckibben) # Debian's, in /usr
  install(DIRECTORY sim/python/mckibben/ DESTINATION ${module} FILES_MATCHING PATTERN *.py PATTERN *.pyi PATTERN py.typed)
  install(TARGETS mckibben_python DESTINATION ${module} OPTIONAL)
endif()

# The library: the rig and a ride on it (docs/library.md).
set(library plant engine ride)
set_property(TARGET plant PROPERTY OUTPUT_NAME mckibben-plant) # in a system, others have engines too
set_property(TARGET engine PROPERTY OUTPUT_NAME mckibben-engine)
set_property(TARGET ride PROPERTY OUTPUT_NAME mckibben-ride)
install(TARGETS ${library} EXPORT mckibben INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/mckibben)
install(DIRECTORY plant DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/mckibben FILES_MATCHING PATTERN *.hpp)
install(DIRECTORY sim/engine sim/ride DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/mckibben/sim
        FILES_MATCHING PATTERN *.hpp)
set(config ${CMAKE_INSTALL_LIBDIR}/cmake/mckibben)
install(EXPORT mckibben NAMESPACE mckibben:: FILE mckibben-targets.cmake DESTINATION ${config})
configure_package_config_file(cmake/mckibben-config.cmake.in mckibben-config.cmake INSTALL_DESTINATION ${config})
write_basic_package_version_file(mckibben-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/mckibben-config.cmake ${PROJECT_BINARY_DIR}/mckibben-config-version.cmake
        DESTINATION ${config})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the McKibben maintainers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "simulator of a pneumatic artificial muscle that lifts a load")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "Simulates a McKibben muscle, its valve, its load and its controllers, and finds in
 measurements which effects a real rig shows and the model lacks. With a module for Python, and headers and a library
 for C++.")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS python3-numpy) # for the module
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libeigen3-dev, libfmt-dev, libsundials-dev") # to compile against the library
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
include(CPack)
