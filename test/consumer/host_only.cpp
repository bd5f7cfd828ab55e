// SPDX-License-Identifier: Apache-2.0
// Holding a workspace of device memory takes no CUDA compiler, and without a device, asking it for
// memory throws.
#include <cuda_runtime_api.h>
#include <cstdio>
#include <deferred_shade/schedule.hpp>  // what reserve asks

#include "project/cuda/renderer.hpp"

#ifdef __CUDACC__
#error "this file is here to be compiled without a CUDA compiler"
#endif

int main() {
  int devices = 0;
  bool const has_device = cudaGetDeviceCount(&devices) == cudaSuccess && devices > 0;
  renderer r;
  try {
    r.scratch.reserve(1000, 3);
    std::printf("%zu bytes\n", r.scratch.capacity());
    return has_device && r.scratch.capacity() >= r.scratch.bytes_for(1000, 3) ? 0 : 1;
  } catch (deferred_shade::cuda_error const& error) {
    std::printf("%s\n", error.what());
    return !has_device && r.scratch.capacity() == 0 ? 0 : 1;
  }
}
