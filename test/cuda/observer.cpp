// SPDX-License-Identifier: Apache-2.0
// An observer of batches on a GPU, which puts events around the work of each phase.
#include <deferred_shade/observer.hpp>

#include <cuda_runtime_api.h>
#include <string>
#include <vector>

#include "catch.hpp"
#include "support/device_batch.hpp"
#include "support/every_schedule.hpp"

namespace ds = deferred_shade;

namespace {

using test::check_cuda;

/// Notes phases and puts an event on the stream where each begins and ends.
struct recorder {
  cudaStream_t stream;
  cudaEvent_t event = nullptr;
  std::string text;

  explicit recorder(cudaStream_t s) : stream(s) { check_cuda(cudaEventCreate(&event)); }
  recorder(recorder const&) = delete;
  ~recorder() { cudaEventDestroy(event); }

  struct entry {
    recorder* book;
    explicit entry(recorder* r) : book(r) {
      check_cuda(cudaEventRecord(book->event, book->stream));
    }
    entry(entry const&) = delete;
    ~entry() {
      book->text += '}';
      cudaEventRecord(book->event, book->stream);
    }
  };
  auto observer() {
    return [this](ds::phase const& p) {
      text += p.name + (p.shader ? ' ' + std::to_string(*p.shader) : "") + '{';
      return entry(this);
    };
  }
};

constexpr std::uint32_t batch_size = 20011;

std::vector<std::uint8_t> some_ids() {
  return test::make_ids<std::uint8_t>(test::layout::random, batch_size, test::device_batch::shaders,
                                      test::run_seed());
}

template <class Schedule>
std::string told(Schedule const& schedule) {
  test::stream stream;
  auto const exec = thrust::cuda::par_nosync.on(stream);
  test::device_batch batch(batch_size);
  ds::workspace scratch{exec};
  recorder book(stream);
  ds::observed seen{scratch, book.observer()};
  batch.send(some_ids(), stream);
  ds::shade(exec, schedule, batch_size, batch.ids(), batch.table(), seen);
  batch.fetch(stream);
  stream.wait();
  CHECK(batch.first_wrong() == batch_size);
  return book.text;
}

}  // namespace

TEST_CASE("an observer is told what is submitted to a GPU", "[cuda]") {
  using implicit = ds::implicit_serialization;
  std::string const shaders = "dispatch{shader 0{}shader 1{}shader 2{}shader 3{}shader 4{}}";
  CHECK(told(implicit{}) == "dispatch{}");
  CHECK(told(ds::explicit_serialization{}) == shaders);
  CHECK(told(ds::compact_then_dispatch<>{}) == "group{}" + shaders);
  CHECK(told(ds::sort_then_dispatch<>{}) == "group{}" + shaders);
  CHECK(told(ds::bucket_then_dispatch<>{}) == "group{}" + shaders);
  CHECK(told(ds::bucket_then_dispatch<implicit>{}) == "group{}dispatch{}");
  CHECK(told(ds::local_sort_then_dispatch<>{}) == "dispatch{}");
  CHECK(told(ds::local_sort_then_dispatch<ds::bitonic>{}) == "dispatch{}");
  CHECK(told(ds::window_sort_then_dispatch{}) == "group{}dispatch{}");
}

TEST_CASE("an observer is told the ids of the renderer's table, whatever it has left out",
          "[cuda]") {
  test::stream stream;
  auto const exec = thrust::cuda::par_nosync.on(stream);
  test::device_batch batch(batch_size);
  ds::workspace scratch{exec};
  recorder book(stream);
  ds::observed seen{scratch, book.observer()};
  batch.send(some_ids(), stream);
  ds::shade(exec, ds::bucket_then_dispatch<>{}, batch_size, batch.ids(), batch.table().only<1, 3>(),
            seen);
  stream.wait();
  CHECK(book.text == "group{}dispatch{shader 1{}shader 3{}}");
}

TEST_CASE("an observed batch can be captured", "[cuda]") {
  test::for_each_schedule([](auto const& schedule) {
    test::stream stream;
    auto const exec = thrust::cuda::par_nosync.on(stream);
    test::device_batch batch(batch_size);
    ds::workspace scratch{exec};
    scratch.reserve(batch_size, test::device_batch::shaders);
    recorder book(stream);
    ds::observed seen{scratch, book.observer()};
    cudaGraph_t graph{};
    cudaGraphExec_t executable{};
    check_cuda(cudaStreamBeginCapture(stream, cudaStreamCaptureModeGlobal));
    ds::shade(exec, schedule, batch_size, batch.ids(), batch.table(), seen);
    check_cuda(cudaStreamEndCapture(stream, &graph));
    check_cuda(cudaGraphInstantiate(&executable, graph, 0));
    batch.send(some_ids(), stream);
    check_cuda(cudaGraphLaunch(executable, stream));
    batch.fetch(stream);
    stream.wait();
    CHECK(batch.first_wrong() == batch_size);
    cudaGraphExecDestroy(executable);
    cudaGraphDestroy(graph);
  });
}
