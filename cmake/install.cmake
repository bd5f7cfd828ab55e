# SPDX-License-Identifier: Apache-2.0
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(package_dir ${CMAKE_INSTALL_DATADIR}/cmake/deferred_shade)
configure_package_config_file(
  ${PROJECT_SOURCE_DIR}/cmake/deferred_shadeConfig.cmake.in
  ${PROJECT_BINARY_DIR}/package/deferred_shadeConfig.cmake
  INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(
  ${PROJECT_BINARY_DIR}/package/deferred_shadeConfigVersion.cmake
  COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "*.hpp")
install(TARGETS deferred_shade EXPORT deferred_shadeTargets)
install(EXPORT deferred_shadeTargets NAMESPACE deferred_shade:: DESTINATION ${package_dir})
install(FILES
  ${PROJECT_BINARY_DIR}/package/deferred_shadeConfig.cmake
  ${PROJECT_BINARY_DIR}/package/deferred_shadeConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/deferred_shade_cccl.cmake
  ${PROJECT_SOURCE_DIR}/cmake/deferred_shade_systems.cmake
  DESTINATION ${package_dir})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/deferred_shade)
