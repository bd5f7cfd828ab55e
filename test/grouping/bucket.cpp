// SPDX-License-Identifier: Apache-2.0
// By tables of all the sizes at which buckets are counted and ranked in another way.
// Covers grouping.hpp, detail/cpu/bucket.hpp, detail/cpu/prefetch.hpp, detail/cuda/bucket.hpp,
// detail/cuda/bucket_tile.hpp, detail/cuda/counter_bucket.hpp, detail/cuda/lane_bucket.hpp,
// detail/cuda/load_keys.hpp, detail/cuda/rank_in_warp.hpp, detail/cuda/sorted_bucket_tile.hpp,
// detail/cuda/thread_counts.hpp and detail/cuda/warp.hpp.
#include <deferred_shade/grouping.hpp>

#include "support/grouping_properties.hpp"

namespace {

template <class Backend, class Id, test::ds::shader_id Shaders>
void check() {
  test::check_grouping_of<Backend, Id, Shaders>(
      [](auto const& policy, test::ds::request_index n, auto ids, auto& scratch) {
        return test::ds::group_by_bucket<Shaders>(policy, n, ids, scratch);
      });
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("group_by_bucket is a stable sort by shader", "[grouping]",
                        test::backends) {
  check<TestType, std::uint8_t, 1>();
  check<TestType, std::uint8_t, 5>();
  check<TestType, std::uint8_t, 7>();
  check<TestType, std::uint8_t, 8>();
  check<TestType, std::uint8_t, 11>();
  check<TestType, std::int8_t, 14>();
  check<TestType, std::uint8_t, 15>();
  check<TestType, std::uint16_t, 15>();
  check<TestType, std::uint8_t, 16>();
  check<TestType, std::int16_t, 32>();
  check<TestType, std::uint16_t, 33>();
  check<TestType, std::uint8_t, 200>();
  check<TestType, std::uint8_t, 255>();
  check<TestType, std::uint16_t, 256>();
  check<TestType, std::uint16_t, 511>();
  check<TestType, std::int16_t, 512>();
  check<TestType, std::uint32_t, 1000>();
  check<TestType, std::int32_t, 3000>();
  check<TestType, std::uint16_t, 65535>();
  check<TestType, std::uint32_t, 65536>();
}
