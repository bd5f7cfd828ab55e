// SPDX-License-Identifier: Apache-2.0
// For a build with -fno-exceptions -fno-rtti. Without an argument, shades a batch and ends with 0.
// With one, makes the error of that name, which must end the program after one line on stderr.
// Covers detail/fail.hpp and config.hpp.
#include <thrust/system/cpp/execution_policy.h>

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deferred_shade/deferred_shade.hpp>
#include <deferred_shade/math.hpp>
#include <deferred_shade/specialized.hpp>
#include <utility>
#include <vector>

#include "support/every_schedule.hpp"

#if defined(__cpp_exceptions) || defined(__cpp_rtti)
#error "this file is here to be compiled without exceptions and RTTI"
#endif

namespace ds = deferred_shade;

namespace {

struct mark {
  std::uint32_t* out;
  std::uint32_t value;
  void operator()(ds::request_index i) const { out[i] = value; }
};

/// Shader k writes k + 1. The table has code for every `Step`th one.
template <std::uint32_t Step, std::uint32_t... Ids>
auto table_of(std::uint32_t* out, std::integer_sequence<std::uint32_t, Ids...>) {
  auto const slot = [out](auto id) {
    if constexpr (id % Step == 0) {
      return mark{out, id + 1};
    } else {
      return ds::no_shader{};
    }
  };
  return ds::shader_table{slot(std::integral_constant<std::uint32_t, Ids>{})...};
}

/// The batches that come out wrong, of one for each schedule, with ids of two bytes.
template <std::uint32_t Shaders, std::uint32_t Step>
int wrong_batches() {
  std::vector<std::uint16_t> ids(30000);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    ids[i] = static_cast<std::uint16_t>(i * 40503 % 65537 % (Shaders + 2));
  }
  std::vector<std::uint32_t> out(ids.size());
  auto const table =
      table_of<Step>(out.data(), std::make_integer_sequence<std::uint32_t, Shaders>());
  ds::workspace scratch{thrust::cpp::par};
  int wrong = 0;
  test::for_each_schedule([&](auto const& schedule) {
    out.assign(out.size(), 0);
    ds::shade(thrust::cpp::par, schedule, ids.size(), ids.data(), table, scratch);
    bool right = true;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      bool const shaded = ids[i] < Shaders && ids[i] % Step == 0;
      right = right && out[i] == (shaded ? ids[i] + 1U : 0U);
    }
    wrong += !right;
  });
  return wrong;
}

// What abort() calls: CTest would take the signal by itself for any crash.
void aborted(int) {
  std::puts("aborted");
  std::fflush(stdout);
  std::_Exit(0);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::uint8_t> ids{0, 1, 2, 1};
  std::vector<std::uint32_t> out(ids.size());
  ds::shader_table const table{mark{out.data(), 7}, mark{out.data(), 8}};
  ds::workspace scratch{thrust::cpp::par};
  auto const exec = thrust::cpp::par;
  char const* const name = argc > 1 ? argv[1] : "";
  auto const is = [name](char const* other) { return std::strcmp(name, other) == 0; };
  if (argc > 1) std::signal(SIGABRT, aborted);
  if (is("negative")) ds::shade(exec, ds::sort_then_dispatch<>{}, -1, ids.data(), table, scratch);
  if (is("null")) {
    std::uint8_t const* const none = nullptr;
    ds::shade(exec, ds::sort_then_dispatch<>{}, 4, none, table, scratch);
  }
  if (is("many")) scratch.reserve(ds::max_requests + 1, 1);
  if (is("width")) ds::count_occurrences(exec, 4, ids.data(), 2, 0);
  if (argc > 1) return 1;

  return wrong_batches<3, 1>() + wrong_batches<300, 50>();
}
