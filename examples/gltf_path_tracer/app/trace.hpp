// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/report.hpp"

namespace path_tracer {

/// A timeline of `--trace` ends with the batch that reaches so many spans: some 15 MB of text.
inline constexpr std::size_t most_traced_spans = 100'000;

/// The timelines of all runs in the JSON of Chrome's trace events, which Perfetto reads: a process
/// for each, from time 0, with a thread for the host and, where there is a GPU, one for its stream.
std::string trace_json(options const& o, std::vector<run> const& runs);

/// Which batches the timeline of a run leaves out: a sentence, or nothing where it has all.
std::string left_out(run const& r);

}  // namespace path_tracer
