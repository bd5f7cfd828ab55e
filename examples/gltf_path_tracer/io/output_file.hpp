// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace path_tracer {

/// Writes all of `bytes` to a file, or leaves the old file unchanged. The bytes go to a temporary
/// file in the same folder, which is renamed when everything has reached the disk. A symbolic link
/// is followed; a device or a pipe is written to directly. Throws std::runtime_error with the path
/// and the system's reason.
void write_file(std::string const& path, std::string_view bytes);

/// Throws the errors of `write_file` that can be known before there is anything to write.
void check_writable(std::string const& path);

}  // namespace path_tracer
