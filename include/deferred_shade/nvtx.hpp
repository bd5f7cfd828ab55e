// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nvtx3/nvtx3.hpp>
#include <string>

#include <deferred_shade/types.hpp>

namespace deferred_shade {

/// An observer that marks every phase with an NVTX range, for Nsight Systems and other tools:
/// "group", "dispatch", "shader 3". Works on CPUs as well. Requires the NVTX headers of the CUDA
/// toolkit, but no CUDA compiler. Not included by deferred_shade.hpp.
///
///     deferred_shade::observed seen{scratch, deferred_shade::nvtx_ranges{}};
struct nvtx_ranges {
  /// The domain of the ranges: tools show it by this name.
  struct domain {
    static constexpr char const* name = "deferred_shade";
  };

  auto operator()(phase const& p) const {
    std::string const number = p.shader ? " " + std::to_string(*p.shader) : "";
    return nvtx3::scoped_range_in<domain>{p.name + number};
  }
};

}  // namespace deferred_shade
