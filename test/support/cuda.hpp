// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cuda_runtime_api.h>
#include <thrust/system/cuda/error.h>
#include <thrust/system/cuda/execution_policy.h>
#include <thrust/system_error.h>
#include <cstddef>
#include <cstdint>
#include <deferred_shade/cuda.hpp>
#include <vector>

namespace test {

/// Throws what a call of the CUDA runtime reports.
inline void check_cuda(cudaError_t status) {
  if (status != cudaSuccess) throw thrust::system_error(status, thrust::cuda_category());
}

/// Pinned memory of the host, which every GPU reaches by the same pointers.
template <class T>
struct pinned_allocator {
  using value_type = T;

  pinned_allocator() = default;
  template <class U>
  pinned_allocator(pinned_allocator<U> const&) {}

  T* allocate(std::size_t n) {
    void* p = nullptr;
    check_cuda(cudaMallocHost(&p, n * sizeof(T)));
    return static_cast<T*>(p);
  }
  void deallocate(T* p, std::size_t) noexcept { cudaFreeHost(p); }

  template <class U>
  bool operator==(pinned_allocator<U> const&) const {
    return true;
  }
  template <class U>
  bool operator!=(pinned_allocator<U> const&) const {
    return false;
  }
};

/// The current GPU as a backend of the tests; see backends.hpp.
struct cuda {
  static constexpr std::uint32_t many_blocks = 300007;
  template <class T>
  using vector = std::vector<T, pinned_allocator<T>>;
  template <class T>
  using allocator = deferred_shade::cuda_allocator<T>;
  static auto policy() { return thrust::cuda::par_nosync; }
  static void wait() { check_cuda(cudaDeviceSynchronize()); }
  template <class T>
  static std::vector<T> read(T const* first, std::size_t n) {
    wait();
    std::vector<T> copy(n);
    check_cuda(cudaMemcpy(copy.data(), first, n * sizeof(T), cudaMemcpyDefault));
    return copy;
  }
};

/// A stream of the current GPU, independent of the default stream.
class stream {
 public:
  stream() { check_cuda(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking)); }
  stream(stream const&) = delete;
  stream& operator=(stream const&) = delete;
  ~stream() { cudaStreamDestroy(stream_); }

  operator cudaStream_t() const { return stream_; }
  void wait() const { check_cuda(cudaStreamSynchronize(stream_)); }

 private:
  cudaStream_t stream_ = nullptr;
};

}  // namespace test
