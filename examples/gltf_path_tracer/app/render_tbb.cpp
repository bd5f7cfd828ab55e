// SPDX-License-Identifier: Apache-2.0
#ifdef PATH_TRACER_HAS_TBB

#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <thrust/system/tbb/execution_policy.h>

#include "app/integrator.hpp"

namespace path_tracer {

template <class Set>
render_result render_tbb(host_scene const& scene, render_settings const& settings,
                         progress_function const& progress) {
  std::size_t const threads =
      settings.threads > 0 ? settings.threads
                           : static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  tbb::global_control const limit(tbb::global_control::max_allowed_parallelism, threads);
  return integrate<Set>(host_backend{thrust::tbb::par}, scene.view(), settings, progress);
}

template render_result render_tbb<variant_set<PATH_TRACER_VARIANT>>(host_scene const&,
                                                                    render_settings const&,
                                                                    progress_function const&);

}  // namespace path_tracer

#endif
