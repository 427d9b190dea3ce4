// A certificate's folder: its documents and the figures, written together or not at all.
#pragma once

#include <filesystem>

#include "certificates/document/certificate.hpp"

namespace veritrack::reports {

/// Writes certificate.md, certificate.json, figures/*.svg and, if it has formal proofs, certificate.v into
/// `directory` (made when missing) and returns the path of certificate.md. Every file appears whole or not at
/// all. Throws certificates::OutputError, FigureError.
std::filesystem::path write_certificate_files(const certificates::Certificate& certificate,
                                              const std::filesystem::path& directory);

}  // namespace veritrack::reports
