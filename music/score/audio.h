// music/score/audio.h: renders MIDI files as sound with the program FluidSynth.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

namespace sikku {

/// 16 bits, two channels, 44,100 frames a second in either.
enum class AudioFormat { wav, flac };

/// Called about ten times a second of work, with the seconds of sound rendered; an exception ends the work.
using AudioWatch = std::function<void(double seconds)>;

/// Maximum duration: that of a WAV file of 4 GB, 6 hours 45 minutes.
constexpr double most_audio_seconds = 24'347;

/// The soundfont that render_audio uses: the one named by the environment variable SIKKU_SOUNDFONT, else the first of
/// those that distributions install below /usr/share/sounds or /usr/share/soundfonts (default-GM before others, then
/// alphabetically).
/// @throws std::runtime_error if there is none (with a package to install), or if SIKKU_SOUNDFONT does not name a
/// readable file
std::filesystem::path find_soundfont();

/// Renders `midi` with the program `fluidsynth` found in PATH and writes `output`, which is replaced. The loudest
/// sample is at -1 dBFS; a score without sound stays silent. The sound is three seconds longer than the score, for
/// the last notes to fade (with FluidSynth 2.3). The same FluidSynth and soundfont give the same bytes each time.
///
/// Memory: a few hundred kB, besides that of FluidSynth and the soundfont. Disk: temporarily twice the size of the
/// WAV in the folder of `output`, in a file without a name, so that nothing is ever left behind. Cost: a second for
/// some hundred seconds of music.
///
/// `output` is written once the rendering has succeeded, from front to back.
/// @param shown  name of the output in messages, where `output` is a temporary file; empty: `output`
/// @return the loudest sample before scaling, in units of full scale; 0 if the soundfont has no sound for these keys
/// @throws std::runtime_error if fluidsynth or a soundfont is missing (with a package to install), if fluidsynth
///         fails (with its messages), if a file cannot be read or written, and for more sound than a WAV file of 4 GB
///         can contain, 6 hours 45 minutes
double render_audio(const std::filesystem::path& midi, const std::filesystem::path& output, AudioFormat format,
                    const AudioWatch& watch = {}, const std::filesystem::path& shown = {});

}  // namespace sikku
