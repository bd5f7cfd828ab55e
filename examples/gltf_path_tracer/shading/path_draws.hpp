// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace path_tracer::path_draw {

// Pairs of random numbers that a path draws once; far from those of its bounces, see path.hpp.
inline constexpr std::uint32_t lens = 0x8000'0000u;
inline constexpr std::uint32_t wavelength = 0x8000'0001u;
inline constexpr std::uint32_t time = 0x8000'0002u;

// One pair more for each bounce: add its number.
inline constexpr std::uint32_t sky_texel = 0xa000'0000u;
inline constexpr std::uint32_t free_path = 0xc000'0000u;

}  // namespace path_tracer::path_draw
