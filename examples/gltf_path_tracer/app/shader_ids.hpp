// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "io/image.hpp"

namespace path_tracer {

/// Linear RGB of a shader: well apart from all others, and the same in every scene. That of rays
/// which leave the scene is grey.
rgb shader_color(std::size_t id);

/// Which shader each pixel runs first, with the names and the shares of those that occur below. The
/// ids are `render_result::first_shaders`, as many as the picture has pixels; std::invalid_argument
/// otherwise.
image shader_id_picture(std::uint32_t width, std::uint32_t height,
                        std::vector<std::uint8_t> const& ids);

}  // namespace path_tracer
