// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/detail/cuda/architectures.hpp>

// Kernels of one stream that overlap, from compute capability 9.0 on ("programmatic dependent
// launch" in CUDA's guide): the blocks of a kernel move in while the last blocks of the one ahead
// still run. So each kernel that launch() starts waits by itself: before it reads what an earlier
// kernel writes, and at the latest before it ends. On other GPUs both functions do nothing.
//
// The first kernel of a call to shade() waits before it lets the next one start. So what the
// renderer wrote before the call is done when any of them runs, and those behind wait for each
// other's results alone. They also see it, because every launch drops what the first-level caches
// hold. CUB's kernels rely on that as well.

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// Returns when everything ahead of this kernel on its stream is done, and what it wrote visible.
__device__ inline void wait_for_earlier_kernels() {
#if __CUDA_ARCH__ >= 900
  asm volatile("griddepcontrol.wait;" ::: "memory");
#endif
}

/// Lets the kernel behind this one on its stream start, once all blocks have come here.
__device__ inline void let_next_kernel_start() {
#if __CUDA_ARCH__ >= 900
  asm volatile("griddepcontrol.launch_dependents;" ::: "memory");
#endif
}

/// How a kernel begins that needs all that was launched before it.
__device__ inline void begin_after_earlier_kernels() {
  detail::wait_for_earlier_kernels();
  detail::let_next_kernel_start();
}

/// One kernel of several that do not need each other: only the first waits for what was launched
/// before them, and none is done before the one ahead of it.
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
