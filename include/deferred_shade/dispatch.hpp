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

/// One launch over all requests, with a switch: where neighbours need different shaders, the
/// hardware runs one after the other. Schedule 1 of Hoberock et al., HPG 2009, and, over a
/// grouping, the second half of its schedules 3 and 5. On CUDA, the loads and stores of record
/// shaders are taken out of the switch (docs/gpu.md).
struct implicit_serialization {
  /// It takes none of a workspace.
  template <class Policy>
  static constexpr std::size_t workspace_bytes(Policy const&, std::size_t, std::size_t) {
    return 0;
  }

  /// The schedule: requests as they come.
  template <class Policy, class Count, class Ids, class... Shaders, class Workspace>
  void operator()(Policy const& exec, Count n, Ids ids, shader_table<Shaders...> const& shaders,
                  Workspace& scratch) const {
    [[maybe_unused]] auto const dispatched = scratch.begin_phase({"dispatch"});
    detail::run_implicit(detail::system_of<Policy>{}, exec, n, ids, shaders, scratch);
  }

  /// The dispatch: requests as `group` orders them. `scratch` is there for its observer.
  template <class Policy, class... Shaders, class Workspace = workspace<>>
  void operator()(Policy const& exec, grouping group, shader_table<Shaders...> const& shaders,
                  Workspace const& scratch = {}) const {
    [[maybe_unused]] auto const dispatched = scratch.begin_phase({"dispatch"});
    detail::run_implicit(detail::system_of<Policy>{}, exec, group, shaders, scratch);
  }
};

/// One launch per shader. Schedule 2 of Hoberock et al., HPG 2009, and, over a grouping, the
/// second half of its schedules 4 and 6.
///
/// On CUDA, launches overlap if the GPU can do that. A launch has as many threads in a block, up to
/// 256, as fill the device. A shader may set another number (shader_traits.hpp):
///
///     struct marble { static constexpr int block_size = 128; /* ... */ };
struct explicit_serialization {
  /// It takes none of a workspace.
  template <class Policy>
  static constexpr std::size_t workspace_bytes(Policy const&, std::size_t, std::size_t) {
    return 0;
  }

  /// The schedule: every launch visits all requests and masks those of other shaders.
  template <class Policy, class Count, class Ids, class... Shaders, class Workspace>
  void operator()(Policy const& exec, Count n, Ids ids, shader_table<Shaders...> const& shaders,
                  Workspace& scratch) const {
    [[maybe_unused]] auto const dispatched = scratch.begin_phase({"dispatch"});
    detail::run_explicit(detail::system_of<Policy>{}, exec, n, ids, shaders, scratch);
  }

  /// The dispatch: every launch visits the segment of its shader. On CPUs, an empty one is not
  /// launched; on CUDA the length is read by the launch itself, so that the host need not wait:
  /// shader_table::expecting spares the launches of shaders that a scene does not have. `scratch`
  /// is there for its observer.
  template <class Policy, class... Shaders, class Workspace = workspace<>>
  void operator()(Policy const& exec, grouping group, shader_table<Shaders...> const& shaders,
                  Workspace const& scratch = {}) const {
    [[maybe_unused]] auto const dispatched = scratch.begin_phase({"dispatch"});
    detail::run_explicit(detail::system_of<Policy>{}, exec, group, shaders, scratch);
  }
};

}  // namespace deferred_shade
