// The figures of a certificate, as SVG. They are drawn to be read in grey: lines differ by dash and weight.
#pragma once

#include <string>
#include <vector>

#include "certificates/document/certificate.hpp"
#include "reports/figure_table.hpp"

namespace veritrack::reports {

struct Figure {
  std::string file;        ///< name of the file, e.g. "error.svg"
  std::string caption;     ///< the contents, with units
  std::string script;      ///< draws it, for gnuplot (gnuplot.hpp)
  std::string title = {};  ///< its subject, in a few words: the title of the SVG, and the alternative text
  std::vector<FigureTable> data = {};  ///< the numbers in it
  std::string values = {};  ///< for a map, the values under the pointer: JSON (map_values.hpp); or none
  std::string svg = {};     ///< the picture; empty until it is drawn
};

/// The figures with their pictures, which have the figure's title in place of gnuplot's own name, drawn by
/// one gnuplot. Throws FigureError, which names the figure that it could not draw.
[[nodiscard]] std::vector<Figure> with_pictures(std::vector<Figure> figures);
[[nodiscard]] Figure with_picture(Figure figure);

/// The figures that certificates of this kind of tracker have, drawn; empty when it has none. Throws
/// FigureError.
[[nodiscard]] std::vector<Figure> draw_figures(const certificates::Certificate& certificate);

}  // namespace veritrack::reports
