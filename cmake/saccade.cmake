# How every target of this project is built.

# Flags of our own code, which nobody who uses the libraries inherits. The headers of other libraries are system headers
# and stay silent.
add_library(saccade_flags INTERFACE)
target_compile_options(saccade_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Wcast-align)
if(SACCADE_WERROR)
  target_compile_options(saccade_flags INTERFACE -Werror)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 warns falsely of strings.
  target_compile_options(saccade_flags INTERFACE
    -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread)
endif()
# Results must not depend on the compiler: multiplications and additions are fused only where the code says so.
target_compile_options(saccade_flags INTERFACE -ffp-contract=off)
target_include_directories(saccade_flags INTERFACE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})

if(SACCADE_SANITIZE)
  add_compile_options(
    -fsanitize=${SACCADE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)  # GCC warns falsely in instrumented code
  add_link_options(-fsanitize=${SACCADE_SANITIZE})
  # Before a program that the build runs: what is known of libraries is not reported.
  set(saccade_runs_with ${CMAKE_COMMAND} -E env
    TSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/tsan.supp
    LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/lsan.supp:print_suppressions=0)
endif()

# OpenCV with its headers, which flood -Wconversion, as system headers. cmake/package.cmake exports the target without
# their folder, and SaccadeConfig.cmake adds the one of the machine at hand. The program does without imgcodecs and
# videoio: they load 80 libraries more, GDAL and GStreamer among them, which takes longer than a frame.
add_library(saccade_opencv INTERFACE)
add_library(saccade::opencv ALIAS saccade_opencv)
target_link_libraries(saccade_opencv INTERFACE opencv_core opencv_imgproc $<INSTALL_INTERFACE:opencv_imgcodecs>)
target_include_directories(saccade_opencv SYSTEM INTERFACE $<BUILD_INTERFACE:${OpenCV_INCLUDE_DIRS}>)
set_target_properties(saccade_opencv PROPERTIES EXPORT_NAME opencv)

# The large headers that most files include, precompiled once for all libraries: it saves a quarter to a half of the time
# of a file. Each includes what it needs all the same, which the preset tidy checks, where nothing is precompiled.
#
# The preset release also compiles the files of a target together, sixteen at a time (CMAKE_UNITY_BUILD), which halves the time
# of a build from nothing. So names in anonymous namespaces are unique within a room, and within a test program:
# CMAKE_UNITY_BUILD_BATCH_SIZE=0, which makes one unit of each target, shows whether they are. Nor are they names of headers
# there: such a name would hide that of the header from the other files without an error. The other presets compile file by
# file.
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/headers.cpp CONTENT "// Only for its precompiled headers.\n")
add_library(saccade_headers OBJECT ${PROJECT_BINARY_DIR}/headers.cpp)
target_link_libraries(saccade_headers PRIVATE saccade_flags saccade_opencv fmt::fmt)
target_compile_features(saccade_headers PRIVATE cxx_std_20)
set_target_properties(saccade_headers PROPERTIES POSITION_INDEPENDENT_CODE ON)
target_precompile_headers(saccade_headers PRIVATE
  <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <mutex> <optional> <span>
  <string> <string_view> <thread> <utility> <variant> <vector> <fmt/format.h> <opencv2/core.hpp>)
target_compile_definitions(saccade_flags INTERFACE FMT_SHARED)  # by all as by fmt::fmt, or the compiler refuses them

# saccade_library(NAME SOURCES file... LINK target... PRIVATE_LINK target...): the library saccade::NAME of one folder.
# cmake/package.cmake says which of them are installed.
function(saccade_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  add_library(saccade_${name} STATIC ${arg_SOURCES})
  add_library(saccade::${name} ALIAS saccade_${name})
  target_link_libraries(saccade_${name}
    PUBLIC ${arg_LINK}
    PRIVATE $<BUILD_INTERFACE:saccade_flags> ${arg_PRIVATE_LINK})
  target_include_directories(saccade_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  target_compile_features(saccade_${name} PUBLIC cxx_std_20)
  set_target_properties(saccade_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON EXPORT_NAME ${name})
  target_precompile_headers(saccade_${name} REUSE_FROM saccade_headers)
endfunction()
