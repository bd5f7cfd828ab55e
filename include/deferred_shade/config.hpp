// SPDX-License-Identifier: Apache-2.0
#pragma once

// First of all: what is too old fails here, and not somewhere in a template.
#if __has_include(<thrust/version.h>)
#include <thrust/version.h>
#if THRUST_VERSION < 200800
#error \
    "deferred_shade: this Thrust is too old; take CCCL 2.8 or newer, from CUDA 12.9 or github.com/NVIDIA/cccl, and name its folder before the old one's (-isystem)"
#endif
#endif
#if defined(__CUDA_ARCH__) && __CUDA_ARCH__ < 750
#error \
    "deferred_shade: this GPU architecture is too old; compile for sm_75 or newer (nvcc -arch, CMAKE_CUDA_ARCHITECTURES)"
#endif

/// Marks a function that runs on the host and, where a CUDA compiler is at work, on the device.
#ifdef __CUDACC__
#define DEFERRED_SHADE_HOST_DEVICE __host__ __device__
#else
#define DEFERRED_SHADE_HOST_DEVICE
#endif

/// Goes before a host/device function that calls a user's function: lets that one be host only,
/// without a warning from nvcc, as long as it is called on the host alone.
#ifdef __CUDACC__
#define DEFERRED_SHADE_EXEC_CHECK_DISABLE _Pragma("nv_exec_check_disable")
#else
#define DEFERRED_SHADE_EXEC_CHECK_DISABLE
#endif

/// Goes before a function that is never inlined, for what it takes of the stack to be its own.
#if defined(__GNUC__)
#define DEFERRED_SHADE_NOINLINE __attribute__((noinline))
#else
#define DEFERRED_SHADE_NOINLINE
#endif

/// Whether the compiler of this code for the host has GNU's builtins, attributes and vectors: g++
/// from 12 on, whose builtins shuffle vectors, and clang.
#if defined(__GNUC__) && (defined(__clang__) || __GNUC__ >= 12) && !defined(__CUDACC__)
#define DEFERRED_SHADE_HAS_GNU 1
#else
#define DEFERRED_SHADE_HAS_GNU 0
#endif

/// Whether the compiler of this code has exceptions. Without them, an error ends the program: see
/// detail/fail.hpp.
#if defined(__cpp_exceptions) || defined(__EXCEPTIONS) || defined(_CPPUNWIND)
#define DEFERRED_SHADE_HAS_EXCEPTIONS 1
#else
#define DEFERRED_SHADE_HAS_EXCEPTIONS 0
#endif
