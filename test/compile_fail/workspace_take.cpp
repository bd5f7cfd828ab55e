// SPDX-License-Identifier: Apache-2.0
// A workspace of the renderer's that gives no memory.
// error: scratch must be a workspace that is not const, or have its member
// take\(elements<T>\.\.\.\)
#include "program.hpp"

struct renderers_workspace {
  ds::workspace<> memory;
#ifdef RIGHT
  template <class... T>
  auto take(ds::elements<T>... arrays) {
    return memory.take(arrays...);
  }
#endif
  void reserve(std::size_t n, std::size_t shaders) { memory.reserve(n, shaders); }
  char begin_phase(ds::phase const&) const { return 0; }
};
void f(std::uint8_t* ids, float* out, renderers_workspace& scratch) {
  ds::shader_table const table{mark{out}, mark{out}};
  ds::shade(thrust::cpp::par, ds::sort_then_dispatch<>{}, 5, ids, table, scratch);
}
