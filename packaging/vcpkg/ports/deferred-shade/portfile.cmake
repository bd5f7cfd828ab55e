# SPDX-License-Identifier: Apache-2.0
# Builds from the tree that this file lies in: vcpkg install deferred-shade --overlay-ports=packaging/vcpkg/ports
# Thrust is taken from the machine: from the CUDA toolkit in its usual place, or from CCCL_ROOT, which
# vcpkg hands on when VCPKG_KEEP_ENV_VARS names it.
set(VCPKG_BUILD_TYPE release)  # headers only

cmake_path(SET SOURCE_PATH NORMALIZE "${CMAKE_CURRENT_LIST_DIR}/../../../..")

vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS
    -DDEFERRED_SHADE_BUILD_TESTS=OFF
    -DDEFERRED_SHADE_BUILD_EXAMPLES=OFF
    -DDEFERRED_SHADE_BUILD_BENCHMARKS=OFF
    -DDEFERRED_SHADE_FETCH_CCCL=OFF
    -DDEFERRED_SHADE_INSTALL=ON)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME deferred_shade CONFIG_PATH share/cmake/deferred_shade)

file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/share/cmake" "${CURRENT_PACKAGES_DIR}/share/doc")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
