// SPDX-License-Identifier: Apache-2.0
// Covers detail/counted_at_run_time.hpp and detail/cuda/copied_ids.hpp.
#include <deferred_shade/dispatch.hpp>
#include <deferred_shade/grouping.hpp>
#include <deferred_shade/shader_table.hpp>

#include <thrust/iterator/transform_iterator.h>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "support/grouping_properties.hpp"

namespace {

namespace ds = test::ds;

/// What `group` returns for `ids`: a grouping with one shader more, which those without one name.
template <class Id>
test::stable_grouping all_requests(std::vector<Id> const& ids, ds::shader_id shaders) {
  std::vector<std::uint32_t> named(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    auto const id = static_cast<ds::shader_id>(ids[i]);
    named[i] = id < shaders ? id : shaders;
  }
  return test::stable_grouping(named, shaders + 1);
}

template <class Backend>
void check_groups(ds::request_groups const& groups, test::stable_grouping const& expected,
                  std::size_t n) {
  test::check_grouping<Backend>(groups, expected);
  auto const live = groups.live();
  auto const all = groups.all();
  CHECK(live.permutation == groups.permutation);
  CHECK(all.permutation == groups.permutation);
  CHECK(Backend::read(live.n.pointer, 1)[0] == expected.offsets[groups.shaders]);
  CHECK(Backend::read(all.n.pointer, 1)[0] == n);
  CHECK(live.n.maximum == n);
}

template <class Backend, class Id, class Algorithm>
void check_group(Algorithm const& how, ds::shader_id shaders) {
  auto const exec = Backend::policy();
  ds::workspace scratch{exec};
  for (std::uint32_t const n : test::some_sizes()) {
    for (test::layout const layout : test::layouts) {
      std::uint32_t const seed = test::run_seed() + n + shaders;
      CAPTURE(n, static_cast<int>(layout), seed, shaders);
      auto const data = test::make_ids<Id>(layout, n, shaders, seed);
      auto const ids = test::on<Backend>(data);
      scratch.reserve_bytes(Algorithm::workspace_bytes(exec, n, shaders));
      std::size_t const capacity = scratch.capacity();
      check_groups<Backend>(ds::group(exec, how, n, ids.data(), shaders, scratch),
                            all_requests(data, shaders), n);
      CHECK(scratch.capacity() == capacity);
    }
  }
}

struct low_byte {
  DEFERRED_SHADE_HOST_DEVICE std::uint8_t operator()(std::uint32_t word) const {
    return static_cast<std::uint8_t>(word & 0xff);
  }
};

/// Puts its id down for each request that names it.
struct mark {
  ds::shader_id id;
  std::uint32_t* out;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i) const { out[i] = id + 1; }
};

}  // namespace

TEMPLATE_LIST_TEST_CASE("group has room for any number of shaders", "[grouping]", test::backends) {
  for (ds::shader_id const shaders : {1U, 7U, 8U, 14U, 15U, 31U, 32U, 127U, 128U}) {
    check_group<TestType, std::uint8_t>(ds::by_bucket{}, shaders);
  }
  for (ds::shader_id const shaders : {300U, 510U, 511U, 65534U}) {
    check_group<TestType, std::uint32_t>(ds::by_bucket{}, shaders);
  }
  for (ds::shader_id const shaders : {3U, 15U, 200U}) {
    check_group<TestType, std::int16_t>(ds::by_radix_sort{}, shaders);
  }
  for (ds::shader_id const shaders : {3U, 254U}) {
    check_group<TestType, std::int16_t>(ds::by_compaction{}, shaders);
  }
}

TEMPLATE_LIST_TEST_CASE("group takes a device_count, an iterator and no shaders at all",
                        "[grouping]", test::backends) {
  auto const exec = TestType::policy();
  ds::workspace scratch{exec};
  std::uint32_t const seed = test::run_seed();
  CAPTURE(seed);
  auto data = test::make_ids<std::uint32_t>(test::layout::random, 5000, 11, seed);
  auto const words = test::on<TestType>(data);
  for (std::uint32_t& word : data) word &= 0xff;
  auto const ids = thrust::make_transform_iterator(words.data(), low_byte{});
  check_groups<TestType>(ds::group(exec, 5000, ids, 11, scratch), all_requests(data, 11), 5000);
  check_groups<TestType>(ds::group(exec, 5000, ids, 0, scratch), all_requests(data, 0), 5000);
  check_groups<TestType>(ds::group(exec, 0, ids, 11, scratch),
                         all_requests(std::vector<std::uint32_t>{}, 11), 0);

  for (ds::shader_id const shaders :
       {100U, 255U, 300U}) {  // ids that are copied in one byte or two
    check_groups<TestType>(ds::group(exec, 5000, ids, shaders, scratch),
                           all_requests(data, shaders), 5000);
  }

  auto const count = test::on<TestType>(std::vector<int>{3001});
  data.resize(3001);
  auto const groups = ds::group(exec, ds::device_count{count.data(), 5000}, ids, 11, scratch);
  test::check_grouping<TestType>(groups, all_requests(data, 11));
  CHECK(TestType::read(groups.all().n.pointer, 1)[0] == 3001);
}

TEMPLATE_LIST_TEST_CASE("dispatches take what group returns", "[grouping]", test::backends) {
  auto const exec = TestType::policy();
  ds::workspace scratch{exec};
  std::uint32_t const seed = test::run_seed();
  CAPTURE(seed);
  std::vector<std::uint8_t> const data =
      test::make_ids<std::uint8_t>(test::layout::random, 9000, 2, seed);
  auto const ids = test::on<TestType>(data);
  auto const groups = ds::group(exec, data.size(), ids.data(), 2, scratch);
  std::vector<std::uint32_t> expected(data.size());
  for (std::size_t i = 0; i < data.size(); ++i) expected[i] = data[i] < 2 ? data[i] + 1U : 0U;
  auto out = test::on<TestType>(std::vector<std::uint32_t>(data.size()));
  ds::shader_table const shaders{mark{0, out.data()}, mark{1, out.data()}};
  auto const check = [&] {
    TestType::wait();
    CHECK(test::first_difference(out, test::on<TestType>(expected)) == out.size());
    for (std::uint32_t& value : out) value = 0;
  };
  ds::explicit_serialization{}(exec, groups, shaders, scratch);
  check();
  ds::implicit_serialization{}(exec, groups, shaders, scratch);
  check();
}

TEMPLATE_LIST_TEST_CASE("group says what is wrong with its arguments", "[grouping]",
                        test::backends) {
  auto const exec = TestType::policy();
  ds::workspace scratch{exec};
  auto const ids = test::on<TestType>(std::vector<std::uint8_t>(10));
  std::uint8_t const* const nowhere = nullptr;
  CHECK_THROWS_AS(ds::group(exec, -1, ids.data(), 2, scratch), std::invalid_argument);
  CHECK_THROWS_AS(ds::group(exec, 10, nowhere, 2, scratch), std::invalid_argument);
  CHECK_THROWS_AS(ds::group(exec, std::size_t{1} << 32, ids.data(), 2, scratch), std::length_error);
  CHECK_THROWS_WITH(ds::group(exec, 10, ids.data(), 65535, scratch),
                    "deferred_shade::group: shader_count is 65535, and this algorithm has room for "
                    "at most 65534 shaders");
  CHECK_THROWS_AS(ds::group(exec, ds::by_compaction{}, 10, ids.data(), 255, scratch),
                  std::length_error);
  CHECK_NOTHROW(ds::group(exec, 0, nowhere, 2, scratch));
}
