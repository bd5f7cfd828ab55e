// SPDX-License-Identifier: Apache-2.0
// No variant.
// error: variants must have at least one ids<\.\.\.>
#include "program.hpp"

#include <deferred_shade/specialized.hpp>

#ifdef RIGHT
using some = ds::variants<ds::ids<0>>;
#else
using some = ds::variants<>;
#endif
auto f() { return some::count; }
