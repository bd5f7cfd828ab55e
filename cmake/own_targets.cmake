# SPDX-License-Identifier: Apache-2.0
# deferred_shade_own: what this project's own programs are built with. Never exported.

string(TOLOWER "${DEFERRED_SHADE_DEVICE_SYSTEM}" system)
if(NOT TARGET deferred_shade::${system})
  message(FATAL_ERROR
    "DEFERRED_SHADE_DEVICE_SYSTEM is ${DEFERRED_SHADE_DEVICE_SYSTEM}: ${deferred_shade_${system}_error}")
endif()

add_library(deferred_shade_own INTERFACE)
target_link_libraries(deferred_shade_own INTERFACE deferred_shade::${system})
# No contraction: a shader then gives the same bits wherever the compiler inlines it.
target_compile_options(deferred_shade_own INTERFACE
  -Wall -Wextra -Wconversion -Wsign-conversion -ffp-contract=off
  $<$<BOOL:${DEFERRED_SHADE_WARNINGS_AS_ERRORS}>:-Werror>)

# The other systems' runtimes, for programs that take the system at run time.
foreach(name IN ITEMS omp tbb)
  string(TOUPPER ${name} upper)
  if(TARGET deferred_shade::${name})
    set(deferred_shade_has_${name} TRUE)
  else()
    message(STATUS "Built without the ${upper} backend: ${deferred_shade_${name}_error}")
    set(deferred_shade_has_${name} FALSE)
  endif()
endforeach()
add_library(deferred_shade_runtimes INTERFACE)
target_link_libraries(deferred_shade_runtimes INTERFACE
  $<$<BOOL:${deferred_shade_has_omp}>:OpenMP::OpenMP_CXX> $<$<BOOL:${deferred_shade_has_tbb}>:TBB::tbb>)
