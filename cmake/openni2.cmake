# OpenNI2, and the folder from which a program of ours loads it together with its driver modules.
#
# OpenNI2 looks for driver modules in the folder OpenNI2/Drivers beside the libOpenNI2.so.0 that was loaded, and a
# symbolic link counts as the place where it lies. So a folder with a link to the library, links to the stock modules
# and our own modules makes all sensors known to any program that loads the library from there:
#
#   <build>/openni2/            or  <prefix>/lib/saccade/openni2/
#     libOpenNI2.so.0               -> the system's
#     OpenNI2/Drivers/
#       libPS1080.so.0, libPSLink.so.0  -> the system's
#       libSaccadeVirtual.so.0, libSaccadeFreenect.so.0  drivers/modules
#
# saccade_use_sensors(TARGET) makes a program or test do so, without any environment variable. A library that only calls
# OpenNI2 links OpenNI2::OpenNI2. Other programs, such as NiViewer2, see our devices with LD_LIBRARY_PATH=<that folder>.
find_library(OPENNI2_LIBRARY OpenNI2 REQUIRED)
find_path(OPENNI2_INCLUDE_DIR OpenNI.h PATH_SUFFIXES openni2 REQUIRED)
add_library(OpenNI2::OpenNI2 INTERFACE IMPORTED GLOBAL)
target_link_libraries(OpenNI2::OpenNI2 INTERFACE ${OPENNI2_LIBRARY})
target_include_directories(OpenNI2::OpenNI2 SYSTEM INTERFACE ${OPENNI2_INCLUDE_DIR})

set(SACCADE_REDIST ${PROJECT_BINARY_DIR}/openni2)
set(SACCADE_REDIST_INSTALLED lib/saccade/openni2)
cmake_path(GET OPENNI2_LIBRARY PARENT_PATH openni2_home)
foreach(file libOpenNI2.so.0 OpenNI2/Drivers/libPS1080.so.0 OpenNI2/Drivers/libPSLink.so.0)
  if(NOT EXISTS ${openni2_home}/${file})
    message(FATAL_ERROR "OpenNI2 is incomplete: ${openni2_home}/${file} is missing (install libopenni2-0)")
  endif()
  cmake_path(GET file PARENT_PATH folder)
  file(MAKE_DIRECTORY ${SACCADE_REDIST}/${folder})
  file(CREATE_LINK ${openni2_home}/${file} ${SACCADE_REDIST}/${file} SYMBOLIC)
  install(FILES ${SACCADE_REDIST}/${file} DESTINATION ${SACCADE_REDIST_INSTALLED}/${folder})
endforeach()

# saccade_driver_module(NAME SOURCES file... LINK target...): the OpenNI2 driver module libNAME.so.0.
add_custom_target(saccade_driver_modules)
function(saccade_driver_module name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINK" ${ARGN})
  add_library(${name} MODULE ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE saccade_flags ${arg_LINK})
  # OpenNI2 unloads its modules when a program is done with it; the libraries below ours do not bear that, so the
  # module stays.
  target_link_options(${name} PRIVATE
    LINKER:--version-script=${CMAKE_CURRENT_SOURCE_DIR}/exports.map LINKER:-z,nodelete)
  set_target_properties(${name} PROPERTIES
    SUFFIX .so.0 LIBRARY_OUTPUT_DIRECTORY ${SACCADE_REDIST}/OpenNI2/Drivers
    LINK_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/exports.map)
  install(TARGETS ${name} LIBRARY DESTINATION ${SACCADE_REDIST_INSTALLED}/OpenNI2/Drivers)
  add_dependencies(saccade_driver_modules ${name})
endfunction()

function(saccade_use_sensors target)
  target_link_libraries(${target} PRIVATE OpenNI2::OpenNI2)
  add_dependencies(${target} saccade_driver_modules)
  if(SACCADE_SANITIZE MATCHES address)
    target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests/support/keep_modules.cpp)
  endif()
  set_target_properties(${target} PROPERTIES
    BUILD_RPATH ${SACCADE_REDIST} INSTALL_RPATH $ORIGIN/../${SACCADE_REDIST_INSTALLED})
endfunction()
