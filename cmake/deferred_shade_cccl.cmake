# SPDX-License-Identifier: Apache-2.0
# Finds CCCL (Thrust, CUB, libcu++), for the build and for the installed package alike.
#
#   deferred_shade_find_cccl([ROOTS <dir>...] [FETCH <bool>])
#
# makes the imported target deferred_shade::cccl from the first copy that is new enough, looking in
#   1. CCCL_ROOT, a CMake or an environment variable: a header directory, a prefix, a git checkout,
#      or the --target directory of a pip install of NVIDIA's wheel,
#   2. the CUDA toolkit, beside nvcc or in the usual places,
#   3. ROOTS,
#   4. the compiler's and CMake's own search paths,
#   5. github.com, when FETCH is true.
# Without one, there is no target, and deferred_shade_cccl_error says why. A CCCL_ROOT that holds none, or one
# that is too old, is an error: nothing else is looked at. CCCL's own CMake files are not used: those inside the
# wheels do not work, and a header path is all that is needed.

set(deferred_shade_cccl_minimum 2.8.0)  # CUDA 12.9
set(deferred_shade_cccl_tag v3.0.1)     # CUDA 13.0; what FETCH brings

# Sets <dirs> to the header directories below <root>, and <version> to what they hold. If that cannot be used,
# <dirs> is empty, and <fault> says why.
function(deferred_shade_cccl_below root dirs version fault)
  set(${dirs} "" PARENT_SCOPE)
  set(${version} "" PARENT_SCOPE)
  set(why "no CCCL")
  file(GLOB nested
    "${root}/targets/*/include/cccl" "${root}/targets/*/include"
    "${root}/nvidia/*/include/cccl" "${root}/nvidia/*/include")
  foreach(dir IN ITEMS "${root}/include/cccl" "${root}/include" "${root}" "${root}/thrust" LISTS nested)
    if(NOT EXISTS "${dir}/thrust/version.h")
      continue()
    endif()
    file(STRINGS "${dir}/thrust/version.h" line REGEX "^#define THRUST_VERSION +[0-9]+")
    string(REGEX MATCH "[0-9]+" number "${line}")
    if(NOT number)
      continue()
    endif()
    math(EXPR major "${number} / 100000")
    math(EXPR minor "${number} / 100 % 1000")
    math(EXPR patch "${number} % 100")
    set(found_version "${major}.${minor}.${patch}")

    set(found "${dir}")
    set(lacks "")
    if(NOT EXISTS "${dir}/cuda/std/type_traits")
      if(EXISTS "${root}/libcudacxx/include/cuda/std/type_traits")
        set(found "${root}/thrust" "${root}/libcudacxx/include" "${root}/cub")
      else()
        set(lacks " and has no libcu++ (cuda/std) beside it")
      endif()
    endif()
    if(found_version VERSION_LESS deferred_shade_cccl_minimum)
      set(why "${found_version} in ${dir}, which is older than ${deferred_shade_cccl_minimum}${lacks}")
    elseif(lacks)
      set(why "${found_version} in ${dir}, which is Thrust alone${lacks}")
    else()
      set(${dirs} "${found}" PARENT_SCOPE)
      set(${version} "${found_version}" PARENT_SCOPE)
      set(${fault} "" PARENT_SCOPE)
      return()
    endif()
  endforeach()
  set(${fault} "${why}" PARENT_SCOPE)
endfunction()

# The first of these roots that holds a CCCL: sets deferred_shade_cccl_dirs and _version, or deferred_shade_cccl_error.
function(deferred_shade_first_cccl)
  set(passed_over "")
  foreach(root IN LISTS ARGN)
    deferred_shade_cccl_below("${root}" dirs version fault)
    if(dirs)
      set(deferred_shade_cccl_dirs "${dirs}" PARENT_SCOPE)
      set(deferred_shade_cccl_version "${version}" PARENT_SCOPE)
      return()
    elseif(NOT fault STREQUAL "no CCCL")
      list(APPEND passed_over "\n  passed over: ${fault}")
    endif()
  endforeach()
  list(REMOVE_DUPLICATES passed_over)
  string(CONCAT error
    "CCCL ${deferred_shade_cccl_minimum} or newer was not found. Set CCCL_ROOT to a CUDA toolkit, to "
    "a checkout of github.com/NVIDIA/cccl, or to DIR after\n"
    "  python3 -m pip install --no-deps --only-binary=:all: --target DIR nvidia-cuda-cccl==13.0.85"
    ${passed_over})
  set(deferred_shade_cccl_dirs "" PARENT_SCOPE)
  set(deferred_shade_cccl_error "${error}" PARENT_SCOPE)
endfunction()

# Searches places 1 to 4; sets deferred_shade_cccl_dirs and _version, or deferred_shade_cccl_error. Sets
# deferred_shade_cccl_root to whether CCCL_ROOT is set, and so decides.
function(deferred_shade_search_cccl)
  set(deferred_shade_cccl_root TRUE PARENT_SCOPE)
  foreach(place IN ITEMS "variable" "environment variable")
    set(root "${CCCL_ROOT}")
    if(place STREQUAL "environment variable")
      set(root "$ENV{CCCL_ROOT}")
    endif()
    if(root)
      deferred_shade_cccl_below("${root}" dirs version fault)
      set(deferred_shade_cccl_dirs "${dirs}" PARENT_SCOPE)
      set(deferred_shade_cccl_version "${version}" PARENT_SCOPE)
      if(fault)
        set(deferred_shade_cccl_error
          "The ${place} CCCL_ROOT is ${root}, and holds ${fault}. Unset it to search elsewhere." PARENT_SCOPE)
      endif()
      return()
    endif()
  endforeach()
  set(deferred_shade_cccl_root FALSE PARENT_SCOPE)

  find_program(DEFERRED_SHADE_NVCC nvcc)
  set(toolkit "")
  if(DEFERRED_SHADE_NVCC)
    file(REAL_PATH "${DEFERRED_SHADE_NVCC}" nvcc)
    cmake_path(GET nvcc PARENT_PATH toolkit)
    cmake_path(GET toolkit PARENT_PATH toolkit)
  endif()
  set(roots "${CUDAToolkit_ROOT}" "$ENV{CUDAToolkit_ROOT}" "$ENV{CUDA_PATH}" "${toolkit}" /usr/local/cuda
    /opt/cuda ${ARGN} ${CMAKE_PREFIX_PATH} /usr/local /usr)
  list(REMOVE_ITEM roots "")
  deferred_shade_first_cccl(${roots})
  set(deferred_shade_cccl_dirs "${deferred_shade_cccl_dirs}" PARENT_SCOPE)
  set(deferred_shade_cccl_version "${deferred_shade_cccl_version}" PARENT_SCOPE)
  set(deferred_shade_cccl_error "${deferred_shade_cccl_error}" PARENT_SCOPE)
endfunction()

function(deferred_shade_find_cccl)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "FETCH" "ROOTS")
  if(TARGET deferred_shade::cccl)
    return()
  endif()
  deferred_shade_search_cccl(${arg_ROOTS})
  mark_as_advanced(DEFERRED_SHADE_NVCC)
  if(deferred_shade_cccl_dirs)
    set(dirs "${deferred_shade_cccl_dirs}")
    set(version "${deferred_shade_cccl_version}")
  elseif(arg_FETCH AND NOT deferred_shade_cccl_root)
    message(STATUS "CCCL: none found here, fetching ${deferred_shade_cccl_tag}")
    include(FetchContent)
    FetchContent_Declare(deferred_shade_fetched_cccl
      GIT_REPOSITORY https://github.com/NVIDIA/cccl.git
      GIT_TAG ${deferred_shade_cccl_tag}
      GIT_SHALLOW TRUE
      SOURCE_SUBDIR this_directory_does_not_exist)  # headers only: its CMake project is not entered
    FetchContent_MakeAvailable(deferred_shade_fetched_cccl)
    deferred_shade_cccl_below("${deferred_shade_fetched_cccl_SOURCE_DIR}" dirs version fault)
  else()
    set(deferred_shade_cccl_error "${deferred_shade_cccl_error}" PARENT_SCOPE)
    return()
  endif()

  message(STATUS "CCCL: ${version} in ${dirs}")
  add_library(deferred_shade::cccl INTERFACE IMPORTED GLOBAL)
  target_include_directories(deferred_shade::cccl INTERFACE ${dirs})
endfunction()
