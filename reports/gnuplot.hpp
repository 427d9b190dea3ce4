// Runs gnuplot: scripts in, SVG pictures out.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace veritrack::reports {

/// Thrown when gnuplot is not installed, fails, or draws nothing. what() is one line.
class FigureError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The standard output of gnuplot when it executes `script`. The script chooses the terminal. Throws
/// FigureError.
[[nodiscard]] std::string run_gnuplot(const std::string& script);

/// A picture to be drawn, and its name for the message when that fails.
struct GnuplotScript {
  std::string name;
  std::string text;  ///< sets the terminal svg
};

/// The pictures of the scripts, drawn by one gnuplot, since its start takes longer than a picture: the same
/// bytes as by one for each. Throws FigureError, which names the script that failed.
[[nodiscard]] std::vector<std::string> draw_pictures(const std::vector<GnuplotScript>& scripts);

/// How every figure begins: an SVG 820 pixels wide and `height` high in the house style (grey axes without
/// mirror, a key below), before labels and data.
[[nodiscard]] std::string gnuplot_style(std::size_t height);

/// "gnuplot 5.4 patchlevel 4", or the like: the program that drew the picture, by its own words. Throws
/// FigureError when it says nothing.
[[nodiscard]] std::string gnuplot_version(std::string_view svg);

}  // namespace veritrack::reports
