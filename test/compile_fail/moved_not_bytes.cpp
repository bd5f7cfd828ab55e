// SPDX-License-Identifier: Apache-2.0
// An array of strings, whose bytes alone are no copy.
// errors: 1
// error: elements of a moved array must be trivially copyable; specialise
#include <deferred_shade/gather.hpp>
#include <string>

#include "program.hpp"

#ifdef RIGHT
using element = int;
#else
using element = std::string;
#endif

void f(element const* from, element* to, ds::request_order order) {
  ds::gather(thrust::cpp::par, order, ds::moved{from, to});
}
