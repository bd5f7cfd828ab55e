// SPDX-License-Identifier: Apache-2.0
// The same for statistics.
// error: ids must be a random-access iterator over shader ids; pass ids.data\(\)
#include "program.hpp"

auto f(std::vector<std::uint8_t> const& ids) {
#ifdef RIGHT
  return ds::count_occurrences(thrust::cpp::par, 5U, ids.data(), 3);
#else
  return ds::count_occurrences(thrust::cpp::par, 5U, ids, 3);
#endif
}
