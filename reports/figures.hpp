// The figures of a certificate, as SVG. They are drawn to be read in grey: lines differ by dash and weight.
#pragma once

#include <string>
#include <vector>

#include "certificates/document/certificate.hpp"

namespace veritrack::reports {

struct Figure {
  std::string file;     ///< name of the file, e.g. "error.svg"
  std::string caption;  ///< what is seen, with units
  std::string svg;
};

/// The tracker's frequency beside the true one, and the error beside the bounds that were certified or
/// claimed, along the certificate's simulated run. None when there was no run. Throws FigureError.
[[nodiscard]] std::vector<Figure> draw_figures(const certificates::Certificate& certificate);

}  // namespace veritrack::reports
