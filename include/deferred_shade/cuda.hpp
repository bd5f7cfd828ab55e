// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cuda_runtime_api.h>
#include <algorithm>
#include <cstddef>
#include <mutex>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include <deferred_shade/detail/fail.hpp>

namespace deferred_shade {

/// Thrown if a call of the CUDA runtime fails. The message says what was being done.
///
/// It is not thrust::system_error: Thrust's namespace is named after the list of GPU architectures,
/// and code compiled by g++ could not catch what code compiled by nvcc throws.
class cuda_error : public std::runtime_error {
 public:
  cuda_error(cudaError_t code, char const* doing)
      : std::runtime_error("deferred_shade: " + std::string(doing) + ": " + cudaGetErrorName(code) +
                           ", " + cudaGetErrorString(code)),
        code_(code) {}

  cudaError_t code() const noexcept { return code_; }

 private:
  cudaError_t code_;
};

namespace detail {

/// Throws a cuda_error if `status` is an error. Allocates nothing if it is not.
inline void check_cuda(cudaError_t status, char const* doing) {
  if (status == cudaSuccess) return;
  cudaGetLastError();  // or the next call would report it again
  detail::fail<cuda_error>(status, doing);
}

/// Clears a pending error of the renderer's. Called before CUB, which would report it as its own.
inline void forget_earlier_error() { cudaGetLastError(); }

/// Frees memory of a device. CUDA may refuse that while this thread or another one captures a
/// stream. The memory is then kept, and a later call frees it.
inline void free_on_device(void* memory) noexcept {
  static std::mutex mutex;
  static std::vector<void*> refused;
  std::lock_guard<std::mutex> const lock(mutex);
  // In relaxed mode, a capture by this thread does not forbid cudaFree, which does not end it
  // either.
  cudaStreamCaptureMode mode = cudaStreamCaptureModeRelaxed;
  cudaThreadExchangeStreamCaptureMode(&mode);
  auto const is_freed = [](void* pointer) {
    if (cudaFree(pointer) == cudaSuccess) return true;
    cudaGetLastError();
    return false;
  };
  refused.erase(std::remove_if(refused.begin(), refused.end(), is_freed), refused.end());
  if (!is_freed(memory)) refused.push_back(memory);
  cudaThreadExchangeStreamCaptureMode(&mode);
}

}  // namespace detail

/// Allocates memory on the current CUDA device. A workspace for a CUDA policy uses it by default.
///
/// Needs the headers and the library of the CUDA runtime, but no CUDA compiler: code for the host
/// can hold a `workspace<cuda_allocator<std::byte>>`. `allocate` throws cuda_error if CUDA refuses;
/// the message names the bytes and the device.
template <class T>
struct cuda_allocator {
  using value_type = T;

  cuda_allocator() = default;
  template <class U>
  cuda_allocator(cuda_allocator<U> const&) noexcept {}

  T* allocate(std::size_t n) {
    if (n > static_cast<std::size_t>(-1) / sizeof(T)) detail::fail<std::bad_array_new_length>();
    int device = 0;
    detail::check_cuda(cudaGetDevice(&device), "looking for a CUDA device");
    void* memory = nullptr;
    cudaError_t const status = cudaMalloc(&memory, n * sizeof(T));
    if (status != cudaSuccess) {
      std::string const doing = "allocating " + std::to_string(n * sizeof(T)) +
                                " bytes on CUDA device " + std::to_string(device);
      detail::check_cuda(status, doing.c_str());
    }
    return static_cast<T*>(memory);
  }

  // Waits for all work on the device.
  void deallocate(T* memory, std::size_t) noexcept { detail::free_on_device(memory); }

  template <class U>
  bool operator==(cuda_allocator<U> const&) const noexcept {
    return true;
  }
  template <class U>
  bool operator!=(cuda_allocator<U> const&) const noexcept {
    return false;
  }
};

}  // namespace deferred_shade
