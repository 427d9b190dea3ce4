// The same filter as a recursion of the tracker "model": its certificate is a part of this tracker's. Its
// proofs use the filter's structure (docs/model-proof.md, section 13), also with a leak.
#pragma once

#include <optional>
#include <string>

#include "certificates/document/certificate.hpp"
#include "certificates/single_channel/single_channel_design.hpp"

namespace veritrack::certificates {

/// The `particulars` of a certificate.
struct RecursionPart {
  std::optional<Certificate> certificate;  ///< empty where nothing was searched for
  std::string objection;                   ///< then the reason, as a sentence
  /// In the long run, rad/sample, at the worst of some frequencies of the band; empty where no bound is
  /// proved.
  std::optional<double> first_order_error;
  bool can_be_asked = false;  ///< there is none, and a requirement would have it searched for
};

/// The requirements of this design that the recursion's own [require] repeats.
struct RecursionQuestion {
  bool largest_noise = false;
  bool radius = false;
  [[nodiscard]] bool asks() const { return largest_noise || radius; }
};

/// The design file of the recursion: the same filter and tone, at a constant frequency, started anywhere in
/// its sets. Needs the upward mode.
[[nodiscard]] std::string recursion_design_text(const SingleChannelEkfTables& tables,
                                                const RecursionQuestion& question);

/// Certifies the recursion where it can decide a requirement that is still open, and adds its further
/// statements as claims "recursion/...". Needs the upward mode; call when every other claim is there.
void add_recursion(Certificate& certificate, const CertifyProgress& progress);

/// The bound on the frequency error in the long run that the windows prove; empty where they prove none.
[[nodiscard]] std::optional<rigor::Interval> proved_long_run(const Certificate& certificate);

[[nodiscard]] const RecursionPart& recursion_part(const Certificate& certificate);

/// Whether something is proved about the recursion.
[[nodiscard]] bool has_recursion(const Certificate& certificate);

}  // namespace veritrack::certificates
