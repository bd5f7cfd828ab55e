// SPDX-License-Identifier: Apache-2.0
// Compiled once for each instruction set, as BUCKET: how many of `n` requests have a shader.
#include <thrust/system/cpp/execution_policy.h>
#include <cstdint>
#include <deferred_shade/grouping.hpp>
#include <vector>

std::uint32_t BUCKET(std::uint32_t n);

std::uint32_t BUCKET(std::uint32_t n) {
  // 20 shaders: counted by comparing vectors where those have 32 bytes, and one by one elsewhere.
  std::vector<std::uint8_t> ids(n);
  for (std::uint32_t i = 0; i < n; ++i) ids[i] = static_cast<std::uint8_t>(i % 23);
  std::uint8_t const* const first = ids.data();
  deferred_shade::workspace scratch{thrust::cpp::par};
  return deferred_shade::group_by_bucket<20>(thrust::cpp::par, n, first, scratch).offsets[20];
}
