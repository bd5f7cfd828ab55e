// SPDX-License-Identifier: Apache-2.0
// Covers detail/cpu/compact.hpp and detail/cuda/compact.hpp.
#include <deferred_shade/grouping.hpp>

#include <bitset>
#include <cstdint>
#include <vector>

#include "support/grouping_properties.hpp"

namespace {

template <class Backend, class Id, test::ds::shader_id Shaders>
void check() {
  test::check_grouping_of<Backend, Id, Shaders>(
      [](auto const& policy, test::ds::request_index n, auto ids, auto& scratch) {
        return test::ds::group_by_compaction<Shaders>(policy, n, ids, scratch);
      });
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("group_by_compaction is a stable sort by shader", "[grouping]",
                        test::backends) {
  check<TestType, std::uint8_t, 1>();
  check<TestType, std::uint8_t, 5>();
  check<TestType, std::int8_t, 11>();
  check<TestType, std::int16_t, 33>();
  if (test::quick()) return;  // on CUDA, two launches per shader
  check<TestType, std::uint8_t, 200>();
  check<TestType, std::uint32_t, 300>();
}

namespace {

/// Compacts the shaders of `wanted` among ids of all; a plain loop does not see the others.
template <class Backend, test::ds::shader_id Shaders>
void check_wanted(std::bitset<Shaders> const& wanted) {
  auto const exec = Backend::policy();
  test::ds::workspace scratch{exec};
  for (std::uint32_t const n : {0U, 1U, 1000U, 20011U}) {
    CAPTURE(n, wanted, test::run_seed());
    auto seen =
        test::make_ids<std::uint8_t>(test::layout::random, n, Shaders, test::run_seed() + n);
    auto const ids = test::on<Backend>(seen);
    for (std::uint8_t& id : seen) {
      if (id < Shaders && !wanted[id]) id = Shaders;
    }
    test::check_grouping<Backend>(
        test::ds::group_by_compaction<Shaders>(exec, n, ids.data(), scratch, wanted),
        test::stable_grouping(seen, Shaders));
  }
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("group_by_compaction leaves out the shaders that are not wanted",
                        "[grouping]", test::backends) {
  check_wanted<TestType, 1>({});
  check_wanted<TestType, 5>({});
  check_wanted<TestType, 5>(std::bitset<5>().set());
  check_wanted<TestType, 5>(std::bitset<5>().set(0));
  check_wanted<TestType, 5>(std::bitset<5>().set(4));
  check_wanted<TestType, 32>(std::bitset<32>().set(3).set(31));
  check_wanted<TestType, 130>(std::bitset<130>().set(1).set(64).set(127).set(128));
}
