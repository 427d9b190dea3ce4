// Standard output as a result that may fail to arrive.
#pragma once

namespace veritrack::cli {

/// To be called first: a standard stream that is closed is opened to nowhere, so that no file that the
/// program opens takes its place, and a reader that goes away is an error like any other and no signal.
void prepare_standard_streams();

/// Writes what was printed so far. That it cannot be written is for finish_standard_output to say.
void flush_standard_output();

/// Throws std::runtime_error when what was printed to standard output has not all been written.
void finish_standard_output();

}  // namespace veritrack::cli
