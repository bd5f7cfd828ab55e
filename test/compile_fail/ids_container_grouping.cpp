// SPDX-License-Identifier: Apache-2.0
// The same for a grouping.
// error: ids must be a random-access iterator over shader ids; pass ids.data\(\)
#include "program.hpp"

auto f(std::vector<std::uint8_t> const& ids, ds::workspace<>& scratch) {
#ifdef RIGHT
  return ds::group_by_bucket<3>(thrust::cpp::par, 5U, ids.data(), scratch);
#else
  return ds::group_by_bucket<3>(thrust::cpp::par, 5U, ids, scratch);
#endif
}
