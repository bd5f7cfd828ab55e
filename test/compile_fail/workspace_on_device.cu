// SPDX-License-Identifier: Apache-2.0
// A policy for a CPU with memory of a GPU.
// errors: 1
// error: scratch must have memory that the CPU reaches, not that of a cuda_allocator; write
// deferred_shade::workspace scratch\{exec\}
#include "cuda.hpp"

#ifdef RIGHT
using scratch_type = ds::workspace<>;
#else
using scratch_type = device_workspace;
#endif
void f(std::uint8_t* ids, float* out, scratch_type& scratch) {
  ds::shade(thrust::cpp::par, ds::implicit_serialization{}, 5, ids, ds::shader_table{mark{out}},
            scratch);
}
