# SPDX-License-Identifier: Apache-2.0
# cmake -P search_cccl.cmake: exits with 0 when this machine has a CCCL that the build would take.
cmake_minimum_required(VERSION 3.22)
include(${CMAKE_CURRENT_LIST_DIR}/../cmake/deferred_shade_cccl.cmake)
deferred_shade_search_cccl(${CMAKE_CURRENT_LIST_DIR}/../build/cccl)
if(NOT deferred_shade_cccl_dirs)
  message(FATAL_ERROR "${deferred_shade_cccl_error}")
endif()
message(STATUS "CCCL: ${deferred_shade_cccl_version} in ${deferred_shade_cccl_dirs}")
