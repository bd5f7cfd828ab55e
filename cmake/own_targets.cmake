# SPDX-License-Identifier: Apache-2.0
# deferred_shade_own: what this project's own programs are built with, and deferred_shade_own_flags without
# a Thrust system. Never exported.

string(TOLOWER "${DEFERRED_SHADE_DEVICE_SYSTEM}" system)
if(NOT TARGET deferred_shade::${system})
  message(FATAL_ERROR
    "DEFERRED_SHADE_DEVICE_SYSTEM is ${DEFERRED_SHADE_DEVICE_SYSTEM}: ${deferred_shade_${system}_error}")
endif()

# No contraction: a shader then gives the same bits wherever the compiler inlines it. nvcc's host compiler
# is given no -Wsign-conversion: it sees no bodies of device functions, but objects to each array in a device
# struct whose length is an int. nvcc's "all-warnings" are also those of the host compiler and of ptxas.
set(flags -Wall -Wextra -Wconversion -ffp-contract=off)
set(werror $<BOOL:${DEFERRED_SHADE_WARNINGS_AS_ERRORS}>)
add_library(deferred_shade_own_flags INTERFACE)
target_compile_options(deferred_shade_own_flags INTERFACE
  "$<$<COMPILE_LANGUAGE:CXX>:${flags};-Wsign-conversion;$<${werror}:-Werror>>"
  "$<$<COMPILE_LANGUAGE:CUDA>:-Xcompiler=$<JOIN:${flags},$<COMMA>>;-fmad=false;--extended-lambda>"
  "$<$<AND:$<COMPILE_LANGUAGE:CUDA>,${werror}>:SHELL:-Werror all-warnings>")
add_library(deferred_shade_own INTERFACE)
target_link_libraries(deferred_shade_own INTERFACE deferred_shade_own_flags deferred_shade::${system})

# deferred_shade_own_sources_as_cuda(<source>...) gives these sources of the calling directory to nvcc in a
# CUDA build, whatever their names end in. Elsewhere it does nothing.
function(deferred_shade_own_sources_as_cuda)
  if(DEFERRED_SHADE_DEVICE_SYSTEM STREQUAL "CUDA")
    set_source_files_properties(${ARGN} PROPERTIES LANGUAGE CUDA)
  endif()
endfunction()

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
# deferred_shade_own_systems(<result> <prefix> <system>...): of CPP, OMP and TBB those that this machine has, each with
# the prefix.
function(deferred_shade_own_systems result prefix)
  set(has "")
  foreach(system IN LISTS ARGN)
    string(TOLOWER "${system}" lower)
    if(system STREQUAL "CPP" OR deferred_shade_has_${lower})
      list(APPEND has ${prefix}${system})
    endif()
  endforeach()
  set(${result} ${has} PARENT_SCOPE)
endfunction()
add_library(deferred_shade_runtimes INTERFACE)
target_link_libraries(deferred_shade_runtimes INTERFACE
  $<$<BOOL:${deferred_shade_has_omp}>:OpenMP::OpenMP_CXX> $<$<BOOL:${deferred_shade_has_tbb}>:TBB::tbb>)
# CMake's OpenMP target has flags for C++ alone.
set(nvcc_openmp $<AND:$<BOOL:${deferred_shade_has_omp}>,$<COMPILE_LANGUAGE:CUDA>>)
target_compile_options(deferred_shade_runtimes INTERFACE
  "$<${nvcc_openmp}:-Xcompiler=$<JOIN:${OpenMP_CXX_FLAGS},$<COMMA>>>")
