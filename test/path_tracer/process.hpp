// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <string>
#include <vector>

#include "path_tracer/fixture.hpp"

extern char** environ;

namespace path_tracer_test {

struct outcome {
  int exit_code;  ///< 128 + signal for a process that a signal ended
  std::string out, err;
};

/// Runs a program to its end; the first argument is its path.
inline outcome run_program(std::vector<std::string> arguments) {
  temporary_folder const folder;
  std::string const out = folder / "out", err = folder / "err";
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), O_WRONLY | O_CREAT, 0600);
  std::vector<char*> pointers;
  for (std::string& a : arguments) pointers.push_back(a.data());
  pointers.push_back(nullptr);
  pid_t child = 0;
  int const error = posix_spawn(&child, pointers[0], &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return {-1, "", std::strerror(error)};
  int status = 0;
  waitpid(child, &status, 0);
  int const code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {code, read_bytes(out), read_bytes(err)};
}

/// The path tracer with small settings before the arguments given.
inline outcome run_path_tracer(std::vector<std::string> const& arguments) {
  std::vector<std::string> all = {PATH_TRACER_EXECUTABLE};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return run_program(all);
}

}  // namespace path_tracer_test
