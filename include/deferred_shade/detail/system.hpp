// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/config.hpp>  // first: it refuses what is too old

#include <thrust/system/cpp/execution_policy.h>
#include <type_traits>
#include <utility>
#ifdef __CUDACC__
#include <thrust/system/cuda/execution_policy.h>
#endif

namespace deferred_shade::detail {

// A program may wrap Thrust and CUB in a namespace of its own (THRUST_CUB_WRAPPED_NAMESPACE). The
// library's names thrust and cub refer to the wrapped ones.
namespace thrust = THRUST_NS_QUALIFIER;

/// Where an execution policy runs. It selects the version of an algorithm.
struct host_system {};
struct cuda_system {};

// Thrust's systems for CPUs, cpp, omp and tbb, share a base; so does thrust::seq.
template <class Policy>
host_system find_system(thrust::system::detail::sequential::execution_policy<Policy> const&);
#ifdef __CUDACC__
template <class Policy>
cuda_system find_system(thrust::system::cuda::execution_policy<Policy> const&);
#endif
host_system find_system(host_system);
cuda_system find_system(cuda_system);
void find_system(...);

/// The system of a policy: host_system; in code for a CUDA compiler, cuda_system; or void. A system
/// is its own system.
template <class Policy>
using system_of = decltype(detail::find_system(std::declval<Policy const&>()));

template <class Policy>
inline constexpr bool has_system = !std::is_void_v<system_of<Policy>>;

/// What every function asks of its execution policy.
template <class Policy>
struct requirements_of_exec {
  static_assert(has_system<Policy>,
                "deferred_shade: exec must be an execution policy of Thrust's system cpp, omp, tbb "
                "or, in code for nvcc, cuda; pass thrust::omp::par, for example");
};

}  // namespace deferred_shade::detail
