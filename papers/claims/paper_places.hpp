// Where in a publication a claim stands: for the ledger of published claims (veritrack reproduce ledger).
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace veritrack::theorems {

/// The publications, in the order of the ledger.
enum class Paper {
  la_scala_1994,           ///< the thesis, with its errata sheet
  la_scala_bitmead_1996,   ///< the paper on the design of the quadrature tracker
  bittanti_savaresi_2000,  ///< the single-channel tracker
  praly_marconi_isidori,   ///< the KKL observer
  zarchan_slides,          ///< the four filters
  kang_song_lee,           ///< the first page of the paper on subset averaged median filters
  guan_chen_ueta,          ///< the first page of the paper on the pendulum
  cited                    ///< a theorem by others that the papers, or we, apply to the tracker
};

/// All of them, in that order.
inline constexpr std::array kAllPapers{Paper::la_scala_1994,          Paper::la_scala_bitmead_1996,
                                       Paper::bittanti_savaresi_2000, Paper::praly_marconi_isidori,
                                       Paper::zarchan_slides,         Paper::kang_song_lee,
                                       Paper::guan_chen_ueta,         Paper::cited};
static_assert(static_cast<std::size_t>(Paper::cited) + 1 == kAllPapers.size());

/// "B. F. La Scala, ...", for a heading.
[[nodiscard]] std::string_view to_string(Paper paper);

/// The relation of a claim to the publication.
enum class PaperRole {
  sentence,    ///< the publication asserts it
  hypothesis,  ///< the publication assumes it, and we ask whether its own tracker and design satisfy it
  repair       ///< ours: a corrected sentence
};

/// The place of one claim.
struct PaperPlace {
  Paper paper = Paper::la_scala_1994;
  PaperRole role = PaperRole::sentence;
  std::string place;        ///< e.g. "thesis, theorem 2.9, (2.43)", with the reading where there are two
  std::string_view repair;  ///< the claim proved in place of a false one; empty when there is none
};

/// Is this a claim about a publication? Our own theorems and claims about designs are not.
[[nodiscard]] bool is_published(std::string_view claim);

/// The place of a claim, by its id: of a statement, or "derivation/condition". Throws std::out_of_range when
/// it is not about a publication.
[[nodiscard]] PaperPlace paper_place(std::string_view claim);

}  // namespace veritrack::theorems
