#include "checker/quadrature/steady_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "checker/document/evidence.hpp"
#include "checker/numbers/budget.hpp"

namespace veritrack::checker {

namespace {

/// The frequencies of a piece, exact.
struct PieceEnds {
  Ball from, to;
};

std::optional<PieceEnds> ends_of(const Tree& item) {
  const Tree& numbers = item.at("numbers");
  const Tree* from = numbers.find("from");
  const Tree* to = numbers.find("to");
  if (from == nullptr && to == nullptr) {
    return std::nullopt;
  }
  return PieceEnds{exact_number(numbers.at("from")), exact_number(numbers.at("to"))};
}

/// The pieces follow each other from the lowest frequency to the highest, each beginning where the one before
/// ends or sooner: what they cover has no gap.
bool cover_band(const std::vector<PieceEnds>& ends, const Design& design) {
  bool cover = !ends.empty() && certainly_at_most(ends.front().from, design.lowest_frequency) &&
               certainly_at_most(design.highest_frequency, ends.back().to);
  for (std::size_t k = 0; k < ends.size(); ++k) {
    cover = cover && certainly_less(ends[k].from, ends[k].to) &&
            (k == 0 || certainly_at_most(ends[k].from, ends[k - 1].to));
  }
  return cover;
}

/// A large set needs to know the steady state better.
SteadyPiece check_piece(const Tree& item, const Design& design, const std::vector<SteadyCell>& wide,
                        const std::vector<SteadyCell>& narrow, std::int64_t& cells, Objections& objections) {
  Objections coarse;
  SteadyPiece piece{check_steady_set(item, design, wide, cells, coarse), {}};
  if (!piece.set.verified) {
    piece.set = check_steady_set(item, design, narrow, cells, objections);
  }
  if (piece.set.verified) {
    // A certificate chooses how many pieces there are.
    spend(static_cast<std::int64_t>(narrow.size() * sizeof(SteadyCell)));
    piece.cells = narrow;
  }
  return piece;
}

bool is_for_a_purpose(const Tree& name) {
  return name.is("start-error") || name.is("frequency-error-radius") || name.is("largest-noise") ||
         name.is("largest-slew");
}

/// Several pieces: what one set alone need not satisfy.
bool verify_pieces(const SteadyPieces& cover, const std::vector<PieceEnds>& ends, const Design& design,
                   Objections& objections) {
  bool verified = cover.verified;
  if (!cover_band(ends, design)) {
    objections.push_back("the sets " + cover.name + " do not cover the band of frequencies");
    verified = false;
  }
  for (const SteadyPiece& piece : cover.pieces) {
    if (!certainly_equal(piece.set.slew, zero)) {
      objections.push_back("a set " + cover.name + " is for a piece of the band, which a slew may leave");
      verified = false;
    }
  }
  return verified;
}

}  // namespace

std::vector<SteadyCell> part_of(const std::vector<SteadyCell>& branch, const Ball& from, const Ball& to) {
  std::vector<SteadyCell> part;
  for (SteadyCell cell : branch) {
    cell.from = std::fmax(cell.from, from.near());
    cell.to = std::fmin(cell.to, to.near());
    if (cell.from < cell.to) {
      cell.frequency = Ball::hull(Ball(cell.from), Ball(cell.to));
      part.push_back(std::move(cell));
    }
  }
  return part;
}

std::vector<SteadyPieces> check_steady_covers(const Tree& evidence, const Design& design,
                                              const SteadyBranches& branches, std::int64_t& cells,
                                              Objections& objections) {
  std::vector<SteadyPieces> covers;
  std::vector<PieceEnds> ends;  // of the pieces of the last cover; none when it is one set for the whole band
  const auto finish = [&] {
    if (!covers.empty() && !ends.empty()) {
      covers.back().verified = verify_pieces(covers.back(), ends, design, objections);
    }
    ends.clear();
  };
  for (const Tree& item : evidence.elements()) {
    const Tree& name = item.at("name");
    if (name.is("start-covariance")) {
      continue;
    }
    if (!is_for_a_purpose(name)) {
      objections.emplace_back("no set is for this purpose");
      continue;
    }
    const std::optional<PieceEnds> piece = ends_of(item);
    if (!piece || ends.empty() || !name.is(covers.back().name)) {
      finish();
      covers.push_back({name.text(), {}, true});
    }
    const auto cut = [&](const std::vector<SteadyCell>& branch) {
      return piece ? part_of(branch, piece->from, piece->to) : branch;
    };
    SteadyPieces& cover = covers.back();
    cover.pieces.push_back(
        check_piece(item, design, cut(branches.wide), cut(branches.narrow), cells, objections));
    if (piece) {
      ends.push_back(*piece);
    }
    // Without any steady state every set would be true.
    cover.verified = cover.verified && cover.pieces.back().set.verified && !cover.pieces.back().cells.empty();
  }
  finish();
  return covers;
}

Ball noise_of(const SteadyPieces& cover) {
  Ball least = cover.pieces.front().set.noise;
  for (const SteadyPiece& piece : cover.pieces) {
    least = min(least, piece.set.noise);
  }
  return least;
}

Ball slew_of(const SteadyPieces& cover) {
  Ball least = cover.pieces.front().set.slew;
  for (const SteadyPiece& piece : cover.pieces) {
    least = min(least, piece.set.slew);
  }
  return least;
}

std::array<Ball, 3> error_radii(const SteadyPieces& cover) {
  std::array<Ball, 3> least = error_radii(cover.pieces.front().set);
  for (const SteadyPiece& piece : cover.pieces) {
    const std::array<Ball, 3> radii = error_radii(piece.set);
    for (std::size_t i = 0; i < 3; ++i) {
      least[i] = min(least[i], radii[i]);
    }
  }
  return least;
}

Ball slowest(const SteadyPieces& cover) {
  Ball rate = zero;
  for (const SteadyPiece& piece : cover.pieces) {
    const std::vector<Ball>& levels = piece.set.levels;
    rate = levels.size() > 1 ? rate : max(rate, one);
    for (std::size_t j = 1; j < levels.size(); ++j) {
      rate = max(rate, levels[j] / levels[j - 1]);
    }
  }
  return rate;
}

namespace {

/// At least |x3 - omega| at that level of each set.
Ball error_at(const SteadyPieces& cover, const Ball& (*level)(const std::vector<Ball>& levels)) {
  Ball most = zero;
  for (const SteadyPiece& piece : cover.pieces) {
    const Ball about = level(piece.set.levels) * error_radii(piece.set)[2];
    for (const SteadyCell& cell : piece.cells) {
      most = max(most, abs(cell.at(cell.frequency)[2]) + about);
    }
  }
  return most;
}

}  // namespace

Ball ultimate_error(const SteadyPieces& cover) {
  return error_at(cover, [](const std::vector<Ball>& levels) -> const Ball& { return levels.back(); });
}

Ball largest_error(const SteadyPieces& cover) {
  return error_at(cover, [](const std::vector<Ball>& levels) -> const Ball& { return levels.front(); });
}

std::optional<SteadyStart> steady_start(const Design& design, const SteadyPieces& cover,
                                        const StartCovariance& covariance, const SteadyStartClaim& claim) {
  SteadyStart all;
  for (const SteadyPiece& piece : cover.pieces) {
    const auto found = steady_start(design, piece.set, piece.cells, covariance, claim);
    if (!found) {
      return std::nullopt;
    }
    all = {max(all.samples, found->samples), max(all.level, found->level), max(all.bound, found->bound),
           max(all.settling, found->settling)};
  }
  return all;
}

}  // namespace veritrack::checker
