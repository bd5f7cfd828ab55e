// SPDX-License-Identifier: Apache-2.0
#ifdef PATH_TRACER_HAS_OMP

#include <omp.h>
#include <thrust/system/omp/execution_policy.h>

#include "app/integrator.hpp"

namespace path_tracer {
namespace {

/// Sets the number of threads while it lives.
class thread_limit {
 public:
  explicit thread_limit(unsigned threads) : before_(omp_get_max_threads()) {
    omp_set_num_threads(threads > 0 ? static_cast<int>(threads) : omp_get_num_procs());
  }
  ~thread_limit() { omp_set_num_threads(before_); }
  thread_limit(thread_limit const&) = delete;
  thread_limit& operator=(thread_limit const&) = delete;

 private:
  int before_;
};

}  // namespace

template <class Set>
render_result render_omp(host_scene const& scene, render_settings const& settings,
                         progress_function const& progress) {
  thread_limit const limit(settings.threads);
  return integrate<Set>(host_backend{thrust::omp::par}, scene.view(), settings, progress);
}

template render_result render_omp<variant_set<PATH_TRACER_VARIANT>>(host_scene const&,
                                                                    render_settings const&,
                                                                    progress_function const&);

}  // namespace path_tracer

#endif
