// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cuda_runtime.h>
#include <thrust/detail/execution_policy.h>
#include <thrust/system/cuda/detail/util.h>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>

#include <deferred_shade/cuda.hpp>
#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/overlap.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// The stream that a Thrust policy for CUDA names.
template <class Policy>
cudaStream_t stream_of(Policy const& exec) {
  auto policy = thrust::detail::derived_cast(exec);  // Thrust asks for one that is not const
  return thrust::cuda_cub::stream(policy);
}

/// The number of requests, for a kernel. A device_count, which the host cannot check, is clamped to
/// 0 to its maximum.
__device__ inline request_index size_of(request_index n) { return n; }
template <class Integer>
__device__ request_index size_of(device_count<Integer> n) {
  Integer const count = *n.pointer;
  if constexpr (std::is_signed_v<Integer>) {
    if (count < 0) return 0;
  }
  auto const positive = static_cast<std::make_unsigned_t<Integer>>(count);
  return static_cast<request_index>(positive < n.maximum ? positive : n.maximum);
}

/// The grid and the resources of a launch. A grid without blocks is not launched.
struct launch_shape {
  std::size_t blocks = 0;
  std::uint32_t threads = 0;
  std::size_t shared_bytes = 0;
  bool prefers_cache = false;  ///< to shared memory, if both share one memory
};

/// The number of the current device.
inline int current_device() {
  int device = 0;
  detail::check_cuda(cudaGetDevice(&device), "looking for a CUDA device");
  return device;
}

/// Whether any code of this translation unit was compiled for GPUs on which kernels overlap. (With
/// link-time optimisation, a kernel's attributes give the architecture that it was linked for.)
constexpr bool is_compiled_for_overlap() {
#ifdef __CUDA_ARCH_LIST__
  for (int const architecture : {__CUDA_ARCH_LIST__}) {
    if (architecture >= 900) return true;
  }
#endif
  return false;
}

/// Whether `Kernel` may start before the work ahead of it is done: on GPUs that can do that, if its
/// code was compiled for them and so waits explicitly. Asks CUDA once per host thread, and again if
/// its device changes.
template <auto Kernel>
bool may_start_early() {
  thread_local int known_device = -1;
  thread_local bool known = false;
  int const device = detail::current_device();
  if (device == known_device) return known;
  int major = 0;
  detail::check_cuda(cudaDeviceGetAttribute(&major, cudaDevAttrComputeCapabilityMajor, device),
                     "compute capability");
  cudaFuncAttributes attributes{};
  detail::check_cuda(cudaFuncGetAttributes(&attributes, Kernel), "looking for a kernel");
  known = detail::is_compiled_for_overlap() && major >= 9 && attributes.ptxVersion >= 90;
  known_device = device;
  return known;
}

/// Throws if a launch has more blocks than a grid can have. Called for all launches of a batch
/// before the first one.
inline void check_grid(char const* what, launch_shape shape) {
  constexpr std::size_t most = 0x7fffffff;
  if (shape.blocks <= most) return;
  std::string const doing = std::string(what) + ": a launch of " + std::to_string(shape.blocks) +
                            " blocks of " + std::to_string(shape.threads) +
                            " threads, where a grid has at most " + std::to_string(most) +
                            "; let the shader have a larger block_size";
  detail::check_cuda(cudaErrorInvalidConfiguration, doing.c_str());
}

/// Launches `Kernel` on `stream`. Throws cuda_error, which names `what`, if CUDA refuses. `Kernel`
/// must wait for the work ahead of it: see overlap.hpp.
template <auto Kernel, class... Arguments>
void launch(char const* what, cudaStream_t stream, launch_shape shape,
            Arguments const&... arguments) {
  if (shape.blocks == 0) return;
  detail::check_grid(what, shape);
  if (shape.shared_bytes > 0) {  // with static shared memory, it may exceed the default limit
    detail::check_cuda(cudaFuncSetAttribute(Kernel, cudaFuncAttributeMaxDynamicSharedMemorySize,
                                            static_cast<int>(shape.shared_bytes)),
                       what);
  }
  if (shape.prefers_cache) {
    detail::check_cuda(cudaFuncSetAttribute(Kernel, cudaFuncAttributePreferredSharedMemoryCarveout,
                                            cudaSharedmemCarveoutMaxL1),
                       what);
  }
  cudaLaunchAttribute early{};
  early.id = cudaLaunchAttributeProgrammaticStreamSerialization;
  early.val.programmaticStreamSerializationAllowed = 1;
  cudaLaunchConfig_t config{};
  config.gridDim = dim3(static_cast<unsigned>(shape.blocks));
  config.blockDim = dim3(shape.threads);
  config.dynamicSmemBytes = shape.shared_bytes;
  config.stream = stream;
  config.attrs = &early;
  config.numAttrs = detail::may_start_early<Kernel>() ? 1 : 0;
  detail::check_cuda(cudaLaunchKernelEx(&config, Kernel, arguments...), what);
}

/// The number of blocks of `threads` threads that hold `n` threads.
constexpr std::size_t blocks_for(std::size_t n, std::uint32_t threads) {
  return (n + threads - 1) / threads;
}

/// The number of multiprocessors of the current device.
inline std::size_t multiprocessors() {
  int count = 0;
  detail::check_cuda(
      cudaDeviceGetAttribute(&count, cudaDevAttrMultiProcessorCount, detail::current_device()),
      "multiprocessor count");
  return static_cast<std::size_t>(count);
}

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
