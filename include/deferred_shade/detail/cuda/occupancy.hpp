// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cuda_runtime.h>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>

#include <deferred_shade/detail/cuda/launch.hpp>
#include <deferred_shade/record_shaders.hpp>

namespace deferred_shade::detail {

/// The `block_size` that a shader declares, or the function of a record shader; else 0.
template <class Shader, class = void>
inline constexpr int declared_block_size = 0;
template <class Shader>
inline constexpr int declared_block_size<Shader, std::void_t<decltype(Shader::block_size)>> =
    Shader::block_size;
template <class Source, class Function, class Sink>
inline constexpr int declared_block_size<record_shader<Source, Function, Sink>, void> =
    declared_block_size<Function>;

/// How one kernel fills the current device.
struct kernel_occupancy {
  std::uint32_t threads;        ///< per block
  std::size_t resident_blocks;  ///< on all multiprocessors together
};

/// The threads per block that the library chooses at most: the warps of a larger block wait for its
/// last one before the next block can take their place.
inline constexpr int most_threads = 256;

/// The occupancy of `Kernel` on the current device: with `threads` per block, or with as many as
/// fill the device best where that is 0. Asked of CUDA once per thread of the host and device.
template <auto Kernel>
kernel_occupancy occupancy_of(int threads) {
  thread_local int known_device = -1;
  thread_local kernel_occupancy known{};
  int const device = current_device();
  if (device == known_device) return known;
  int blocks = 0;
  if (threads == 0) {
    check_cuda(cudaOccupancyMaxPotentialBlockSize(&blocks, &threads, Kernel, 0, most_threads),
               "occupancy");
  }
  check_cuda(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&blocks, Kernel, threads, 0),
             "occupancy");
  if (blocks == 0) {
    std::string const doing = "finding room for a block of " + std::to_string(threads) + " threads";
    check_cuda(cudaErrorInvalidConfiguration, doing.c_str());
  }
  known = {static_cast<std::uint32_t>(threads),
           static_cast<std::size_t>(blocks) * multiprocessors()};
  known_device = device;
  return known;
}

}  // namespace deferred_shade::detail
