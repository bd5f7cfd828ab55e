// SPDX-License-Identifier: Apache-2.0
// Batches in which every thread block owns many tiles.
#include <thrust/count.h>
#include <thrust/device_vector.h>
#include <thrust/iterator/counting_iterator.h>
#include <thrust/iterator/transform_iterator.h>
#include <algorithm>
#include <cstdint>
#include <vector>

#include "support/device_batch.hpp"
#include "support/every_schedule.hpp"
#include "support/grouping_properties.hpp"

namespace ds = deferred_shade;

namespace {

using gpu = test::cuda;

template <class Id, ds::shader_id Shaders>
void check_groupings(std::uint32_t n, test::layout how) {
  std::uint32_t const seed = test::run_seed();
  CAPTURE(n, static_cast<int>(how), seed, Shaders, sizeof(Id));
  auto const data = test::make_ids<Id>(how, n, Shaders, seed);
  test::stable_grouping const expected(data, Shaders);
  thrust::device_vector<Id> const device_ids(data.begin(), data.end());
  Id const* const ids = thrust::raw_pointer_cast(device_ids.data());
  auto const exec = gpu::policy();
  ds::workspace scratch{exec};
  test::check_grouping<gpu>(ds::group_by_bucket<Shaders>(exec, n, ids, scratch), expected);
  test::check_grouping<gpu>(ds::group_by_radix_sort<Shaders>(exec, n, ids, scratch), expected);
  if constexpr (Shaders < 100) {
    test::check_grouping<gpu>(ds::group_by_compaction<Shaders>(exec, n, ids, scratch), expected);
  }
}

/// A third of the requests each for two shaders, and a third for none.
struct id_of_three {
  DEFERRED_SHADE_HOST_DEVICE std::uint8_t operator()(ds::request_index i) const {
    return static_cast<std::uint8_t>(i % 3);
  }
};

/// Two shaders that tell in one byte per request that they ran, and how often.
struct mark {
  std::uint8_t* marks;
  std::uint8_t step;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i) const {
    marks[i] = static_cast<std::uint8_t>(marks[i] + step);
  }
};

struct is_marked_right {
  std::uint8_t const* marks;
  DEFERRED_SHADE_HOST_DEVICE bool operator()(std::uint64_t i) const {
    std::uint8_t const expected[] = {1, 16, 0};
    return marks[i] == expected[i % 3];
  }
};

}  // namespace

TEST_CASE("groupings of millions of requests are stable", "[cuda]") {
  std::uint32_t const n = test::quick() ? 300007 : 5000011;
  for (test::layout const how : {test::layout::random, test::layout::coherent}) {
    check_groupings<std::uint8_t, 32>(n, how);
    check_groupings<std::uint16_t, 300>(n, how);
  }
  check_groupings<std::uint8_t, 11>(4 * n, test::layout::random);
}

TEST_CASE("every schedule shades millions of requests", "[cuda]") {
  std::uint32_t const n = test::quick() ? 300007 : 5000011;
  std::uint32_t const seed = test::run_seed();
  CAPTURE(seed);
  auto const ids =
      test::make_ids<std::uint8_t>(test::layout::random, n, test::device_batch::shaders, seed);
  cudaStream_t const stream{};
  test::device_batch batch(n);
  ds::workspace scratch{gpu::policy()};
  test::for_each_schedule([&](auto schedule) {
    batch.send(ids, stream);
    ds::shade(gpu::policy(), schedule, n, batch.ids(), batch.table(), scratch);
    batch.fetch(stream);
    gpu::wait();
    CHECK(batch.first_wrong() == n);
  });
}

// Hidden, and run by name, as the large batches of shade.cpp are.
TEST_CASE("groupings of tens of millions of requests are stable", "[cuda][.][large]") {
  check_groupings<std::uint8_t, 11>(80000023, test::layout::random);
  check_groupings<std::uint16_t, 300>(80000023, test::layout::random);
}

TEST_CASE("the largest batch on a GPU", "[cuda][.][large]") {
  std::size_t const n = ds::max_requests;
  auto const exec = gpu::policy();
  std::size_t free = 0;
  std::size_t total = 0;
  test::check_cuda(cudaMemGetInfo(&free, &total));
  auto const ids = thrust::make_transform_iterator(thrust::counting_iterator<ds::request_index>(0),
                                                   id_of_three{});
  auto const check = [&](auto schedule, std::size_t bytes) {
    if (free < bytes) {
      WARN("skipped: the GPU has not enough memory free");
      return;
    }
    thrust::device_vector<std::uint8_t> marks(n, 0);
    std::uint8_t* const first = thrust::raw_pointer_cast(marks.data());
    ds::workspace scratch{exec};
    ds::shade(exec, schedule, n, ids, ds::shader_table{mark{first, 1}, mark{first, 16}}, scratch);
    gpu::wait();
    auto const right =
        thrust::count_if(thrust::device, thrust::counting_iterator<std::uint64_t>(0),
                         thrust::counting_iterator<std::uint64_t>(n), is_marked_right{first});
    CHECK(static_cast<std::size_t>(right) == n);
  };
  check(ds::implicit_serialization{}, n + n / 8);
  check(ds::explicit_serialization{}, n + n / 8);
  check(ds::local_sort_then_dispatch<>{}, n + n / 8);
  check(ds::window_sort_then_dispatch{}, 5 * n + n / 8);
  check(ds::local_sort_then_dispatch<ds::bitonic>{}, n + n / 8);
  check(ds::bucket_then_dispatch<>{}, 6 * n);
  check(ds::bucket_then_dispatch<ds::implicit_serialization>{}, 6 * n);
  check(ds::compact_then_dispatch<>{}, 6 * n);
  check(ds::sort_then_dispatch<>{}, 16 * n);
}
