// SPDX-License-Identifier: Apache-2.0
// A renderer's namespace may hold functions with the names of the library's own, and match calls
// better: none of them is called for the renderer's types.
// Covers deferred_shade.hpp and detail/system.hpp.
#include <cstdint>
#include <deferred_shade/deferred_shade.hpp>
#include <vector>

#include "catch.hpp"
#include "support/backends.hpp"
#include "support/compare.hpp"
#include "support/every_schedule.hpp"
#include "support/random_ids.hpp"

namespace render {

namespace ds = deferred_shade;

enum class material : std::uint8_t {};

struct hit {
  float distance;
  float weight;
};

struct light {
  float value;
};

template <class T>
DEFERRED_SHADE_HOST_DEVICE T load(T const*, ds::request_index) {
  return {};
}
template <class Source>
DEFERRED_SHADE_HOST_DEVICE hit load(Source const&, ds::request_index) {
  return {};
}
template <class T, class Result>
DEFERRED_SHADE_HOST_DEVICE void store(T*, ds::request_index, Result const&) {}
template <class Id>
DEFERRED_SHADE_HOST_DEVICE ds::shader_id shader_of(Id const*, ds::request_index, ds::shader_id) {
  return 0;
}

struct all_hits {
  hit const* hits;
  DEFERRED_SHADE_HOST_DEVICE hit operator()(ds::request_index i) const { return hits[i]; }
};

template <int Factor>
struct scaled {
  DEFERRED_SHADE_HOST_DEVICE light operator()(hit const& h) const {
    return {Factor * h.distance + h.weight};
  }
};

}  // namespace render

namespace {

namespace ds = deferred_shade;

/// By these schedules, or by every one.
template <class Backend, class Source, class... Schedules>
void check(Source source, std::vector<render::hit> const& hits, Schedules const&... schedules) {
  auto const n = static_cast<std::uint32_t>(hits.size());
  auto const data = test::make_ids<std::uint8_t>(test::layout::random, n, 3, test::run_seed());
  std::vector<render::material> names;
  for (auto const id : data) names.push_back(static_cast<render::material>(id));
  auto const ids = test::on<Backend>(names);
  render::material const* const first = ids.data();
  std::vector<float> expected(n, -1);
  for (std::uint32_t i = 0; i < n; ++i) {
    if (data[i] < 3) {
      expected[i] = static_cast<float>(data[i] + 1) * hits[i].distance + hits[i].weight;
    }
  }
  auto const exec = Backend::policy();
  ds::workspace scratch{exec};
  auto const shade = [&](auto schedule) {
    auto results = test::on<Backend>(std::vector<render::light>(n, render::light{-1}));
    ds::shade(exec, schedule, n, first,
              ds::record_shaders(source, results.data(), render::scaled<1>{}, render::scaled<2>{},
                                 render::scaled<3>{}),
              scratch);
    Backend::wait();
    std::vector<float> values;
    for (std::uint32_t i = 0; i < n; ++i) values.push_back(results[i].value);
    CHECK(test::first_difference(values, expected) == n);
  };
  if constexpr (sizeof...(Schedules) == 0) {
    test::for_each_schedule(shade);
  } else {
    (shade(schedules), ...);
  }
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("functions of a renderer's namespace are not taken for the library's",
                        "[names]", test::backends) {
  CAPTURE(test::run_seed());
  std::vector<render::hit> hits(20011);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    hits[i] = {static_cast<float>(i % 113), static_cast<float>(i % 7)};
  }
  auto const there = test::on<TestType>(hits);
  render::hit const* const first = there.data();
  check<TestType>(first, hits);
  check<TestType>(render::all_hits{first}, hits, ds::bucket_then_dispatch<>{},
                  ds::compact_then_dispatch<ds::implicit_serialization>{},
                  ds::local_sort_then_dispatch<>{});
}
