// SPDX-License-Identifier: Apache-2.0
#include <deferred_shade/shader_traits.hpp>

#include <cstdint>
#include <deferred_shade/deferred_shade.hpp>
#include <vector>

#include "catch.hpp"
#include "support/backends.hpp"
#include "support/every_schedule.hpp"

namespace ds = deferred_shade;

namespace {

struct hit {
  float a, b;
};
struct plain {
  DEFERRED_SHADE_HOST_DEVICE float operator()(hit const& h) const { return h.a * h.b; }
};
struct declares {
  static constexpr int block_size = 96;
  static constexpr bool runs_in_vectors = false;
  DEFERRED_SHADE_HOST_DEVICE float operator()(hit const& h) const { return h.a + h.b; }
};
/// Data members of the same names are no traits: they are the shader's own.
struct has_members {
  int block_size;
  bool runs_in_vectors;
  DEFERRED_SHADE_HOST_DEVICE float operator()(hit const& h) const {
    return runs_in_vectors ? h.a : static_cast<float>(block_size);
  }
};
/// Constants of other types are none, either.
struct other_types {
  static constexpr char const* block_size = "large";
  DEFERRED_SHADE_HOST_DEVICE float operator()(hit const& h) const { return h.a - h.b; }
};
/// Says nothing itself: the specialisation below does.
struct foreign {
  DEFERRED_SHADE_HOST_DEVICE float operator()(hit const& h) const { return h.a / (1 + h.b); }
};

}  // namespace

template <>
struct deferred_shade::shader_traits<foreign> : deferred_shade::declared_shader_traits<foreign> {
  static constexpr int block_size = 64;
};

TEST_CASE("a shader's static constants are its traits, and nothing else is", "[traits]") {
  STATIC_REQUIRE(ds::shader_traits<plain>::block_size == 0);
  STATIC_REQUIRE(ds::shader_traits<plain>::runs_in_vectors);
  STATIC_REQUIRE(ds::shader_traits<declares>::block_size == 96);
  STATIC_REQUIRE(!ds::shader_traits<declares>::runs_in_vectors);
  STATIC_REQUIRE(ds::shader_traits<has_members>::block_size == 0);
  STATIC_REQUIRE(ds::shader_traits<has_members>::runs_in_vectors);
  STATIC_REQUIRE(ds::shader_traits<other_types>::block_size == 0);
}

TEST_CASE("a specialisation speaks for a shader, and a record shader for its function",
          "[traits]") {
  STATIC_REQUIRE(ds::shader_traits<foreign>::block_size == 64);
  STATIC_REQUIRE(ds::shader_traits<foreign>::runs_in_vectors);
  using record = ds::record_shader<hit const*, foreign, float*>;
  STATIC_REQUIRE(ds::shader_traits<record>::block_size == 64);
  using declared = ds::record_shader<hit const*, declares, float*>;
  STATIC_REQUIRE(!ds::shader_traits<declared>::runs_in_vectors);
  auto const lambda = [](hit const& h) { return h.a; };
  STATIC_REQUIRE(ds::shader_traits<decltype(lambda)>::runs_in_vectors);
}

TEMPLATE_LIST_TEST_CASE("shaders of all traits run the same by every schedule", "[traits]",
                        test::backends) {
  std::uint32_t const n = 1000;
  std::vector<hit> hits(n);
  std::vector<std::uint8_t> ids(n);
  std::vector<float> expected(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    hit const h = hits[i] = {1 + static_cast<float>(i % 17), static_cast<float>(i % 5)};
    ids[i] = static_cast<std::uint8_t>(i * 7 % 5);
    expected[i] = ids[i] == 0   ? h.a * h.b
                  : ids[i] == 1 ? h.a + h.b
                  : ids[i] == 2 ? h.a
                  : ids[i] == 3 ? h.a / (1 + h.b)
                                : h.a - h.b;
  }
  auto const there = test::on<TestType>(hits);
  auto const ids_there = test::on<TestType>(ids);
  ds::workspace scratch{TestType::policy()};
  ds::for_each_schedule([&](char const* name, auto const& schedule) {
    CAPTURE(name);
    typename TestType::template vector<float> results(n);
    auto const shaders =
        ds::record_shaders(static_cast<hit const*>(there.data()), results.data(), plain{},
                           declares{}, has_members{7, true}, foreign{}, other_types{});
    ds::shade(TestType::policy(), schedule, n, ids_there.data(), shaders, scratch);
    TestType::wait();
    bool same = true;
    for (std::uint32_t i = 0; i < n; ++i) same = same && results[i] == expected[i];
    CHECK(same);
  });
}
