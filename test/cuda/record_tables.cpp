// SPDX-License-Identifier: Apache-2.0
// Record shaders on a GPU, wherever their requests come from and their results go to.
#include <thrust/iterator/counting_iterator.h>
#include <cstdint>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "support/backends.hpp"
#include "support/compare.hpp"
#include "support/every_schedule.hpp"
#include "support/records.hpp"

namespace ds = deferred_shade;

namespace {

using gpu = test::cuda;
using test::mixing;
using test::record;

/// A request from two arrays, and a result that is split over two.
struct load_pair {
  std::uint32_t const* first;
  record<4, 16> const* rest;
  DEFERRED_SHADE_HOST_DEVICE record<5> operator()(ds::request_index i) const {
    auto const& r = rest[i].words;
    return {{first[i], r[0], r[1], r[2], r[3]}};
  }
};
struct store_pair {
  std::uint32_t* first;
  std::uint32_t* second;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i, record<2> const& r) const {
    first[i] = r.words[0];
    second[i] = r.words[1];
  }
};

struct mix_number {
  std::uint32_t factor;
  DEFERRED_SHADE_HOST_DEVICE std::uint32_t operator()(std::uint32_t number) const {
    return factor * number + 1;
  }
};

struct mix_words {
  DEFERRED_SHADE_HOST_DEVICE std::uint32_t operator()(record<3> const& request) const {
    return mixing<record<3>, record<1>>{0}(request).words[0];
  }
};

struct write_index {
  std::uint32_t* results;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i) const { results[i] = ~i; }
};

template <std::uint32_t... Ids>
auto table_of_mixers(std::uint32_t const* source, std::uint32_t* sink,
                     std::integer_sequence<std::uint32_t, Ids...>) {
  return ds::record_shaders(source, sink, mix_number{Ids}...);
}

}  // namespace

TEST_CASE("records come from functions and go to functions", "[cuda]") {
  std::uint32_t const n = 20011;
  CAPTURE(test::run_seed());
  using function = mixing<record<5>, record<2>>;
  gpu::vector<std::uint32_t> first(n);
  for (std::uint32_t i = 0; i < n; ++i) first[i] = i * 7;
  auto const rest = test::random_records<record<4, 16>>(n, test::run_seed() + 1);
  load_pair const load{first.data(), rest.data()};
  auto const ids = test::random_ids(n, 3);
  gpu::vector<record<2>> const zeros(n);
  auto const expected = test::looped(zeros, ids, load);
  auto const exec = gpu::policy();
  ds::workspace scratch{exec};
  test::for_each_schedule([&](auto schedule) {
    gpu::vector<std::uint32_t> left(n, 0);
    gpu::vector<std::uint32_t> right(n, 0);
    ds::shade(exec, schedule, n, ids.data(),
              ds::record_shaders(load, store_pair{left.data(), right.data()}, function{0},
                                 function{1}, function{2}),
              scratch);
    gpu::wait();
    std::vector<record<2>> results(n);
    for (std::uint32_t i = 0; i < n; ++i) results[i] = {{left[i], right[i]}};
    CHECK(test::first_difference(results, expected) == n);
  });
}

TEST_CASE("every shader of a table has its own source and sink", "[cuda]") {
  std::uint32_t const n = 20011;
  CAPTURE(test::run_seed());
  using request = record<8, 16>;
  using result = record<4, 16>;
  using shader = ds::record_shader<request const*, mixing<request, result>, result*>;
  gpu::vector<request> const sources[] = {test::random_records<request>(n, 1),
                                          test::random_records<request>(n, 2),
                                          test::random_records<request>(n, 3)};
  auto const ids = test::random_ids(n, 3);
  auto const exec = gpu::policy();
  ds::workspace scratch{exec};
  test::for_each_schedule([&](auto schedule) {
    gpu::vector<result> sinks[] = {gpu::vector<result>(n), gpu::vector<result>(n),
                                   gpu::vector<result>(n)};
    auto const nth = [&](std::uint32_t k) {
      return shader{sources[k].data(), {k}, sinks[k].data()};
    };
    ds::shade(exec, schedule, n, ids.data(), ds::shader_table{nth(0), nth(1), nth(2)}, scratch);
    gpu::wait();
    for (std::uint32_t k = 0; k < 3; ++k) {
      std::vector<result> expected(n);
      for (std::uint32_t i = 0; i < n; ++i) {
        if (ids[i] == k) expected[i] = mixing<request, result>{k}(sources[k][i]);
      }
      CAPTURE(k);
      CHECK(test::first_difference(sinks[k], expected) == n);
    }
  });
}

TEST_CASE("results may take the place of their requests", "[cuda]") {
  std::uint32_t const n = 20011;
  CAPTURE(test::run_seed());
  using both = record<4, 16>;
  using function = mixing<both, both>;
  auto const ids = test::random_ids(n, 3);
  auto const exec = gpu::policy();
  ds::workspace scratch{exec};
  auto records = test::random_records<both>(n, test::run_seed());
  test::for_each_schedule([&](auto schedule) {
    auto const expected = test::looped(records, ids, [&](std::uint32_t i) { return records[i]; });
    ds::shade(
        exec, schedule, n, ids.data(),
        ds::record_shaders(records.data(), records.data(), function{0}, function{1}, function{2}),
        scratch);
    gpu::wait();
    CHECK(test::first_difference(records, expected) == n);
  });
}

TEST_CASE("record shaders and index shaders of several kinds share a table", "[cuda]") {
  std::uint32_t const n = 20011;
  CAPTURE(test::run_seed());
  auto const ids = test::random_ids(n, 3);
  auto const requests = test::random_records<record<3>>(n, test::run_seed());
  auto const exec = gpu::policy();
  ds::workspace scratch{exec};
  test::for_each_schedule([&](auto schedule) {
    gpu::vector<std::uint32_t> results(n, 9);
    thrust::counting_iterator<std::uint32_t> const number(7);
    using from_memory = ds::record_shader<record<3> const*, mix_words, std::uint32_t*>;
    using from_iterator =
        ds::record_shader<thrust::counting_iterator<std::uint32_t>, mix_number, std::uint32_t*>;
    ds::shade(
        exec, schedule, n, ids.data(),
        ds::shader_table{from_memory{requests.data(), {}, results.data()},
                         from_iterator{number, {5}, results.data()}, write_index{results.data()}},
        scratch);
    gpu::wait();
    std::vector<std::uint32_t> expected(n, 9);
    for (std::uint32_t i = 0; i < n; ++i) {
      if (ids[i] == 0) expected[i] = mix_words{}(requests[i]);
      if (ids[i] == 1) expected[i] = 5 * (i + 7) + 1;
      if (ids[i] == 2) expected[i] = ~i;
    }
    CHECK(test::first_difference(results, expected) == n);
  });
}

TEST_CASE("tiles take tables of many record shaders, and a device_count", "[cuda]") {
  std::uint32_t const n = 20011;
  std::uint32_t const present = 13000;
  CAPTURE(test::run_seed());
  constexpr std::uint32_t many = 40;
  auto const ids = test::random_ids(n, many);
  gpu::vector<std::uint32_t> const count(1, present);
  gpu::vector<std::uint32_t> numbers(n);
  for (std::uint32_t i = 0; i < n; ++i) numbers[i] = i * 3;
  gpu::vector<std::uint32_t> results(n, 9);
  auto const exec = gpu::policy();
  ds::workspace scratch{exec};
  ds::shade(exec, ds::local_sort_then_dispatch<>{}, ds::device_count{count.data(), n}, ids.data(),
            table_of_mixers(numbers.data(), results.data(),
                            std::make_integer_sequence<std::uint32_t, many>()),
            scratch);
  gpu::wait();
  std::vector<std::uint32_t> expected(n, 9);
  for (std::uint32_t i = 0; i < present; ++i) {
    if (ids[i] < many) expected[i] = ids[i] * numbers[i] + 1;
  }
  CHECK(test::first_difference(results, expected) == n);
}
