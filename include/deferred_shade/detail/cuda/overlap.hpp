// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/detail/cuda/architectures.hpp>

// Kernels of one stream overlap from compute capability 9.0 on ("programmatic dependent launch" in
// CUDA's guide): blocks of a kernel start while the last blocks of the one ahead still run. So each
// kernel that launch() starts must wait explicitly, before it reads results of earlier kernels and
// no later than its end. On other GPUs these functions do nothing.
//
// The first kernel of a call to shade() waits before it lets the next one start. So what the
// renderer wrote before the call is complete when any of them runs, and the others wait only for
// each other's results. They also see what it wrote, because every launch invalidates the
// first-level caches. CUB's kernels rely on that as well.

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// Returns when all work ahead of this kernel on its stream is done, and its writes are visible.
__device__ inline void wait_for_earlier_kernels() {
#if __CUDA_ARCH__ >= 900
  asm volatile("griddepcontrol.wait;" ::: "memory");
#endif
}

/// Lets the next kernel on the stream start, once all blocks of this one have called it.
__device__ inline void let_next_kernel_start() {
#if __CUDA_ARCH__ >= 900
  asm volatile("griddepcontrol.launch_dependents;" ::: "memory");
#endif
}

/// Begins a kernel that needs all work launched before it.
__device__ inline void begin_after_earlier_kernels() {
  detail::wait_for_earlier_kernels();
  detail::let_next_kernel_start();
}

/// One of several kernels that do not need each other. Only the first waits for what was launched
/// before them, and none ends before the one ahead of it.
class independent_kernel {
 public:
  __device__ explicit independent_kernel(bool first) : first_(first) {
    if (first) detail::wait_for_earlier_kernels();
    detail::let_next_kernel_start();
  }
  independent_kernel(independent_kernel const&) = delete;
  __device__ ~independent_kernel() {
    if (!first_ && blockIdx.x == 0) detail::wait_for_earlier_kernels();
  }

 private:
  bool first_;
};

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
