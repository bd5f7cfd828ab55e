// SPDX-License-Identifier: Apache-2.0
// Copies in one byte of the ids of 300 shaders.
// errors: 1
// error: copies of ids must have room for all shaders
#include "../cuda.hpp"

#ifdef RIGHT
using key = std::uint16_t;
#else
using key = std::uint8_t;
#endif

__global__ void load(ds::detail::copied_ids<std::uint32_t const*, key> ids, std::uint32_t* out) {
  std::uint32_t keys[16];
  ds::detail::load_neighbours<300>(ids, 0, 16, keys);
  out[0] = keys[0];
}
