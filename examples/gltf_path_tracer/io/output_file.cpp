// SPDX-License-Identifier: Apache-2.0
#include "io/output_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace path_tracer {
namespace {

namespace fs = std::filesystem;

/// A file being written under a temporary name. Without `commit`, it is removed.
class output_file {
 public:
  explicit output_file(std::string const& path) : path_(path), target_(path) {
    std::error_code error;
    fs::file_status const status = fs::status(path, error);
    if (fs::is_directory(status)) fail(EISDIR);
    if (fs::exists(status) && ::access(path.c_str(), W_OK) != 0) fail(errno);
    if (fs::exists(status) && !fs::is_regular_file(status)) {
      descriptor_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
      if (descriptor_ < 0) fail(errno);
      return;
    }
    if (fs::is_symlink(fs::symlink_status(path, error)) && fs::exists(status))
      target_ = fs::canonical(path, error);
    if (error && fs::exists(status)) fail(error.value());
    fs::path const name = "." + target_.filename().string() + "." + std::to_string(::getpid());
    fs::path const temporary = target_.parent_path() / name;
    descriptor_ = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail(errno);
    temporary_ = temporary;
  }
  output_file(output_file const&) = delete;
  output_file& operator=(output_file const&) = delete;

  ~output_file() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
  }

  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      ssize_t const written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail(errno);
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  void commit() {
    if (!temporary_.empty() && ::fsync(descriptor_) != 0) fail(errno);
    int const descriptor = descriptor_;
    descriptor_ = -1;
    if (::close(descriptor) != 0) fail(errno);
    if (temporary_.empty()) return;
    if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
    temporary_.clear();
  }

 private:
  [[noreturn]] void fail(int error) const {
    throw std::runtime_error("cannot write " + path_ + ": " +
                             std::generic_category().message(error));
  }

  std::string path_;
  fs::path target_, temporary_;
  int descriptor_ = -1;
};

}  // namespace

void write_file(std::string const& path, std::string_view bytes) {
  output_file file(path);
  file.write(bytes);
  file.commit();
}

void check_writable(std::string const& path) { output_file const file(path); }

}  // namespace path_tracer
