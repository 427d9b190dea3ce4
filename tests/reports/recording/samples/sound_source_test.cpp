#include "reports/recording/samples/sound_source.hpp"

#include <doctest/doctest.h>
#include <sndfile.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "certificates/design/input_error.hpp"
#include "reports/recording/samples/open_recording.hpp"
#include "tests/support/scratch_folder.hpp"

namespace veritrack::reports {
namespace {

/// Interleaved samples as a file of this format.
void write_sound(const std::string& path, int format, int channels, const std::vector<double>& samples) {
  SF_INFO info{};
  info.channels = channels;
  info.samplerate = 8000;
  info.format = format;
  SNDFILE* file = sf_open(path.c_str(), SFM_WRITE, &info);
  REQUIRE(file != nullptr);
  sf_command(file, SFC_SET_CLIPPING, nullptr, SF_TRUE);
  REQUIRE(sf_write_double(file, samples.data(), static_cast<sf_count_t>(samples.size())) ==
          static_cast<sf_count_t>(samples.size()));
  sf_close(file);
}

std::vector<RecordedSample> all_of(SampleSource& source) {
  std::vector<RecordedSample> all(100000);
  all.resize(source.read(all));
  return all;
}

std::string message_of(const std::string& path, const SoundChannels& channels) {
  try {
    SoundSource source(path, channels);
    (void)all_of(source);
  } catch (const certificates::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST_CASE("samples of every format come out as they went in, to the last bit that it has") {
  const test::ScratchFolder scratch;
  std::vector<double> samples;
  for (int k = 0; k < 10000; ++k) {
    samples.push_back(0.9 * std::sin(0.1 * k));
  }
  const struct {
    const char* name;
    int format;
    double tolerance;
  } formats[] = {{"a.wav", SF_FORMAT_WAV | SF_FORMAT_PCM_16, 0x1p-15},
                 {"b.wav", SF_FORMAT_WAV | SF_FORMAT_PCM_24, 0x1p-23},
                 {"c.wav", SF_FORMAT_WAV | SF_FORMAT_DOUBLE, 0.0},
                 {"d.flac", SF_FORMAT_FLAC | SF_FORMAT_PCM_16, 0x1p-15},
                 {"e.aiff", SF_FORMAT_AIFF | SF_FORMAT_PCM_16, 0x1p-15},
                 {"f.ogg", SF_FORMAT_OGG | SF_FORMAT_VORBIS, 0.05}};
  for (const auto& [name, format, tolerance] : formats) {
    INFO(name);
    const std::string path = (scratch / name).string();
    write_sound(path, format, 1, samples);
    const auto source = open_recording({path, RecordingFormat::by_content, {}, {}});
    CHECK(source->channels() == 1);
    CHECK(source->sample_rate().value() == 8000.0);
    const auto read = all_of(*source);
    REQUIRE(read.size() == samples.size());
    double largest = 0.0;
    for (std::size_t k = 0; k < read.size(); ++k) {
      largest = std::max(largest, std::fabs(read[k].in_phase - samples[k]));
    }
    CHECK(largest <= tolerance);
    CHECK(source->progress().value() == doctest::Approx(1.0));
  }
}

TEST_CASE("channels are chosen, and more than one must be") {
  const test::ScratchFolder scratch;
  const std::string path = (scratch / "stereo.wav").string();
  write_sound(path, SF_FORMAT_WAV | SF_FORMAT_DOUBLE, 2, {0.1, 0.2, 0.3, 0.4});
  CHECK(message_of(path, {}).find("a sound file of 2 channels; allowed: --channel from 1 to 2") !=
        std::string::npos);
  CHECK(message_of(path, {3, false}).find("--channel from 1 to 2") != std::string::npos);
  SoundSource second(path, {2, false});
  CHECK(all_of(second)[1].in_phase == 0.4);
  SoundSource both(path, {std::nullopt, true});
  CHECK(both.channels() == 2);
  const auto samples = all_of(both);
  CHECK(samples[1].in_phase == 0.3);
  CHECK(samples[1].quadrature == 0.4);
  const std::string mono = (scratch / "mono.wav").string();
  write_sound(mono, SF_FORMAT_WAV | SF_FORMAT_DOUBLE, 1, {0.1});
  CHECK(message_of(mono, {std::nullopt, true}).find("of 1 channel; allowed: two channels") !=
        std::string::npos);
}

TEST_CASE("samples that are no numbers are missing") {
  const test::ScratchFolder scratch;
  const std::string path = (scratch / "nan.wav").string();
  write_sound(path, SF_FORMAT_WAV | SF_FORMAT_DOUBLE, 1,
              {0.1, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 0.4});
  SoundSource source(path, {});
  const auto samples = all_of(source);
  REQUIRE(samples.size() == 4);
  CHECK(samples[0].is_present);
  CHECK_FALSE(samples[1].is_present);
  CHECK_FALSE(samples[2].is_present);
  CHECK(samples[3].is_present);
}

TEST_CASE("what is no sound file is refused in one line") {
  const test::ScratchFolder scratch;
  for (const char* text : {"", "RIFF", "RIFF\x04\x00\x00\x00WAVE", "fLaCxxxxxxxxxxxx", "OggS", "hello"}) {
    const std::string path = (scratch / "broken").string();
    std::ofstream(path, std::ios::binary) << text;
    const std::string message = message_of(path, {});
    CHECK(message.find("no sound file that can be read") != std::string::npos);
    CHECK(message.find('\n') == std::string::npos);
  }
  CHECK(message_of((scratch / "missing.wav").string(), {}).find("no sound file") != std::string::npos);
}

}  // namespace
}  // namespace veritrack::reports
