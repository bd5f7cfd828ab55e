// SPDX-License-Identifier: Apache-2.0
// Segments that are longer than the grid of their launch.
#include <deferred_shade/dispatch.hpp>
#include <deferred_shade/grouping.hpp>
#include <deferred_shade/shader_table.hpp>

#include <cstdint>
#include <random>
#include <vector>

#include "catch.hpp"
#include "support/backends.hpp"
#include "support/random_ids.hpp"

namespace {

namespace ds = deferred_shade;

/// A block so small that a grid that fills the GPU has few threads.
template <int>
struct counted {
  static constexpr int block_size = 32;
  std::uint32_t* runs;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i) const { ++runs[i]; }
};

/// Shader 0 has 95 of 100 requests, the others one each.
std::vector<std::uint8_t> uneven_ids(std::uint32_t n, std::uint32_t seed) {
  std::mt19937 engine(seed);
  std::vector<std::uint8_t> ids(n);
  for (std::uint8_t& id : ids) {
    std::uint32_t const percent = static_cast<std::uint32_t>(engine() % 100);
    id = static_cast<std::uint8_t>(percent < 95 ? 0 : percent - 94);
  }
  return ids;
}

template <class Group>
void check(Group const& group) {
  std::uint32_t const n = test::quick() ? 200003 : 2000003;
  std::uint32_t const seed = test::run_seed();
  CAPTURE(n, seed);
  auto const exec = test::cuda::policy();
  ds::workspace scratch{exec};
  auto const ids = test::on<test::cuda>(uneven_ids(n, seed));
  auto runs = test::on<test::cuda>(std::vector<std::uint32_t>(n));
  std::uint32_t* const out = runs.data();
  ds::shader_table const shaders{counted<0>{out}, counted<1>{out}, counted<2>{out}, counted<3>{out},
                                 counted<4>{out}};
  ds::grouping const grouped = group(exec, n, ids.data(), scratch);
  for (std::uint32_t times = 1; times <= 3; ++times) {
    ds::explicit_serialization{}(exec, grouped, shaders, scratch);
    test::cuda::wait();
    std::size_t wrong = 0;
    for (std::uint32_t i = 0; i < n; ++i) wrong += runs[i] != (ids[i] < 5 ? times : 0);
    CHECK(wrong == 0);
  }
}

}  // namespace

TEST_CASE("a segment may be longer than the grid of its launch", "[cuda]") {
  check([](auto const& exec, std::uint32_t n, auto ids, auto& scratch) {
    return ds::group_by_bucket<5>(exec, n, ids, scratch);
  });
  check([](auto const& exec, std::uint32_t n, auto ids, auto& scratch) {
    return ds::group_by_radix_sort<5>(exec, n, ids, scratch);
  });
  check([](auto const& exec, std::uint32_t n, auto ids, auto& scratch) {
    return ds::group_by_compaction<5>(exec, n, ids, scratch);
  });
  check([](auto const& exec, std::uint32_t n, auto ids, auto& scratch) {
    return ds::group(exec, n, ids, 300, scratch);
  });
}
