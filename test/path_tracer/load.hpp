// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io/gltf.hpp"
#include "path_tracer/fixture.hpp"

namespace path_tracer_test {

/// The scene of a file with this text, which is deleted again.
inline path_tracer::scene load(std::string const& text) {
  temporary_folder const folder;
  write_bytes(folder / "scene", text);
  return path_tracer::load_gltf(folder / "scene");
}
inline path_tracer::scene load(gltf_fixture const& f) { return load(f.text()); }

}  // namespace path_tracer_test
