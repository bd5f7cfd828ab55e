// SPDX-License-Identifier: Apache-2.0
// A batch is captured into a CUDA graph once, and replayed with other ids and other counts.
#include <cuda_runtime_api.h>
#include <vector>

#include "catch.hpp"
#include "support/device_batch.hpp"
#include "support/every_schedule.hpp"

namespace ds = deferred_shade;

namespace {

using test::check_cuda;

/// What `submit` puts on a stream, as a graph.
class graph {
 public:
  template <class Function>
  graph(cudaStream_t stream, Function const& submit) {
    // Global: no thread of the program may do what a graph cannot hold, allocate or wait for
    // example.
    check_cuda(cudaStreamBeginCapture(stream, cudaStreamCaptureModeGlobal));
    try {
      submit();
    } catch (...) {
      cudaStreamEndCapture(stream, &graph_);
      release();
      throw;
    }
    check_cuda(cudaStreamEndCapture(stream, &graph_));
    check_cuda(cudaGraphInstantiate(&executable_, graph_, 0));
  }
  graph(graph const&) = delete;
  graph& operator=(graph const&) = delete;
  ~graph() { release(); }

  void launch(cudaStream_t stream) const { check_cuda(cudaGraphLaunch(executable_, stream)); }

  std::vector<cudaGraphNodeType> node_types() const {
    std::size_t count = 0;
    check_cuda(cudaGraphGetNodes(graph_, nullptr, &count));
    std::vector<cudaGraphNode_t> nodes(count);
    check_cuda(cudaGraphGetNodes(graph_, nodes.data(), &count));
    std::vector<cudaGraphNodeType> types(count);
    for (std::size_t i = 0; i < count; ++i) check_cuda(cudaGraphNodeGetType(nodes[i], &types[i]));
    return types;
  }

 private:
  void release() {
    if (executable_ != nullptr) cudaGraphExecDestroy(executable_);
    if (graph_ != nullptr) cudaGraphDestroy(graph_);
  }

  cudaGraph_t graph_ = nullptr;
  cudaGraphExec_t executable_ = nullptr;
};

constexpr test::layout replayed[] = {test::layout::random, test::layout::coherent,
                                     test::layout::descending};

std::uint32_t batch_size() { return test::quick() ? 8193 : 100003; }

}  // namespace

TEST_CASE("a captured batch reads its ids when it is replayed", "[cuda]") {
  std::uint32_t const n = batch_size();
  test::for_each_schedule([n](auto schedule) {
    test::stream stream;
    auto const exec = thrust::cuda::par_nosync.on(stream);
    test::device_batch batch(n);
    ds::workspace scratch{exec};
    scratch.reserve(n, test::device_batch::shaders);
    graph const captured(
        stream, [&] { ds::shade(exec, schedule, n, batch.ids(), batch.table(), scratch); });
    for (test::layout const how : replayed) {
      std::uint32_t const seed = test::run_seed() + static_cast<std::uint32_t>(how);
      CAPTURE(static_cast<int>(how), seed);
      batch.send(test::make_ids<std::uint8_t>(how, n, test::device_batch::shaders, seed), stream);
      captured.launch(stream);
      batch.fetch(stream);
      stream.wait();
      CHECK(batch.first_wrong() == n);
    }
  });
}

TEST_CASE("a captured batch reads its count when it is replayed", "[cuda]") {
  std::uint32_t const n = batch_size();
  test::for_each_schedule([n](auto schedule) {
    test::stream stream;
    auto const exec = thrust::cuda::par_nosync.on(stream);
    test::device_batch batch(n);
    thrust::device_vector<std::uint32_t> count(1);
    ds::workspace scratch{exec};
    scratch.reserve(n, test::device_batch::shaders);
    graph const captured(stream, [&] {
      ds::shade(exec, schedule, ds::device_count{thrust::raw_pointer_cast(count.data()), n},
                batch.ids(), batch.table(), scratch);
    });
    for (std::uint32_t const present : {n / 3, n, 0U, n - 1}) {
      std::uint32_t const seed = test::run_seed() + present;
      CAPTURE(present, seed);
      count[0] = present;
      test::cuda::wait();
      batch.send(
          test::make_ids<std::uint8_t>(test::layout::random, n, test::device_batch::shaders, seed),
          stream);
      captured.launch(stream);
      batch.fetch(stream);
      stream.wait();
      CHECK(batch.first_wrong(present) == n);
    }
  });
}

TEST_CASE("a captured batch is work for the GPU alone, and allocates nothing", "[cuda]") {
  std::uint32_t const n = batch_size();
  test::for_each_schedule([n](auto schedule) {
    test::stream stream;
    auto const exec = thrust::cuda::par_nosync.on(stream);
    test::device_batch batch(n);
    ds::workspace scratch{exec};
    scratch.reserve(n, test::device_batch::shaders);
    std::size_t const reserved = scratch.capacity();
    graph const captured(
        stream, [&] { ds::shade(exec, schedule, n, batch.ids(), batch.table(), scratch); });
    CHECK(scratch.capacity() == reserved);
    auto const types = captured.node_types();
    CHECK(!types.empty());
    for (cudaGraphNodeType const type : types) {
      bool const on_gpu = type == cudaGraphNodeTypeKernel || type == cudaGraphNodeTypeMemset ||
                          type == cudaGraphNodeTypeMemcpy;
      CAPTURE(static_cast<int>(type));
      CHECK(on_gpu);
    }
  });
}
