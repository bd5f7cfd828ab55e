# SPDX-License-Identifier: Apache-2.0
# deferred_shade_add_system(<cpp|omp|tbb|cuda>) makes the target deferred_shade::<system>: the library, with
# what that Thrust system needs, and with thrust::device meaning it. Without the runtime (OpenMP, oneTBB,
# the CUDA toolkit) on this machine there is no target, and deferred_shade_<system>_error says what is
# missing. deferred_shade::cuda is for CUDA sources, and for C++ sources that only hold a workspace.

function(deferred_shade_add_system system)
  if(TARGET deferred_shade::${system})
    return()
  endif()
  set(runtime "")
  if(system STREQUAL "omp")
    find_package(OpenMP QUIET COMPONENTS CXX)
    set(runtime OpenMP::OpenMP_CXX)
  elseif(system STREQUAL "tbb")
    find_package(TBB QUIET CONFIG)
    set(runtime TBB::tbb)
  elseif(system STREQUAL "cuda")
    find_package(CUDAToolkit QUIET)
    set(runtime CUDA::cudart_static)
  elseif(NOT system STREQUAL "cpp")
    set(deferred_shade_${system}_error
      "deferred_shade has no component ${system}; its components are cpp, omp, tbb and cuda" PARENT_SCOPE)
    return()
  endif()
  if(runtime AND NOT TARGET ${runtime})
    set(deferred_shade_${system}_error
      "deferred_shade::${system} needs ${runtime}, which was not found" PARENT_SCOPE)
    return()
  endif()
  if(system STREQUAL "cuda")
    # Where nvcc links, CMake adds the runtime that CUDA_RUNTIME_LIBRARY names, and one is enough.
    set(runtime CUDA::toolkit $<$<NOT:$<LINK_LANGUAGE:CUDA>>:CUDA::cudart_static>)
  endif()

  string(TOUPPER ${system} upper)
  add_library(deferred_shade::${system} INTERFACE IMPORTED GLOBAL)
  target_link_libraries(deferred_shade::${system} INTERFACE deferred_shade::deferred_shade ${runtime})
  target_compile_definitions(deferred_shade::${system} INTERFACE
    THRUST_DEVICE_SYSTEM=THRUST_DEVICE_SYSTEM_${upper})
  get_property(languages GLOBAL PROPERTY ENABLED_LANGUAGES)
  if(system STREQUAL "cuda" AND "CUDA" IN_LIST languages)
    target_compile_features(deferred_shade::cuda INTERFACE cuda_std_17)
    # nvcc of CUDA 12 searches the toolkit's own CCCL before it searches system directories.
    set_property(TARGET deferred_shade::cccl PROPERTY IMPORTED_NO_SYSTEM TRUE)
  endif()
endfunction()

# deferred_shade::simd: what g++ and clang need to make vectors of record shaders besides -O3 and -march,
# which are the renderer's choice. clang inlines what a shader calls only as far as its threshold goes, whatever
# the function that runs it asks for, and makes no vectors of a loop with a call. Nothing else of the library
# carries these.
if(NOT TARGET deferred_shade::simd)
  add_library(deferred_shade::simd INTERFACE IMPORTED GLOBAL)
  target_compile_options(deferred_shade::simd INTERFACE
    "$<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang,AppleClang>:-fno-math-errno;-fno-trapping-math>"
    "$<$<COMPILE_LANG_AND_ID:CXX,Clang,AppleClang>:SHELL:-mllvm -inline-threshold=5000>")
endif()
