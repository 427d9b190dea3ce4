#include "reports/certificate_files.hpp"

#include "certificates/document/json.hpp"
#include "certificates/document/markdown.hpp"
#include "certificates/document/output_files.hpp"
#include "certificates/document/report_json.hpp"
#include "certificates/document/sha256.hpp"
#include "reports/figures.hpp"
#include "reports/gnuplot.hpp"

namespace veritrack::reports {

std::filesystem::path write_certificate_files(const certificates::Certificate& certificate,
                                              const std::filesystem::path& directory) {
  certificates::MarkdownOptions options;
  certificates::OutputFiles files;
  for (const Figure& figure : draw_figures(certificate)) {
    const std::string path = "figures/" + figure.file;
    files.stage(directory / path, figure.svg);
    options.figures.push_back({path, figure.caption});
  }
  if (!options.figures.empty()) {
    options.drawn_with = gnuplot_version();
  }
  std::filesystem::path document = directory / "certificate.md";
  const std::string json = certificates::to_json(certificate);
  options.certificate_sha256 = certificates::sha256(json);
  files.stage(document, certificates::to_markdown(certificate, options));
  files.stage(directory / "certificate.json", json);
  files.stage(directory / "report.json", certificates::to_report_json(certificate));
  if (certificate.formal_proofs) {
    files.stage(directory / certificates::kFormalProofFile, certificate.formal_proofs->text);
  }
  files.commit();
  return document;
}

}  // namespace veritrack::reports
