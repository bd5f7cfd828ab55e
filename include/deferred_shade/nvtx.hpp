// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nvtx3/nvtx3.hpp>
#include <string>

#include <deferred_shade/types.hpp>

namespace deferred_shade {

/// An observer that makes a range of NVTX of every phase, in a domain of the library's own, for
/// Nsight Systems and other tools: "group", "dispatch", "shader 3". Works on CPUs as well. Needs
/// NVTX's headers, which come with the CUDA toolkit, and no CUDA compiler. deferred_shade.hpp does
/// not include it.
///
///     deferred_shade::observed seen{scratch, deferred_shade::nvtx_ranges{}};
struct nvtx_ranges {
  /// The library's own, by the name under which tools show it.
  struct domain {
    static constexpr char const* name = "deferred_shade";
  };

  auto operator()(phase const& p) const {
    std::string const number = p.shader ? " " + std::to_string(*p.shader) : "";
    return nvtx3::scoped_range_in<domain>{p.name + number};
  }
};

}  // namespace deferred_shade
