// certificate.md and published-theorems.md: the certificate for people, and the statements of papers about
// its design.
#pragma once

#include <string>
#include <vector>

#include "certificates/document/certificate.hpp"
#include "certificates/document/verification.hpp"

namespace veritrack::certificates {

/// A figure next to the document, drawn elsewhere (reports/ draws, certificates/ only refers to
/// it).
struct FigureReference {
  std::string path;     ///< relative to the document, e.g. "figures/error.svg"
  std::string title;    ///< what it shows, in a few words
  std::string caption;  ///< the content, with units
};

struct MarkdownOptions {
  std::vector<FigureReference> figures;
  std::string certificate_sha256;  ///< of certificate.json beside the document
  std::string
      drawn_with;  ///< name and version of the program that drew the figures; empty when there are none
  Verification verification = {};  ///< of the certificate and this document
};

/// The whole document. Same certificate and options, same bytes: no times, hosts or paths.
[[nodiscard]] std::string to_markdown(const Certificate& certificate, const MarkdownOptions& options);

/// published-theorems.md, the sentences on publications among it; empty when the kind of tracker has none.
[[nodiscard]] std::string to_published_markdown(const Certificate& certificate,
                                                const MarkdownOptions& options);

/// The figure in a document: the picture, and its caption below.
[[nodiscard]] std::string picture(const FigureReference& figure);

/// The document's first line, without mark-up: the requirement, and the verdict on it. For a certificate that
/// the checker refuses it says so first.
[[nodiscard]] std::string headline(const Certificate& certificate, const Verification& verification = {});

/// The command with which the checker verifies the certificate, with the design file and the documents.
[[nodiscard]] std::string checking_command(const Certificate& certificate);

}  // namespace veritrack::certificates
