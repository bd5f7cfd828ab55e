// SPDX-License-Identifier: Apache-2.0
// A window is sorted by lanes, of which a warp has 32.
// error: cuda_tuning::windows must be false for more than 32 shaders
// errors: 2
#include "cuda.hpp"

template <int>
using counted_mark = mark;
template <int... Ids>
auto table(float* out, std::integer_sequence<int, Ids...>) {
  return ds::shader_table<counted_mark<Ids>...>{((void)Ids, mark{out})...};
}
struct choice : ds::tuning {
  struct cuda : ds::tuning::cuda {
    static constexpr bool windows(ds::shader_id) { return true; }
  };
};
#ifdef RIGHT
constexpr int size = 32;
#else
constexpr int size = 33;
#endif
void f(std::uint16_t* ids, float* out, device_workspace& scratch) {
  ds::tuned tuned{scratch, choice{}};
  ds::shade(thrust::cuda::par, ds::window_sort_then_dispatch{}, 5, ids,
            table(out, std::make_integer_sequence<int, size>()), tuned);
}
