# SPDX-License-Identifier: Apache-2.0
# cmake -D SOURCE_DIR=... -P layers.cmake
# Checks that every header of the library includes only headers of lower layers, by <deferred_shade/...>,
# so that there is no cycle and no include among siblings; that the umbrella reaches every header but cuda/nvtx.hpp,
# which is optional; that no file of code is longer than 250 lines; and that the library has at most 2,000 lines of
# code, and so what is tuned for CUDA, which is counted apart.

cmake_minimum_required(VERSION 3.22)

# Layers from the lowest up: a pattern per layer, first match wins.
set(layers
  "version|config"
  "types|blocks|system|bits|cuda/(runtime|warp|overlap)"
  "counts|math|prefetch|cuda/(allocator|launch|load_keys|rank_in_warp|thread_counts)"
  "shader_table|workspace|cuda/(tile_sort|tile_rows|host_copy)"
  "records|observed"
  "cuda/(renumbered|nvtx)"
  "gaps"
  "lanes|cuda/(configuration|staging)"
  "segment"
  "grouping/cuda/(radix_sort|compact|bucket_tile)"
  "grouping/cuda/sorted_bucket_tile"
  "grouping/cuda/(small_bucket|large_bucket)"
  "grouping/cuda/(bucket|windows)"
  "grouping/counting_sort"
  "grouping/[^/]*"
  "dispatch/cuda/.*"
  "dispatch/[^/]*"
  "schedule/cuda/(packed|staged)_tiles"
  "schedule/cuda/.*"
  "schedule/[^/]*"
  "shade|statistics"
  "deferred_shade")

set(errors "")
set(count 0)
set(cuda_count 0)

function(layer_of header result)
  set(index 0)
  foreach(pattern IN LISTS layers)
    if(header MATCHES "^deferred_shade/(${pattern})\\.hpp$")
      set(${result} ${index} PARENT_SCOPE)
      return()
    endif()
    math(EXPR index "${index} + 1")
  endforeach()
  set(${result} -1 PARENT_SCOPE)
endfunction()

# The lines of a file as a list: brackets and semicolons, which CMake gives a meaning, are dropped.
function(read_lines file result)
  file(READ "${file}" text)
  string(REGEX REPLACE "[][;\\]" "" text "${text}")
  string(REGEX REPLACE "\n$" "" text "${text}")
  string(REGEX REPLACE "\n" " ;" text "${text} ")
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

set(include_dir "${SOURCE_DIR}/include")
file(GLOB_RECURSE headers RELATIVE "${include_dir}" "${include_dir}/*.hpp")
if(NOT headers)
  message(FATAL_ERROR "no header below ${include_dir}")
endif()
foreach(header IN LISTS headers)
  layer_of(${header} layer)
  if(layer EQUAL -1)
    string(APPEND errors "\n  ${header}: belongs to no layer")
  endif()
  set(includes_of_${header} "")
  read_lines("${include_dir}/${header}" lines)
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "^ *(//.*)?$")
      if(header MATCHES "/cuda/")
        math(EXPR cuda_count "${cuda_count} + 1")
      else()
        math(EXPR count "${count} + 1")
      endif()
    endif()
    if(line MATCHES "^ *# *include *\"")
      string(APPEND errors "\n  ${header}: includes by quotes: ${line}")
    elseif(line MATCHES "^ *# *include *<(deferred_shade/[^>]*)>")
      set(included ${CMAKE_MATCH_1})
      list(APPEND includes_of_${header} ${included})
      layer_of(${included} included_layer)
      if(NOT EXISTS "${include_dir}/${included}")
        string(APPEND errors "\n  ${header}: includes ${included}, which does not exist")
      elseif(NOT included_layer LESS layer)
        string(APPEND errors "\n  ${header}: includes ${included}, which lies in no lower layer")
      endif()
    endif()
  endforeach()
endforeach()

# Headers that only a CUDA compiler is given are reached through conditional includes like any other.
set(reached deferred_shade/deferred_shade.hpp)
set(queue ${reached})
while(queue)
  list(POP_FRONT queue header)
  foreach(included IN LISTS includes_of_${header})
    if(NOT included IN_LIST reached)
      list(APPEND reached ${included})
      list(APPEND queue ${included})
    endif()
  endforeach()
endwhile()
list(REMOVE_ITEM headers ${reached} deferred_shade/cuda/nvtx.hpp)
foreach(header IN LISTS headers)
  string(APPEND errors "\n  ${header}: not reached from deferred_shade/deferred_shade.hpp")
endforeach()

file(GLOB_RECURSE sources
  "${include_dir}/*.hpp" "${SOURCE_DIR}/examples/*.[ch]pp" "${SOURCE_DIR}/test/*.[ch]pp"
  "${SOURCE_DIR}/benchmark/*.[ch]pp")
foreach(source IN LISTS sources)
  read_lines("${source}" lines)
  list(LENGTH lines length)
  if(length GREATER 250)
    string(APPEND errors "\n  ${source}: ${length} lines, more than 250")
  endif()
endforeach()
if(count GREATER 2000 OR cuda_count GREATER 2000)
  string(APPEND errors
    "\n  the library has ${count} lines of code, and ${cuda_count} for CUDA; more than 2000")
endif()

if(errors)
  message(FATAL_ERROR "${errors}")
endif()
list(LENGTH reached reached)
message(STATUS "${reached} headers in order, ${count} lines of code, and ${cuda_count} for CUDA")
