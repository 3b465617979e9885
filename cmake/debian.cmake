# cpack -G DEB: one package with the program, the driver modules, the C++ library and the Python module.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME saccade)
set(CPACK_PACKAGE_VENDOR "The Saccade authors")
set(CPACK_PACKAGE_CONTACT "The Saccade authors <saccade@users.noreply.github.com>")
set(CPACK_PACKAGE_FILE_NAME saccade_${PROJECT_VERSION}_${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_SET_DESTDIR ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "attention points in the depth images of RGB-D sensors")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"Saccade finds one attention point per object in the depth images of a
Kinect, an Xtion or a recording, in real time and without training: it
computes how mirror-symmetric the surface around each pixel is.

The package holds the program (viewer, headless processing, recording,
evaluation), driver modules for OpenNI2, and libraries for programs of
your own in C++ and Python.")
# dpkg-shlibdeps finds what is linked. The rest is what src/app/lazy_libav.cpp opens, what the window's libraries open
# while they run (OpenGL, X11), and the font.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(opened)
foreach(library libavcodec libavformat libavutil libswscale)
  string(REGEX MATCH "^[0-9]+" major "${libav_${library}_VERSION}")
  list(APPEND opened ${library}${major})
endforeach()
list(JOIN opened ", " CPACK_DEBIAN_PACKAGE_DEPENDS)
if(SACCADE_VIEWER)
  string(APPEND CPACK_DEBIAN_PACKAGE_DEPENDS ", libgl1, libegl1, libx11-xcb1, libxcursor1, libxi6, libxinerama1, libxrandr2, \
libxrender1, libxxf86vm1, fonts-dejavu-core")
endif()
if(SACCADE_PYTHON)
  math(EXPR next_python "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PACKAGE_RECOMMENDS
    "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_python}), python3-numpy")
endif()
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libopencv-dev, libeigen3-dev, libfmt-dev, libhwy-dev, libturbojpeg0-dev, \
libspng-dev, libdeflate-dev, libavformat-dev, libavcodec-dev, \
libavutil-dev, libswscale-dev, liblz4-dev, libzstd-dev, libbz2-dev, libsqlite3-dev, libopenni2-dev")

set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/debian_files.cmake)
set(CPACK_SACCADE_DATE ${changelog_date})
include(CPack)
