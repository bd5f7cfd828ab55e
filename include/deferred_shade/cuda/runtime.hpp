// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cuda_runtime_api.h>
#include <stdexcept>
#include <string>

namespace deferred_shade {

/// What is thrown where a call of the CUDA runtime fails; the message says what was being done.
///
/// Not thrust::system_error: the name of Thrust's namespace holds the list of GPU architectures, so
/// that a source compiled by g++ could not catch what one compiled by nvcc throws.
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

/// Throws a cuda_error where `status` is one. Allocates nothing where it is not.
inline void check_cuda(cudaError_t status, char const* doing) {
  if (status == cudaSuccess) return;
  cudaGetLastError();  // else the next call would report it again
  throw cuda_error(status, doing);
}

/// Before a call of CUB, which would take what the renderer left there for an error of its own.
inline void forget_earlier_error() { cudaGetLastError(); }

}  // namespace detail
}  // namespace deferred_shade
