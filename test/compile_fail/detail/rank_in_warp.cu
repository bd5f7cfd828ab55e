// SPDX-License-Identifier: Apache-2.0
// More shaders than a warp has lanes.
// errors: 1
// error: each shader must have a lane of a warp to look after it
#include "../cuda.hpp"

#ifdef RIGHT
constexpr ds::shader_id shaders = 32;
#else
constexpr ds::shader_id shaders = 33;
#endif
__global__ void f(std::uint32_t* out) {
  std::uint32_t keys[2] = {};
  std::uint32_t ranks[2];
  *out = ds::detail::rank_in_warp<shaders>(keys, ranks) + ranks[0];
}
