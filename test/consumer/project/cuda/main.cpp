// SPDX-License-Identifier: Apache-2.0
// The part of a renderer that a C++ compiler builds.
#include <cuda_runtime_api.h>
#include <cstdio>

#include "renderer.hpp"

#ifdef __CUDACC__
#error "this file is here to be compiled without a CUDA compiler"
#endif

int main() {
  int devices = 0;
  cudaError_t const status = cudaGetDeviceCount(&devices);
  if (status == cudaErrorNoDevice || status == cudaErrorInsufficientDriver) {
    std::printf("nothing was run: no CUDA device (%s)\n", cudaGetErrorString(status));
    return 1;
  }
  int const n = 1000;
  renderer r;
  int const right = shade_batch(r, n);
  bool const grown = r.scratch.capacity() >= n * sizeof(int);
  std::printf("%d of %d requests are right, in %zu bytes\n", right, n, r.scratch.capacity());
  return right == n && grown ? 0 : 1;
}
