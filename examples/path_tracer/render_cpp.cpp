// SPDX-License-Identifier: Apache-2.0
#include <thrust/system/cpp/execution_policy.h>

#include "integrator.hpp"

namespace path_tracer {

render_result render_cpp(host_scene const& scene, render_settings const& settings,
                         progress_function const& progress) {
  return integrate(host_backend{thrust::cpp::par}, scene.view(), settings, progress);
}

}  // namespace path_tracer
