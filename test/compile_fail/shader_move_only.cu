// SPDX-License-Identifier: Apache-2.0
// A shader for CUDA that cannot be copied.
// errors: 1
// error: shaders must be copyable where exec is for CUDA
#include "cuda.hpp"

struct move_only {
  float* out;
  explicit move_only(float* to) : out(to) {}
#ifdef RIGHT
  move_only(move_only const&) = default;
#else
  move_only(move_only const&) = delete;
#endif
  move_only(move_only&&) = default;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i) const { out[i] = 1; }
};
void f(std::uint8_t* ids, float* out, device_workspace& scratch) {
  ds::shade(thrust::cuda::par, ds::implicit_serialization{}, 5, ids,
            ds::shader_table{move_only{out}}, scratch);
}
