// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <string_view>
#include <type_traits>
#include <vector>

namespace test {

/// The seed of this run: DEFERRED_SHADE_TEST_SEED if it is set, else a fresh one. A test prints it
/// with CAPTURE: a failure can then be run again.
inline std::uint32_t run_seed() {
  static std::uint32_t const seed = [] {
    char const* const text = std::getenv("DEFERRED_SHADE_TEST_SEED");
    return text ? static_cast<std::uint32_t>(std::strtoul(text, nullptr, 10))
                : std::random_device{}();
  }();
  return seed;
}

/// Whether DEFERRED_SHADE_TEST_QUICK=1 asks for fewer sizes: under a tool that makes a test many
/// times as slow.
inline bool quick() {
  char const* const text = std::getenv("DEFERRED_SHADE_TEST_QUICK");
  return text && std::string_view(text) == "1";
}

/// Sizes of a batch on the edges: of a SIMD group or warp, a thread block, a bitonic tile, a
/// counting tile, a block of block_partition; and one of several blocks or multiprocessors.
template <class Backend>
std::vector<std::uint32_t> edge_sizes() {
  if (quick()) return {0, 1, 33, 257, 8193};
  return {0,    1,    2,    31,   32,    33,    63,    65,
          255,  256,  257,  1023, 1024,  1025,  4095,  4096,
          4097, 8191, 8192, 8193, 16383, 16384, 16385, Backend::many_blocks};
}

/// Fewer of them, for the tenth type of id.
inline std::vector<std::uint32_t> some_sizes() {
  if (quick()) return {0, 257, 8193};
  return {0, 1, 33, 257, 8193, 16385};
}

/// How ids lie in a batch.
enum class layout {
  random,      ///< all shaders, and some ids that name none
  coherent,    ///< stretches of one id, 32 long on average
  one_shader,  ///< the last shader of the table alone
  none,        ///< ids outside the table alone
  descending   ///< from the last shader to the first
};
inline constexpr layout layouts[] = {layout::random, layout::coherent, layout::one_shader,
                                     layout::none, layout::descending};

/// An id that no table of `shaders` shaders has: -1 or another negative one, one of the first
/// beyond, or the largest. An 8-bit type that 256 shaders fill has none; the caller's table is
/// smaller.
template <class Id>
Id outside(std::uint32_t shaders, std::mt19937& engine) {
  std::uint64_t const largest = static_cast<std::uint64_t>(std::numeric_limits<Id>::max());
  switch (engine() % 3) {
    case 0:
      return static_cast<Id>(std::min<std::uint64_t>(shaders + engine() % 8, largest));
    case 1:
      return static_cast<Id>(-1);
    default:
      return std::is_signed_v<Id> ? std::numeric_limits<Id>::min() : std::numeric_limits<Id>::max();
  }
}

/// `n` ids over `shaders` shaders.
template <class Id>
std::vector<Id> make_ids(layout how, std::uint32_t n, std::uint32_t shaders, std::uint32_t seed) {
  std::mt19937 engine(seed);
  std::vector<Id> ids(n);
  Id current{};
  for (std::uint32_t i = 0; i < n; ++i) {
    switch (how) {
      case layout::random:
        ids[i] =
            engine() % 8 == 0 ? outside<Id>(shaders, engine) : static_cast<Id>(engine() % shaders);
        break;
      case layout::coherent:
        if (i == 0 || engine() % 32 == 0) current = static_cast<Id>(engine() % (shaders + 1));
        ids[i] = current;
        break;
      case layout::one_shader:
        ids[i] = static_cast<Id>(shaders - 1);
        break;
      case layout::none:
        ids[i] = outside<Id>(shaders, engine);
        break;
      case layout::descending:
        ids[i] = static_cast<Id>(shaders - 1 - std::uint64_t{i} * shaders / n);
        break;
    }
  }
  return ids;
}

}  // namespace test
