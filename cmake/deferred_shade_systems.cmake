# SPDX-License-Identifier: Apache-2.0
# deferred_shade_add_system(<cpp|omp|tbb>) makes the target deferred_shade::<system>: the library, with
# what that Thrust system needs, and with thrust::device meaning it. Without the runtime (OpenMP, oneTBB)
# on this machine there is no target, and deferred_shade_<system>_error says what is missing.

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
  elseif(NOT system STREQUAL "cpp")
    set(deferred_shade_${system}_error "deferred_shade has no Thrust system ${system}" PARENT_SCOPE)
    return()
  endif()
  if(runtime AND NOT TARGET ${runtime})
    set(deferred_shade_${system}_error
      "deferred_shade::${system} needs ${runtime}, which was not found" PARENT_SCOPE)
    return()
  endif()

  string(TOUPPER ${system} upper)
  add_library(deferred_shade::${system} INTERFACE IMPORTED GLOBAL)
  target_link_libraries(deferred_shade::${system} INTERFACE deferred_shade::deferred_shade ${runtime})
  target_compile_definitions(deferred_shade::${system} INTERFACE
    THRUST_DEVICE_SYSTEM=THRUST_DEVICE_SYSTEM_${upper})
endfunction()
