// SPDX-License-Identifier: Apache-2.0
#pragma once

// Comes first: a version that is too old fails here, and not somewhere in a template.
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

/// Marks a function that runs on the host and, in code for a CUDA compiler, on the device.
#ifdef __CUDACC__
#define DEFERRED_SHADE_HOST_DEVICE __host__ __device__
#else
#define DEFERRED_SHADE_HOST_DEVICE
#endif

/// Goes before a host/device function that calls a user's function. The user's function may then be
/// for the host alone, without a warning from nvcc, if only the host calls it.
#ifdef __CUDACC__
#define DEFERRED_SHADE_EXEC_CHECK_DISABLE _Pragma("nv_exec_check_disable")
#else
#define DEFERRED_SHADE_EXEC_CHECK_DISABLE
#endif

/// Goes before a function that is never inlined: its stack frame is its own.
#if defined(__GNUC__)
#define DEFERRED_SHADE_NOINLINE __attribute__((noinline))
#else
#define DEFERRED_SHADE_NOINLINE
#endif

/// Whether the host compiler has GNU's builtins, attributes and vector types: clang, and g++ from
/// 12 on, the first with a builtin that shuffles vectors. 0 in code for nvcc.
#if defined(__GNUC__) && (defined(__clang__) || __GNUC__ >= 12) && !defined(__CUDACC__)
#define DEFERRED_SHADE_HAS_GNU 1
#else
#define DEFERRED_SHADE_HAS_GNU 0
#endif

/// Whether exceptions are enabled. Without them, an error ends the program: see detail/fail.hpp.
#if defined(__cpp_exceptions) || defined(__EXCEPTIONS) || defined(_CPPUNWIND)
#define DEFERRED_SHADE_HAS_EXCEPTIONS 1
#else
#define DEFERRED_SHADE_HAS_EXCEPTIONS 0
#endif
