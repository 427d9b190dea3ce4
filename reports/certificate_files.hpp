// A certificate's folder: its documents and the figures, written together or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "certificates/document/certificate.hpp"
#include "certificates/document/verification.hpp"
#include "reports/page/renderings.hpp"

namespace veritrack::reports {

/// The folder of a certificate, written.
struct CertificateFiles {
  std::filesystem::path document;  ///< certificate.md
  std::string missing_figures;     ///< one line: why there are no figures; empty when nothing is missing
  certificates::Verification verification = {};
};

/// The files that the checker reads, before they are written to a folder.
struct TextsToVerify {
  std::string certificate;                                          ///< certificate.json
  std::string design;                                               ///< the design file
  std::vector<std::pair<std::string, std::string>> documents = {};  ///< names and texts, in Markdown
  std::filesystem::path folder = {};  ///< of the design file, where the files of its code are
};

/// Asks the checker.
using Verify = std::function<certificates::Verification(const TextsToVerify&)>;

/// Writes certificate.md, published-theorems.md where the tracker has such, certificate.json, report.json,
/// figures/*.svg, if it has formal proofs certificate.v, and what of `renderings` is asked for into
/// `directory` (made when missing). Every file appears whole or not at all; without gnuplot all but the
/// figures do. No output may be `design`, the file that the certificate was made from. The documents say what
/// `verify` says of certificate.json, the design and the documents as they will be if all is verified;
/// without it, that nobody was asked. Throws certificates::OutputError, and what `verify` throws.
[[nodiscard]] CertificateFiles write_certificate_files(const certificates::Certificate& certificate,
                                                       const std::filesystem::path& directory,
                                                       const std::filesystem::path& design,
                                                       const page::Renderings& renderings = {},
                                                       const Verify& verify = {});

}  // namespace veritrack::reports
