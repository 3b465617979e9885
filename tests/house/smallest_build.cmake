# The program without the viewer, sensors and the Python module: it configures without looking for their libraries, builds, works, and
# says what it leaves out. Each part left out alone configures too.
#
# cmake -DSOURCE_FOLDER=.. -DBUILD_FOLDER=.. -DBUILD_TYPE=.. -DCOMPILER=.. -DLAUNCHER=.. -P smallest_build.cmake

function(configure folder)
  execute_process(
    COMMAND ${CMAKE_COMMAND} --fresh -G Ninja -S ${SOURCE_FOLDER} -B ${folder} -DCMAKE_BUILD_TYPE=${BUILD_TYPE}
            -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} -DSACCADE_WERROR=ON
            -DSACCADE_TESTS=OFF ${ARGN}
    OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN} does not configure:\n${output}")
  endif()
endfunction()

# expect(STATUS TEXT ARGUMENT...): `saccade ARGUMENT...` ends with this status, and its output has a match of TEXT.
function(expect status text)
  execute_process(COMMAND ${BUILD_FOLDER}/all/saccade ${ARGN} WORKING_DIRECTORY ${BUILD_FOLDER}
                  OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE actual)
  if(NOT actual EQUAL ${status} OR NOT output MATCHES "${text}")
    message(FATAL_ERROR "saccade ${ARGN}: status ${actual} instead of ${status}, or no '${text}' in\n${output}")
  endif()
endfunction()

foreach(part VIEWER OPENNI2 FREENECT PYTHON)
  configure(${BUILD_FOLDER}/${part} -DSACCADE_${part}=OFF)
endforeach()
configure(${BUILD_FOLDER}/all
  -DSACCADE_VIEWER=OFF -DSACCADE_OPENNI2=OFF -DSACCADE_FREENECT=OFF -DSACCADE_PYTHON=OFF)

file(STRINGS ${BUILD_FOLDER}/all/CMakeCache.txt entries REGEX "^[A-Za-z]")
list(FILTER entries EXCLUDE REGEX "^SACCADE_")
# By their names: values may list what only static linking needs.
list(FILTER entries INCLUDE REGEX "^[^:]*([Gg][Ll][Ff][Ww]|[Ii][Mm][Gg][Uu][Ii]|[Ee][Pp][Oo][Xx][Yy]|OPENGL|X11|[Nn][Ii]2|\
[Ff][Rr][Ee][Ee][Nn][Ee][Cc][Tt]|[Hh][Dd][Ff]5|GTest|[Pp][Yy][Bb][Ii][Nn][Dd]|Python|PYTHON)[^:]*:")
if(entries)
  message(FATAL_ERROR "The smallest build looks for what it does not need:\n${entries}")
endif()

execute_process(
  COMMAND ${CMAKE_COMMAND} --build ${BUILD_FOLDER}/all --target saccade
  OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "The smallest build fails:\n${output}")
endif()

expect(0 "1 frame" run "synthetic:table?size=160x120&frames=1" --levels 0..1 --out ${BUILD_FOLDER}/out)
expect(0 "openni2.*not in this build" run --help)
expect(2 "this build has no viewer .*SACCADE_VIEWER=OFF" view --paused)
expect(2 "this build has no OpenNI2 .*SACCADE_OPENNI2=OFF" run openni2 --out ${BUILD_FOLDER}/out)
expect(2 "this build has no OpenNI2" devices)
expect(0 "this build has no OpenNI2 .*configure with -DSACCADE_OPENNI2=ON" doctor)
