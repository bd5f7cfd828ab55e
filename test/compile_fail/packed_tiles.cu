// SPDX-License-Identifier: Apache-2.0
// A table of more shaders than packed tiles have bits for.
// errors: 1
// error: a shader and a position in a tile must fit in 16 bits
#include "cuda.hpp"

template <ds::shader_id>
using counted_mark = mark;
template <ds::shader_id... Ids>
auto kernel_of(std::integer_sequence<ds::shader_id, Ids...>) {
  return &ds::detail::packed_kernel<4, ds::request_index, std::uint8_t const*,
                                    counted_mark<Ids>...>;
}
#ifdef RIGHT
using shaders = std::make_integer_sequence<ds::shader_id, 8>;
#else
using shaders = std::make_integer_sequence<ds::shader_id, 64>;
#endif
auto f() { return kernel_of(shaders{}); }
