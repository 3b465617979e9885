# The installed C++ library: find_package(Saccade) gives saccade::saliency, saccade::models, saccade::attention,
# saccade::tracking and saccade::sources. src/README.md shows its use.
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Saccade)

set(package_targets opencv core attention_simd saliency_simd saliency models attention tracking scene oni openni2 sources)
if(SACCADE_OPENNI2)
  list(APPEND package_targets openni2_modules)
endif()
list(TRANSFORM package_targets PREPEND saccade_)
install(TARGETS ${package_targets} EXPORT SaccadeTargets INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT SaccadeTargets NAMESPACE saccade:: DESTINATION ${package_folder})

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/SaccadeConfig.cmake.in
  ${PROJECT_BINARY_DIR}/package/SaccadeConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/SaccadeConfigVersion.cmake
  COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/package/SaccadeConfig.cmake ${PROJECT_BINARY_DIR}/package/SaccadeConfigVersion.cmake
        DESTINATION ${package_folder})

# The public headers, with all that they include; tests/package compiles them. Inside the project they include one another by the name
# of the room, "core/frame.hpp"; in an installed header that becomes "saccade/core/frame.hpp", so that a user's own
# folder core/ is never in the way.
set(public_headers
  core/background_job.hpp core/error.hpp core/frame.hpp core/frame_source.hpp core/intrinsics.hpp core/sensor_controls.hpp
  core/input_settings.hpp core/sensor_settings.hpp core/setting.hpp core/stage_times.hpp core/version.hpp core/worker_pool.hpp
  saliency/params.hpp saliency/probe.hpp saliency/reference.hpp saliency/symmetry3d.hpp
  models/model.hpp models/model_settings.hpp
  sources/open_source.hpp sources/source_options.hpp)
# AttentionTracker holds most of these rooms' objects.
file(GLOB tracker_headers RELATIVE ${PROJECT_SOURCE_DIR}/src CONFIGURE_DEPENDS
  ${PROJECT_SOURCE_DIR}/src/attention/*.hpp ${PROJECT_SOURCE_DIR}/src/tracking/*.hpp)
list(APPEND public_headers ${tracker_headers})
foreach(header IN LISTS public_headers)
  cmake_path(GET header PARENT_PATH room)
  set(file ${PROJECT_SOURCE_DIR}/src/${header})
  if(header STREQUAL core/version.hpp)
    set(file ${PROJECT_BINARY_DIR}/src/core/${header})
  endif()
  install(CODE "
    file(READ ${file} text)
    string(REGEX REPLACE \"#include \\\"([^\\\"]+)\\\"\" \"#include \\\"saccade/\\\\1\\\"\" text \"\${text}\")
    file(WRITE ${PROJECT_BINARY_DIR}/package/${header} \"\${text}\")")
  install(FILES ${PROJECT_BINARY_DIR}/package/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/saccade/${room})
endforeach()
