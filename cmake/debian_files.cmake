# Run by cpack on the folder that becomes the package: adds Debian's form of the change log, and compresses it and the
# manual pages as Debian wants them.
set(share ${CPACK_TEMPORARY_DIRECTORY}/usr/share)
execute_process(COMMAND date -R -u -d ${CPACK_SACCADE_DATE} OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE
                COMMAND_ERROR_IS_FATAL ANY)
file(WRITE ${share}/doc/saccade/changelog
"saccade (${CPACK_PACKAGE_VERSION}) stable; urgency=medium

  * Version ${CPACK_PACKAGE_VERSION}; CHANGELOG.md in this folder says what is new.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
file(GLOB files ${share}/man/man1/* ${share}/doc/saccade/changelog)
execute_process(COMMAND gzip -9n ${files} COMMAND_ERROR_IS_FATAL ANY)
file(GLOB files ${share}/man/man1/* ${share}/doc/saccade/changelog.gz)
file(CHMOD ${files} PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
