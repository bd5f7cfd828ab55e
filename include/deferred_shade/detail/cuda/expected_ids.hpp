// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cuda_runtime.h>

#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/host_copy.hpp>
#include <deferred_shade/detail/cuda/launch.hpp>
#include <deferred_shade/detail/expected_ids.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/shader_table.hpp>

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// The same for a batch on a GPU, whose ids the host waits for. A stream that is being captured
/// cannot be waited for: nothing is checked then.
template <class Policy, class Count, class Ids, class... Shaders>
void check_expected(cuda_system, Policy const& exec, Count n, Ids const& ids,
                    shader_table<Shaders...> const& shaders) {
  cudaStream_t const stream = detail::stream_of(exec);
  cudaStreamCaptureStatus status{};
  detail::check_cuda(cudaStreamIsCapturing(stream, &status), "looking for a capture");
  if (status != cudaStreamCaptureStatusNone) return;
  request_index const count = detail::count_on_host("shade", stream, n);
  detail::check_expected_ids(count, detail::ids_on_host(stream, count, ids).data(), shaders);
}

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
