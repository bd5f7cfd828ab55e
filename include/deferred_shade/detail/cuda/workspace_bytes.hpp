// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <deferred_shade/detail/cuda/tuning.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>

// Upper bounds of the workspace that groupings take on CUDA: the exact size depends on CUB at run
// time. Needs no CUDA compiler: code for the host can reserve memory of a device. No bound falls
// when batches or tables grow.

namespace deferred_shade::detail {

/// An upper bound of what CUB takes to scan or select `n` elements: 16 bytes for each of its tiles,
/// which have at least 128 elements.
constexpr std::size_t cub_scan_bytes(std::size_t n) {
  return detail::array_bytes<std::byte>(n / 8 + 65536);
}

/// The sort keeps keys and indices twice. CUB adds up to 1024 bytes for each of its tiles, which
/// have at least 1024 pairs with narrow keys. Before compute capability 9.0, it also adds tables
/// whose size depends on the GPU alone.
constexpr std::size_t radix_bytes(cuda_system, std::size_t n, std::size_t shaders) {
  std::size_t const key = shaders <= 0xff ? 1 : shaders <= 0xffff ? 2 : 4;
  return 2 * array_bytes<request_index>(n) + 2 * array_bytes<std::byte>(n * key) +
         detail::array_bytes<std::byte>(4 * n + (std::size_t{3} << 20)) +
         detail::array_bytes<request_index>(shaders + 1);
}

/// The bytes of an id, if ids behind an iterator are copied: see two_passes.
constexpr std::size_t copied_id_bytes(std::size_t shaders) { return shaders < 256 ? 1 : 2; }

constexpr std::size_t bucket_bytes(cuda_system where, std::size_t n, std::size_t shaders) {
  // Tables that are too large for bucket_algorithm::counters are sorted.
  std::size_t const counted = (std::min)(shaders, std::size_t{511});
  std::size_t const tiles = n / bucket_tile + 1;
  std::size_t const counters = tiles * counted + 1;
  std::size_t const buckets =
      detail::array_bytes<request_index>(n) + detail::array_bytes<std::uint32_t>(counters) +
      detail::array_bytes<std::uint32_t>(counted) + detail::cub_scan_bytes(counters) +
      detail::array_bytes<request_index>(counted + 1) +
      detail::array_bytes<std::byte>(n * detail::copied_id_bytes(counted));
  return shaders > counted ? (std::max)(buckets, detail::radix_bytes(where, n, shaders)) : buckets;
}

constexpr std::size_t compact_bytes(cuda_system, std::size_t n, std::size_t shaders) {
  return detail::array_bytes<request_index>(n) + detail::cub_scan_bytes(n) +
         detail::array_bytes<request_index>(shaders + 1);
}

constexpr std::size_t window_bytes(cuda_system where, std::size_t n, std::size_t shaders) {
  std::size_t const tiles = n / bucket_tile + 1;
  std::size_t const counted = (std::min)(shaders, std::size_t{warp_size});
  std::size_t const windows = detail::array_bytes<std::uint32_t>(n) +
                              detail::array_bytes<std::uint32_t>(tiles * counted) +
                              detail::array_bytes<std::uint32_t>(n / window_size + 1) +
                              detail::array_bytes<std::byte>(n * detail::copied_id_bytes(counted));
  return shaders > counted ? (std::max)(windows, detail::bucket_bytes(where, n, shaders)) : windows;
}

}  // namespace deferred_shade::detail
