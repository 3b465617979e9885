# OpenNI2, and the folder from which our programs load it together with its driver modules; drivers/README.md has the
# layout and the reason. A library that only calls OpenNI2 links OpenNI2::OpenNI2; saccade_use_sensors(TARGET) makes a
# program or test load it from that folder. Without SACCADE_OPENNI2 nothing is looked for.
if(NOT SACCADE_OPENNI2)
  function(saccade_use_sensors target)
  endfunction()
  return()
endif()

find_library(OPENNI2_LIBRARY OpenNI2 REQUIRED)
find_path(OPENNI2_INCLUDE_DIR OpenNI.h PATH_SUFFIXES openni2 REQUIRED)
add_library(OpenNI2::OpenNI2 INTERFACE IMPORTED GLOBAL)
target_link_libraries(OpenNI2::OpenNI2 INTERFACE ${OPENNI2_LIBRARY})
target_include_directories(OpenNI2::OpenNI2 SYSTEM INTERFACE ${OPENNI2_INCLUDE_DIR})

set(SACCADE_REDIST ${PROJECT_BINARY_DIR}/openni2)
set(SACCADE_REDIST_INSTALLED ${CMAKE_INSTALL_LIBDIR}/saccade/openni2)
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

file(STRINGS ${OPENNI2_INCLUDE_DIR}/OniVersion.h openni2_numbers REGEX "define ONI_VERSION_(MAJOR|MINOR|MAINTENANCE|BUILD)\t")
list(TRANSFORM openni2_numbers REPLACE ".*\t([0-9]+).*" "\\1")
list(JOIN openni2_numbers "." OPENNI2_VERSION)

# saccade_driver_module(NAME SOURCES file... LINK target...): the OpenNI2 driver module libNAME.so.0.
add_custom_target(saccade_driver_modules)
function(saccade_driver_module name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINK" ${ARGN})
  add_library(${name} MODULE ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE saccade_flags ${arg_LINK})
  # OpenNI2 unloads its modules when a program has finished with it; the libraries below ours do not support that, so
  # the module stays.
  target_link_options(${name} PRIVATE
    LINKER:--version-script=${CMAKE_CURRENT_SOURCE_DIR}/exports.map LINKER:-z,nodelete)
  set_target_properties(${name} PROPERTIES
    SUFFIX .so.0 LIBRARY_OUTPUT_DIRECTORY ${SACCADE_REDIST}/OpenNI2/Drivers
    LINK_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/exports.map
    BUILD_WITH_INSTALL_RPATH ON)
  install(TARGETS ${name} LIBRARY DESTINATION ${SACCADE_REDIST_INSTALLED}/OpenNI2/Drivers)
  add_dependencies(saccade_driver_modules ${name})
endfunction()

# saccade_use_sensors(TARGET [BUILT folder INSTALLED folder]); with INSTALLED: the target is built into the one folder, and
# has been installed by install(TARGETS) into the other, which is relative to the prefix.
function(saccade_use_sensors target)
  cmake_parse_arguments(arg "" "BUILT;INSTALLED" "" ${ARGN})
  target_link_libraries(${target} PRIVATE OpenNI2::OpenNI2)
  add_dependencies(${target} saccade_driver_modules)
  if(SACCADE_SANITIZE MATCHES address)
    target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests/support/keep_modules.cpp)
  endif()
  if(NOT arg_INSTALLED)
    set_target_properties(${target} PROPERTIES BUILD_RPATH ${SACCADE_REDIST})
    return()
  endif()
  # A RUNPATH that CMake is to replace when it installs gets an empty last entry, and there the loader looks in the
  # working directory. So the build tree has that of both places, and it is cut when the program has been installed.
  file(RELATIVE_PATH built ${arg_BUILT} ${SACCADE_REDIST})
  file(RELATIVE_PATH installed /prefix/${arg_INSTALLED} /prefix/${SACCADE_REDIST_INSTALLED})
  set_target_properties(${target} PROPERTIES
    BUILD_WITH_INSTALL_RPATH ON INSTALL_RPATH "$ORIGIN/${built};$ORIGIN/${installed}")
  set(file "\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${arg_INSTALLED}/$<TARGET_FILE_NAME:${target}>")
  install(CODE "file(RPATH_SET FILE \"${file}\" NEW_RPATH \"$ORIGIN/${installed}\")")
endfunction()
