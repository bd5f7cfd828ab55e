// SPDX-License-Identifier: Apache-2.0
// Keys are compared byte by byte: 256 shaders have keys of two.
// error: cpu_tuning::compares_keys must be false for more than 255 shaders
// errors: 9
#include "program.hpp"

struct choice : ds::tuning {
  struct cpu : ds::tuning::cpu {
    static constexpr bool compares_keys(ds::shader_id, std::size_t) { return true; }
  };
};
#ifdef RIGHT
constexpr ds::shader_id size = 255;
#else
constexpr ds::shader_id size = 256;
#endif
void f(std::uint16_t const* ids, ds::workspace<>& scratch) {
  ds::tuned tuned{scratch, choice{}};
  ds::group_by_bucket<size>(thrust::cpp::par, 5U, ids, tuned);
}
