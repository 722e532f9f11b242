#pragma once

// A progress bar with the time left, on standard error, on a terminal only.

#include <string>

#include "apps/terminal.hpp"

namespace harpoon::app {

/// The bar's text without escapes: "[######....]  60 %  12 s left  title". `share` in [0, 1];
/// no time is given before 2 % are done, when it would be a guess.
std::string progress_line(double share, double elapsed_s, const std::string& title);

/// Draws itself at most ten times a second and wipes itself out at the end of its life. Does
/// nothing where the terminal shows no progress.
class Progress {
 public:
  explicit Progress(const Terminal& terminal);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(double share, const std::string& title);

 private:
  bool enabled_;
  double start_s_;
  double drawn_s_ = -1;
};

}  // namespace harpoon::app
