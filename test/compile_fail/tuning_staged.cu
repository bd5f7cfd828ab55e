// SPDX-License-Identifier: Apache-2.0
// Index shaders load and store by themselves: they cannot pass through shared memory.
// error: cuda_tuning::tile must not choose staged for tables that cannot be staged
// errors: 9
#include "cuda.hpp"

struct choice : ds::tuning {
  struct cuda : ds::tuning::cuda {
    static constexpr ds::tile_algorithm tile(ds::shader_id, bool) {
      return ds::tile_algorithm::staged;
    }
  };
};
void f(std::uint8_t* ids, hit* hits, color* out, device_workspace& scratch) {
  ds::tuned tuned{scratch, choice{}};
#ifdef RIGHT
  auto const shaders = ds::record_shaders(hits, out, matte{});
#else
  (void)hits;
  ds::shader_table const shaders{mark{&out->value}};
#endif
  ds::shade(thrust::cuda::par, ds::local_sort_then_dispatch<>{}, 5, ids, shaders, tuned);
}
