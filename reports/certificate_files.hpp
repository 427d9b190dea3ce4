// A certificate's folder: its documents and the figures, written together or not at all.
#pragma once

#include <filesystem>
#include <string>

#include "certificates/document/certificate.hpp"
#include "reports/page/renderings.hpp"

namespace veritrack::reports {

/// The folder of a certificate, written.
struct CertificateFiles {
  std::filesystem::path document;  ///< certificate.md
  std::string missing_figures;     ///< one line: why there are no figures; empty when nothing is missing
};

/// Writes certificate.md, published-theorems.md where the tracker has such, certificate.json, report.json,
/// figures/*.svg, if it has formal proofs certificate.v, and what of `renderings` is asked for into
/// `directory` (made when missing). Every file appears whole or not at all; without gnuplot all but the
/// figures do. No output may be `design`, the file that the certificate was made from. Throws
/// certificates::OutputError.
[[nodiscard]] CertificateFiles write_certificate_files(const certificates::Certificate& certificate,
                                                       const std::filesystem::path& directory,
                                                       const std::filesystem::path& design,
                                                       const page::Renderings& renderings = {});

}  // namespace veritrack::reports
