// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/config.hpp>  // first: it refuses what is too old

#include <cstddef>

#include <deferred_shade/detail/cpu/explicit.hpp>
#include <deferred_shade/detail/cpu/implicit.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>
#ifdef __CUDACC__
#include <deferred_shade/detail/cuda/explicit.hpp>
#include <deferred_shade/detail/cuda/implicit.hpp>
#endif

namespace deferred_shade {

/// Runs all requests in one launch, with a switch over their shaders. If neighbouring lanes need
/// different shaders, the hardware runs these one after the other. Schedule 1 of Hoberock et al.,
/// HPG 2009; over a grouping, the second half of its schedules 3 and 5. On CUDA, record shaders
/// load and store outside of the switch (docs/gpu.md).
struct implicit_serialization {
  /// Takes no workspace.
  template <class Policy>
  static constexpr std::size_t workspace_bytes(Policy const&, std::size_t, std::size_t) {
    return 0;
  }

  /// As a schedule: runs requests in the order of their indices.
  template <class Policy, class Count, class Ids, class... Shaders, class Workspace>
  void operator()(Policy const& exec, Count n, Ids ids, shader_table<Shaders...> const& shaders,
                  Workspace& scratch) const {
    [[maybe_unused]] auto const dispatched = scratch.begin_phase({"dispatch"});
    detail::run_implicit(detail::system_of<Policy>{}, exec, n, ids, shaders, scratch);
  }

  /// As a dispatch: runs requests in the order of `group`. `scratch` gives its observer and its
  /// tuning, and no memory.
  template <class Policy, class... Shaders, class Workspace = workspace<>>
  void operator()(Policy const& exec, grouping group, shader_table<Shaders...> const& shaders,
                  Workspace const& scratch = {}) const {
    [[maybe_unused]] auto const dispatched = scratch.begin_phase({"dispatch"});
    detail::run_implicit(detail::system_of<Policy>{}, exec, group, shaders, scratch);
  }
};

/// Runs each shader in a launch of its own. Schedule 2 of Hoberock et al., HPG 2009; over a
/// grouping, the second half of its schedules 4 and 6.
///
/// On CUDA, the launches overlap from compute capability 9.0 on. A block has the number of threads,
/// up to 256, that maximises occupancy. A shader may set another number (shader_traits.hpp):
///
///     struct marble { static constexpr int block_size = 128; /* ... */ };
struct explicit_serialization {
  /// Takes no workspace.
  template <class Policy>
  static constexpr std::size_t workspace_bytes(Policy const&, std::size_t, std::size_t) {
    return 0;
  }

  /// As a schedule: every launch visits all requests and masks those of other shaders.
  template <class Policy, class Count, class Ids, class... Shaders, class Workspace>
  void operator()(Policy const& exec, Count n, Ids ids, shader_table<Shaders...> const& shaders,
                  Workspace& scratch) const {
    [[maybe_unused]] auto const dispatched = scratch.begin_phase({"dispatch"});
    detail::run_explicit(detail::system_of<Policy>{}, exec, n, ids, shaders, scratch);
  }

  /// As a dispatch: every launch visits the segment of its shader. On a CPU, empty segments are not
  /// launched. On CUDA, the kernel reads the length, and the host does not wait for it: empty
  /// segments are launched as well, except for shaders that shader_table::expecting rules out.
  /// `scratch` gives its observer, and no memory.
  template <class Policy, class... Shaders, class Workspace = workspace<>>
  void operator()(Policy const& exec, grouping group, shader_table<Shaders...> const& shaders,
                  Workspace const& scratch = {}) const {
    [[maybe_unused]] auto const dispatched = scratch.begin_phase({"dispatch"});
    detail::run_explicit(detail::system_of<Policy>{}, exec, group, shaders, scratch);
  }
};

}  // namespace deferred_shade
