# Packs what every FMU holds into a ZIP archive: the program, its sources and how to build them.
#   cmake -D OUTPUT=parts.zip -D LIBRARY=mckibben.so -D ROOT=/path -D STAGE=/path/of/a/folder -P fmu_parts.cmake
file(REMOVE_RECURSE ${STAGE})
file(COPY ${LIBRARY} DESTINATION ${STAGE}/binaries)
foreach(folder plant sim/engine sim/ride sim/fmu/model)
  get_filename_component(parent ${folder} DIRECTORY)
  file(COPY ${ROOT}/${folder} DESTINATION ${STAGE}/sources/${parent})
endforeach()
file(COPY ${ROOT}/sim/domain/rig_number.cpp ${ROOT}/sim/domain/rig_number.hpp ${ROOT}/sim/domain/number.cpp ${ROOT}/sim/domain/number.hpp
     ${ROOT}/sim/domain/outer_force.hpp ${ROOT}/sim/domain/renamed.hpp
  DESTINATION ${STAGE}/sources/sim/domain)
file(COPY ${ROOT}/cmake/fmu.cmake ${ROOT}/LICENSE DESTINATION ${STAGE}/sources)
file(WRITE ${STAGE}/sources/CMakeLists.txt
"# The program of this FMU: cmake -S . -B build && cmake --build build
cmake_minimum_required(VERSION 3.25)
project(mckibben_fmu LANGUAGES CXX)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
set(MCKIBBEN_ROOT \${PROJECT_SOURCE_DIR})
include(fmu.cmake)
")
# What FMI 3.0 wants to know of sources.
file(GLOB_RECURSE sources RELATIVE ${STAGE}/sources ${STAGE}/sources/*.cpp)
list(SORT sources)
set(list "")
foreach(source ${sources})
  string(APPEND list "      <SourceFile name=\"${source}\"/>\n")
endforeach()
file(WRITE ${STAGE}/sources/buildDescription.xml
"<?xml version=\"1.0\" encoding=\"UTF-8\"?>
<fmiBuildDescription fmiVersion=\"3.0\">
  <BuildConfiguration modelIdentifier=\"mckibben\" description=\"see CMakeLists.txt\">
    <SourceFileSet language=\"C++20\">
${list}      <PreprocessorDefinition name=\"FMT_HEADER_ONLY\"/>
      <IncludeDirectory name=\".\"/>
    </SourceFileSet>
    <Library name=\"sundials_arkode\" external=\"true\"/>
    <Library name=\"sundials_cvode\" external=\"true\"/>
  </BuildConfiguration>
</fmiBuildDescription>
")
file(REMOVE ${OUTPUT})
execute_process(COMMAND ${CMAKE_COMMAND} -E tar cf ${OUTPUT} --format=zip --mtime=1980-01-01 binaries sources
  WORKING_DIRECTORY ${STAGE} COMMAND_ERROR_IS_FATAL ANY)
