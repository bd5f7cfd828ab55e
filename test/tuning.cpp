// SPDX-License-Identifier: Apache-2.0
// Covers detail/cpu/tuning.hpp and detail/cuda/tuning.hpp.
#include <deferred_shade/tuning.hpp>

#include <cstdint>
#include <deferred_shade/deferred_shade.hpp>

#include "catch.hpp"
#include "support/backends.hpp"
#include "support/schedule_properties.hpp"

namespace test_tuning {

namespace ds = deferred_shade;

/// The other choice everywhere on a CPU.
struct other_on_cpu : ds::tuning {
  struct cpu : ds::tuning::cpu {
    static constexpr ds::request_index tile = 1000;
    static constexpr ds::request_index long_stretch = 3;
    static constexpr bool compares_keys(ds::shader_id, std::size_t) { return false; }
    static constexpr ds::request_index counted_parts(ds::shader_id) { return 3; }
    static constexpr ds::cache_level ahead_of_places(ds::shader_id) {
      return ds::cache_level::none;
    }
  };
};
struct counts_in_place : ds::tuning {
  struct cpu : ds::tuning::cpu {
    static constexpr bool compares_keys(ds::shader_id, std::size_t) { return false; }
    static constexpr ds::request_index counted_parts(ds::shader_id) { return 1; }
    static constexpr bool counts_tiles(ds::shader_id) { return false; }
  };
};

/// One algorithm of each kind on a GPU, whatever the table; and other sizes.
template <ds::bucket_algorithm Bucket, ds::tile_algorithm Tile, bool Windows>
struct fixed_on_gpu : ds::tuning {
  struct cuda : ds::tuning::cuda {
    static constexpr ds::bucket_algorithm bucket(ds::shader_id) { return Bucket; }
    static constexpr ds::tile_algorithm tile(ds::shader_id, bool) { return Tile; }
    static constexpr bool windows(ds::shader_id) { return Windows; }
    static constexpr std::uint32_t switch_threads(ds::shader_id, bool) { return 64; }
    static constexpr std::uint32_t grouped_switch_threads = 512;
    static constexpr std::uint32_t tile_threads = 256;
    static constexpr std::uint32_t tile_items = 4;
    static constexpr std::uint32_t dense_threads = 128;
    static constexpr std::uint32_t window_threads(ds::shader_id) { return 128; }
  };
};

template <class Backend, class Tuning, std::uint32_t Shaders, class Schedule>
void check_schedule(Schedule const& schedule) {
  ds::workspace scratch{Backend::policy()};
  ds::tuned tuned{scratch, Tuning{}};
  for (std::uint32_t const n : {1U, 1000U, 20011U}) {
    for (test::layout const how : test::layouts) {
      std::uint32_t const seed = test::run_seed() + n;
      CAPTURE(n, static_cast<int>(how), seed, Shaders);
      auto const ids = test::on<Backend>(test::make_ids<std::uint8_t>(how, n, Shaders, seed));
      test::check_against_loop<Backend, Shaders>(schedule, n, ids.data(), tuned);
    }
  }
}
template <class Backend, class Tuning, std::uint32_t Shaders>
void check_every_schedule() {
  ds::for_each_schedule([](char const* name, auto const& schedule) {
    CAPTURE(name);
    check_schedule<Backend, Tuning, Shaders>(schedule);
  });
}
/// One schedule for each choice that a tuning has: of buckets, tiles and windows.
template <class Backend, class Tuning, std::uint32_t Shaders>
void check_each_choice() {
  check_schedule<Backend, Tuning, Shaders>(ds::bucket_then_dispatch<>{});
  check_schedule<Backend, Tuning, Shaders>(ds::local_sort_then_dispatch<>{});
  check_schedule<Backend, Tuning, Shaders>(ds::window_sort_then_dispatch{});
}

}  // namespace test_tuning

using namespace test_tuning;

TEMPLATE_LIST_TEST_CASE("a renderer's tuning for CPUs changes no result", "[tuning]",
                        test::host_backends) {
  check_every_schedule<TestType, other_on_cpu, 5>();
  check_each_choice<TestType, other_on_cpu, 40>();
  check_each_choice<TestType, counts_in_place, 5>();
}

#ifdef DEFERRED_SHADE_TEST_CUDA
TEST_CASE("a renderer's tuning for GPUs changes no result", "[tuning]") {
  using ds::bucket_algorithm;
  using ds::tile_algorithm;
  check_every_schedule<test::cuda,
                       fixed_on_gpu<bucket_algorithm::counters, tile_algorithm::rows, false>, 5>();
  check_each_choice<
      test::cuda, fixed_on_gpu<bucket_algorithm::radix_sort, tile_algorithm::bitonic, false>, 5>();
  check_each_choice<test::cuda, fixed_on_gpu<bucket_algorithm::lanes, tile_algorithm::dense, true>,
                    20>();
}
#endif

TEST_CASE("a tuning goes through observers", "[tuning]") {
  ds::workspace scratch{thrust::cpp::par};
  ds::tuned tuned{scratch, other_on_cpu{}};
  int phases = 0;
  ds::observed seen{tuned, [&phases](ds::phase const&) { return ++phases; }};
  STATIC_REQUIRE(ds::detail::cpu_tuning_of<decltype(seen)>::tile == 1000);
  STATIC_REQUIRE(ds::detail::cpu_tuning_of<decltype(scratch)>::tile == ds::cpu_tuning::tile);
  std::vector<std::uint8_t> const ids(3000, 1);
  test::check_against_loop<test::cpp, 2>(ds::bucket_then_dispatch<>{}, 3000, ids.data(), seen);
  CHECK(phases > 1);
}
