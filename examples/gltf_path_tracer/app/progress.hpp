// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <string>
#include <utility>

namespace path_tracer {

/// Seconds as a reader wants them: `42 s`, `3 min 05 s`, `2 h 10 min`.
inline std::string duration(double seconds) {
  char text[64];
  auto const s = static_cast<unsigned long>(seconds < 0 ? 0 : seconds > 1e9 ? 1e9 : seconds + 0.5);
  if (s < 60)
    std::snprintf(text, sizeof(text), "%lu s", s);
  else if (s < 3600)
    std::snprintf(text, sizeof(text), "%lu min %02lu s", s / 60, s % 60);
  else
    std::snprintf(text, sizeof(text), "%lu h %02lu min", s / 3600, s / 60 % 60);
  return text;
}

/// Shows how far a task is: on a terminal a bar that rewrites itself, elsewhere a line every 10 %.
class progress {
 public:
  progress(std::string label, std::FILE* out) : progress(std::move(label), out, is_terminal(out)) {}
  progress(std::string label, std::FILE* out, bool terminal)
      : label_(std::move(label)), out_(out), terminal_(terminal) {}
  progress(progress const&) = delete;
  progress& operator=(progress const&) = delete;

  /// Leaves the cursor on a fresh line.
  ~progress() {
    if (terminal_ && shown_ >= 0) std::fputc('\n', out_);
  }

  /// Called as often as one likes with the fraction done, from 0 to 1.
  void operator()(double fraction) {
    int const percent = static_cast<int>(100 * (fraction < 0 ? 0 : fraction > 1 ? 1 : fraction));
    int const step = terminal_ ? percent : percent / 10 * 10;
    if (step <= shown_) return;
    shown_ = step;
    std::chrono::duration<double> const passed = clock::now() - start_;
    std::string const rest = step >= 100 ? duration(passed.count())
                             : fraction > 0
                                 ? duration(passed.count() * (1 - fraction) / fraction) + " left"
                                 : "";
    if (terminal_) {
      auto const filled = static_cast<std::size_t>(percent) * width / 100;
      std::string const bar = std::string(filled, '#') + std::string(width - filled, '.');
      std::fprintf(out_, "\r%s [%s] %3d %%  %-16s", label_.c_str(), bar.c_str(), percent,
                   rest.c_str());
    } else {
      std::fprintf(out_, "%s %3d %%%s%s\n", label_.c_str(), step, rest.empty() ? "" : "  ",
                   rest.c_str());
    }
    std::fflush(out_);
  }

 private:
  using clock = std::chrono::steady_clock;
  static constexpr std::size_t width = 30;
  static bool is_terminal(std::FILE* file) { return ::isatty(::fileno(file)) == 1; }

  std::string label_;
  std::FILE* out_;
  bool terminal_;
  int shown_ = -1;
  clock::time_point start_ = clock::now();
};

}  // namespace path_tracer
