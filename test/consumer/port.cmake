# SPDX-License-Identifier: Apache-2.0
# cmake -D SOURCE_DIR=... -D BINARY_DIR=... -P port.cmake
# The vcpkg port builds the tree that it lies in, and the release of its version elsewhere. vcpkg's functions only note
# here what they are given.

cmake_minimum_required(VERSION 3.22)
set(port ${SOURCE_DIR}/packaging/vcpkg/ports/deferred-shade)
file(READ ${port}/vcpkg.json manifest)
string(JSON VERSION GET "${manifest}" version)
set(CURRENT_PACKAGES_DIR ${BINARY_DIR}/packages)
file(REMOVE_RECURSE ${BINARY_DIR})

function(vcpkg_from_github)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "OUT_SOURCE_PATH;REPO;REF;SHA512;HEAD_REF" "")
  set(${arg_OUT_SOURCE_PATH} "archive of ${arg_REF}" PARENT_SCOPE)
endfunction()
function(vcpkg_cmake_configure)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "SOURCE_PATH" "OPTIONS")
  set(configured "${arg_SOURCE_PATH}" PARENT_SCOPE)
endfunction()
function(vcpkg_cmake_install)
endfunction()
function(vcpkg_cmake_config_fixup)
endfunction()
function(vcpkg_install_copyright)
endfunction()

include(${port}/portfile.cmake)
file(REAL_PATH ${SOURCE_DIR} tree)
file(REAL_PATH ${configured} configured)
if(NOT configured STREQUAL tree)
  message(FATAL_ERROR "in a tree, the port builds ${configured} instead of ${tree}")
endif()
file(COPY ${port} DESTINATION ${BINARY_DIR}/registry/one/two/ports)
include(${BINARY_DIR}/registry/one/two/ports/deferred-shade/portfile.cmake)
if(NOT configured STREQUAL "archive of v${VERSION}")
  message(FATAL_ERROR "in a registry, the port builds ${configured} instead of the release")
endif()
