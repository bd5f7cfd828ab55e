// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace path_tracer {

/// Writes all of `bytes` to a file, or leaves what stood there before: they go to a temporary file
/// in the same folder, which takes the name when everything has reached the disk. A symbolic link
/// is followed; a device or a pipe is written to directly. Throws std::runtime_error with the path
/// and the reason of the system.
void write_file(std::string const& path, std::string_view bytes);

/// Throws as `write_file` would, for what can be known before there is anything to write.
void check_writable(std::string const& path);

}  // namespace path_tracer
