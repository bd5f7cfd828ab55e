# SPDX-License-Identifier: Apache-2.0
# In a tree of the library, the port builds that tree:
#   vcpkg install deferred-shade --overlay-ports=packaging/vcpkg/ports
# In a registry, it downloads a release. To submit one, copy this folder to ports/ of the registry, then
#   - leave out the branch of the local tree;
#   - put the account that publishes the library for OWNER, here and in a "homepage" of vcpkg.json;
#   - put the checksum of the tag's archive for 0: vcpkg says it when it finds another one.
# Thrust is taken from the machine: from the CUDA toolkit in its usual place, or from CCCL_ROOT, which
# vcpkg hands on when VCPKG_KEEP_ENV_VARS names it.
set(VCPKG_BUILD_TYPE release)  # headers only

cmake_path(SET SOURCE_PATH NORMALIZE "${CMAKE_CURRENT_LIST_DIR}/../../../..")
if(NOT EXISTS "${SOURCE_PATH}/include/deferred_shade/version.hpp")
  vcpkg_from_github(
    OUT_SOURCE_PATH SOURCE_PATH
    REPO OWNER/deferred_shade
    REF "v${VERSION}"
    SHA512 0
    HEAD_REF main)
endif()

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
