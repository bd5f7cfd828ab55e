// SPDX-License-Identifier: Apache-2.0
// A batch on a GPU. The number of requests stays in device memory. The whole step is captured into
// a CUDA graph once, and launched for every bounce.
#include <thrust/device_vector.h>
#include <thrust/host_vector.h>
#include <cstdint>
#include <cstdio>
#include <deferred_shade/deferred_shade.hpp>

namespace ds = deferred_shade;

struct scale {
  float factor;
  float* radiance;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i) const { radiance[i] *= factor; }
};

int main() {
  std::size_t const most = 6;
  thrust::device_vector<std::uint8_t> const material(
      thrust::host_vector<std::uint8_t>{0, 1, 0, 255, 1, 0});  // 255: this path has ended
  thrust::device_vector<float> radiance(most, 8.0F);
  thrust::device_vector<int> alive(1, 5);  // the last request is not in the batch

  cudaStream_t stream{};
  cudaStreamCreate(&stream);
  auto const exec = thrust::cuda::par_nosync.on(stream);
  float* const out = radiance.data().get();
  ds::shader_table const shaders{scale{0.5F, out}, scale{0.25F, out}};
  ds::workspace scratch{exec};
  scratch.reserve(most, shaders.size());  // nothing allocates from here on

  cudaGraph_t graph{};
  cudaGraphExec_t bounce{};
  cudaStreamBeginCapture(stream, cudaStreamCaptureModeGlobal);
  ds::shade(exec, ds::bucket_then_dispatch<>{}, ds::device_count{alive.data().get(), most},
            material.data().get(), shaders, scratch);
  cudaStreamEndCapture(stream, &graph);
  cudaGraphInstantiate(&bounce, graph, 0);
  for (int i = 0; i < 2; ++i) cudaGraphLaunch(bounce, stream);
  bool const ran = cudaStreamSynchronize(stream) == cudaSuccess;

  thrust::host_vector<float> const result = radiance;
  for (float const r : result) std::printf("%.1f ", r);  // 2.0 0.5 2.0 8.0 0.5 8.0
  std::printf("\n");
  cudaGraphExecDestroy(bounce);
  cudaGraphDestroy(graph);
  cudaStreamDestroy(stream);
  return ran && result == thrust::host_vector<float>{2, 0.5F, 2, 8, 0.5F, 8} ? 0 : 1;
}
