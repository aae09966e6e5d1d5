# The program inside an FMU: the ride of a rig with the interfaces of FMI 2.0 and 3.0, as one shared library that
# needs nothing but libc and libm. An FMU carries this file with its sources, so that others can build it; the
# program's own build makes it of its rooms (CMakeLists.txt).
#   MCKIBBEN_ROOT: the folder that holds plant/ and sim/
# SUNDIALS, libstdc++ and libgcc are linked statically; of Eigen and fmt the headers are enough.
file(GLOB fmu_sources CONFIGURE_DEPENDS ${MCKIBBEN_ROOT}/plant/*.cpp ${MCKIBBEN_ROOT}/sim/engine/*.cpp
  ${MCKIBBEN_ROOT}/sim/ride/*.cpp ${MCKIBBEN_ROOT}/sim/fmu/model/*.cpp ${MCKIBBEN_ROOT}/sim/domain/rig_number.cpp
  ${MCKIBBEN_ROOT}/sim/domain/number.cpp)
foreach(library arkode cvode generic)
  find_library(SUNDIALS_${library}_STATIC libsundials_${library}.a REQUIRED)
  list(APPEND fmu_static ${SUNDIALS_${library}_STATIC})
endforeach()
add_library(mckibben_fmu MODULE ${fmu_sources})
target_include_directories(mckibben_fmu PRIVATE ${MCKIBBEN_ROOT})
target_link_libraries(mckibben_fmu PRIVATE Eigen3::Eigen fmt::fmt-header-only ${fmu_static} m)
target_link_options(mckibben_fmu PRIVATE -static-libstdc++ -static-libgcc -s LINKER:--no-undefined
  LINKER:--version-script=${MCKIBBEN_ROOT}/sim/fmu/model/exports.map)
# As in the program itself: the same numbers.
target_compile_options(mckibben_fmu PRIVATE -fno-tree-vectorize -fno-math-errno)
foreach(lanes batch lane_problem vectorised)
  set_property(SOURCE ${MCKIBBEN_ROOT}/sim/engine/${lanes}.cpp TARGET_DIRECTORY mckibben_fmu APPEND PROPERTY
    COMPILE_OPTIONS -ftree-vectorize -fno-trapping-math -ffp-contract=off -Wno-psabi)
endforeach()
set_target_properties(mckibben_fmu PROPERTIES PREFIX "" OUTPUT_NAME mckibben CXX_VISIBILITY_PRESET hidden
  VISIBILITY_INLINES_HIDDEN ON POSITION_INDEPENDENT_CODE ON CXX_STANDARD 20)
