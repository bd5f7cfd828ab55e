// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/system/cpp/execution_policy.h>
#include <tuple>
#ifdef DEFERRED_SHADE_TEST_OMP
#include <thrust/system/omp/execution_policy.h>
#endif
#ifdef DEFERRED_SHADE_TEST_TBB
#include <thrust/system/tbb/execution_policy.h>
#endif

namespace test {

struct cpp {
  static auto policy() { return thrust::cpp::par; }
};
#ifdef DEFERRED_SHADE_TEST_OMP
struct omp {
  static auto policy() { return thrust::omp::par; }
};
#endif
#ifdef DEFERRED_SHADE_TEST_TBB
struct tbb {
  static auto policy() { return thrust::tbb::par; }
};
#endif

/// The Thrust systems that this build tests, for TEMPLATE_LIST_TEST_CASE.
using backends = std::tuple<cpp
#ifdef DEFERRED_SHADE_TEST_OMP
                            ,
                            omp
#endif
#ifdef DEFERRED_SHADE_TEST_TBB
                            ,
                            tbb
#endif
                            >;

}  // namespace test
