// The meaning of lines, by weight and dash, the same in every figure: figures must be readable in grey.
#pragma once

namespace veritrack::reports::line {

constexpr const char* kCertified = "lw 3 lc rgb '#000000'";
constexpr const char* kLongRun = "lw 1.8 dt '-.' lc rgb '#000000'";   ///< certified, in the long run
constexpr const char* kAssumed = "lw 1.8 dt '-' lc rgb '#000000'";    ///< certified, for the assumed starts
constexpr const char* kRequired = "lw 1.8 dt '_' lc rgb '#000000'";   ///< by [require]
constexpr const char* kPublished = "lw 1.8 dt '.' lc rgb '#000000'";  ///< a published theorem
constexpr const char* kSimulated = "lw 1.2 lc rgb '#777777'";
constexpr const char* kSignal = "lw 5 lc rgb '#cccccc'";  ///< the truth, or a whole that has parts

}  // namespace veritrack::reports::line
