// Optional files beside a Markdown document: a page, tables for a paper, data of figures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "certificates/document/output_files.hpp"
#include "reports/figures.hpp"

namespace veritrack::reports::page {

/// The requested files.
struct Renderings {
  bool html = false;   ///< one page with everything in it
  bool csv = false;    ///< the data of each figure, beside it
  bool latex = false;  ///< the tables
};

/// A document and its figures.
struct Document {
  std::string stem;  ///< "certificate": of certificate.md, certificate.html and certificate-tables.tex
  std::string markdown;
  std::string appendix = {};       ///< published-theorems.md, for the page
  std::string figure_folder = {};  ///< in which the figures are, e.g. "figures/"; empty: beside the document
  std::vector<Figure> figures = {};
  std::string how_to_check =
      {};  ///< the checker's command; empty when it has nothing to do with the document
};

/// Stages the document, its figures, and the requested files: <stem>.html, <stem>-tables.tex, and beside each
/// figure <figure>.csv, <figure>-<table>.csv for further tables of a figure. Throws
/// certificates::OutputError.
void stage_document(certificates::OutputFiles& files, const std::filesystem::path& directory,
                    const Document& document, const Renderings& renderings);

}  // namespace veritrack::reports::page
