// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cuda_runtime.h>
#include <cstddef>
#include <cstdint>
#include <string>

#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/launch.hpp>
#include <deferred_shade/detail/cuda/tuning.hpp>

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// How one kernel fills the current device.
struct kernel_occupancy {
  std::uint32_t threads;        ///< per block
  std::size_t resident_blocks;  ///< on all multiprocessors together
};

/// The occupancy of `Kernel` on the current device, with `threads` per block. 0 stands for the
/// number, up to explicit_threads, that maximises occupancy. Asks CUDA once per host thread, and
/// again if its device or `threads` changes. Throws cuda_error if no block fits.
template <auto Kernel>
kernel_occupancy occupancy_of(int threads) {
  thread_local int known_device = -1;
  thread_local int known_threads = -1;
  thread_local kernel_occupancy known{};
  int const device = detail::current_device();
  if (device == known_device && threads == known_threads) return known;
  int const wanted_threads = threads;
  int blocks = 0;
  if (threads == 0) {
    detail::check_cuda(
        cudaOccupancyMaxPotentialBlockSize(&blocks, &threads, Kernel, 0, explicit_threads),
        "occupancy");
  }
  detail::check_cuda(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&blocks, Kernel, threads, 0),
                     "occupancy");
  if (blocks == 0) {
    std::string const doing = "finding room for a block of " + std::to_string(threads) + " threads";
    detail::check_cuda(cudaErrorInvalidConfiguration, doing.c_str());
  }
  known = {static_cast<std::uint32_t>(threads),
           static_cast<std::size_t>(blocks) * multiprocessors()};
  known_device = device;
  known_threads = wanted_threads;
  return known;
}

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
