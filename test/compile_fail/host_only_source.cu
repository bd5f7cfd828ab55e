// SPDX-License-Identifier: Apache-2.0
// A source for the host alone is refused by every schedule.
// error: calling a __host__ function\(
// errors: 99
// by every schedule: host_only<SCHEDULE>
#include "cuda.hpp"

#ifdef RIGHT
#define ON_DEVICE __host__ __device__
#else
#define ON_DEVICE
#endif
template <class Schedule>
struct host_only {
  hit const* hits;
  ON_DEVICE hit operator()(ds::request_index i) const { return hits[i]; }
};
void f(std::uint8_t* ids, hit const* hits, color* out, device_workspace& scratch) {
  ds::for_each_schedule([&](char const*, auto const& schedule) {
    using type = std::decay_t<decltype(schedule)>;
    ds::shade(thrust::cuda::par, schedule, 5, ids,
              ds::record_shaders(host_only<type>{hits}, out, matte{}, matte{}), scratch);
  });
}
