// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include "io/gltf_document.hpp"
#include "scene/math.hpp"

namespace path_tracer::gltf {

/// The bytes of an accessor, known to lie inside their buffer.
struct elements {
  unsigned char const* data;
  std::size_t count, stride;
  int component_type;

  template <class T>
  T get(std::size_t i, std::size_t component) const {
    T value;
    std::memcpy(&value, data + i * stride + component * sizeof(T), sizeof(T));
    return value;
  }

  std::uint32_t unsigned_at(std::size_t i, std::size_t component) const {
    if (component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE)
      return get<std::uint8_t>(i, component);
    if (component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT)
      return get<std::uint16_t>(i, component);
    return get<std::uint32_t>(i, component);
  }

  /// A float, or a normalised integer.
  real real_at(std::size_t i, std::size_t component) const {
    switch (component_type) {
      case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return get<float>(i, component);
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return std::max(static_cast<real>(get<std::int8_t>(i, component)) / real(127), real(-1));
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return std::max(static_cast<real>(get<std::int16_t>(i, component)) / real(32767), real(-1));
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return static_cast<real>(unsigned_at(i, component)) / real(255);
      default:
        return static_cast<real>(unsigned_at(i, component)) / real(65535);
    }
  }
};

/// The elements of accessor number `index`; errors call it `name` of the element `where`. Throws
/// std::runtime_error if it is sparse or exceeds its buffer.
elements open_accessor(document const& d, std::string const& where, int index,
                       std::string const& name);

}  // namespace path_tracer::gltf
