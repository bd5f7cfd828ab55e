// SPDX-License-Identifier: Apache-2.0
// Rows have counters for 255 shaders.
// error: cuda_tuning::tile must not choose rows for more than 255 shaders
#include "cuda.hpp"

template <int>
using counted_mark = mark;
template <int... Ids>
auto table(float* out, std::integer_sequence<int, Ids...>) {
  return ds::shader_table<counted_mark<Ids>...>{((void)Ids, mark{out})...};
}
struct choice : ds::tuning {
  struct cuda : ds::tuning::cuda {
    static constexpr ds::tile_algorithm tile(ds::shader_id, bool) {
      return ds::tile_algorithm::rows;
    }
  };
};
#ifdef RIGHT
constexpr int size = 40;
#else
constexpr int size = 256;
#endif
void f(std::uint16_t* ids, float* out, device_workspace& scratch) {
  ds::tuned tuned{scratch, choice{}};
  ds::shade(thrust::cuda::par, ds::local_sort_then_dispatch<>{}, 5, ids,
            table(out, std::make_integer_sequence<int, size>()), tuned);
}
