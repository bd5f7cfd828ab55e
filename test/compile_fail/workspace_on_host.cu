// SPDX-License-Identifier: Apache-2.0
// A policy for CUDA with memory of the host.
// errors: 1
// error: scratch must have memory that the GPU reaches, not std::allocator's; write
// deferred_shade::workspace scratch\{exec\}
#include "cuda.hpp"

#ifdef RIGHT
using scratch_type = device_workspace;
#else
using scratch_type = ds::workspace<>;
#endif
void f(std::uint8_t* ids, float* out, scratch_type& scratch) {
  ds::shade(thrust::cuda::par, ds::implicit_serialization{}, 5, ids, ds::shader_table{mark{out}},
            scratch);
}
