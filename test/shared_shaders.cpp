// SPDX-License-Identifier: Apache-2.0
// Shaders of one type, which share their code, in tables with others.
// Covers detail/shared_shader.hpp.
#include <deferred_shade/schedule.hpp>
#include <deferred_shade/shade.hpp>
#include <deferred_shade/shader_table.hpp>

#include <cstdint>
#include <vector>

#include "catch.hpp"
#include "support/backends.hpp"
#include "support/random_ids.hpp"

namespace {

namespace ds = deferred_shade;

/// Puts down a number that depends on the shader and on the request.
struct numbered {
  std::uint32_t number;
  std::uint32_t* out;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i) const { out[i] = number + i; }
};
template <int>
struct of_its_own {
  std::uint32_t number;
  std::uint32_t* out;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i) const { out[i] = number + i; }
};
struct by_id {
  std::uint32_t* out;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::shader_id id, ds::request_index i) const {
    out[i] = 1000000 * (id + 1) + i;
  }
};

/// Runs a table whose shader k puts down 1,000,000 * (k + 1) + i, by every schedule.
template <class Backend, class MakeTable>
void check(std::uint32_t shaders, MakeTable const& make_table) {
  auto const exec = Backend::policy();
  ds::workspace scratch{exec};
  for (std::uint32_t const n : test::some_sizes()) {
    std::uint32_t const seed = test::run_seed() + n;
    CAPTURE(n, seed, shaders);
    auto const data = test::make_ids<std::uint8_t>(test::layout::random, n, shaders, seed);
    std::vector<std::uint32_t> expected(n);
    for (std::uint32_t i = 0; i < n; ++i) {
      if (data[i] < shaders) expected[i] = 1000000 * (data[i] + 1U) + i;
    }
    auto const ids = test::on<Backend>(data);
    ds::for_each_schedule([&](char const* name, auto const& schedule) {
      CAPTURE(name);
      auto out = test::on<Backend>(std::vector<std::uint32_t>(n));
      ds::shade(exec, schedule, n, ids.data(), make_table(out.data()), scratch);
      Backend::wait();
      CHECK(std::vector<std::uint32_t>(out.begin(), out.end()) == expected);
    });
  }
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("each shader has its own data, whether or not it shares its code",
                        "[shader_table]", test::backends) {
  check<TestType>(5, [](std::uint32_t* out) {
    return ds::shader_table{numbered{1000000, out}, of_its_own<0>{2000000, out},
                            numbered{3000000, out}, of_its_own<1>{4000000, out},
                            numbered{5000000, out}};
  });
  check<TestType>(4, [](std::uint32_t* out) {
    return ds::shader_table{numbered{1000000, out}, numbered{2000000, out},
                            of_its_own<0>{3000000, out}, of_its_own<0>{4000000, out}};
  });
}

TEMPLATE_LIST_TEST_CASE("shared_shaders runs one callable for all ids", "[shader_table]",
                        test::backends) {
  check<TestType>(6, [](std::uint32_t* out) { return ds::shared_shaders<6>(by_id{out}); });
  if (test::quick()) return;
  check<TestType>(40, [](std::uint32_t* out) { return ds::shared_shaders<40>(by_id{out}); });
}
