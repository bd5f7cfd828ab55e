// SPDX-License-Identifier: Apache-2.0
// What a shader says of its own launch, and what may be a shader or an iterator of ids.
// Covers detail/cuda/launch.hpp, detail/cuda/occupancy.hpp and detail/cuda/call.hpp.
#include <thrust/iterator/constant_iterator.h>
#include <thrust/iterator/transform_iterator.h>
#include <cstdint>
#include <string>
#include <vector>

#include "catch.hpp"
#include "support/device_batch.hpp"
#include "support/every_schedule.hpp"

namespace ds = deferred_shade;

namespace {

using gpu = test::cuda;

/// Notes how many threads the block has that runs the request.
DEFERRED_SHADE_HOST_DEVICE void note_block(unsigned* threads, ds::request_index i) {
#ifdef __CUDA_ARCH__
  threads[i] = blockDim.x;
#else
  threads[i] = 1;
#endif
}

template <int Size>
struct sized_shader {
  static constexpr int block_size = Size;
  unsigned* threads;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i) const { note_block(threads, i); }
};

struct plain_shader {
  unsigned* threads;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i) const { note_block(threads, i); }
};

/// Notes that any of its requests ran.
template <int Size>
struct mark_shader {
  static constexpr int block_size = Size;
  unsigned* ran;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i) const {
    if (i == 0) *ran = 1;
  }
};

/// A record shader's function may say it as well.
struct sized_function {
  static constexpr int block_size = 192;
  DEFERRED_SHADE_HOST_DEVICE unsigned operator()(std::uint8_t const&) const {
#ifdef __CUDA_ARCH__
    return blockDim.x;
#else
    return 1;
#endif
  }
};

std::vector<std::uint8_t> random_ids(std::uint32_t n, std::uint32_t shaders) {
  return test::make_ids<std::uint8_t>(test::layout::random, n, shaders, test::run_seed());
}

template <class Schedule>
void check_block_sizes(Schedule const& schedule) {
  std::uint32_t const n = 20011;
  CAPTURE(test::run_seed());
  auto const exec = gpu::policy();
  auto const ids = test::on<gpu>(random_ids(n, 5));
  auto threads = test::on<gpu>(std::vector<unsigned>(n, 0));
  unsigned* const out = threads.data();
  ds::workspace scratch{exec};
  ds::shade(
      exec, schedule, n, ids.data(),
      ds::shader_table{
          sized_shader<64>{out}, sized_shader<96>{out}, plain_shader{out}, sized_shader<1024>{out},
          ds::record_shader<std::uint8_t const*, sized_function, unsigned*>{ids.data(), {}, out}},
      scratch);
  gpu::wait();
  unsigned const declared[] = {64, 96, 0, 1024, 192};
  unsigned chosen = 0;  // by the library, the same for all blocks of the plain shader
  for (std::uint32_t i = 0; i < n; ++i) {
    if (ids[i] == 2 && chosen == 0) chosen = threads[i];
    unsigned const expected = ids[i] > 4 ? 0 : ids[i] == 2 ? chosen : declared[ids[i]];
    REQUIRE(threads[i] == expected);
  }
  CHECK(chosen % 32 == 0);
  CHECK(chosen >= 32);
  CHECK(chosen <= 1024);
}

}  // namespace

TEST_CASE("a shader is launched in blocks of the size that it declares", "[cuda]") {
  check_block_sizes(ds::explicit_serialization{});
  check_block_sizes(ds::bucket_then_dispatch<>{});
  check_block_sizes(ds::sort_then_dispatch<>{});
  check_block_sizes(ds::compact_then_dispatch<>{});
}

TEST_CASE("a lambda for host and device is a shader", "[cuda]") {
  std::uint32_t const n = 20011;
  std::uint32_t const seed = test::run_seed();
  CAPTURE(seed);
  auto const exec = gpu::policy();
  auto const ids = test::on<gpu>(random_ids(n, 3));
  auto results = test::on<gpu>(std::vector<float>(n, -1));
  float* const out = results.data();
  float const scale = 3;
  auto const twice = [out] __host__ __device__(ds::request_index i) {
    out[i] += 2 * static_cast<float>(i);
  };
  auto const scaled = [out, scale] __host__ __device__(ds::request_index i) {
    out[i] += scale * static_cast<float>(i);
  };
  std::vector<float> expected(n, -1);
  ds::workspace scratch{exec};
  test::for_each_schedule([&](auto schedule) {
    ds::shade(exec, schedule, n, ids.data(), ds::shader_table{twice, scaled, twice}, scratch);
    for (std::uint32_t i = 0; i < n; ++i) {
      if (ids[i] < 3) expected[i] += (ids[i] == 1 ? 3 : 2) * static_cast<float>(i);
    }
    gpu::wait();
    CHECK(test::first_difference(results, expected) == n);
  });
}

TEST_CASE("a lambda for host and device makes ids of hit records", "[cuda]") {
  std::uint32_t const n = 20011;
  std::uint32_t const seed = test::run_seed();
  CAPTURE(seed);
  auto const materials = random_ids(n, 5);
  auto hits = test::on<gpu>(std::vector<test::hit_record>(n));
  for (std::uint32_t i = 0; i < n; ++i) hits[i] = {i % 7 == 0 ? 0.0F : 1.0F, materials[i]};
  // A ray that hit nothing has no material, whatever its record says.
  auto const id_of = [] __host__ __device__(test::hit_record const& h) -> std::int32_t {
    return h.distance > 0 ? h.material : -1;
  };
  auto const ids =
      thrust::make_transform_iterator(static_cast<test::hit_record const*>(hits.data()), id_of);
  ds::workspace scratch{gpu::policy()};
  test::for_each_schedule(
      [&](auto schedule) { test::check_against_loop<gpu, 5>(schedule, n, ids, scratch); });
}

// [api_error]: a call of the CUDA runtime fails on purpose, which a tool that watches it reports.
TEST_CASE("an error that the renderer left behind does not disturb a batch", "[cuda][api_error]") {
  std::uint32_t const n = 20011;
  CAPTURE(test::run_seed());
  auto const ids = test::on<gpu>(random_ids(n, 40));
  ds::workspace scratch{gpu::policy()};
  auto const leave_error = [] {
    cudaGetLastError();
    CHECK(cudaSetDevice(-1) == cudaErrorInvalidDevice);
  };
  test::for_each_schedule([&](auto schedule) {
    leave_error();
    test::check_against_loop<gpu, 40>(schedule, n, ids.data(), scratch);
    cudaGetLastError();
  });
  // It stays for the renderer to find, where the library calls no CUB.
  test::trace<gpu> actual(n);
  leave_error();
  ds::shade(gpu::policy(), ds::implicit_serialization{}, n, ids.data(),
            test::tracing_table<40>(actual.value.data(), actual.runs.data()), scratch);
  CHECK(cudaGetLastError() == cudaErrorInvalidDevice);
  gpu::wait();
}

TEST_CASE("shaders of a large table run on a GPU", "[cuda]") {
  std::uint32_t const n = 100003;
  CAPTURE(test::run_seed());
  auto const bytes = test::on<gpu>(random_ids(n, 200));
  ds::workspace scratch{gpu::policy()};
  test::check_against_loop<gpu, 200>(ds::implicit_serialization{}, n, bytes.data(), scratch);
  test::check_against_loop<gpu, 200>(ds::bucket_then_dispatch<>{}, n, bytes.data(), scratch);
  test::check_against_loop<gpu, 200>(ds::local_sort_then_dispatch<>{}, n, bytes.data(), scratch);

  auto const words =
      test::on<gpu>(test::make_ids<std::uint16_t>(test::layout::random, n, 300, test::run_seed()));
  test::check_against_loop<gpu, 300>(ds::sort_then_dispatch<ds::implicit_serialization>{}, n,
                                     words.data(), scratch);
  test::check_against_loop<gpu, 300>(ds::local_sort_then_dispatch<>{}, n, words.data(), scratch);
}

// [api_error]: see memory.cpp.
TEST_CASE("a launch that does not fit a grid is refused before any shader runs",
          "[cuda][api_error]") {
  auto ran = test::on<gpu>(std::vector<unsigned>(1, 0));
  unsigned* const out = ran.data();
  ds::workspace scratch{gpu::policy()};
  // All requests name shader 0, which fits. Shader 1 has a block for each request.
  std::uint32_t const n = 3000000000U;
  ds::shader_table const shaders{mark_shader<256>{out}, mark_shader<1>{out}};
  std::string message;
  try {
    ds::shade(gpu::policy(), ds::explicit_serialization{}, n,
              thrust::constant_iterator<std::uint8_t>(0), shaders, scratch);
  } catch (ds::cuda_error const& error) {
    message = error.what();
    CHECK(error.code() == cudaErrorInvalidConfiguration);
  }
  gpu::wait();
  CAPTURE(message);
  CHECK(message.find("3000000000 blocks") != std::string::npos);
  CHECK(message.find("block_size") != std::string::npos);
  CHECK(ran[0] == 0);
  CHECK(cudaGetLastError() == cudaSuccess);
}
