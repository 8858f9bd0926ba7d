# `cmake --install build` gives a package: find_package(dovetail), targets dovetail::core ... dovetail::studies.
include(CMakePackageConfigHelpers)

get_property(targets GLOBAL PROPERTY DOVETAIL_TARGETS)
install(TARGETS ${targets} EXPORT dovetailTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/dovetail)
if(TARGET dovetail_program)
  install(TARGETS dovetail_program dovetail_mpi_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  # What its command line says of itself, for shells and manuals.
  set(shell_dir ${PROJECT_BINARY_DIR}/shell)
  install(CODE "file(MAKE_DIRECTORY ${shell_dir})
    foreach(kind bash zsh man)
      execute_process(COMMAND $<TARGET_FILE:dovetail_program> completion \${kind} OUTPUT_FILE ${shell_dir}/\${kind}
        COMMAND_ERROR_IS_FATAL ANY)
    endforeach()")
  install(FILES ${shell_dir}/bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME dovetail)
  install(FILES ${shell_dir}/zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions RENAME _dovetail)
  install(FILES ${shell_dir}/man DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 RENAME dovetail.1)
endif()

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/dovetail)
install(EXPORT dovetailTargets NAMESPACE dovetail:: DESTINATION ${package_dir})
install(FILES ${PROJECT_SOURCE_DIR}/.cmake/packages.cmake DESTINATION ${package_dir})
configure_package_config_file(${PROJECT_SOURCE_DIR}/.cmake/dovetailConfig.cmake.in
  ${PROJECT_BINARY_DIR}/dovetailConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/dovetailConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/dovetailConfig.cmake ${PROJECT_BINARY_DIR}/dovetailConfigVersion.cmake
  DESTINATION ${package_dir})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
