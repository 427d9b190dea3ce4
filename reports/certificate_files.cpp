#include "reports/certificate_files.hpp"

#include <vector>

#include "certificates/document/json.hpp"
#include "certificates/document/markdown.hpp"
#include "certificates/document/output_files.hpp"
#include "certificates/document/report_json.hpp"
#include "certificates/document/sha256.hpp"
#include "reports/figures.hpp"
#include "reports/gnuplot.hpp"

namespace veritrack::reports {

namespace {

struct Drawing {
  std::vector<Figure> figures;
  std::string drawn_with;
};

/// Nothing, and the reason, without gnuplot.
Drawing draw(const certificates::Certificate& certificate, std::string& missing) {
  try {
    Drawing drawing{draw_figures(certificate), {}};
    if (!drawing.figures.empty()) {
      drawing.drawn_with = gnuplot_version();
    }
    return drawing;
  } catch (const FigureError& error) {
    missing = error.what();
    return {};
  }
}

}  // namespace

CertificateFiles write_certificate_files(const certificates::Certificate& certificate,
                                         const std::filesystem::path& directory,
                                         const std::filesystem::path& design) {
  CertificateFiles written{directory / "certificate.md", {}};
  certificates::MarkdownOptions options;
  certificates::OutputFiles files;
  files.keep(design);
  const Drawing drawing = draw(certificate, written.missing_figures);
  for (const Figure& figure : drawing.figures) {
    const std::string path = "figures/" + figure.file;
    files.stage(directory / path, figure.svg);
    options.figures.push_back({path, figure.title, figure.caption});
  }
  options.drawn_with = drawing.drawn_with;
  const std::string json = certificates::to_json(certificate);
  options.certificate_sha256 = certificates::sha256(json);
  files.stage(written.document, certificates::to_markdown(certificate, options));
  if (const std::string published = certificates::to_published_markdown(certificate, options);
      !published.empty()) {
    files.stage(directory / "published-theorems.md", published);
  }
  files.stage(directory / "certificate.json", json);
  files.stage(directory / "report.json", certificates::to_report_json(certificate));
  if (certificate.formal_proofs) {
    files.stage(directory / certificates::kFormalProofFile, certificate.formal_proofs->text);
  }
  files.commit();
  return written;
}

}  // namespace veritrack::reports
