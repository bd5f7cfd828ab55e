# SPDX-License-Identifier: Apache-2.0
# cmake -D SOURCE_DIR=... -D PREFIX=... -D BINARY_DIR=... -D CCCL_ROOT_THAT_WORKS=... -P messages.cmake
# What a user is told if CCCL_ROOT leads nowhere, if there is a Thrust that is too old, and if a component does not
# exist. PREFIX holds an installed copy of the library. The trees of other versions are made here, of two files each.

cmake_minimum_required(VERSION 3.22)
include(${SOURCE_DIR}/cmake/deferred_shade_cccl.cmake)
file(REMOVE_RECURSE ${BINARY_DIR})
set(errors "")

# expect(<case> <text> <regex>...): the text has all of them.
function(expect case text)
  foreach(regex IN LISTS ARGN)
    if(NOT text MATCHES "${regex}")
      set(errors "${errors}\n${case}: expected \"${regex}\", and it is\n${text}" PARENT_SCOPE)
      return()
    endif()
  endforeach()
endfunction()

# make_tree(<name> <version> <bool>): a folder with headers of this Thrust, and with libcu++ if so.
function(make_tree name version libcudacxx)
  file(WRITE ${BINARY_DIR}/${name}/include/thrust/version.h "#define THRUST_VERSION ${version} // macro\n")
  if(libcudacxx)
    file(WRITE ${BINARY_DIR}/${name}/include/cuda/std/type_traits "")
  endif()
endfunction()
make_tree(empty 0 FALSE)
file(REMOVE ${BINARY_DIR}/empty/include/thrust/version.h)
make_tree(old 200200 TRUE)
make_tree(debian 101702 FALSE)
make_tree(half 300001 FALSE)
make_tree(good 300001 TRUE)

# What is passed over is named, if nothing better is there.
set(trees "")
foreach(name IN ITEMS empty old debian half old)
  list(APPEND trees ${BINARY_DIR}/${name})
endforeach()
deferred_shade_first_cccl(${trees})
expect("nothing usable" "${deferred_shade_cccl_error}" "was not found" "passed over: 2[.]2[.]0 in [^\n]*/old"
  "passed over: 1[.]17[.]2 in [^\n]*/debian/include, which is older than [0-9.]+ and has no libcu"
  "passed over: 3[.]0[.]1 in [^\n]*/half/include, which is Thrust alone and has no libcu")
string(REGEX MATCHALL "passed over" lines "${deferred_shade_cccl_error}")
list(LENGTH lines count)
expect("each is named once" "${count}" "^3$")
deferred_shade_first_cccl(${trees} ${BINARY_DIR}/good)
expect("something usable" "${deferred_shade_cccl_dirs} ${deferred_shade_cccl_version}" "/good/include 3[.]0[.]1$")

# A project that asks for the installed copy, or that has the library's sources in a folder of its own.
file(WRITE ${BINARY_DIR}/find/CMakeLists.txt [[
cmake_minimum_required(VERSION 3.22)
project(find LANGUAGES NONE)
find_package(deferred_shade CONFIG REQUIRED COMPONENTS ${ASKED})
]])
file(WRITE ${BINARY_DIR}/add/CMakeLists.txt [[
cmake_minimum_required(VERSION 3.22)
project(add LANGUAGES CXX)
add_subdirectory(${LIBRARY} library)
]])

# configure(<project> <variable of CCCL_ROOT> <value> <regex>...): it fails, and says this.
function(configure project kind value)
  set(define "")
  set(environment --unset=CCCL_ROOT)
  if(kind STREQUAL "variable")
    set(define "-DCCCL_ROOT=${value}")
  elseif(kind STREQUAL "environment")
    set(environment "CCCL_ROOT=${value}")
  endif()
  file(REMOVE_RECURSE ${BINARY_DIR}/${project}/build)
  execute_process(
    COMMAND ${CMAKE_COMMAND} -E env ${environment} ${CMAKE_COMMAND} -S ${BINARY_DIR}/${project}
      -B ${BINARY_DIR}/${project}/build -DCMAKE_PREFIX_PATH=${PREFIX} -DLIBRARY=${SOURCE_DIR} "-DASKED=${asked}"
      -DDEFERRED_SHADE_FETCH_CCCL=ON ${define}
    RESULT_VARIABLE failed OUTPUT_VARIABLE text ERROR_VARIABLE text)
  string(REGEX REPLACE "[ \n]+" " " text "${text}")  # CMake breaks lines of messages
  if(NOT failed)
    set(text "no error, but ${text}")
  endif()
  expect("${project}, ${kind} ${value} ${asked}" "${text}" "Error at" ${ARGN})
  set(errors "${errors}" PARENT_SCOPE)
endfunction()
set(asked cpp)
foreach(project IN ITEMS find add)
  foreach(kind IN ITEMS variable environment)
    configure(${project} ${kind} ${BINARY_DIR}/empty "variable CCCL_ROOT is [^ ]*/empty, and holds no CCCL")
    configure(${project} ${kind} ${BINARY_DIR}/old
      "variable CCCL_ROOT is [^ ]*/old, and holds 2[.]2[.]0 in [^ ]*/old/include, which is older than")
  endforeach()
endforeach()
set(asked "cpp;wrong;worse")
configure(find variable ${CCCL_ROOT_THAT_WORKS} "no component wrong; its components are cpp, omp, tbb and cuda"
  "no component worse")

if(errors)
  message(FATAL_ERROR "${errors}")
endif()
