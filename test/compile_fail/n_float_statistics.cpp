// SPDX-License-Identifier: Apache-2.0
// The same for statistics.
// errors: 3
// error: n must be an integer or a device_count
#include "program.hpp"

auto f(std::uint8_t const* ids) {
#ifdef RIGHT
  return ds::count_occurrences(thrust::cpp::par, 5, ids, 3);
#else
  return ds::count_occurrences(thrust::cpp::par, 5.0, ids, 3);
#endif
}
