// SPDX-License-Identifier: Apache-2.0
// For a CUDA compiler; empty in a build without CUDA.
#ifdef PATH_TRACER_HAS_CUDA

#include <deque>
#include <type_traits>

#include "app/cuda_backend.hpp"
#include "app/integrator.hpp"

namespace path_tracer {
namespace {

/// A scene in the memory of the CUDA device.
class device_scene {
 public:
  device_scene(cuda_backend const& backend, host_scene const& s)
      : backend_(backend), view_(s.view()) {
    move(view_.bvh.nodes, s.hierarchy.nodes.size());
    move(view_.bvh.triangles, s.hierarchy.triangles.size());
    move(view_.triangles, s.source.triangles.size());
    move(view_.materials, s.source.materials.size());
    move(view_.textures.textures, s.source.textures.size());
    move(view_.textures.texels, s.source.texels.size());
    move(view_.textures.linear, s.linear.size());
    move(view_.lights.entries, view_.lights.count);
    move(view_.lights.punctual, s.source.lights.size());
    move(view_.lights.sky.texels, s.source.sky.texels.size());
    bool const shines = view_.lights.sky_entry < view_.lights.count;
    move(view_.lights.sky_entries, shines ? s.source.sky.texels.size() : 0);
    if (view_.motion != nullptr) move(view_.motion, s.source.motion.size());
    view_.lights.motion = view_.motion;
    view_.lights.triangles = view_.triangles;
    view_.lights.materials = view_.materials;
    view_.lights.textures = view_.textures;
    move(view_.tables, 1);
  }

  scene_view const& view() const { return view_; }

 private:
  using bytes = thrust::device_vector<unsigned char>;

  /// Turns a pointer to `n` elements in host memory into one to a copy of them on the device.
  template <class T>
  void move(T const*& first, std::size_t n) {
    static_assert(std::is_trivially_copyable_v<T>);
    auto const* const source = reinterpret_cast<unsigned char const*>(first);
    bytes& copy = arrays_.emplace_back(backend_.to_device(source, n * sizeof(T)));
    first = reinterpret_cast<T const*>(data_of(copy));
  }

  cuda_backend const& backend_;
  scene_view view_;
  std::deque<bytes> arrays_;  // which never moves an element
};

}  // namespace

template <class Set>
render_result render_cuda(host_scene const& scene, render_settings const& settings,
                          progress_function const& progress) {
  cuda_backend const backend;
  device_scene const copy(backend, scene);
  return integrate<Set>(backend, copy.view(), settings, progress);
}

template render_result render_cuda<variant_set<PATH_TRACER_VARIANT>>(host_scene const&,
                                                                     render_settings const&,
                                                                     progress_function const&);

}  // namespace path_tracer

#endif
