#include "certificates/document/certificate.hpp"

#include <algorithm>

#include "analysis/rigor/rounding.hpp"
#include "certificates/design/design_reader.hpp"
#include "certificates/document/tracker_kind.hpp"

namespace veritrack::certificates {

std::vector<theorems::Derivation> derivations_of(const Certificate& certificate, std::string_view prefix) {
  std::vector<theorems::Derivation> found;
  for (const theorems::Derivation& derivation : certificate.derivations) {
    if (derivation.id.starts_with(prefix)) {
      found.push_back(derivation);
    }
  }
  return found;
}

const theorems::Derivation* find_derivation(const Certificate& certificate, std::string_view id) {
  const auto found = std::find_if(certificate.derivations.begin(), certificate.derivations.end(),
                                  [&](const theorems::Derivation& each) { return each.id == id; });
  return found == certificate.derivations.end() ? nullptr : &*found;
}

std::string verdict_text(const Certificate& certificate) {
  return certificate.verdict ? std::string(rigor::to_string(*certificate.verdict)) : "nothing-required";
}

Certificate certify(const Design& design, const std::string& design_file, const std::string& design_text,
                    const CertifyProgress& progress, Extent extent, const search::Deadline& deadline) {
  const rigor::UpwardRounding upward;
  Certificate certificate;
  certificate.design = design;
  certificate.extent = extent;
  certificate.deadline = deadline;
  certificate.design_file = design_file;
  certificate.design_text = design_text;
  kind_of(design).certify(certificate, progress);
  return certificate;
}

Certificate certify_file(const std::filesystem::path& path, const CertifyProgress& progress, Extent extent,
                         const search::Deadline& deadline) {
  const std::string text = read_design_text(path);
  return certify(read_design(text, path.string()), path.filename().string(), text, progress, extent,
                 deadline);
}

}  // namespace veritrack::certificates
