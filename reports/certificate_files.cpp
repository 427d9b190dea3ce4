#include "reports/certificate_files.hpp"

#include <utility>
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
      drawing.drawn_with = gnuplot_version(drawing.figures.front().svg);
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
                                         const std::filesystem::path& design,
                                         const page::Renderings& renderings, const Verify& verify) {
  CertificateFiles written{directory / "certificate.md", {}};
  page::Document document{"certificate", {}};
  document.figure_folder = "figures/";
  certificates::MarkdownOptions options;
  certificates::OutputFiles files;
  files.keep(design);
  Drawing drawing = draw(certificate, written.missing_figures);
  for (const Figure& figure : drawing.figures) {
    options.figures.push_back({document.figure_folder + figure.file, figure.title, figure.caption});
  }
  document.figures = std::move(drawing.figures);
  options.drawn_with = drawing.drawn_with;
  const std::string json = certificates::to_json(certificate);
  options.certificate_sha256 = certificates::sha256(json);
  const auto render = [&](certificates::Verification verification) {
    options.verification = std::move(verification);
    document.markdown = certificates::to_markdown(certificate, options);
    document.appendix = certificates::to_published_markdown(certificate, options);
  };
  if (verify) {
    // The verified texts are those that will be written: a line of them says that they were verified.
    render({certificates::Verification::Outcome::verified});
    TextsToVerify texts{
        json, certificate.design_text, {{"certificate.md", document.markdown}}, design.parent_path()};
    if (!document.appendix.empty()) {
      texts.documents.emplace_back("published-theorems.md", document.appendix);
    }
    written.verification = verify(texts);
  }
  if (written.verification.outcome != certificates::Verification::Outcome::verified) {
    render(written.verification);
  }
  document.how_to_check = certificates::checking_command(certificate);
  stage_document(files, directory, document, renderings);
  if (!document.appendix.empty()) {
    files.stage(directory / "published-theorems.md", document.appendix);
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
