// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/device_vector.h>
#include <thrust/for_each.h>
#include <thrust/iterator/counting_iterator.h>
#include <chrono>
#include <cstddef>
#include <deferred_shade/deferred_shade.hpp>
#include <fstream>
#include <string>
#include <vector>
#ifdef __CUDACC__
#include <cuda_profiler_api.h>
#include <cuda_runtime.h>
#include <thrust/system/cuda/error.h>
#include <thrust/system/cuda/execution_policy.h>
#include <thrust/system_error.h>
#if __has_include(<nvtx3/nvtx3.hpp>)
#include <nvtx3/nvtx3.hpp>
#define BENCH_HAS_NVTX
#endif
#else
#include <thrust/execution_policy.h>
#endif

/// The machine that the build chose (DEFERRED_SHADE_DEVICE_SYSTEM), behind one interface: all else
/// of the benchmarks is the same for a GPU and for CPUs.
namespace bench {

namespace ds = deferred_shade;
using ds::request_index;

/// An array where shaders run.
template <class T>
using array = thrust::device_vector<T>;

template <class T>
T* raw(array<T>& a) {
  return thrust::raw_pointer_cast(a.data());
}
template <class T>
T const* raw(array<T> const& a) {
  return thrust::raw_pointer_cast(a.data());
}

#ifdef __CUDACC__

inline constexpr bool on_cuda = true;

inline void check_cuda(cudaError_t status) {
  if (status != cudaSuccess) throw thrust::system_error(status, thrust::cuda_category());
}

/// The stream that everything runs on.
inline cudaStream_t stream() {
  static cudaStream_t const made = [] {
    cudaStream_t s{};
    check_cuda(cudaStreamCreate(&s));
    return s;
  }();
  return made;
}

inline auto policy() { return thrust::cuda::par_nosync.on(stream()); }

template <class Function>
__global__ void request_kernel(request_index n, Function f) {
  request_index const i = blockIdx.x * blockDim.x + threadIdx.x;
  if (i < n) f(i);
}

/// Calls `f(i)` for every request, with nothing in between: what the controls are made of.
template <class Function>
void for_each_request(std::size_t n, Function f) {
  if (n == 0) return;
  unsigned const threads = 256;
  auto const blocks = static_cast<unsigned>((n + threads - 1) / threads);
  request_kernel<<<blocks, threads, 0, stream()>>>(static_cast<request_index>(n), f);
  check_cuda(cudaGetLastError());
}

/// The seconds that each of `calls` calls of `f` takes, between two events on the stream. Caches
/// are as the call before left them, which is no matter for batches that are larger than a cache.
template <class Function>
std::vector<double> seconds_per_call(Function const& f, int calls) {
  cudaEvent_t begin{};
  cudaEvent_t end{};
  check_cuda(cudaEventCreate(&begin));
  check_cuda(cudaEventCreate(&end));
  std::vector<double> seconds;
  for (int call = 0; call < calls; ++call) {
    float milliseconds = 0;
    check_cuda(cudaEventRecord(begin, stream()));
    f();
    check_cuda(cudaEventRecord(end, stream()));
    check_cuda(cudaEventSynchronize(end));
    check_cuda(cudaEventElapsedTime(&milliseconds, begin, end));
    seconds.push_back(1e-3 * static_cast<double>(milliseconds));
  }
  check_cuda(cudaEventDestroy(begin));
  check_cuda(cudaEventDestroy(end));
  return seconds;
}

/// Calls `f` once for a profiler that waits for it to begin, in a range `name` where the toolkit
/// has NVTX.
template <class Function>
void profile([[maybe_unused]] std::string const& name, Function const& f) {
  check_cuda(cudaDeviceSynchronize());
  check_cuda(cudaProfilerStart());
  {
#ifdef BENCH_HAS_NVTX
    nvtx3::scoped_range const range{name};
#endif
    f();
    check_cuda(cudaDeviceSynchronize());
  }
  check_cuda(cudaProfilerStop());
}

/// What the times were measured on.
inline std::string machine_name() {
  int device = 0;
  check_cuda(cudaGetDevice(&device));
  cudaDeviceProp properties{};
  check_cuda(cudaGetDeviceProperties(&properties, device));
  return properties.name;
}

#else

inline constexpr bool on_cuda = false;

inline auto policy() { return thrust::device; }

/// Calls `f(i)` for every request, with nothing in between: what the controls are made of.
template <class Function>
void for_each_request(std::size_t n, Function f) {
  thrust::for_each_n(policy(), thrust::counting_iterator<request_index>(0), n, f);
}

/// The seconds that each of `calls` calls of `f` takes.
template <class Function>
std::vector<double> seconds_per_call(Function const& f, int calls) {
  using clock = std::chrono::steady_clock;
  std::vector<double> seconds;
  for (int call = 0; call < calls; ++call) {
    clock::time_point const begin = clock::now();
    f();
    seconds.push_back(std::chrono::duration<double>(clock::now() - begin).count());
  }
  return seconds;
}

/// Calls `f` once: profilers of CPUs need no help.
template <class Function>
void profile(std::string const&, Function const& f) {
  f();
}

/// What the times were measured on.
inline std::string machine_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

#endif

/// The workspace of all schedules and groupings.
inline auto& scratch() {
  static ds::workspace memory{policy()};
  return memory;
}

}  // namespace bench
