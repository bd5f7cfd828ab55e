// SPDX-License-Identifier: Apache-2.0
// A function of records for the host alone is refused by every schedule.
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
  ON_DEVICE color operator()(hit const& h) const { return {h.a}; }
};
void f(std::uint8_t* ids, hit const* hits, color* out, device_workspace& scratch) {
  ds::for_each_schedule([&](char const*, auto const& schedule) {
    using type = std::decay_t<decltype(schedule)>;
    ds::shade(thrust::cuda::par, schedule, 5, ids,
              ds::record_shaders(hits, out, host_only<type>{}, matte{}), scratch);
  });
}
