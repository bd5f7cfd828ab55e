// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cuda_runtime_api.h>
#include <thrust/system/cuda/error.h>
#include <thrust/system_error.h>
#include <string>

namespace deferred_shade::detail {

/// Throws thrust::system_error where a call of the CUDA runtime failed: `what` was being done.
inline void check_cuda(cudaError_t status, std::string const& what) {
  if (status == cudaSuccess) return;
  cudaGetLastError();  // else the next call would report it again
  throw thrust::system_error(status, thrust::cuda_category(), "deferred_shade: " + what);
}

}  // namespace deferred_shade::detail
