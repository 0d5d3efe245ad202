# Installs the program, the library, its headers, and the package that find_package(lichtmc) finds.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/lichtmc)
install(TARGETS lichtmc EXPORT lichtmcTargets)
if(TARGET lichtmc_mpi)
  install(TARGETS lichtmc_mpi EXPORT lichtmcMpiTargets)
  install(EXPORT lichtmcMpiTargets NAMESPACE lichtmc:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lichtmc)
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/lichtmc DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
if(LICHTMC_BUILD_APPS)
  install(TARGETS lichtmc_program)
endif()
install(EXPORT lichtmcTargets NAMESPACE lichtmc:: DESTINATION ${package_dir})

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/lichtmcConfig.cmake.in
  ${PROJECT_BINARY_DIR}/lichtmcConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lichtmcConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/lichtmcConfig.cmake ${PROJECT_BINARY_DIR}/lichtmcConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/LichtmcDependencies.cmake DESTINATION ${package_dir})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
