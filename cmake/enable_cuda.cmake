# SPDX-License-Identifier: Apache-2.0
# Enables the CUDA language for this project's own programs, with nvcc, and with the C++ compiler of the
# build as its host compiler unless another one was named. Without CMAKE_CUDA_ARCHITECTURES they are built
# for the GPUs of this machine, and where it has none, for Ampere and Hopper.

if(NOT DEFINED CMAKE_CUDA_ARCHITECTURES AND NOT DEFINED ENV{CUDAARCHS})
  execute_process(COMMAND nvidia-smi --query-gpu=compute_cap --format=csv,noheader
    OUTPUT_VARIABLE output ERROR_QUIET)
  string(REGEX MATCHALL "[0-9]+\\.[0-9]" capabilities "${output}")
  string(REPLACE "." "" architectures "${capabilities}")
  list(REMOVE_DUPLICATES architectures)
  if(NOT architectures)
    set(architectures 80 90)
  endif()
  set(CMAKE_CUDA_ARCHITECTURES "${architectures}" CACHE STRING "CUDA architectures")
endif()
if(NOT DEFINED CMAKE_CUDA_HOST_COMPILER AND NOT DEFINED ENV{CUDAHOSTCXX})
  set(CMAKE_CUDA_HOST_COMPILER "${CMAKE_CXX_COMPILER}" CACHE FILEPATH "Host compiler of nvcc")
endif()

enable_language(CUDA)
message(STATUS "CUDA architectures: ${CMAKE_CUDA_ARCHITECTURES}")
