#include "reports/recording/samples/sound_source.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "certificates/design/input_error.hpp"

namespace veritrack::reports {

namespace {

constexpr int kMostChannels = 64;
constexpr std::size_t kFrames = 4096;

}  // namespace

SoundSource::SoundSource(const std::string& path, const SoundChannels& channels)
    : name_(path == "-" ? "standard input" : path) {
  SF_INFO info{};
  file_.reset(path == "-" ? sf_open_fd(::dup(STDIN_FILENO), SFM_READ, &info, SF_TRUE)
                          : sf_open(path.c_str(), SFM_READ, &info));
  if (!file_) {
    std::string reason = sf_strerror(nullptr);
    reason.erase(reason.find_last_not_of(". \n") + 1);
    throw certificates::InputError(name_, {}, "no sound file that can be read: " + reason);
  }
  if (info.channels < 1 || info.channels > kMostChannels || info.samplerate < 1) {
    throw certificates::InputError(name_, {},
                                   fmt::format("{} channels at {} Hz; allowed: 1 to {} channels",
                                               info.channels, info.samplerate, kMostChannels));
  }
  const auto refuse = [&](const std::string& allowed) {
    throw certificates::InputError(name_, {},
                                   fmt::format("a sound file of {} channel{}; allowed: {}", info.channels,
                                               info.channels == 1 ? "" : "s", allowed));
  };
  if (channels.quadrature) {
    if (info.channels < 2) {
      refuse("two channels with --quadrature");
    }
    second_ = 1;
  } else if (channels.channel) {
    if (*channels.channel < 1 || *channels.channel > info.channels) {
      refuse(fmt::format("--channel from 1 to {}", info.channels));
    }
    first_ = static_cast<std::size_t>(*channels.channel - 1);
  } else if (info.channels > 1) {
    refuse(
        fmt::format("--channel from 1 to {}, or --quadrature when the first two are in phase and "
                    "quadrature",
                    info.channels));
  }
  width_ = static_cast<std::size_t>(info.channels);
  sample_rate_ = info.samplerate;
  // The header of a stream says nothing or too much.
  frames_ = path != "-" && info.frames > 0 && info.frames < SF_COUNT_MAX ? info.frames : 0;
  buffer_.resize(kFrames * width_);
}

std::size_t SoundSource::read(std::span<RecordedSample> block) {
  std::size_t count = 0;
  while (count < block.size()) {
    const std::size_t wanted = std::min(kFrames, block.size() - count);
    const sf_count_t got = sf_readf_double(file_.get(), buffer_.data(), static_cast<sf_count_t>(wanted));
    if (sf_error(file_.get()) != SF_ERR_NO_ERROR) {
      throw certificates::InputError(
          name_, {}, fmt::format("cannot be read after {} samples: {}", taken_, sf_strerror(file_.get())));
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(std::max<sf_count_t>(got, 0)); ++i) {
      const double in_phase = buffer_[i * width_ + first_];
      const double quadrature = second_ ? buffer_[i * width_ + *second_] : 0.0;
      block[count++] = std::isfinite(in_phase) && std::isfinite(quadrature)
                           ? RecordedSample{in_phase, quadrature, true}
                           : RecordedSample{0.0, 0.0, false};
    }
    taken_ += std::max<sf_count_t>(got, 0);
    if (got < static_cast<sf_count_t>(wanted)) {
      break;
    }
  }
  return count;
}

std::optional<double> SoundSource::progress() const {
  if (frames_ <= 0) {
    return std::nullopt;
  }
  return std::min(1.0, static_cast<double>(taken_) / static_cast<double>(frames_));
}

}  // namespace veritrack::reports
