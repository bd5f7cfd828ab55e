// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cuda_runtime_api.h>
#include <thrust/device_ptr.h>
#include <thrust/device_vector.h>
#include <thrust/mr/allocator.h>
#include <thrust/mr/disjoint_pool.h>
#include <thrust/mr/new.h>
#include <thrust/system/cuda/error.h>
#include <thrust/system/cuda/execution_policy.h>
#include <thrust/system/cuda/memory_resource.h>
#include <thrust/system_error.h>

#include <cstddef>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace path_tracer {

/// Throws thrust::system_error where a call of the CUDA runtime failed.
inline void check_cuda(cudaError_t status, char const* what) {
  if (status != cudaSuccess) throw thrust::system_error(status, thrust::cuda_category(), what);
}

/// The current CUDA device: everything runs on one stream of it, see host_backend. Throws
/// thrust::system_error where there is none, std::runtime_error where its memory is too small.
class cuda_backend {
 public:
  cuda_backend() { check_cuda(cudaStreamCreate(&stream_), "cannot render with CUDA"); }
  ~cuda_backend() { cudaStreamDestroy(stream_); }
  cuda_backend(cuda_backend const&) = delete;
  cuda_backend& operator=(cuda_backend const&) = delete;

  /// What Thrust's reductions need for a moment comes from a pool: allocating it would wait for the
  /// device each time.
  auto policy() const { return thrust::cuda::par_nosync(allocator_).on(stream_); }

  template <class T>
  thrust::device_vector<T> make_array(std::size_t n) const {
    return allocated<T>(n, [&] { return thrust::device_vector<T>(n, T{}); });
  }

  /// A copy of host memory on the device.
  template <class T>
  thrust::device_vector<T> to_device(T const* first, std::size_t n) const {
    return allocated<T>(n, [&] { return thrust::device_vector<T>(first, first + n); });
  }

  template <class T>
  std::vector<T> to_host(T const* first, std::size_t n) const {
    std::vector<T> result(n);
    check_cuda(
        cudaMemcpyAsync(result.data(), first, n * sizeof(T), cudaMemcpyDeviceToHost, stream_),
        "cannot copy from the CUDA device");
    check_cuda(cudaStreamSynchronize(stream_), "the CUDA device failed");
    return result;
  }
  template <class T>
  std::vector<T> to_host(thrust::device_vector<T>&& array) const {
    return to_host(thrust::raw_pointer_cast(array.data()), array.size());
  }

  /// Measures by events: what the stream takes from start() to stop(). Reading it waits for the
  /// second.
  class stopwatch {
   public:
    explicit stopwatch(cuda_backend const& backend) : stream_(backend.stream_) {}
    void start() { start_.record(stream_); }
    void stop() { stop_.record(stream_); }
    double milliseconds() const {
      check_cuda(cudaEventSynchronize(stop_.handle), "the CUDA device failed");
      float result = 0;
      check_cuda(cudaEventElapsedTime(&result, start_.handle, stop_.handle),
                 "cannot read a CUDA event");
      return double{result};
    }

   private:
    struct event {
      cudaEvent_t handle = nullptr;
      event() { check_cuda(cudaEventCreate(&handle), "cannot create a CUDA event"); }
      ~event() { cudaEventDestroy(handle); }
      event(event const&) = delete;
      event& operator=(event const&) = delete;
      void record(cudaStream_t stream) {
        check_cuda(cudaEventRecord(handle, stream), "cannot record a CUDA event");
      }
    };
    cudaStream_t stream_;
    event start_, stop_;
  };

 private:
  using pool = thrust::mr::disjoint_unsynchronized_pool_resource<thrust::cuda::memory_resource,
                                                                 thrust::mr::new_delete_resource>;

  template <class T, class Function>
  static auto allocated(std::size_t n, Function const& f) {
    try {
      return f();
    } catch (std::bad_alloc const&) {
      throw std::runtime_error("the CUDA device is out of memory: no room for an array of " +
                               std::to_string(n * sizeof(T)) + " bytes");
    }
  }

  cudaStream_t stream_ = nullptr;
  pool pool_;
  mutable thrust::mr::allocator<char, pool> allocator_{&pool_};
};

}  // namespace path_tracer
