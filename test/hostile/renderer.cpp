// SPDX-License-Identifier: Apache-2.0
// A renderer whose namespace has a function by the name of each function of the library
// (functions.py): none of them may be called. All types that a renderer hands over come from there.
// Compiled for CPUs, and by nvcc.
#include <thrust/copy.h>
#include <thrust/device_vector.h>
#include <thrust/execution_policy.h>
#include <thrust/system/cpp/execution_policy.h>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <vector>
#ifdef DEFERRED_SHADE_TEST_OMP
#include <thrust/system/omp/execution_policy.h>
#endif
#ifdef DEFERRED_SHADE_TEST_TBB
#include <thrust/system/tbb/execution_policy.h>
#endif

#include "hostile_functions.hpp"  // generated; before the library, as a renderer's headers may be

#include <deferred_shade/deferred_shade.hpp>
#include <deferred_shade/specialized.hpp>

namespace ds = deferred_shade;

namespace hostile {

enum class material : std::uint8_t { matte, glass, lamp, none };
struct hit {
  float a, b;
};
struct light {
  float v;
};
template <int Kind>
struct function {
  DEFERRED_SHADE_HOST_DEVICE light operator()(hit const& h) const { return {h.a * Kind + h.b}; }
};
struct source {
  hit const* hits;
  DEFERRED_SHADE_HOST_DEVICE hit operator()(ds::request_index i) const { return hits[i]; }
};
struct sink {
  light* lights;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i, light const& l) const {
    lights[i] = l;
  }
};
template <int Kind>
struct index_shader {
  hit const* hits;
  light* lights;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i) const {
    lights[i] = function<Kind>{}(hits[i]);
  }
};
template <class T>
struct allocator : std::allocator<T> {
  allocator() = default;
  template <class U>
  allocator(allocator<U> const&) {}
  template <class U>
  struct rebind {
    using other = allocator<U>;
  };
};
struct observer {
  int* phases;
  int operator()(ds::phase const&) const { return ++*phases; }
};
struct my_tuning : ds::tuning {};
struct schedule {
  template <class Policy, class Count, class Ids, class... Shaders, class Workspace>
  void operator()(Policy const& exec, Count n, Ids ids, ds::shader_table<Shaders...> const& shaders,
                  Workspace& scratch) const {
    ds::explicit_serialization{}(
        exec, ds::group_by_bucket<sizeof...(Shaders)>(exec, n, ids, scratch), shaders, scratch);
  }
};

}  // namespace hostile

/// Where a machine has its memory.
struct on_cpu {
  template <class T>
  using vector = std::vector<T>;
  static auto allocator() { return hostile::allocator<std::byte>{}; }
  template <class T>
  static T* pointer(std::vector<T>& v) {
    return v.data();
  }
};
#ifdef __CUDACC__
struct on_gpu {
  template <class T>
  using vector = thrust::device_vector<T>;
  static auto allocator() { return ds::cuda_allocator<std::byte>{}; }
  template <class T>
  static T* pointer(thrust::device_vector<T>& v) {
    return v.data().get();
  }
};
#endif

template <class Machine, class Policy>
int check(Policy const& exec, char const* what) {
  std::uint32_t const n = 20011;
  std::vector<hostile::hit> hits(n);
  std::vector<hostile::material> ids(n);
  std::vector<float> expected(n, -1);
  for (std::uint32_t i = 0; i < n; ++i) {
    hits[i] = {static_cast<float>(i % 101), static_cast<float>(i % 7)};
    ids[i] = static_cast<hostile::material>(i * 7919 % 4);
    if (ids[i] == hostile::material::matte) expected[i] = hits[i].a + hits[i].b;
    if (ids[i] == hostile::material::glass) expected[i] = hits[i].a * 2 + hits[i].b;
    if (ids[i] == hostile::material::lamp) expected[i] = hits[i].a * 3 + hits[i].b;
  }
  typename Machine::template vector<hostile::hit> hits_there(hits.begin(), hits.end());
  typename Machine::template vector<hostile::material> ids_there(ids.begin(), ids.end());
  typename Machine::template vector<hostile::light> lights(n);
  hostile::hit const* const from = Machine::pointer(hits_there);
  hostile::light* const to = Machine::pointer(lights);
  int wrong = 0, phases = 0;
  ds::workspace plain{Machine::allocator()};
  ds::tuned tuned{plain, hostile::my_tuning{}};
  ds::observed seen{tuned, hostile::observer{&phases}};
  auto const check_one = [&](char const* name, auto const& schedule, auto const& shaders) {
    lights.assign(n, hostile::light{-1});
    ds::shade(exec, schedule, n, Machine::pointer(ids_there), shaders, seen);
    std::vector<hostile::light> results(n);
    thrust::copy(lights.begin(), lights.end(), results.begin());
    for (std::uint32_t i = 0; i < n; ++i) {
      if (results[i].v == expected[i]) continue;
      std::printf("%s, %s: request %u is %g, not %g\n", what, name, i,
                  static_cast<double>(results[i].v), static_cast<double>(expected[i]));
      ++wrong;
      break;
    }
  };
  using hostile::function;
  auto const all = [&](char const* name, auto const& schedule) {
    check_one(name, schedule,
              ds::record_shaders(from, to, function<1>{}, function<2>{}, function<3>{}));
    check_one(name, schedule,
              ds::record_shaders(hostile::source{from}, hostile::sink{to}, function<1>{},
                                 function<2>{}, function<3>{}));
    check_one(
        name, schedule,
        ds::shader_table{hostile::index_shader<1>{from, to}, hostile::index_shader<2>{from, to},
                         hostile::index_shader<3>{from, to}});
  };
  ds::for_each_schedule(all);
  all("its own", hostile::schedule{});
  all("specialized",
      ds::specialized{hostile::schedule{}, ds::variants<ds::ids<0, 1, 2>>{}, std::bitset<3>(7)});
  if (phases == 0) ++wrong;
  double const costs[] = {1, 1, 1};
  ds::heterogeneous_efficiency(exec, n, Machine::pointer(ids_there), {costs, 3});
  return wrong;
}

int main() {
  int wrong = check<on_cpu>(thrust::cpp::par, "cpp");
#ifdef DEFERRED_SHADE_TEST_OMP
  wrong += check<on_cpu>(thrust::omp::par, "omp");
#endif
#ifdef DEFERRED_SHADE_TEST_TBB
  wrong += check<on_cpu>(thrust::tbb::par, "tbb");
#endif
#ifdef __CUDACC__
  wrong += check<on_gpu>(thrust::cuda::par, "cuda");
#endif
  std::printf("%d wrong\n", wrong);
  return wrong != 0;
}
