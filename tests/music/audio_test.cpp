#include "music/score/audio.h"

#include "tests/checks.h"
#include "tests/files.h"
#include "tests/print_tools.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sikku::audio_test {

/// Sets an environment variable, or takes it away, for as long as this lives.
class Environment {
public:
    Environment(std::string name, const std::optional<std::string>& value) : name_(std::move(name)) {
        if (const char* old = std::getenv(name_.c_str())) old_ = old;
        set(value);
    }
    ~Environment() { set(old_); }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

private:
    void set(const std::optional<std::string>& value) {
        if (value) {
            ::setenv(name_.c_str(), value->c_str(), 1);
        } else {
            ::unsetenv(name_.c_str());
        }
    }
    std::string name_;
    std::optional<std::string> old_;
};

bool can_sound() {
    if (!has_program("fluidsynth")) return false;
    try {
        find_soundfont();
        return true;
    } catch (const std::runtime_error&) {
        return false;
    }
}

#define NEEDS_FLUIDSYNTH \
    if (!can_sound()) GTEST_SKIP() << "fluidsynth or a soundfont is not installed"

void put_big(std::string& out, std::uint32_t value, int bytes) {
    for (int i = bytes - 1; i >= 0; --i) out += static_cast<char>(value >> (8 * i) & 0xFF);
}

std::string variable_length(std::uint32_t value) {
    std::string bytes(1, static_cast<char>(value & 0x7F));
    while (value >>= 7) bytes.insert(bytes.begin(), static_cast<char>(0x80 | (value & 0x7F)));
    return bytes;
}

/// A MIDI file: keys after each other, each `ticks` long, 480 a quarter, 120 quarters a minute. A bend of 8192 is
/// none.
std::string midi(const std::vector<int>& keys, std::uint32_t ticks, int velocity = 80, std::uint32_t bend = 8192,
                 int program = 0) {
    std::string track;
    track += std::string("\0\xFF\x51\x03\x07\xA1\x20", 7);
    track += std::string("\0\xC0", 2) + static_cast<char>(program);
    track += std::string("\0\xE0", 2) + static_cast<char>(bend & 0x7F) + static_cast<char>(bend >> 7);
    for (const int key : keys) {
        track += std::string("\0\x90", 2) + static_cast<char>(key) + static_cast<char>(velocity);
        track += variable_length(ticks) + std::string("\x80") + static_cast<char>(key) + std::string("\x40");
    }
    track += std::string("\0\xFF\x2F\0", 4);
    std::string file = "MThd";
    put_big(file, 6, 4);
    put_big(file, 0, 2);
    put_big(file, 1, 2);
    put_big(file, 480, 2);
    file += "MTrk";
    put_big(file, static_cast<std::uint32_t>(track.size()), 4);
    return file + track;
}

std::uint64_t little(const std::string& bytes, std::size_t at, std::size_t count) {
    std::uint64_t value = 0;
    for (std::size_t i = count; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
    return value;
}

std::vector<std::int16_t> wav_samples(const std::string& bytes) {
    std::vector<std::int16_t> samples;
    for (std::size_t at = 44; at + 1 < bytes.size(); at += 2) {
        samples.push_back(static_cast<std::int16_t>(little(bytes, at, 2)));
    }
    return samples;
}

/// Of the loudest sample, in dB below full scale.
double peak_decibels(const std::vector<std::int16_t>& samples) {
    int peak = 0;
    for (const std::int16_t sample : samples) peak = std::max(peak, std::abs(static_cast<int>(sample)));
    return 20.0 * std::log10(peak / 32768.0);
}

/// The strongest frequency near `about` Hz in the left channel between two times, by the phase that it turns through
/// in a tenth of a second.
double frequency(const std::vector<std::int16_t>& samples, double about, double from) {
    constexpr double turn = 6.283185307179586;
    const auto phase = [&](double begin) {
        std::complex<double> sum = 0.0;
        const auto first = static_cast<std::size_t>(begin * 44100.0);
        const std::size_t count = 8820;
        for (std::size_t i = 0; i < count; ++i) {
            const double window = 0.5 - 0.5 * std::cos(turn * static_cast<double>(i) / static_cast<double>(count));
            sum += window * samples.at(2 * (first + i)) *
                   std::polar(1.0, -turn * about * static_cast<double>(first + i) / 44100.0);
        }
        return std::arg(sum);
    };
    constexpr double apart = 0.1;
    const double turned = std::remainder(phase(from + apart) - phase(from), turn);
    return about + turned / turn / apart;
}

TEST(Audio, WavHasAHeadAndItsPeakJustBelowFullScale) {
    NEEDS_FLUIDSYNTH;
    const ScratchFolder folder;
    // One quiet note, and a loud scale: the peak is the same.
    for (const int velocity : {1, 20, 127}) {
        folder.write("x.mid", midi({60, 62, 64}, 480, velocity));
        render_audio(folder / "x.mid", folder / "x.wav", AudioFormat::wav);
        const std::string bytes = contents(folder / "x.wav");
        ASSERT_GT(bytes.size(), 44U);
        EXPECT_EQ(bytes.substr(0, 4), "RIFF");
        EXPECT_EQ(little(bytes, 4, 4), bytes.size() - 8);
        EXPECT_EQ(bytes.substr(8, 8), "WAVEfmt ");
        EXPECT_EQ(little(bytes, 16, 4), 16U);
        EXPECT_EQ(little(bytes, 20, 2), 1U);
        EXPECT_EQ(little(bytes, 22, 2), 2U);
        EXPECT_EQ(little(bytes, 24, 4), 44100U);
        EXPECT_EQ(little(bytes, 28, 4), 176400U);
        EXPECT_EQ(little(bytes, 32, 2), 4U);
        EXPECT_EQ(little(bytes, 34, 2), 16U);
        EXPECT_EQ(bytes.substr(36, 4), "data");
        EXPECT_EQ(little(bytes, 40, 4), bytes.size() - 44);
        EXPECT_NEAR(peak_decibels(wav_samples(bytes)), -1.0, 0.01) << velocity;
        // Three quarters take 1.5 s; then at most a few seconds of fading.
        const double seconds = static_cast<double>(bytes.size() - 44) / 176400.0;
        EXPECT_GE(seconds, 1.5);
        EXPECT_LE(seconds, 1.5 + 4.0);
    }
    // Nothing is left beside the files.
    std::vector<std::string> names = folder.names();
    std::sort(names.begin(), names.end());
    EXPECT_EQ(names, (std::vector<std::string>{"x.mid", "x.wav"}));
}

TEST(Audio, FlacHoldsTheSamplesOfTheWav) {
    NEEDS_FLUIDSYNTH;
    const ScratchFolder folder;
    // Over 128 frames of the format, so that their numbers take two bytes.
    std::vector<int> keys;
    for (int i = 0; i < 24; ++i) keys.push_back(48 + 7 * i % 36);
    folder.write("x.mid", midi(keys, 480));
    render_audio(folder / "x.mid", folder / "x.wav", AudioFormat::wav);
    render_audio(folder / "x.mid", folder / "x.flac", AudioFormat::flac);
    const std::string flac = contents(folder / "x.flac");
    EXPECT_EQ(flac.substr(0, 4), "fLaC");
    EXPECT_LT(flac.size(), contents(folder / "x.wav").size() * 3 / 4);
    NEEDS("flac");
    ToolOutcome outcome = run_tool("flac --warnings-as-errors -s -t '" + folder.file("x.flac") + "'");
    EXPECT_TRUE(outcome.ok) << outcome.text;
    outcome = run_tool("flac -s -d -o '" + folder.file("back.wav") + "' '" + folder.file("x.flac") + "'");
    EXPECT_TRUE(outcome.ok) << outcome.text;
    EXPECT_TRUE(contents(folder / "back.wav") == contents(folder / "x.wav"));
}

TEST(Audio, IsTheSameEachTime) {
    NEEDS_FLUIDSYNTH;
    const ScratchFolder folder;
    folder.write("x.mid", midi({60, 67, 72}, 240));
    for (const AudioFormat format : {AudioFormat::wav, AudioFormat::flac}) {
        render_audio(folder / "x.mid", folder / "a", format);
        render_audio(folder / "x.mid", folder / "b", format);
        EXPECT_TRUE(contents(folder / "a") == contents(folder / "b"));
    }
}

TEST(Audio, IgnoresTheUsersSettings) {
    NEEDS_FLUIDSYNTH;
    const ScratchFolder folder;
    folder.write("x.mid", midi({60}, 480));
    folder.write(".fluidsynth", "tuning oops 0 0\ngain 9\n");
    render_audio(folder / "x.mid", folder / "a", AudioFormat::wav);
    const Environment home("HOME", folder.path().string());
    render_audio(folder / "x.mid", folder / "b", AudioFormat::wav);
    EXPECT_TRUE(contents(folder / "a") == contents(folder / "b"));
}

TEST(Audio, SoundsAtThePitchThatIsWritten) {
    NEEDS_FLUIDSYNTH;
    const ScratchFolder folder;
    // A4, and a quarter tone above it: a bend of 50 cents where the range is the 200 of General MIDI. A clarinet
    // holds its pitch.
    for (const auto& [bend, cents] : {std::pair(8192U, 0.0), std::pair(8192U + 2048U, 50.0)}) {
        folder.write("x.mid", midi({69}, 960, 80, bend, 71));
        render_audio(folder / "x.mid", folder / "x.wav", AudioFormat::wav);
        const double expected = 440.0 * std::exp2(cents / 1200.0);
        const double heard = frequency(wav_samples(contents(folder / "x.wav")), expected, 0.4);
        EXPECT_NEAR(1200.0 * std::log2(heard / expected), 0.0, 6.0) << heard;
    }
}

TEST(Audio, SilenceStaysSilent) {
    NEEDS_FLUIDSYNTH;
    const ScratchFolder folder;
    // A note that sounds in none of the voices: key 60 with velocity 0 ends one.
    folder.write("x.mid", midi({60}, 480, 0));
    render_audio(folder / "x.mid", folder / "x.wav", AudioFormat::wav);
    const std::vector<std::int16_t> samples = wav_samples(contents(folder / "x.wav"));
    ASSERT_FALSE(samples.empty());
    EXPECT_TRUE(std::all_of(samples.begin(), samples.end(), [](std::int16_t sample) { return sample == 0; }));
    render_audio(folder / "x.mid", folder / "x.flac", AudioFormat::flac);
    EXPECT_LT(contents(folder / "x.flac").size(), samples.size() / 50);
    if (has_program("flac")) {
        const ToolOutcome outcome = run_tool("flac --warnings-as-errors -s -t '" + folder.file("x.flac") + "'");
        EXPECT_TRUE(outcome.ok) << outcome.text;
    }
}

TEST(Audio, NamesAreNoOptions) {
    NEEDS_FLUIDSYNTH;
    const ScratchFolder folder;
    folder.write("-g 9 'x' $(y).mid", midi({60}, 480));
    render_audio(folder / "-g 9 'x' $(y).mid", folder / "-x .wav", AudioFormat::wav);
    EXPECT_GT(contents(folder / "-x .wav").size(), 44U);
    const auto old = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    EXPECT_NO_THROW(render_audio("-g 9 'x' $(y).mid", "y.wav", AudioFormat::wav));
    std::filesystem::current_path(old);
    EXPECT_TRUE(contents(folder / "y.wav") == contents(folder / "-x .wav"));
}

TEST(Audio, TheWatchMayEndTheWork) {
    NEEDS_FLUIDSYNTH;
    const ScratchFolder folder;
    folder.write("x.mid", midi({60, 62, 64}, 480 * 200));
    folder.write("x.wav", "as it was");
    double last = 0.0;
    struct Enough {};
    const auto watch = [&](double seconds) {
        EXPECT_GE(seconds, last);
        last = seconds;
        if (seconds > 30.0) throw Enough();
    };
    EXPECT_THROW(render_audio(folder / "x.mid", folder / "x.wav", AudioFormat::wav, watch), Enough);
    EXPECT_LT(last, 250.0);
    EXPECT_EQ(contents(folder / "x.wav"), "as it was");
    EXPECT_EQ(folder.names().size(), 2U);
}

std::string failure(const ScratchFolder& folder, const std::string& midi_name = "x.mid",
                    const std::string& output = "x.wav") {
    try {
        render_audio(folder / midi_name, folder / output, AudioFormat::wav);
    } catch (const std::runtime_error& error) {
        EXPECT_FALSE(std::filesystem::exists(folder / "x.wav"));
        return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return "";
}

TEST(Audio, TellsWhatToInstall) {
    const ScratchFolder folder;
    folder.write("x.mid", midi({60}, 480));
    const Environment path("PATH", folder.path().string());
    const std::string message = failure(folder);
    EXPECT_TRUE(has(message, "fluidsynth"));
    EXPECT_TRUE(has(message, "apt install fluidsynth timgm6mb-soundfont"));
}

TEST(Audio, RefusesASoundfontThatIsNone) {
    NEEDS_FLUIDSYNTH;
    const ScratchFolder folder;
    folder.write("x.mid", midi({60}, 480));
    {
        const Environment soundfont("SIKKU_SOUNDFONT", folder.file("none.sf2"));
        EXPECT_TRUE(has(failure(folder), "SIKKU_SOUNDFONT"));
        EXPECT_THROW(find_soundfont(), std::runtime_error);
    }
    {
        const Environment soundfont("SIKKU_SOUNDFONT", folder.write("bad.sf2", "no soundfont at all"));
        EXPECT_TRUE(has(failure(folder), "bad.sf2"));
    }
}

TEST(Audio, RefusesAMidiFileThatIsNone) {
    NEEDS_FLUIDSYNTH;
    const ScratchFolder folder;
    EXPECT_TRUE(has(failure(folder), "x.mid"));
    folder.write("x.mid", "no MIDI at all");
    EXPECT_TRUE(has(failure(folder), "fluidsynth"));
}

TEST(Audio, RefusesAFolderThatIsNotThere) {
    NEEDS_FLUIDSYNTH;
    const ScratchFolder folder;
    folder.write("x.mid", midi({60}, 480));
    EXPECT_TRUE(has(failure(folder, "x.mid", "none/x.wav"), "none"));
}

/// Another program of that name, first in PATH.
std::string with_impostor(const std::string& script) {
    const ScratchFolder folder;
    folder.write("x.mid", midi({60}, 480));
    folder.write("some.sf2", "anything");
    ::chmod(folder.write("fluidsynth", "#!/bin/sh\n" + script).c_str(), 0755);
    const Environment path("PATH", folder.path().string() + ":" + std::getenv("PATH"));
    const Environment soundfont("SIKKU_SOUNDFONT", folder.file("some.sf2"));
    return failure(folder);
}

TEST(Audio, TellsWhatFluidsynthSaid) {
    const std::string message = with_impostor("echo 'it rains'; echo 'and pours' >&2; exit 3\n");
    EXPECT_TRUE(has(message, "status 3"));
    EXPECT_TRUE(has(message, "it rains"));
    EXPECT_TRUE(has(message, "and pours"));
    EXPECT_TRUE(has(with_impostor("kill -9 $$\n"), "signal 9"));
    EXPECT_TRUE(has(with_impostor("exit 0\n"), "nothing"));
    // Four bytes that are no number, many times.
    EXPECT_TRUE(has(with_impostor("for i in 1 2 3 4 5 6 7 8; do printf '\\377\\377\\377\\177' >&3; done\n"),
                    "no readable sound"));
    // Very much of it does not fill a pipe and hang.
    EXPECT_TRUE(has(with_impostor("i=0; while [ $i -lt 20000 ]; do echo 0123456789; i=$((i+1)); done; exit 1\n"),
                    "0123456789"));
}

/// Messages name the output that the user named, not the temporary file beside it.
TEST(Audio, FailuresNameTheOutput) {
    NEEDS_FLUIDSYNTH;
    const ScratchFolder folder;
    folder.write("x.mid", midi({60}, 480));
    EXPECT_TRUE(has(error_of<std::runtime_error>(
                        [&] { render_audio(folder / "x.mid", "/dev/full", AudioFormat::wav, {}, "my music.wav"); }),
                    "cannot write 'my music.wav': "));
}

TEST(Audio, IsWrittenWholeOrTheFailureIsTold) {
    NEEDS_FLUIDSYNTH;
    const ScratchFolder folder;
    folder.write("x.mid", midi({60}, 480));
    EXPECT_TRUE(
        has(error_of<std::runtime_error>([&] { render_audio(folder / "x.mid", "/dev/full", AudioFormat::wav); }),
            "/dev/full"));
}

}  // namespace sikku::audio_test
