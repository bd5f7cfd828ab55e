// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/detail/cpu/tuning.hpp>
#include <deferred_shade/detail/cuda/tuning.hpp>
#include <deferred_shade/observer.hpp>

namespace deferred_shade {

/// The sizes and thresholds of all schedules, and the algorithm that a table gets. These were the
/// best on the machines that the project measured. detail/cpu/tuning.hpp and detail/cuda/tuning.hpp
/// say what decided each.
struct tuning {
  using cpu = cpu_tuning;
  using cuda = cuda_tuning;
};

/// A workspace that carries a tuning for schedules. Pass it in place of the workspace. A renderer's
/// tuning derives from the library's and replaces what it knows better for its shaders or its
/// machine. No choice changes a result: every request still runs once, and a worker starts the
/// requests of one shader in the order of their indices.
///
///     struct long_shaders : ds::tuning {
///       struct cuda : ds::tuning::cuda {
///         static constexpr ds::tile_algorithm tile(ds::shader_id, bool) {
///           return ds::tile_algorithm::rows;
///         }
///       };
///     };
///     ds::tuned mine{scratch, long_shaders{}};
///     ds::shade(exec, ds::local_sort_then_dispatch<>{}, n, ids, shaders, mine);
template <class Workspace, class Tuning>
struct tuned : detail::workspace_wrapper<Workspace> {
  using tuning_type = Tuning;
  tuned(Workspace& scratch, Tuning) : detail::workspace_wrapper<Workspace>(scratch) {}
};

}  // namespace deferred_shade
