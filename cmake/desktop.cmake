# What makes the program at home on a desktop: menu entry, icon, metainfo, documents. src/app/CHANGELOG.md must begin
# with this version.
file(STRINGS ${PROJECT_SOURCE_DIR}/src/app/CHANGELOG.md changelog_head REGEX "^## " LIMIT_COUNT 1)
if(NOT changelog_head MATCHES "^## ${PROJECT_VERSION} \\(([0-9-]+)\\)$")
  message(FATAL_ERROR "src/app/CHANGELOG.md begins with '${changelog_head}', not with version ${PROJECT_VERSION}")
endif()
set(changelog_date ${CMAKE_MATCH_1})
set(desktop ${PROJECT_SOURCE_DIR}/src/app/desktop)
set(documents ${CMAKE_INSTALL_DATADIR}/doc/saccade)

if(SACCADE_VIEWER)
  configure_file(${desktop}/io.github.saccade.metainfo.xml.in
    ${PROJECT_BINARY_DIR}/package/io.github.saccade.metainfo.xml @ONLY)
  install(FILES ${desktop}/saccade.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
  install(FILES ${desktop}/saccade.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
  install(FILES ${PROJECT_BINARY_DIR}/package/io.github.saccade.metainfo.xml
    DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo)
endif()
install(FILES ${desktop}/copyright ${PROJECT_SOURCE_DIR}/src/app/CHANGELOG.md DESTINATION ${documents})
install(PROGRAMS ${PROJECT_SOURCE_DIR}/src/eval/cluster.sh DESTINATION ${documents}/examples)

# The rooms' documents that help a user, each by the name of its room. They are written for the source tree: there
# ./run is the program, and the bundled recording is in recordings/.
set(rooms src src/app src/attention src/eval src/models src/oni src/output src/saliency src/sources src/tracking drivers ui)
if(SACCADE_PYTHON)
  list(APPEND rooms src/python)
endif()
foreach(room IN LISTS rooms)
  cmake_path(GET room FILENAME name)
  string(REGEX REPLACE "^src$" "library" name ${name})
  string(REGEX REPLACE "^app$" "commands" name ${name})
  install(CODE "
    file(READ ${PROJECT_SOURCE_DIR}/${room}/README.md text)
    string(REPLACE ./run saccade text \"\${text}\")
    string(REPLACE recordings/table.oni \${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}/saccade/table.oni text \"\${text}\")
    file(WRITE ${PROJECT_BINARY_DIR}/package/doc/${name}.md \"\${text}\")")
  install(FILES ${PROJECT_BINARY_DIR}/package/doc/${name}.md DESTINATION ${documents})
endforeach()
