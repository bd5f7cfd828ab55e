// SPDX-License-Identifier: Apache-2.0
#include "io/gltf_accessor.hpp"

#include <stdexcept>

namespace path_tracer::gltf {

elements open_accessor(document const& d, std::string const& where, int index,
                       std::string const& name) {
  auto const fail = [&](std::string const& what) {
    throw std::runtime_error(where + ": " + name + " (accessor " + std::to_string(index) + ") " +
                             what);
  };
  tinygltf::Accessor const& a = d.model.accessors[static_cast<std::size_t>(index)];
  if (a.sparse.isSparse) fail("is sparse, which is not supported");
  if (a.bufferView < 0) fail("has no bufferView");
  tinygltf::BufferView const& view = d.model.bufferViews[static_cast<std::size_t>(a.bufferView)];
  auto const component = static_cast<std::uint32_t>(a.componentType);
  auto const components = static_cast<std::size_t>(
      tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(a.type)));
  std::size_t const size =
      components * static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(component));
  std::size_t const stride = view.byteStride == 0 ? size : view.byteStride;
  if (stride < size) fail("overlaps itself: its byteStride is too small");
  // check() bounds all three numbers to 32 bits, so that nothing here can overflow 64.
  std::size_t const end = a.byteOffset + (a.count - 1) * stride + size;
  if (end > view.byteLength)
    fail("ends at byte " + std::to_string(end) + " of a buffer view of " +
         std::to_string(view.byteLength));
  auto const& bytes = d.model.buffers[static_cast<std::size_t>(view.buffer)].data;
  return {bytes.data() + view.byteOffset + a.byteOffset, a.count, stride, a.componentType};
}

}  // namespace path_tracer::gltf
