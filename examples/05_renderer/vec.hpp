// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

/// Marks a function that runs on the host and, in code for a CUDA compiler, on the device.
#ifdef __CUDACC__
#define HD __host__ __device__
#else
#define HD
#endif

/// Three floats: a point, a direction or a colour.
struct vec {
  float x, y, z;
};

HD inline vec operator+(vec a, vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
HD inline vec operator-(vec a, vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
HD inline vec operator*(vec a, vec b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
HD inline vec operator*(float s, vec a) { return {s * a.x, s * a.y, s * a.z}; }
HD inline float dot(vec a, vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
HD inline vec cross(vec a, vec b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
HD inline vec unit(vec a) { return (1 / std::sqrt(dot(a, a))) * a; }
HD inline vec reflected(vec d, vec normal) { return d - 2 * dot(d, normal) * normal; }
