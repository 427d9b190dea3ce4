// The same filter as a recursion of the tracker "model": its certificate is a part of this tracker's. What is
// proved there is by the filter's structure (docs/model-proof.md, section 13), with a leak, too.
#pragma once

#include <optional>
#include <string>

#include "certificates/document/certificate.hpp"
#include "certificates/single_channel/single_channel_design.hpp"

namespace veritrack::certificates {

/// Of a certificate: its `particulars`.
struct RecursionPart {
  std::optional<Certificate> certificate;  ///< none where nothing was looked for
  std::string objection;                   ///< then why, as a sentence
};

/// What the recursion's own [require] asks, of what this design's does.
struct RecursionQuestion {
  bool largest_noise = false;
  bool radius = false;
  [[nodiscard]] bool asks() const { return largest_noise || radius; }
};

/// The design file of the recursion: the same filter and tone, at a constant frequency, started anywhere in
/// its sets. Needs the upward mode.
[[nodiscard]] std::string recursion_design_text(const SingleChannelEkfTables& tables,
                                                const RecursionQuestion& question);

/// Certifies the recursion where it can decide what is required and still open, and adds what it tells beside
/// that as claims "recursion/...". Needs the upward mode; call when every other claim is there.
void add_recursion(Certificate& certificate, const CertifyProgress& progress);

[[nodiscard]] const RecursionPart& recursion_part(const Certificate& certificate);

/// Whether something is proved of the recursion.
[[nodiscard]] bool has_recursion(const Certificate& certificate);

}  // namespace veritrack::certificates
