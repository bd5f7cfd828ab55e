// SPDX-License-Identifier: Apache-2.0
#ifdef PATH_TRACER_HAS_CPP

#include <thrust/system/cpp/execution_policy.h>

#include "app/integrator.hpp"

namespace path_tracer {

template <class Set>
render_result render_cpp(host_scene const& scene, render_settings const& settings,
                         progress_function const& progress) {
  return integrate<Set>(host_backend{thrust::cpp::par}, scene.view(), settings, progress);
}

template render_result render_cpp<variant_set<PATH_TRACER_VARIANT>>(host_scene const&,
                                                                    render_settings const&,
                                                                    progress_function const&);

}  // namespace path_tracer

#endif
