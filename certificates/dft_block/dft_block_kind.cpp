// The block tracker as a kind of tracker.
#include "certificates/dft_block/dft_block.hpp"
#include "certificates/dft_block/dft_block_track.hpp"
#include "certificates/dft_block/markdown_dft_block.hpp"
#include "certificates/document/tracker_kind.hpp"

namespace veritrack::certificates {

const TrackerKind& dft_block_kind() {
  static const TrackerKind kind{.name = "dft-block-ekf",
                                .design_json = dft_block_design_json,
                                .certify = certify_dft_block,
                                .answers = dft_block_answers,
                                .sections = dft_block_sections,
                                .track = track_dft_block};
  return kind;
}

}  // namespace veritrack::certificates
