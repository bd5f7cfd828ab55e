// SPDX-License-Identifier: Apache-2.0
// Shaders and records of types that C++ allows and few programs have, by every schedule on a CPU.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <deferred_shade/deferred_shade.hpp>
#include <memory>
#include <vector>

#include "catch.hpp"
#include "support/backends.hpp"
#include "support/every_schedule.hpp"
#include "support/random_ids.hpp"

namespace ds = deferred_shade;

namespace test_unusual {

constexpr std::uint32_t several_tiles = 16385;

/// In a build with warnings as errors, a schedule that drops the result does not compile.
struct with_result {
  std::uint32_t* out;
  [[nodiscard]] std::uint32_t operator()(ds::request_index i) const { return out[i] = i + 1; }
};

/// A sink whose result must not be dropped either.
struct checked_sink {
  std::uint32_t* out;
  [[nodiscard]] bool operator()(ds::request_index i, std::uint32_t result) const {
    out[i] = result;
    return true;
  }
};

struct move_only {
  std::unique_ptr<std::uint32_t> amount;
  std::uint32_t* out;
  void operator()(ds::request_index i) const { out[i] = i + *amount; }
};

struct move_only_function {
  std::unique_ptr<std::uint32_t> amount;
  std::uint32_t operator()(std::uint32_t request) const { return request + *amount; }
};

/// A record for which unary & is not the address.
struct mask {
  std::uint32_t bits;
  std::uint32_t const* operator&() const {
    static std::uint32_t const other = 0;
    return &other;
  }
};

/// Runs `table` by every schedule; `out` must then
/// be i + 1 for each request that names a shader, and untouched elsewhere.
template <class Backend, class Table, class Value>
void check_every_schedule(Table const& table, std::vector<Value>& out, Value untouched) {
  auto const ids = test::make_ids<std::uint8_t>(test::layout::random, several_tiles, Table::size(),
                                                test::run_seed());
  ds::workspace scratch{Backend::policy()};
  test::for_each_schedule([&](auto const& schedule) {
    std::fill(out.begin(), out.end(), untouched);
    ds::shade(Backend::policy(), schedule, several_tiles, ids.data(), table, scratch);
    std::uint32_t wrong = 0;
    for (std::uint32_t i = 0; i < several_tiles; ++i) {
      std::uint32_t value = 0;
      std::uint32_t before = 0;
      std::memcpy(&value, std::addressof(out[i]), sizeof value);
      std::memcpy(&before, std::addressof(untouched), sizeof before);
      wrong += value != (ids[i] < Table::size() ? i + 1 : before);
    }
    CHECK(wrong == 0);
  });
}

}  // namespace test_unusual

using namespace test_unusual;

// A table holds shaders of several of these types, for a schedule takes a compiler as long whatever
// they are.
TEMPLATE_LIST_TEST_CASE(
    "shaders may return what must not be dropped, be move-only, and of a function's own type",
    "[types]", test::host_backends) {
  struct local_shader {
    std::uint32_t* out;
    void operator()(ds::request_index i) const { out[i] = i + 1; }
  };
  std::vector<std::uint32_t> out(several_tiles);
  check_every_schedule<TestType>(
      ds::shader_table{with_result{out.data()}, local_shader{out.data()},
                       move_only{std::make_unique<std::uint32_t>(1U), out.data()}},
      out, 77U);
}

TEMPLATE_LIST_TEST_CASE(
    "a sink may return what must not be dropped, of functions that are move-only", "[types]",
    test::host_backends) {
  std::vector<std::uint32_t> in(several_tiles);
  std::vector<std::uint32_t> out(several_tiles);
  for (std::uint32_t i = 0; i < several_tiles; ++i) in[i] = i;
  auto const next = [](std::uint32_t request) { return request + 1; };
  check_every_schedule<TestType>(
      ds::record_shaders(in.data(), checked_sink{out.data()}, next,
                         move_only_function{std::make_unique<std::uint32_t>(1U)}),
      out, 77U);
}

TEMPLATE_LIST_TEST_CASE("a record may be of a function's own type and overload unary &", "[types]",
                        test::host_backends) {
  struct local_record : mask {};
  struct local_function {
    local_record operator()(local_record const& r) const { return {{r.bits + 1}}; }
  };
  std::vector<local_record> in(several_tiles);
  std::vector<local_record> out(several_tiles);
  for (std::uint32_t i = 0; i < several_tiles; ++i) in[i] = {{i}};
  check_every_schedule<TestType>(
      ds::record_shaders(in.data(), out.data(), local_function{}, local_function{}), out,
      local_record{{77U}});
}
