// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cuda_runtime_api.h>
#include <cstddef>
#include <string>

#include <deferred_shade/cuda/runtime.hpp>

namespace deferred_shade {

/// An allocator of memory on the current CUDA device: what a workspace takes unless it is given
/// another one.
///
/// Needs no CUDA compiler, only the headers of the CUDA runtime and its library, so that a
/// translation unit for the host can hold a `workspace<cuda_allocator<std::byte>>`. Throws
/// cuda_error, with the bytes and the device in its message, where the memory cannot be
/// had.
template <class T>
struct cuda_allocator {
  using value_type = T;

  cuda_allocator() = default;
  template <class U>
  cuda_allocator(cuda_allocator<U> const&) noexcept {}

  T* allocate(std::size_t n) {
    if (n > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_array_new_length();
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

  // Waits for what runs on the device.
  void deallocate(T* memory, std::size_t) noexcept {
    if (cudaFree(memory) != cudaSuccess) cudaGetLastError();
  }

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
