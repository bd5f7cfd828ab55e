// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <deferred_shade/detail/cpu/lanes.hpp>
#include <deferred_shade/detail/cpu/prefetch.hpp>
#include <deferred_shade/detail/cpu/tuning.hpp>
#include <deferred_shade/record_shaders.hpp>
#include <deferred_shade/shader_traits.hpp>
#include <deferred_shade/types.hpp>

// How a CPU runs one shader on many requests. It packs their records and runs the shader over them
// in a loop that compilers vectorise (docs/records.md, "Vectors on a CPU").

/// Goes before a function that is not inlined, but has all its callees inlined.
#if DEFERRED_SHADE_HAS_GNU
#define DEFERRED_SHADE_FLATTEN __attribute__((flatten, noinline))
#else
#define DEFERRED_SHADE_FLATTEN
#endif

namespace deferred_shade::detail {

/// Whether the requests of a shader are packed.
template <class Shader>
inline constexpr bool is_packable = false;
template <class Source, class Function, class Sink>
inline constexpr bool is_packable<record_shader<Source, Function, Sink>> =
    shader_traits<Function>::runs_in_vectors&&
        has_words<typename record_shader<Source, Function, Sink>::request_type>&&
            has_words<typename record_shader<Source, Function, Sink>::result_type>;

/// The requests of a shader that are packed at a time.
template <class Shader>
inline constexpr std::size_t packed_lanes = (std::min)(most_packed,
                                                       packed_bytes /
                                                           (sizeof(typename Shader::request_type) +
                                                            sizeof(typename Shader::result_type)) /
                                                           16 * 16);

/// Prefetches request i and the place of its result, if `shader` is a record shader.
template <class Shader>
void prefetch_records(Shader const& shader, request_index i) noexcept {
  if constexpr (is_record_shader<Shader>) {
    detail::prefetch<cache_level::second_level>(shader.source, i);
    detail::prefetch<cache_level::second_level>(shader.sink, i);
  }
}

/// Runs a shader on the requests `index_of(j)` for j from 0 to `count` - 1, and calls `ahead(j)`
/// between loads. `count` is at most `packed_lanes`. Kept out of line: all shaders then use the
/// same part of the stack. Its callees are inlined: a loop with a call stays scalar.
template <class Shader, class IndexOf, class Ahead>
DEFERRED_SHADE_FLATTEN void run_packed(Shader const& shader, std::size_t count, IndexOf index_of,
                                       Ahead ahead) {
  using request = typename Shader::request_type;
  using result = typename Shader::result_type;
  lanes<request, packed_lanes<Shader>> requests;
  lanes<result, packed_lanes<Shader>> results;
  std::size_t packed = 0;
  // Four at a time if the source is a pointer. The code of a source that is a function would be
  // there five times, and it may return a reference that its next call overwrites.
  using source = decltype(shader.source);
  if constexpr (std::is_same_v<source, request const*> || std::is_same_v<source, request*>) {
    auto const at = [&](std::size_t j) -> request const& { return shader.source[index_of(j)]; };
    for (; packed + 4 <= count; packed += 4) {
      for (std::size_t j = packed; j < packed + 4; ++j) ahead(j);
      requests.copy(packed, at(packed), at(packed + 1), at(packed + 2), at(packed + 3));
    }
  }
  for (; packed < count; ++packed) {
    ahead(packed);
    requests.copy(packed, detail::load(shader.source, index_of(packed)));
  }
  auto const& function = shader.function;
  for (std::size_t j = 0; j < count; ++j) {
    request const r = requests.get(j);
    results.set(j, function(r));
  }
  for (std::size_t j = 0; j < count; ++j) detail::store(shader.sink, index_of(j), results.get(j));
}

/// Runs one shader on the requests `index_of(j)` for j from 0 to `count` - 1. Calls `ahead(j)` once
/// for each, to prefetch later requests.
template <class Shader, class IndexOf, class Ahead>
void run_segment(Shader const& shader, std::size_t count, IndexOf index_of, Ahead ahead) {
  if constexpr (is_packable<Shader>) {
    for (std::size_t begin = 0; begin < count; begin += packed_lanes<Shader>) {
      detail::run_packed(
          shader, (std::min)(packed_lanes<Shader>, count - begin),
          [=](std::size_t j) { return index_of(begin + j); },
          [=](std::size_t j) { ahead(begin + j); });
    }
  } else {
    for (std::size_t j = 0; j < count; ++j) {
      ahead(j);
      static_cast<void>(shader(index_of(j)));
    }
  }
}

}  // namespace deferred_shade::detail
