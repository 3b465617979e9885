# How every target of this project is built.

# Flags of our own code. Libraries' headers are system headers and stay silent.
add_library(saccade_flags INTERFACE)
target_compile_options(saccade_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Wcast-align -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(saccade_flags INTERFACE -Wno-restrict)  # GCC 12 warns falsely of "x" + std::string
endif()
# The reference and the maps must not depend on the compiler's mood: a contraction into fused multiply-adds only
# where the code says so.
target_compile_options(saccade_flags INTERFACE -ffp-contract=off)
target_include_directories(saccade_flags INTERFACE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
if(SACCADE_SANITIZE)
  target_compile_options(saccade_flags INTERFACE
    -fsanitize=${SACCADE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer
    -Wno-maybe-uninitialized)  # GCC warns falsely in instrumented code
  target_link_options(saccade_flags INTERFACE -fsanitize=${SACCADE_SANITIZE})
endif()

# OpenCV's headers flood -Wconversion; its imported targets are system includes already.
add_library(saccade_opencv INTERFACE)
target_link_libraries(saccade_opencv INTERFACE opencv_core opencv_imgproc opencv_imgcodecs)
target_include_directories(saccade_opencv SYSTEM INTERFACE ${OpenCV_INCLUDE_DIRS})

# saccade_library(NAME SOURCES file... LINK target...): the library saccade_NAME of one folder.
function(saccade_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  add_library(saccade_${name} STATIC ${arg_SOURCES})
  target_link_libraries(saccade_${name} PUBLIC saccade_flags ${arg_LINK} PRIVATE ${arg_PRIVATE_LINK})
  set_target_properties(saccade_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
endfunction()
