// SPDX-License-Identifier: Apache-2.0
#include "scene/texture.hpp"

#include <vector>

#include "catch.hpp"

using namespace path_tracer;

namespace {

/// A 4 x 2 image whose red is 10 x column, green 100 x row, blue 255, alpha 128.
struct image {
  std::vector<std::uint32_t> texels = std::vector<std::uint32_t>(3, 0);  // an offset
  std::vector<float> linear;
  texture t;

  image() {
    for (std::uint32_t y = 0; y < 2; ++y)
      for (std::uint32_t x = 0; x < 4; ++x)
        texels.push_back(10 * x | (100 * y) << 8 | 255u << 16 | 128u << 24);
    for (int k = 0; k < 256; ++k) linear.push_back(srgb_to_linear(static_cast<float>(k) / 255));
    t.width = 4;
    t.height = 2;
    t.offset = 3;
  }
  vec4 at(float u, float v) const {
    return sample_texture({&t, texels.data(), linear.data()}, 0, {u, v}) * 255.0f;
  }
};

}  // namespace

TEST_CASE("the sRGB curve has its known values", "[texture]") {
  CHECK(srgb_to_linear(0) == 0);
  CHECK_THAT(srgb_to_linear(1), WithinAbs(1, 1e-6));
  CHECK_THAT(srgb_to_linear(0.5f), WithinAbs(0.21404114, 1e-6));
  CHECK_THAT(srgb_to_linear(0.04f), WithinAbs(0.04 / 12.92, 1e-7));
}

TEST_CASE("a texel's centre gives the texel, row 0 on top", "[texture]") {
  image const i;
  vec4 const c = i.at(2.5f / 4, 1.5f / 2);
  CHECK_THAT(c.x, WithinAbs(20, 1e-3));
  CHECK_THAT(c.y, WithinAbs(100, 1e-3));
  CHECK_THAT(c.z, WithinAbs(255, 1e-3));
  CHECK_THAT(c.w, WithinAbs(128, 1e-3));
}

TEST_CASE("bilinear filtering is linear between centres and wraps", "[texture]") {
  image i;
  CHECK_THAT(i.at(1.75f / 4, 0.5f / 2).x, WithinAbs(12.5, 1e-3));
  CHECK_THAT(i.at(0, 0.25f).x, WithinAbs(15, 1e-3));  // between columns 3 and 0
  CHECK_THAT(i.at(7, 0.25f).x, WithinAbs(15, 1e-3));
  CHECK_THAT(i.at(-2.375f, 0.25f).x, WithinAbs(20, 1e-3));
  CHECK_THAT(i.at(0.5f, 0).y, WithinAbs(50, 1e-3));
}

TEST_CASE("wrap modes are those of glTF", "[texture]") {
  std::vector<std::uint32_t> repeat, clamp, mirror;
  for (std::int64_t k = -4; k < 7; ++k) {
    repeat.push_back(wrap_texel(k, 3, 0));
    clamp.push_back(wrap_texel(k, 3, 1));
    mirror.push_back(wrap_texel(k, 3, 2));
  }
  CHECK(repeat == std::vector<std::uint32_t>{2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0});
  CHECK(clamp == std::vector<std::uint32_t>{0, 0, 0, 0, 0, 1, 2, 2, 2, 2, 2});
  CHECK(mirror == std::vector<std::uint32_t>{2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0});
}

TEST_CASE("colour is decoded before it is filtered", "[texture]") {
  image i;
  i.t.srgb = true;
  float const a = srgb_to_linear(0), b = srgb_to_linear(100.0f / 255);
  CHECK_THAT(i.at(0.125f, 0.5f).y, WithinAbs(255 * (a + b) / 2, 1e-2));
  CHECK_THAT(i.at(0.125f, 0.25f).w, WithinAbs(128, 1e-3));  // alpha is linear always
}

TEST_CASE("nearest takes the texel that holds the point", "[texture]") {
  image i;
  i.t.nearest = true;
  CHECK_THAT(i.at(0.49f, 0.1f).x, WithinAbs(10, 1e-3));
  CHECK_THAT(i.at(0.51f, 0.1f).x, WithinAbs(20, 1e-3));
  CHECK_THAT(i.at(-0.01f, 0.1f).x, WithinAbs(30, 1e-3));
}

TEST_CASE("coordinates that are huge or not finite stay inside the image", "[texture]") {
  image const i;
  for (float const bad : {1e30f, -1e30f, INFINITY, NAN}) {
    vec4 const c = i.at(bad, bad);
    CHECK(c.x >= 0);
    CHECK(c.x <= 30.01f);
    CHECK_THAT(c.z, WithinAbs(255, 1e-3));
  }
}
