// SPDX-License-Identifier: Apache-2.0
// A warp has lanes for 32 shaders.
// error: cuda_tuning::bucket must not choose lanes for more than 32 shaders
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
    static constexpr ds::bucket_algorithm bucket(ds::shader_id) {
      return ds::bucket_algorithm::lanes;
    }
  };
};
#ifdef RIGHT
constexpr int size = 32;
#else
constexpr int size = 33;
#endif
void f(std::uint16_t* ids, float* out, device_workspace& scratch) {
  ds::tuned tuned{scratch, choice{}};
  ds::shade(thrust::cuda::par, ds::bucket_then_dispatch<ds::implicit_serialization>{}, 5, ids,
            table(out, std::make_integer_sequence<int, size>()), tuned);
}
