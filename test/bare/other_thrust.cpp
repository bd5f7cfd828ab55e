// SPDX-License-Identifier: Apache-2.0
// A program that wraps Thrust and CUB in a namespace of its own (THRUST_CUB_WRAPPED_NAMESPACE),
// with an alias for it or without (ALIASED), or that has another host system of Thrust
// (THRUST_HOST_SYSTEM): every schedule compiles and is right.
#include <thrust/execution_policy.h>
#ifdef ALIASED
namespace thrust = mine::thrust;
#endif

#include <cstdint>
#include <cstdio>
#include <deferred_shade/deferred_shade.hpp>
#include <vector>

namespace ds = deferred_shade;

namespace {

struct hit {
  float a, b;
};
template <int Kind>
struct function {
  DEFERRED_SHADE_HOST_DEVICE float operator()(hit const& h) const { return h.a * Kind + h.b; }
};

template <class Policy>
int check(Policy const& exec, std::uint32_t n) {
  std::vector<hit> hits(n);
  std::vector<std::uint8_t> ids(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    hits[i] = {static_cast<float>(i % 101), static_cast<float>(i % 7)};
    ids[i] = static_cast<std::uint8_t>(i * 7919 % 3);
  }
  int wrong = 0;
  ds::workspace scratch{exec};
  ds::for_each_schedule([&](char const* name, auto const& schedule) {
    std::vector<float> results(n, -1);
    ds::shade(exec, schedule, n, ids.data(),
              ds::record_shaders(static_cast<hit const*>(hits.data()), results.data(),
                                 function<1>{}, function<2>{}),
              scratch);
    for (std::uint32_t i = 0; i < n; ++i) {
      float const expected = ids[i] == 0   ? hits[i].a + hits[i].b
                             : ids[i] == 1 ? hits[i].a * 2 + hits[i].b
                                           : -1;
      if (results[i] == expected) continue;
      std::printf("%s: request %u is %g\n", name, i, static_cast<double>(results[i]));
      ++wrong;
      break;
    }
  });
  return wrong;
}

}  // namespace

#ifdef __CUDACC__
// Compiled, and called by no one: there may be no GPU.
template <class Policy>
void compile_for(Policy const& exec, hit const* hits, float* results, std::uint8_t const* ids) {
  ds::workspace scratch{exec};
  ds::for_each_schedule([&](char const*, auto const& schedule) {
    ds::shade(exec, schedule, 5, ids,
              ds::record_shaders(hits, results, function<1>{}, function<2>{}), scratch);
  });
}
void compile(hit const* hits, float* results, std::uint8_t const* ids) {
  compile_for(THRUST_NS_QUALIFIER::cuda::par, hits, results, ids);
}
#endif

int main() {
  int const wrong = check(THRUST_NS_QUALIFIER::cpp::par, 20011) +
                    check(THRUST_NS_QUALIFIER::host, 20011) + check(THRUST_NS_QUALIFIER::host, 0);
  std::printf("%d wrong\n", wrong);
  return wrong != 0;
}
